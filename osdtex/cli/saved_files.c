/* saved_files.c -- asking the saved mapping for them, once. */
#include "cli/saved_files.h"

#include "cli/spool.h"

#include <stdlib.h>
#include <string.h>

static void
add(void *user, osdtex_saved_file file, const char *path)
{
    otx_flag_saved *s = user;

    if (s->count == OTX_FLAG_SAVED_MAX)
        return;
    s->exemplars += file == OSDTEX_SAVED_EXEMPLAR;
    s->files[s->count] = strdup(path);
    s->out_of_memory |= !s->files[s->count];
    ++s->count;
}

osdtex_status
otx_saved_files_take(otx_session *session, otx_flag_values *values)
{
    osdtex_status status;

    if (!values->saved)
        return OSDTEX_OK;
    status = osdtex_mapping_files(
        session->context, values->saved, add, &values->of_saved);
    return status == OSDTEX_OK && values->of_saved.out_of_memory
               ? OSDTEX_ERROR_MEMORY
               : status;
}

void
otx_saved_files_free(otx_flag_values *values)
{
    for (int i = 0; i < values->of_saved.count; ++i)
        free(values->of_saved.files[i]);
    values->of_saved.count = 0;
}

const char *
otx_saved_files_source(const otx_flag_values *values)
{
    return values->operand_count == 0 && values->of_saved.count > 0
               ? values->of_saved.files[0]
               : otx_spool_name(values, values->operands[0]);
}

int
otx_saved_files_exemplars(const otx_flag_values *values)
{
    return values->of_saved.exemplars;
}

/* saved_files.c -- asking the saved mapping for them, once. */
#include "cli/saved_files.h"

#include "cli/spool.h"

#include <jansson.h>
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

/* Bit k: a map of kind k is in the list. */
static uint32_t
kinds_of(const json_t *list)
{
    uint32_t kinds = 0;
    json_t *map;
    size_t i;

    json_array_foreach(list, i, map)
    {
        const char *name = json_string_value(json_object_get(map, "kind"));

        for (int k = 0; name && k < OSDTEX_MAP_KINDS; ++k)
            if (strcmp(name, osdtex_map_kind_name(k)) == 0)
                kinds |= 1u << k;
    }
    return kinds;
}

/* What the library has checked. */
static void
add_kinds(void *user, const char *about)
{
    otx_flag_saved *s = user;
    json_t *root = json_loads(about, 0, NULL), *exemplar;
    size_t k;

    s->out_of_memory |= !root;
    json_array_foreach(
        json_object_get(root, "exemplars"), k,
        exemplar) if (k < OSDTEX_EXEMPLARS_MAX) s->maps[k] =
        kinds_of(json_object_get(exemplar, "maps"));
    json_decref(root);
}

osdtex_status
otx_saved_files_take(otx_session *session, otx_flag_saved *saved)
{
    osdtex_status status;

    if (!saved->path)
        return OSDTEX_OK;
    status = osdtex_mapping_files(session->context, saved->path, add, saved);
    if (status == OSDTEX_OK)
        status = osdtex_mapping_inspect(
            session->context, saved->path, add_kinds, saved);
    return status == OSDTEX_OK && saved->out_of_memory ? OSDTEX_ERROR_MEMORY
                                                       : status;
}

void
otx_saved_files_free(otx_flag_saved *saved)
{
    for (int i = 0; i < saved->count; ++i)
        free(saved->files[i]);
    saved->count = 0;
}

const char *
otx_saved_files_source(const otx_flag_values *values)
{
    return values->operand_count == 0 && values->inputs.saved.count > 0
               ? values->inputs.saved.files[0]
               : otx_spool_name(values, values->operands[0]);
}

int
otx_saved_files_exemplars(const otx_flag_values *values)
{
    return values->inputs.saved.exemplars;
}

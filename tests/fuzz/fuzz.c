/* fuzz.c -- files for readers that take a path, and what is true of them all.
 */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static char folder[64];
static char path[512];

static void
remove_folder(void)
{
    DIR *dir = opendir(folder);

    for (struct dirent *e; dir && (e = readdir(dir));)
    {
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        unlink(path);
    }
    if (dir)
        closedir(dir);
    rmdir(folder);
}

const char *
fuzz_folder(void)
{
    if (*folder)
        return folder;
    strcpy(folder, "/tmp/osdtex-fuzz-XXXXXX");
    fuzz_check(mkdtemp(folder));
    atexit(remove_folder);
    return folder;
}

const char *
fuzz_file(const char *name, const uint8_t *data, size_t size)
{
    FILE *file;

    snprintf(path, sizeof path, "%s/%s", fuzz_folder(), name);
    file = fopen(path, "wb");
    fuzz_check(file && fwrite(data, 1, size, file) == size);
    fuzz_check(fclose(file) == 0);
    return path;
}

osdtex_context *
fuzz_context(void)
{
    osdtex_context_options options = osdtex_context_options_default();
    osdtex_context *context;

    options.memory_limit = (size_t)256 << 20;
    options.threads = 1;
    fuzz_check(osdtex_context_create(&options, &context) == OSDTEX_OK);
    return context;
}

void
fuzz_judge(const osdtex_context *context, osdtex_status status, const void *out)
{
    const osdtex_diagnostic *error = osdtex_context_error(context);

    fuzz_check((status == OSDTEX_OK) == (out != NULL));
    fuzz_check(status != OSDTEX_ERROR_INTERNAL);
    if (status != OSDTEX_OK)
        fuzz_check(error->status == status && strlen(error->message) > 3);
}

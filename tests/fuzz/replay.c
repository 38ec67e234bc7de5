/* replay.c -- calls a fuzz target with files, or with all files of folders. */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

static int
replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    uint8_t *data = NULL;
    long size = -1;

    if (file && fseek(file, 0, SEEK_END) == 0)
        size = ftell(file);
    if (size >= 0)
        data = malloc((size_t)size + 1);
    if (!data || fseek(file, 0, SEEK_SET) != 0 ||
        fread(data, 1, (size_t)size, file) != (size_t)size)
    {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(1);
    }
    fclose(file);
    /* Said before, so that the last line of a crash names the file. */
    printf("%s\n", path);
    fflush(stdout);
    /* A block of its very size, so that sanitizers see its end. */
    uint8_t *exact = malloc((size_t)size + !size);
    memcpy(exact, data, (size_t)size);
    free(data);
    LLVMFuzzerTestOneInput(exact, (size_t)size);
    free(exact);
    return 1;
}

static int
replay_folder(const char *path)
{
    struct dirent **entries;
    const int count = scandir(path, &entries, NULL, alphasort);
    int replayed = 0;

    if (count < 0)
        return replay_file(path);
    for (int i = 0; i < count; ++i)
    {
        char name[4096];

        snprintf(name, sizeof name, "%s/%s", path, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.')
            replayed += replay_file(name);
        free(entries[i]);
    }
    free(entries);
    return replayed;
}

int
main(int argc, char **argv)
{
    int replayed = 0;

    for (int i = 1; i < argc; ++i)
        replayed += replay_folder(argv[i]);
    printf("%d inputs\n", replayed);
    return replayed > 0 ? 0 : 1;
}

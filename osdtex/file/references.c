/* references.c -- scanning for names of files, without parsing what is around
 * them. */
#include "file/references.h"

#include "file/udim_name.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum
{
    WORDS_MAX = 24 /* of a line; the words after them are passed over */
};

typedef struct scan
{
    void (*visit)(void *user, const char *path);
    void *user;
    bool out_of_memory;
} scan;

static void scan_file(scan *s, const char *path, bool is_mtl);

static bool
is_plain_file(const char *path)
{
    struct stat info;

    return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

/* Pictures are not searched. */
static bool
is_text(const char *path)
{
    char head[512];
    FILE *file = fopen(path, "rb");
    const size_t bytes = file ? fread(head, 1, sizeof head, file) : 0;

    if (file)
        fclose(file);
    return bytes > 0 && !memchr(head, 0, bytes);
}

static bool
ends_in(const char *path, const char *extension)
{
    const size_t length = strlen(path), tail = strlen(extension);

    return length > tail && strcasecmp(path + length - tail, extension) == 0;
}

/* Length of the folder part of a path, its slash included. */
static size_t
folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* ---- tiles ---------------------------------------------------------------*/

/* Whether a file's name fits a pattern with tokens in angle brackets. */
static bool
fits(const char *name, const char *pattern)
{
    const size_t head = strcspn(pattern, "<");
    const char *tail = strrchr(pattern, '>');
    const size_t end = tail ? strlen(tail + 1) : 0;
    const size_t size = strlen(name);

    return tail && size >= head + end && strncmp(name, pattern, head) == 0 &&
           strcmp(name + size - end, tail + 1) == 0;
}

static void
visit_tiles(scan *s, const char *pattern)
{
    const size_t folder = folder_length(pattern);
    char *path = malloc(folder + NAME_MAX + 2);
    struct dirent **entries = NULL;
    int count = -1;

    if (path)
    {
        memcpy(path, pattern, folder);
        strcpy(path + folder, folder > 0 ? "" : ".");
        count = scandir(path, &entries, NULL, alphasort);
    }
    for (int i = 0; i < count; ++i)
    {
        strcpy(path + folder, entries[i]->d_name);
        if (fits(entries[i]->d_name, pattern + folder) && is_plain_file(path))
            s->visit(s->user, path);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    s->out_of_memory |= !path;
    free(path);
}

/* ---- names in lines ------------------------------------------------------*/

/* One reading of a name, as seen from the folder of the file it stands in. */
static void
try_path(scan *s, const char *path)
{
    if (otx_udim_name_is_pattern(path))
        visit_tiles(s, path);
    if (!is_plain_file(path))
        return;
    s->visit(s->user, path);
    if (ends_in(path, ".mtl"))
        scan_file(s, path, true);
}

/* The name as it stands, with the slashes of this system, and, for names of
 * another machine, without its folders. */
static void
try_name(scan *s, const char *from, const char *name, size_t length)
{
    const size_t folder = folder_length(from);
    char *path = malloc(folder + length + 1);
    char *slash;

    if (!path)
    {
        s->out_of_memory = true;
        return;
    }
    snprintf(path, folder + length + 1, "%.*s", (int)folder, from);
    memcpy(path + folder, name, length);
    path[folder + length] = '\0';
    try_path(s, path[folder] == '/' ? path + folder : path);
    for (char *c = path + folder; *c; ++c)
        if (*c == '\\')
            *c = '/';
    if (path[folder] != '/')
        try_path(s, path);
    slash = strrchr(path + folder, '/');
    if (slash)
    {
        memmove(path + folder, slash + 1, strlen(slash));
        if (path[folder])
            try_path(s, path);
    }
    free(path);
}

/* Every run of words of a line, with its blanks and without quotes. */
static void
try_words(scan *s, const char *from, const char *text)
{
    const char *begin[WORDS_MAX], *end[WORDS_MAX];
    int count = 0;

    while (count < WORDS_MAX && *(text += strspn(text, " \t\"\r\n")))
    {
        begin[count] = text;
        text += strcspn(text, " \t\"\r\n");
        end[count++] = text;
    }
    for (int i = 0; i < count; ++i)
        for (int k = i; k < count; ++k)
            try_name(s, from, begin[i], (size_t)(end[k] - begin[i]));
}

static bool
is_word(const char *line, const char *word, const char **rest)
{
    const size_t length = strlen(word);

    line += strspn(line, " \t");
    if (strncasecmp(line, word, length) != 0)
        return false;
    *rest = line + length;
    return **rest == ' ' || **rest == '\t';
}

/* The words behind a keyword that names files; NULL for other lines. */
static const char *
names_of(const char *line, bool is_mtl)
{
    static const char *const of_obj[] = {
        "mtllib", "maplib", "shadow_obj", "trace_obj", "call", NULL};
    static const char *const of_mtl[] = {
        "bump", "disp", "decal", "refl", "norm", NULL};
    const char *const *words = is_mtl ? of_mtl : of_obj;
    const char *rest;

    for (; *words; ++words)
        if (is_word(line, *words, &rest))
            return rest;
    line += strspn(line, " \t");
    if (!is_mtl || strncasecmp(line, "map_", 4) != 0)
        return NULL;
    return line + strcspn(line, " \t");
}

/* Takes the next line with those that a backslash joins to it. */
static bool
next_line(FILE *file, char **line, size_t *bytes, scan *s)
{
    ssize_t length = getline(line, bytes, file);

    while (length > 1 && (*line)[length - 1] == '\n')
    {
        const ssize_t end =
            length - ((*line)[length - 2] == '\r' && length > 2 ? 3 : 2);
        char *more = NULL;
        size_t more_bytes = 0;
        const ssize_t added =
            (*line)[end] == '\\' ? getline(&more, &more_bytes, file) : -1;
        char *grown =
            added > 0 ? realloc(*line, (size_t)(end + added) + 2) : NULL;

        s->out_of_memory |= added > 0 && !grown;
        if (grown)
        {
            *line = grown;
            *bytes = (size_t)(end + added) + 2;
            grown[end] = ' ';
            memcpy(grown + end + 1, more, (size_t)added + 1);
        }
        free(more);
        if (!grown)
            break;
        length = end + 1 + added;
    }
    return length > 0;
}

static void
scan_file(scan *s, const char *path, bool is_mtl)
{
    FILE *file = fopen(path, "rb");
    size_t bytes = 0;
    char *line = NULL;

    while (file && next_line(file, &line, &bytes, s))
    {
        const char *names = names_of(line, is_mtl);

        if (names)
            try_words(s, path, names);
    }
    free(line);
    if (file)
        fclose(file);
}

/* Every word between quotes and commas that could be a file's: those that have
 * a dot and a letter. */
static void
scan_words(scan *s, const char *path)
{
    FILE *file = fopen(path, "rb");
    size_t length;
    int c;

    for (bool more = file != NULL; more;)
    {
        char name[PATH_MAX];
        bool dot = false, letter = false;

        for (length = 0; (c = getc(file)) != EOF && !strchr("\",\n\r[]{}", c);)
        {
            dot |= c == '.';
            letter |= (c | 32) >= 'a' && (c | 32) <= 'z';
            if (length < sizeof name && (length > 0 || c != ' '))
                name[length++] = (char)c;
        }
        if (dot && letter && length < sizeof name)
            try_name(s, path, name, length);
        more = c != EOF;
    }
    if (file)
        fclose(file);
}

otx_status
otx_references_visit(
    const char *path, void (*visit)(void *user, const char *path), void *user)
{
    scan s = {visit, user, false};

    if (otx_udim_name_is_pattern(path))
        visit_tiles(&s, path);
    if (is_plain_file(path))
    {
        visit(user, path);
        if (ends_in(path, ".mtl"))
            scan_file(&s, path, true);
        else if (ends_in(path, ".json") || ends_in(path, ".csv"))
            scan_words(&s, path);
        else if (is_text(path))
            scan_file(&s, path, false);
    }
    return s.out_of_memory ? OSDTEX_ERROR_MEMORY : OSDTEX_OK;
}

/* udim_name.c -- tokens in names, and what stands for them. */
#include "file/udim_name.h"

#include "image/udim.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

enum
{
    NUMBER_BYTES = 32
};

static const char *const TOKENS[] = {"<udim>", "<uvtile>"};

/* Where a token begins in the name of a file; NULL none. */
static const char *
find_token(const char *path, int *token)
{
    const char *slash = strrchr(path, '/');

    for (const char *at = slash ? slash : path; *at; ++at)
        for (int k = 0; k < 2; ++k)
            if (strncasecmp(at, TOKENS[k], strlen(TOKENS[k])) == 0)
            {
                *token = k;
                return at;
            }
    return NULL;
}

bool
otx_udim_name_is_pattern(const char *path)
{
    int token;

    return find_token(path, &token) != NULL;
}

const char *
otx_udim_name_of(otx_arena *arena, const char *pattern, int32_t tile)
{
    int token = 0;
    const char *at = find_token(pattern, &token);
    const size_t bytes = strlen(pattern) + NUMBER_BYTES;
    char *path = OTX_NEW(arena, char, bytes);
    char number[NUMBER_BYTES];

    if (!path || !at)
        return at ? path : pattern;
    if (token == 0)
        snprintf(number, sizeof number, "%d", (int)tile);
    else
        snprintf(
            number, sizeof number, "u%d_v%d", (int)otx_udim_column(tile) + 1,
            (int)otx_udim_row(tile) + 1);
    snprintf(
        path, bytes, "%.*s%s%s", (int)(at - pattern), pattern, number,
        at + strlen(TOKENS[token]));
    return path;
}

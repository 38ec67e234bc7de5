/* usda_name.c -- names as USD allows them. */
#include "file/usda_name.h"

#include <string.h>

static bool
is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

char *
otx_usda_identifier(otx_arena *arena, const char *name)
{
    const size_t length = strlen(name);
    const bool digit_first = length == 0 || (name[0] >= '0' && name[0] <= '9');
    char *out = OTX_NEW(arena, char, length + 2);
    char *to = out;

    if (!out)
        return NULL;
    if (digit_first)
        *to++ = '_';
    for (const char *c = name; *c; ++c)
        *to++ = is_letter(*c) || (*c >= '0' && *c <= '9') ? *c : '_';
    *to = '\0';
    return out;
}

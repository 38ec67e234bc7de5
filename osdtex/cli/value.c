/* value.c -- numbers, sizes and words. */
#include "cli/value.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A number that ends at `end` (a NUL or a comma). */
static bool
real_until(const char *text, char stop, double *out, const char **rest)
{
    char *end;
    double value;

    if (isspace((unsigned char)text[0]))
        return false;
    value = strtod(text, &end);
    if (end == text || *end != stop || !isfinite(value))
        return false;
    *out = value;
    *rest = end;
    return true;
}

bool
otx_value_real(const char *text, double *out)
{
    const char *rest;

    return real_until(text, '\0', out, &rest);
}

bool
otx_value_reals(const char *text, int count, double *out)
{
    for (int i = 0; i < count; ++i)
    {
        const char stop = i + 1 < count ? ',' : '\0';

        if (!real_until(text, stop, &out[i], &text))
            return false;
        text += stop == ',';
    }
    return true;
}

bool
otx_value_int(const char *text, int64_t low, int64_t high, int64_t *out)
{
    char *end;
    long long value;

    if (isspace((unsigned char)text[0]))
        return false;
    errno = 0;
    value = strtoll(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < low ||
        value > high)
        return false;
    *out = value;
    return true;
}

bool
otx_value_bytes(const char *text, size_t *out)
{
    static const char suffixes[] = "KMGT";
    char *end;
    const char *suffix;
    double value;

    if (!isdigit((unsigned char)text[0]))
        return false;
    value = strtod(text, &end);
    suffix = *end ? strchr(suffixes, toupper((unsigned char)*end)) : NULL;
    if (suffix)
    {
        value = ldexp(value, 10 * (int)(suffix - suffixes + 1));
        ++end;
    }
    /* 2^62 bytes are enough, and far from what a size_t cannot hold. */
    if (*end != '\0' || !(value < 0x1p62))
        return false;
    *out = (size_t)value;
    return true;
}

bool
otx_value_word(const char *text, const char *const *words, int count, int *out)
{
    for (int i = 0; i < count; ++i)
    {
        if (strcasecmp(text, words[i]) == 0)
        {
            *out = i;
            return true;
        }
    }
    return false;
}

bool
otx_value_has_extension(const char *path, const char *extension)
{
    const size_t length = strlen(path), tail = strlen(extension);

    return length > tail && strcasecmp(path + length - tail, extension) == 0;
}

const char *
otx_value_map_of(const char *text)
{
    static const char lead[] = "map:";
    const char *name = text && *text == '-' ? text + 1 : text;

    return name && strncmp(name, lead, strlen(lead)) == 0 ? name + strlen(lead)
                                                          : NULL;
}

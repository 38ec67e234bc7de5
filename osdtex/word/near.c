/* near.c -- optimal string alignment distance [Damerau64]. */
#include "word/near.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum
{
    NAME_MAX_BYTES = 63,
    SUGGESTIONS = 3,
    FAR_AWAY = 1000
};

static int
lower(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : (unsigned char)c;
}

static int32_t
least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

int32_t
otx_near_distance(const char *a, const char *b)
{
    const size_t rows = strlen(a), columns = strlen(b);
    int32_t d[NAME_MAX_BYTES + 1][NAME_MAX_BYTES + 1];

    if (rows > NAME_MAX_BYTES || columns > NAME_MAX_BYTES)
        return FAR_AWAY;
    for (size_t i = 0; i <= rows; ++i)
        d[i][0] = (int32_t)i;
    for (size_t j = 0; j <= columns; ++j)
        d[0][j] = (int32_t)j;
    for (size_t i = 1; i <= rows; ++i)
    {
        for (size_t j = 1; j <= columns; ++j)
        {
            const int x = lower(a[i - 1]), y = lower(b[j - 1]);

            d[i][j] = least(
                d[i - 1][j - 1] + (x != y),
                1 + least(d[i - 1][j], d[i][j - 1]));
            if (i > 1 && j > 1 && x == lower(b[j - 2]) && y == lower(a[i - 2]))
                d[i][j] = least(d[i][j], 1 + d[i - 2][j - 2]);
        }
    }
    return d[rows][columns];
}

/* Whether one name is the beginning of the other, three letters or more. */
static bool
is_prefix(const char *a, const char *b)
{
    while (*a && lower(*a) == lower(*b))
        ++a, ++b;
    return *a == '\0';
}

/* A third of the letters may be wrong; a beginning always counts. */
static int32_t
score(const char *name, const char *candidate)
{
    const int32_t distance = otx_near_distance(name, candidate);
    const int32_t allowed = 1 + (int32_t)strlen(name) / 3;

    if (distance <= allowed)
        return distance;
    if (strlen(name) >= 3 && is_prefix(name, candidate))
        return allowed;
    return FAR_AWAY;
}

void
otx_near_text(
    const char *name, otx_near_name get, const void *list, char text[256])
{
    const char *best[SUGGESTIONS];
    int32_t scores[SUGGESTIONS];
    int32_t count = 0;
    size_t length = 0;

    for (int32_t i = 0; get(list, i); ++i)
    {
        const char *candidate = get(list, i);
        const int32_t s = score(name, candidate);
        int32_t at = count < SUGGESTIONS ? count++ : SUGGESTIONS;

        if (s == FAR_AWAY || (at == SUGGESTIONS && s >= scores[at - 1]))
        {
            count -= at < SUGGESTIONS;
            continue;
        }
        at -= at == SUGGESTIONS;
        for (; at > 0 && scores[at - 1] > s; --at)
        {
            best[at] = best[at - 1];
            scores[at] = scores[at - 1];
        }
        best[at] = candidate;
        scores[at] = s;
    }
    text[0] = '\0';
    for (int32_t i = 0; i < count && length < 256; ++i)
        length += (size_t)snprintf(
            text + length, 256 - length, "%s'%.60s'%s",
            i == 0 ? "; did you mean " : (i + 1 == count ? " or " : ", "),
            best[i], i + 1 == count ? "?" : "");
}

const char *
otx_near_best(const char *name, otx_near_name get, const void *list)
{
    const size_t length = strlen(name);
    /* Two slips in a word of three letters, one more for each four. */
    int32_t nearest = (length > 2 ? 3 : 2) + (int32_t)length / 4;
    const char *best = NULL;

    for (int32_t i = 0; get(list, i); ++i)
    {
        const char *candidate = get(list, i);
        const bool begins = length >= 2 && is_prefix(name, candidate);
        const int32_t distance =
            begins ? 1 : otx_near_distance(name, candidate);

        if (!begins && distance >= nearest)
            continue;
        nearest = distance;
        best = candidate;
    }
    return best;
}

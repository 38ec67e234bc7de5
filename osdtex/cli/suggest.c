/* suggest.c -- Levenshtein distance over one row. */
#include "cli/suggest.h"

#include <string.h>

enum
{
    WORD_MAX = 40,
    FAR_AWAY = 1000
};

static int
least(int a, int b)
{
    return a < b ? a : b;
}

static int
distance(const char *a, const char *b)
{
    const int columns = (int)strlen(b);
    int row[WORD_MAX + 1];

    if (columns > WORD_MAX)
        return FAR_AWAY;
    for (int j = 0; j <= columns; ++j)
        row[j] = j;
    for (int i = 1; a[i - 1]; ++i)
    {
        int diagonal = row[0];

        row[0] = i;
        for (int j = 1; j <= columns; ++j)
        {
            const int replace = diagonal + (a[i - 1] != b[j - 1]);

            diagonal = row[j];
            row[j] = least(replace, 1 + least(row[j], row[j - 1]));
        }
    }
    return row[columns];
}

const char *
otx_suggest_name(
    const char *word, const char *(*get)(const void *list, int index),
    const void *list)
{
    const size_t length = strlen(word);
    /* Two slips in a word of three letters, one more for each four. */
    int best_distance = (length > 2 ? 3 : 2) + (int)length / 4;
    const char *best = NULL;

    for (int i = 0; get(list, i); ++i)
    {
        const char *name = get(list, i);
        const int d = distance(word, name);
        const int begins = length >= 2 && strncmp(name, word, length) == 0;

        if (begins || d < best_distance)
        {
            best_distance = begins ? 1 : d;
            best = name;
        }
    }
    return best;
}

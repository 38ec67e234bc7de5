/* turntable.c -- NAME.%04d.png. */
#include "cli/turntable.h"

#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
#include <string.h>

enum
{
    DEFAULT_FRAMES = 48,
    MOST_FRAMES = 9999
};

/* Where "%04d" stands, or any "%d" of one to nine digits; its length in
 * *length. NULL: there is none. */
static const char *
find_number(const char *text, int *length)
{
    for (const char *at = strchr(text, '%'); at; at = strchr(at + 1, '%'))
    {
        int digits = 1;

        if (at[1] == '0' && at[2] >= '1' && at[2] <= '9')
            digits = 3;
        if (at[digits] == 'd')
        {
            *length = digits + 1;
            return at;
        }
    }
    return NULL;
}

bool
otx_turntable_parse(const otx_flag_values *values, otx_turntable *out)
{
    const char *text = values->text[OTX_FLAG_FRAMES];
    int64_t frames = DEFAULT_FRAMES;
    int length;

    *out = (otx_turntable){.pattern = values->text[OTX_FLAG_OUTPUT]};
    if (text && !otx_value_int(text, 1, MOST_FRAMES, &frames))
    {
        otx_session_refuse(
            "--frames takes a number from 1 to %d, not '%s'", MOST_FRAMES,
            text);
        return false;
    }
    if (find_number(out->pattern, &length))
        out->frames = (int)frames;
    else if (text)
    {
        otx_session_refuse(
            "the frames of --frames need numbers in their names: "
            "-o NAME.%%04d.png");
        return false;
    }
    if (strlen(out->pattern) + 10 < OTX_TURNTABLE_PATH_BYTES)
        return true;
    otx_session_refuse("'%s' is too long a name", out->pattern);
    return false;
}

void
otx_turntable_name(
    const otx_turntable *turntable, int i, char out[OTX_TURNTABLE_PATH_BYTES])
{
    int length = 0;
    const char *number =
        turntable->frames > 0 ? find_number(turntable->pattern, &length) : NULL;

    if (!number)
        snprintf(out, OTX_TURNTABLE_PATH_BYTES, "%s", turntable->pattern);
    else
        snprintf(
            out, OTX_TURNTABLE_PATH_BYTES, "%.*s%0*d%s",
            (int)(number - turntable->pattern), turntable->pattern,
            length == 4 ? number[2] - '0' : 1, i + 1, number + length);
}

void
otx_turntable_outputs(const otx_turntable *turntable, otx_path_list *out)
{
    char path[OTX_TURNTABLE_PATH_BYTES];

    for (int i = 0; i == 0 || i < turntable->frames; ++i)
    {
        otx_turntable_name(turntable, i, path);
        otx_path_list_add(out, path);
    }
}

double
otx_turntable_turn(const otx_turntable *turntable, int i)
{
    return turntable->frames > 0
               ? 2.0 * 3.14159265358979323846 * i / turntable->frames
               : 0.0;
}

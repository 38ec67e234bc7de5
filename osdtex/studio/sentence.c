/* sentence.c -- texts for the person. */
#include "studio/sentence.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void
otx_sentence(char out[OTX_STUDIO_ERROR_BYTES], const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(out, OTX_STUDIO_ERROR_BYTES, format, arguments);
    va_end(arguments);
}

json_t *
otx_sentence_json(const char *text)
{
    json_t *json = json_string(text);
    char *plain;

    if (json || !text)
        return json;
    plain = strdup(text);
    for (char *c = plain; plain && *c; ++c)
        if ((unsigned char)*c > 0x7F)
            *c = '?';
    json = json_string(plain);
    free(plain);
    return json;
}

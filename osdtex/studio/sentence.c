/* sentence.c -- one sentence for the person, cut where it is too long. */
#include "studio/sentence.h"

#include <stdarg.h>
#include <stdio.h>

void
otx_sentence(char out[OTX_STUDIO_ERROR_BYTES], const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(out, OTX_STUDIO_ERROR_BYTES, format, arguments);
    va_end(arguments);
}

/* sentence.h -- texts for the person. */
#ifndef OTX_STUDIO_SENTENCE_H
#define OTX_STUDIO_SENTENCE_H

#include "studio/studio.h"

#include <jansson.h>

/* One sentence, cut where it is too long. */
void otx_sentence(char out[OTX_STUDIO_ERROR_BYTES], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* A text as JSON, with `?` where it is not UTF-8: names of files may hold any
 * bytes. NULL for NULL, and when memory is out. */
json_t *otx_sentence_json(const char *text);

#endif

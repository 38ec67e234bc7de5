/* sentence.h -- one sentence for the person, cut where it is too long. */
#ifndef OTX_STUDIO_SENTENCE_H
#define OTX_STUDIO_SENTENCE_H

#include "studio/studio.h"

void otx_sentence(char out[OTX_STUDIO_ERROR_BYTES], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif

/* near.h -- names that somebody may have meant. */
#ifndef OTX_WORD_NEAR_H
#define OTX_WORD_NEAR_H

#include <stdint.h>

/* Name `index` of a list; NULL behind its end. */
typedef const char *(*otx_near_name)(const void *list, int32_t index);

/* Edits (insert, delete, replace, swap neighbours) between two names without
 * regard to ASCII case; names past 63 bytes count as far away. */
int32_t otx_near_distance(const char *a, const char *b);

/* Writes up to three names of a list that resemble `name`, nearest first, as
 * "; did you mean 'a' or 'b'?", or "" when none does: the end of a sentence. */
void otx_near_text(
    const char *name, otx_near_name get, const void *list, char text[256]);

/* The one name of a list that resembles `name` most, or begins with it; NULL
 * when none does. */
const char *
otx_near_best(const char *name, otx_near_name get, const void *list);

#endif

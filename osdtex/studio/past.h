/* past.h -- recipes one after the other, to go back and forth in. */
#ifndef OTX_STUDIO_PAST_H
#define OTX_STUDIO_PAST_H

#include <jansson.h>
#include <stdbool.h>

enum
{
    OTX_PAST_MOST = 256 /* older ones are forgotten */
};

/* Begins as {0}. */
typedef struct otx_past
{
    json_t *items[OTX_PAST_MOST];
    int count, at;    /* `at` is the one in force */
    int64_t revision; /* counts every change of the one in force */
} otx_past;

/* Takes the reference; what was undone is forgotten. */
void otx_past_push(otx_past *past, json_t *recipe);
/* By -1 back, by 1 forth; false at the ends. */
bool otx_past_step(otx_past *past, int by);
bool otx_past_has(const otx_past *past, int by);
/* Lent. */
json_t *otx_past_now(const otx_past *past);
void otx_past_free(otx_past *past);

#endif

/* compare.h -- is this file what it was? By content, or within a tolerance. */
#ifndef OTX_REGRESS_COMPARE_H
#define OTX_REGRESS_COMPARE_H

#include <osdtex/osdtex.h>

/* Hash of an OBJ, MTL, USDA or MaterialX file without the lines that open with
 * `#`, comments that name the version and the job. False when it cannot be
 * read. */
bool otx_compare_hash_text(const char *path, char text[OSDTEX_HASH_BYTES]);

/* Hash of the size and the pixels of a picture, whatever its header says. */
bool otx_compare_hash_pixels(
    osdtex_context *context, const char *path, char text[OSDTEX_HASH_BYTES]);

/* How two pictures differ, in the terms of OpenImageIO's idiff: a pixel's
 * difference is that of the channel that differs most. */
typedef struct otx_compare_difference
{
    bool has_pixels;   /* both could be read and are of one size */
    double worst;      /* 1 is white */
    int32_t x, y;      /* of the worst pixel, y from the top */
    int64_t differing; /* pixels with any difference */
    int64_t over;      /* pixels that differ by more than `fail` */
    int64_t pixels;
    bool passes;
} otx_compare_difference;

/* Those of OpenImageIO's test suite: at most `share` of the pixels may differ
 * by more than `fail`, none by more than `hard`. */
#define OTX_COMPARE_FAIL 0.004
#define OTX_COMPARE_SHARE 0.0002
#define OTX_COMPARE_HARD 0.012

void otx_compare_pictures(
    osdtex_context *context, const char *path, const char *reference,
    otx_compare_difference *out);

#endif

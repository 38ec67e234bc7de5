/* feature_mask.h -- feature masks of pictures that tile: what is there, what is
 * not.
 *
 * A feature is the minority phase of a picture: spots, joints, stripes. Masks
 * are 1 in it and 0 elsewhere, a row after the other from the bottom, on a
 * torus. */
#ifndef OTX_STACK_FEATURE_MASK_H
#define OTX_STACK_FEATURE_MASK_H

#include "image/image.h"

typedef enum otx_feature_kind
{
    OTX_FEATURE_SPOTS, /* the minority on one side of a lightness */
    OTX_FEATURE_JOINTS /* narrow, by a black or a white top hat */
} otx_feature_kind;

/* What a detector made of a picture. */
typedef struct otx_feature_mask
{
    uint8_t *texels; /* [height * width] */
    double share;    /* of the texels that are in it */
    double clarity;  /* of the threshold: share of the variance that it
                      * explains, 0 to 1 [Otsu79] */
} otx_feature_mask;

/* Finds a feature in CIELAB, in run->arena. A picture of one lightness gives an
 * empty mask. MEMORY. */
otx_status otx_feature_mask_find(
    otx_run *run, const otx_image *lab, otx_feature_kind feature,
    otx_feature_mask *out);

/* Fills in islands and holes of fewer than `least` texels that hang together by
 * their sides. MEMORY. */
otx_status otx_feature_mask_clean(
    otx_run *run, uint8_t *mask, int32_t width, int32_t height, int32_t least);

/* How many islands and holes of fewer than `below` texels there are. MEMORY. */
otx_status otx_feature_mask_crumbs(
    otx_run *run, const uint8_t *mask, int32_t width, int32_t height,
    int32_t below, int32_t *count);

/* Share of the texels that are in a mask. */
double otx_feature_mask_share(const uint8_t *mask, int64_t texels);

#endif

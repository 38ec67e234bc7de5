/* feature.h -- the things that a picture shows, each by itself.
 *
 * Stones between joints, leaves on nothing. What an alpha cuts out is parted
 * where it is; else joints are what is darker, or lighter, than all around it,
 * and hangs together. */
#ifndef OTX_ANALYSIS_FEATURE_H
#define OTX_ANALYSIS_FEATURE_H

#include "exemplar/exemplar.h"

typedef struct otx_feature
{
    otx_vec2 middle; /* texels of the labels; beyond a side where it wraps */
    double area;     /* texels */
    double radius;   /* to its farthest texel from the middle */
    bool whole;      /* the picture's border does not cut it, and it is not
                      * several that nothing parts */
} otx_feature;

typedef struct otx_features
{
    int32_t width, height; /* those of exemplar->lab */
    bool wrap_x, wrap_y;
    int32_t *labels; /* [height * width] 0: between features; else 1 + index */
    int32_t count;
    otx_feature *list; /* [count] */
    bool by_alpha;
    double share;   /* of the picture that is in features */
    double aligned; /* how alike they are turned: 0 all ways, 1 one way */
    double network; /* of what is between them that hangs together; 1: all */
} otx_features;

/* Whether alpha cuts something out of the picture: neither nearly all of it nor
 * hardly any. */
bool otx_features_are_cut_out(const otx_exemplar *exemplar);

/* In run->arena. No feature is an answer as well. MEMORY. */
otx_status otx_features_find(
    otx_run *run, const otx_exemplar *exemplar, otx_features *out);

/* Whether there are enough of them, of the size of features, well parted. */
bool otx_features_are_clear(const otx_features *features);

static inline bool
otx_features_some_are_whole(const otx_features *f)
{
    for (int32_t i = 0; i < f->count; ++i)
        if (f->list[i].whole)
            return true;
    return false;
}

/* 0, or 1 + the feature at a place in texels of the labels. */
static inline int32_t
otx_features_at(const otx_features *f, otx_vec2 at)
{
    int32_t x = (int32_t)floor(at.x), y = (int32_t)floor(at.y);

    if (x < 0 || x >= f->width)
    {
        if (!f->wrap_x)
            return 0;
        x = otx_image_wrap(x, f->width);
    }
    if (y < 0 || y >= f->height)
    {
        if (!f->wrap_y)
            return 0;
        y = otx_image_wrap(y, f->height);
    }
    return f->labels[(ptrdiff_t)y * f->width + x];
}

#endif

/* pattern.h -- an exemplar as windows are looked up in it.
 *
 * A pyramid of features, four channels or eight: Lab and edge strength, and
 * behind them a guide (a mask, a height, a progression; up to four channels).
 * Every level has a rim of texels that repeat or wrap, so that no lookup of a
 * window whose middle is inside asks where it is. */
#ifndef OTX_SYNTH_PATTERN_H
#define OTX_SYNTH_PATTERN_H

#include "image/image.h"
#include "synth/quad.h"

enum
{
    OTX_PATTERN_LEVELS = 6,
    OTX_PATTERN_RIM = 16,     /* texels; 4 * sqrt(2) * stretch of 2, and 2 */
    OTX_PATTERN_MIN_SIDE = 12 /* of the coarsest level */
};

typedef struct otx_pattern_level
{
    int32_t width, height; /* without the rim */
    int32_t stride;        /* texels from a row to the next */
    /* [(height + 2 rim) * stride * quads] */
    const otx_quad *values;
    float per_x, per_y; /* texels of the level to one of full resolution */
} otx_pattern_level;

typedef struct otx_pattern
{
    int32_t width, height;
    bool wrap_x, wrap_y;
    int32_t quads; /* 1, or 2 with a guide */
    int32_t level_count;
    otx_pattern_level levels[OTX_PATTERN_LEVELS];
} otx_pattern;

typedef struct otx_pattern_input
{
    const otx_image *lab;   /* 3 channels */
    const otx_image *guide; /* 1 to 4 channels of the same size, in units of
                             * Lab: times the weight that they are to have;
                             * NULL none */
    bool wrap_x, wrap_y;
    double edge; /* spread of the edges' channel to that of L; .7 */
    int32_t levels;
} otx_pattern_input;

/* In `arena`. As many levels as asked for, or as have sides of
 * OTX_PATTERN_MIN_SIDE. ARGUMENT where the guide is of another size, MEMORY. */
otx_status otx_pattern_build(
    otx_run *run, otx_arena *arena, const otx_pattern_input *input,
    otx_pattern *out);

/* A coordinate brought onto a side of the pattern: folded where it tiles, held
 * at the border where it does not. */
static inline float
otx_pattern_fold(float at, int32_t side, bool wrap)
{
    const float size = (float)side;

    if (at >= 0.0f && at < size)
        return at;
    if (wrap && fabsf(at) < 1e6f)
    {
        at -= size * floorf(at / size);
        return at >= 0.0f && at < size ? at : 0.0f;
    }
    return at > 0.0f ? size : 0.0f;
}

/* Features at a position of a level, in its texels; within the rim.
 *
 *   out  [quads] */
static inline void
otx_pattern_at(
    const otx_pattern_level *level, int32_t quads, float x, float y,
    otx_quad *out)
{
    const float u = x + (OTX_PATTERN_RIM - 0.5f);
    const float v = y + (OTX_PATTERN_RIM - 0.5f);
    const int32_t i = (int32_t)u, j = (int32_t)v;
    const float fx = u - (float)i, fy = v - (float)j;
    const otx_quad *low =
        level->values + ((ptrdiff_t)j * level->stride + i) * quads;
    const otx_quad *high = low + (ptrdiff_t)level->stride * quads;

    for (int32_t q = 0; q < quads; ++q)
    {
        const otx_quad below = low[q] + (low[q + quads] - low[q]) * fx;
        const otx_quad above = high[q] + (high[q + quads] - high[q]) * fx;

        out[q] = below + (above - below) * fy;
    }
}

#endif

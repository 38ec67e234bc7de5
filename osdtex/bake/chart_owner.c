/* chart_owner.c -- counting the samples of a texel by chart. */
#include "bake/chart_owner.h"

/* The chart at a sample, -1 none. */
static inline int32_t
chart_at(const otx_block *block, int32_t x, int32_t y, int32_t s)
{
    const int64_t id = otx_block_sample(block, x, y, s);

    return id < 0 ? -1 : block->source->layout->chart[otx_mip_facet_face(id)];
}

int32_t
otx_chart_owner(const otx_block *block, int32_t x, int32_t y, int32_t *first)
{
    const int32_t samples = block->raster.n * block->raster.n;
    int32_t charts[OTX_BLOCK_SAMPLES_MAX * OTX_BLOCK_SAMPLES_MAX];
    int32_t best = -1, best_count = 0;
    bool alike = true;

    *first = 0;
    charts[0] = chart_at(block, x, y, 0);
    for (int32_t s = 1; s < samples; ++s)
    {
        charts[s] = chart_at(block, x, y, s);
        alike = alike && charts[s] == charts[0];
    }
    if (alike)
        return charts[0];
    for (int32_t s = 0; s < samples; ++s)
    {
        int32_t count = 0;

        if (charts[s] < 0 || charts[s] == best)
            continue;
        for (int32_t t = s; t < samples; ++t)
            count += charts[t] == charts[s];
        if (count > best_count)
        {
            best = charts[s];
            best_count = count;
            *first = s;
        }
    }
    return best;
}

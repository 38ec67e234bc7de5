/* occurrence.c -- how often each part of a pattern is taken. */
#include "synth/occurrence.h"

void
otx_occurrence_count(
    const otx_canvas *const *canvases, int32_t count, double share,
    otx_occurrence *out)
{
    const double cells = OTX_OCCURRENCE_CELLS * OTX_OCCURRENCE_CELLS;
    double cost = 0.0;
    int64_t seen = 0;

    *out = (otx_occurrence){.weight = 0.0f};
    for (int32_t k = 0; k < count; ++k)
    {
        const otx_canvas *c = canvases[k];

        for (int32_t y = 0; y < c->height; ++y)
            for (int32_t x = 0; x < c->width; ++x)
            {
                const ptrdiff_t at = otx_canvas_index(c, x, y);

                if (c->uses[at] != OTX_CANVAS_SEEK)
                    continue;
                ++out->counts[otx_occurrence_cell(c->pattern, c->matches[at])];
                cost += c->costs[at];
                ++seen;
            }
    }
    if (seen > 0)
        out->weight =
            (float)(share * (cost / (double)seen) / ((double)seen / cells));
}

/* resolve.c -- colours of texels that charts reach into. */
#include "bake/resolve.h"

#include "bake/sample.h"

/* How far facets may be apart on what they share, in texels of the exemplar:
 * rounding, and the bend of a curved surface within a texel. */
static const double AGREED = 0.0625;

/* The chart at a sample, -1 none. */
static inline int32_t
chart_at(const otx_block *block, int32_t x, int32_t y, int32_t s)
{
    const int64_t id = otx_block_sample(block, x, y, s);

    return id < 0 ? -1 : block->source->layout->chart[otx_mip_facet_face(id)];
}

int32_t
otx_resolve_owner(const otx_block *block, int32_t x, int32_t y, int32_t *first)
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

/* What runs through a texel that one chart owns. */
typedef enum texel_state
{
    TEXEL_WHOLE,  /* nothing, and one lookup shows it: a close view */
    TEXEL_SMOOTH, /* nothing */
    TEXEL_TORN    /* a seam, or a rim */
} texel_state;

/* By whether all facets in the texel agree on what is at its centre.
 *
 *   first  a sample on the texel's chart
 *   uv     out: what is at the centre, in the exemplar */
static texel_state
state_of(otx_block *block, int32_t x, int32_t y, int32_t first, otx_vec2 *uv)
{
    const otx_vec2 centre = otx_raster_texel(&block->raster, x, y);
    const otx_mip_facet *placed =
        otx_block_piece(block, otx_block_sample(block, x, y, first));
    const otx_texture *texture = placed->texture;
    const otx_image *image = &texture->pyramid.levels[0];
    const int32_t chart = placed->chart;
    bool is_plain = placed->is_plain;
    int64_t seen = placed->id;

    *uv = otx_mip_facet_uv(placed, centre);
    for (int32_t s = 0; s < block->raster.n * block->raster.n; ++s)
    {
        const int64_t id = otx_block_sample(block, x, y, s);

        if (id == seen)
            continue;
        if (id < 0)
            return TEXEL_TORN;
        seen = id;
        placed = otx_block_piece(block, id);
        is_plain = is_plain && placed->is_plain;

        const otx_vec2 d = otx_vec2_sub(otx_mip_facet_uv(placed, centre), *uv);

        if (placed->chart != chart || placed->texture != texture ||
            !(fabs(d.x) * image->width < AGREED) ||
            !(fabs(d.y) * image->height < AGREED))
            return TEXEL_TORN;
    }
    return is_plain ? TEXEL_WHOLE : TEXEL_SMOOTH;
}

/* The facet at a place within a texel, of those that its samples have: first
 * that of the sample nearest to it. */
static int64_t
piece_near(otx_block *block, int32_t x, int32_t y, otx_vec2 at)
{
    const otx_vec2 origin = block->raster.origin;
    const int32_t n = block->raster.n, samples = n * n;
    const int32_t i = (int32_t)((at.x - origin.x - x) * n);
    const int32_t j = (int32_t)((at.y - origin.y - y) * n);

    for (int32_t s = 0; s < samples; ++s)
    {
        const int64_t id =
            otx_block_sample(block, x, y, (j * n + i + s) % samples);

        if (id >= 0 && otx_mip_facet_contains(otx_block_piece(block, id), at))
            return id;
    }
    return otx_block_sample(block, x, y, j * n + i);
}

/* Color of one of n x n samples of a texel that `chart` owns, at `at`, on the
 * facet `id`: where that is another chart's, or none, what the facet `home` of
 * this one goes on to. */
static void
color_of_sample(
    otx_block *block, int64_t id, int64_t home, int32_t chart, int32_t n,
    otx_vec2 at, float *color)
{
    const otx_texel_source *source = block->source;

    if (id >= 0 && source->layout->chart[otx_mip_facet_face(id)] == chart)
        otx_sample_on_piece(
            source, otx_block_piece(block, id), 1.0 / block->raster.n, at,
            color);
    else
    {
        const otx_walk walk =
            otx_block_walk(block, otx_block_piece(block, home), at);

        otx_sample_at(source, &walk, 1.0 / n, color);
    }
}

/* Where a seam runs through a texel more samples are taken, so that each side
 * has its share. */
void
otx_resolve_color(
    otx_block *block, int32_t x, int32_t y, int32_t chart, int32_t first,
    float *out)
{
    otx_vec2 uv;
    const otx_texel_source *source = block->source;
    const texel_state state = state_of(block, x, y, first, &uv);
    const int32_t n =
        state == TEXEL_TORN ? OTX_BLOCK_SAMPLES_MAX : block->raster.n;
    const int64_t home = otx_block_sample(block, x, y, first);
    float color[OTX_IMAGE_MAX_CHANNELS];
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0};

    if (state == TEXEL_WHOLE)
    {
        otx_sample_on_piece(
            source, otx_block_piece(block, home), 1.0,
            otx_raster_texel(&block->raster, x, y), out);
        return;
    }
    for (int32_t s = 0; s < n * n; ++s)
    {
        const int32_t i = s % n, j = s / n;
        const otx_vec2 at = {
            block->raster.origin.x + x + (i + 0.5) / n,
            block->raster.origin.y + y + (j + 0.5) / n};
        const int64_t id = n == block->raster.n
                               ? otx_block_sample(block, x, y, s)
                               : piece_near(block, x, y, at);

        color_of_sample(block, id, home, chart, n, at, color);
        for (int32_t c = 0; c < source->channels; ++c)
            sum[c] += color[c];
    }
    for (int32_t c = 0; c < source->channels; ++c)
        out[c] = (float)(sum[c] / (n * n));
}

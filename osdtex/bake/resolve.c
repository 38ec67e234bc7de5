/* resolve.c -- what texels show that charts reach into. */
#include "bake/resolve.h"

#include "bake/sample.h"

/* How far facets may be apart on what they share, in texels of the exemplar:
 * rounding, and the bend of a curved surface within a texel. */
static const double AGREED = 0.0625;

/* Whether nothing runs through a texel, no seam and no rim, by whether all
 * facets in it agree on what is at its centre; and where that is so, whether
 * one lookup shows it all: a close view.
 *
 *   first  a sample on the texel's chart */
static bool
is_smooth(otx_block *block, int32_t x, int32_t y, int32_t first, bool plain[2])
{
    const otx_vec2 centre = otx_raster_texel(&block->raster, x, y);
    const otx_mip_facet *placed =
        otx_block_piece(block, otx_block_sample(block, x, y, first));
    const otx_texture *texture = placed->own.texture;
    const otx_image *image = &texture->pyramid.levels[0];
    const otx_vec2 uv = otx_mip_facet_uv(placed, centre);
    const int32_t chart = placed->chart;
    int64_t seen = placed->id;

    plain[0] = placed->own.is_plain;
    plain[1] = placed->maps.is_plain;
    for (int32_t s = 0; s < block->raster.n * block->raster.n; ++s)
    {
        const int64_t id = otx_block_sample(block, x, y, s);

        if (id == seen)
            continue;
        if (id < 0)
            return false;
        seen = id;
        placed = otx_block_piece(block, id);
        plain[0] = plain[0] && placed->own.is_plain;
        plain[1] = plain[1] && placed->maps.is_plain;

        const otx_vec2 d = otx_vec2_sub(otx_mip_facet_uv(placed, centre), uv);

        if (placed->chart != chart || placed->own.texture != texture ||
            !(fabs(d.x) * image->width < AGREED) ||
            !(fabs(d.y) * image->height < AGREED))
            return false;
    }
    return true;
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

/* A texel that `chart` owns, and the facet that its first sample has. */
typedef struct texel
{
    int32_t x, y, chart;
    int64_t home;
    bool own, maps; /* what of the block is asked for */
} texel;

/* All that a block shows of what is asked for, on a facet. */
static void
on_piece(
    const otx_block *block, const otx_mip_facet *placed, const texel *t,
    double share, otx_vec2 at, float *out)
{
    if (t->own)
        otx_sample_on_piece(
            block->source, placed, &placed->own, &placed->own.probes, share, at,
            out);
    if (t->maps)
        otx_sample_on_piece(
            block->maps, placed, &placed->maps, &placed->maps.probes, share, at,
            out + block->source->channels);
}

/* One of n x n samples of a texel, at `at`, on the facet `id`: where that is
 * another chart's, or none, what the home facet goes on to. */
static void
take_sample(
    otx_block *block, int64_t id, const texel *t, int32_t n, otx_vec2 at,
    float *out)
{
    if (id >= 0 &&
        block->source->layout->chart[otx_mip_facet_face(id)] == t->chart)
        on_piece(block, otx_block_piece(block, id), t, 1.0 / n, at, out);
    else
    {
        const otx_walk walk =
            otx_block_walk(block, otx_block_piece(block, t->home), at);

        otx_sample_walk(block, &walk, 1.0 / n, out);
    }
}

/* The mean of n x n samples. */
static void
take_mean(otx_block *block, const texel *t, int32_t n, float *out)
{
    const int32_t first = t->own ? 0 : block->source->channels;
    const int32_t end = t->maps ? block->channels : block->source->channels;
    float values[OTX_SAMPLE_CHANNELS];
    double sum[OTX_SAMPLE_CHANNELS] = {0.0};

    for (int32_t s = 0; s < n * n; ++s)
    {
        const int32_t i = s % n, j = s / n;
        const otx_vec2 at = {
            block->raster.origin.x + t->x + (i + 0.5) / n,
            block->raster.origin.y + t->y + (j + 0.5) / n};
        const int64_t id = n == block->raster.n
                               ? otx_block_sample(block, t->x, t->y, s)
                               : piece_near(block, t->x, t->y, at);

        take_sample(block, id, t, n, at, values);
        for (int32_t c = first; c < end; ++c)
            sum[c] += values[c];
    }
    for (int32_t c = first; c < end; ++c)
        out[c] = (float)(sum[c] / (n * n));
}

/* What is asked for of a texel that nothing runs through. */
static void
take_smooth(
    otx_block *block, const texel *t, bool plain, int32_t fineness, float *out)
{
    if (plain)
        on_piece(
            block, otx_block_piece(block, t->home), t, 1.0,
            otx_raster_texel(&block->raster, t->x, t->y), out);
    else
        take_mean(block, t, fineness, out);
}

/* Where a seam runs through a texel more samples are taken, so that each side
 * has its share. */
void
otx_resolve_texel(
    otx_block *block, int32_t x, int32_t y, int32_t chart, int32_t first,
    float *out)
{
    const int64_t home = otx_block_sample(block, x, y, first);
    texel t = {x, y, chart, home, true, block->maps != NULL};
    bool plain[2];

    if (!is_smooth(block, x, y, first, plain))
    {
        take_mean(block, &t, OTX_BLOCK_SAMPLES_MAX, out);
        return;
    }

    const otx_mip_facet *placed = otx_block_piece(block, home);
    const int32_t own = placed->own.fineness, maps = placed->maps.fineness;

    if (!t.maps || (plain[0] == plain[1] && (plain[0] || own == maps)))
    {
        take_smooth(block, &t, plain[0], own, out);
        return;
    }
    t.maps = false;
    take_smooth(block, &t, plain[0], own, out);
    t.own = false;
    t.maps = true;
    take_smooth(block, &t, plain[1], maps, out);
}

/* exhaust.c -- eq. 2 of [Soler02] for every x0 at once.
 *
 * With weights W in place of J, summed over the channels c:
 *
 *   E(x0) = sum W I_c^2  - 2 (W I_c) * T_c  + W * (sum_c T_c^2)
 *
 * where (f * g)(x0) = sum_x f(x) g(x + x0). The correlations are added up in
 * Fourier space, so an orientation costs one forward transform per channel,
 * one for the weights, and one inverse. T has its mean subtracted: less
 * cancels between the terms.
 *
 * Pixels add up. A mask that is larger than one period of a tiling exemplar is
 * folded over it, and every texel of the mask still counts exactly once. */
#include "match/exhaust.h"

#include <string.h>

otx_status
otx_exhaust_buffers_create(
    otx_arena *arena, const otx_plane *plane, const otx_match_query *query,
    otx_exhaust_buffers *out)
{
    const size_t floats =
        (size_t)plane->fft_height * otx_fft_stride(plane->fft);

    *out = (otx_exhaust_buffers){0};
    for (int32_t c = 0; c <= plane->channels; ++c)
    {
        out->planes[c] = OTX_NEW(arena, float, floats);
        if (!out->planes[c])
            return OSDTEX_ERROR_MEMORY;
    }
    out->scratch = OTX_NEW(arena, float, otx_fft_scratch_floats(plane->fft));
    out->map = OTX_NEW(arena, float, floats);
    out->usage_column = OTX_NEW(arena, int32_t, plane->fft_width);
    if (!out->scratch || !out->map || !out->usage_column)
        return OSDTEX_ERROR_MEMORY;
    return otx_wear_create(arena, query, &out->wear);
}

/* ------------------------------------------------------------ painting */

typedef struct painter
{
    const otx_mask *mask;
    const otx_plane *plane;
    const otx_exhaust_buffers *buffers;
    int32_t first_x, first_y; /* pixel of the frame that is drawn at 0 */
    otx_exhaust_sums *sums;
} painter;

static void
paint_span(void *context, const otx_mask_span *span)
{
    const painter *p = context;
    const otx_plane *plane = p->plane;
    const otx_plane *from =
        otx_matcher_source(p->mask->triangles[span->triangle].from, plane);
    const int32_t channels = plane->channels;
    const double step_x = span->source_step.x / from->pixel.x;
    const double step_y = span->source_step.y / from->pixel.y;
    const int32_t y = (span->y - p->first_y) % plane->fft_height;
    const size_t row = (size_t)y * otx_fft_stride(plane->fft);
    int32_t x = (span->x - p->first_x) % plane->fft_width;
    double u = span->source.x / from->pixel.x;
    double v = span->source.y / from->pixel.y;
    double energy = 0.0, weights = 0.0;
    float *planes[OTX_PLANE_SPECTRA];

    for (int32_t c = 0; c <= channels; ++c)
        planes[c] = p->buffers->planes[c] + row;
    for (int32_t n = 0; n < span->count; ++n)
    {
        const double w = span->weight + n * span->weight_step;
        const float weight = w > 0.0 ? (float)w : 0.0f;
        const double su = otx_plane_wrap(u, from->width, from->wrap_x);
        const double sv = otx_plane_wrap(v, from->height, from->wrap_y);
        float color[OTX_PLANE_LANES];
        float square = 0.0f;

        otx_plane_sample(from, su, sv, color);
        for (int32_t c = 0; c < channels; ++c)
        {
            planes[c][x] += weight * color[c];
            square += color[c] * color[c];
        }
        planes[channels][x] += weight;
        energy += (double)(weight * square);
        weights += (double)weight;
        /* From the wrapped position, the next one rarely needs a floor. */
        u = (from->wrap_x ? su : u) + step_x;
        v = (from->wrap_y ? sv : v) + step_y;
        if (++x == plane->fft_width)
            x = 0;
    }
    p->sums->energy += energy;
    p->sums->weight += weights;
}

otx_exhaust_sums
otx_exhaust_map(
    const otx_plane *plane, const otx_mask *mask, double angle,
    const otx_exhaust_buffers *buffers)
{
    const otx_mask_frame frame = {
        .rotation = otx_vec2_polar(angle), .pixel = plane->pixel};
    const otx_mask_box box = otx_mask_bounds(mask, &frame);
    /* The first and the last row whose centres the mask can hold. */
    const int32_t x = (int32_t)ceil(box.low.x - 0.5);
    const int32_t y = (int32_t)ceil(box.low.y - 0.5);
    otx_exhaust_sums sums = {
        .base_x = x + plane->pad_x, .base_y = y + plane->pad_y};
    int32_t rows = (int32_t)ceil(box.high.y - 0.5) - y;
    painter p = {mask, plane, buffers, x, y, &sums};

    if (rows > plane->fft_height)
        rows = plane->fft_height;
    if (rows <= 0)
        return sums;
    for (int32_t c = 0; c <= plane->channels; ++c)
        memset(
            buffers->planes[c], 0,
            (size_t)rows * otx_fft_stride(plane->fft) * sizeof(float));
    otx_mask_draw(mask, &frame, paint_span, &p);
    if (sums.weight > 0.0)
        otx_fft_correlate(
            plane->fft, plane->channels + 1, rows, buffers->planes,
            (const float *const *)plane->spectra, buffers->scratch,
            buffers->map);
    return sums;
}

/* ------------------------------------------------------------ scanning */

/* Translations x0 whose shift lies in [low, high]; one, to be clamped, where
 * the interval is narrower than a pixel. False when nothing fits. */
static bool
valid_offsets(
    double low, double high, double pixel, int32_t base, int32_t size,
    bool wrap, int32_t *begin, int32_t *end)
{
    const double slack = 1e-9;

    *begin = 0;
    *end = size;
    if (wrap)
        return true;
    if (!(low <= high))
        return false;
    *begin = (int32_t)ceil(low / pixel + base - slack);
    *end = (int32_t)floor(high / pixel + base + slack) + 1;
    if (*begin >= *end)
    {
        *begin = (int32_t)floor(0.5 * (low + high) / pixel + base + 0.5);
        *end = *begin + 1;
    }
    *begin = otx_view_fold(*begin, size, false);
    *end = otx_view_fold(*end - 1, size, false) + 1;
    return true;
}

/* Replaces E by E (1 + w usage) in the map, in the map's own terms. */
static void
penalise(
    const otx_matcher *matcher, const otx_plane *plane,
    const otx_match_query *query, double angle, const otx_exhaust_sums *sums,
    const otx_peaks_map *map, const otx_exhaust_buffers *buffers)
{
    const otx_vec2 centre = otx_vec2_mul(otx_vec2_polar(angle), query->centre);
    const float energy = (float)sums->energy;

    otx_wear_tabulate(matcher, query, angle, &buffers->wear);
    for (int32_t x = map->x_begin; x < map->x_end; ++x)
        buffers->usage_column[x] = otx_matcher_usage_cell(
            centre.x + (x - sums->base_x) * plane->pixel.x, matcher->width,
            matcher->wrap_x, query->usage_width);
    for (int32_t y = map->y_begin; y < map->y_end; ++y)
    {
        const int32_t cell = otx_matcher_usage_cell(
            centre.y + (y - sums->base_y) * plane->pixel.y, matcher->height,
            matcher->wrap_y, query->usage_height);
        const float *factors =
            buffers->wear.factors + (size_t)cell * (size_t)query->usage_width;
        float *row = buffers->map + (size_t)y * map->stride;

        for (int32_t x = map->x_begin; x < map->x_end; ++x)
        {
            const float error = row[x] + energy;
            const float factor = factors[buffers->usage_column[x]];

            row[x] = (error > 0.0f ? error * factor : 0.0f) - energy;
        }
    }
}

void
otx_exhaust_angle(
    const otx_matcher *matcher, int32_t level, const otx_mask *mask,
    const otx_match_query *query, int32_t angle,
    const otx_exhaust_buffers *buffers, otx_peaks *peaks)
{
    const otx_plane *plane = &matcher->planes[level];
    const double radians = query->angles[angle];
    const otx_matcher_range range =
        otx_matcher_shifts(matcher, mask, query, radians);
    otx_peaks_map map = {
        .values = buffers->map,
        .stride = otx_fft_stride(plane->fft),
        .wrap_x = plane->wrap_x,
        .wrap_y = plane->wrap_y};

    if (!(range.low.x <= range.high.x && range.low.y <= range.high.y))
        return;
    const otx_exhaust_sums sums =
        otx_exhaust_map(plane, mask, radians, buffers);

    if (!(sums.weight > 0.0) ||
        !valid_offsets(
            range.low.x, range.high.x, plane->pixel.x, sums.base_x,
            plane->fft_width, plane->wrap_x, &map.x_begin, &map.x_end) ||
        !valid_offsets(
            range.low.y, range.high.y, plane->pixel.y, sums.base_y,
            plane->fft_height, plane->wrap_y, &map.y_begin, &map.y_end))
        return;
    if (query->usage)
        penalise(matcher, plane, query, radians, &sums, &map, buffers);
    otx_peaks_scan(
        &map, angle, sums.energy / sums.weight, 1.0 / sums.weight, peaks);
}

otx_match
otx_exhaust_placement(
    const otx_matcher *matcher, int32_t level, const otx_mask *mask,
    const otx_match_query *query, const otx_peak *peak,
    const otx_matcher_range *range)
{
    const otx_plane *plane = &matcher->planes[level];
    const double angle = query->angles[peak->angle];
    const otx_mask_frame frame = {
        .rotation = otx_vec2_polar(angle), .pixel = plane->pixel};
    const otx_mask_box box = otx_mask_bounds(mask, &frame);
    const otx_vec2 shift = {
        (peak->x - plane->pad_x - ceil(box.low.x - 0.5)) * plane->pixel.x,
        (peak->y - plane->pad_y - ceil(box.low.y - 0.5)) * plane->pixel.y};

    return (otx_match){
        .angle = angle,
        .shift =
            {fmin(fmax(shift.x, range->low.x), range->high.x),
             fmin(fmax(shift.y, range->low.y), range->high.y)},
        .error = peak->value};
}

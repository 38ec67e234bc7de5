/* matcher.c -- the exemplar's side of the search, and the exact score. */
#include "match/matcher.h"

#include <string.h>

enum
{
    SMALLEST_SIDE = 16 /* of the coarsest level, pixels */
};

/* Share of a side by which a mask may reach over a rim. */
static const double OVERHANG = 0.3;

/* Of sigma squared. The distance from the mean is half of that in the mean, so
 * that it comes to about what good matches have elsewhere. */
static const double BEYOND = 0.2;

static void
mean_color(const otx_image *image, double mean[OTX_PLANE_LANES])
{
    const double count = (double)image->width * image->height;

    for (int32_t k = 0; k < OTX_PLANE_LANES; ++k)
        mean[k] = 0.0;
    for (int32_t y = 0; y < image->height; ++y)
        for (int32_t x = 0; x < image->width; ++x)
            for (int32_t k = 0; k < image->channels; ++k)
                mean[k] += (double)otx_image_at(image, x, y)[k];
    for (int32_t k = 0; k < OTX_PLANE_LANES; ++k)
        mean[k] /= count;
}

static int32_t
count_levels(int32_t width, int32_t height)
{
    const int32_t side = width < height ? width : height;
    int32_t count = 1;

    while (count < OTX_MATCHER_MAX_LEVELS && (side >> count) >= SMALLEST_SIDE)
        ++count;
    return count;
}

static otx_status
check_image(otx_run *run, const otx_image *match, double sigma)
{
    if (match->width < 1 || match->height < 1 || match->channels < 1 ||
        match->channels > OTX_PLANE_LANES)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "match", OTX_NOWHERE,
            "An image to match has 1 to %d channels and is not empty; this "
            "one is %d x %d with %d channels.",
            OTX_PLANE_LANES, match->width, match->height, match->channels);
    if (!(sigma >= 0.0) || isinf(sigma))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "match", OTX_NOWHERE,
            "The contrast of the exemplar (sigma) must be a finite number, 0 "
            "or more.");
    return OSDTEX_OK;
}

otx_status
otx_matcher_create(
    otx_run *run, const otx_image *match, bool wrap_x, bool wrap_y,
    double sigma, int32_t finest_level, otx_matcher **out)
{
    return otx_matcher_create_like(
        run, match, wrap_x, wrap_y, sigma, finest_level, NULL, out);
}

otx_status
otx_matcher_create_like(
    otx_run *run, const otx_image *match, bool wrap_x, bool wrap_y,
    double sigma, int32_t finest_level, const otx_matcher *like,
    otx_matcher **out)
{
    otx_matcher *matcher;

    *out = NULL;
    OTX_TRY(check_image(run, match, sigma));
    matcher = OTX_ZNEW(run->arena, otx_matcher, 1);
    OTX_TRY(otx_run_ok(run));
    matcher->width = match->width;
    matcher->height = match->height;
    matcher->wrap_x = wrap_x;
    matcher->wrap_y = wrap_y;
    matcher->sigma = sigma;
    matcher->level_count = count_levels(match->width, match->height);
    if (finest_level >= matcher->level_count)
        finest_level = matcher->level_count - 1;
    matcher->finest_level = finest_level < 0 ? 0 : finest_level;
    matcher->overhang.x = wrap_x ? 0.0 : OVERHANG * match->width;
    matcher->overhang.y = wrap_y ? 0.0 : OVERHANG * match->height;
    mean_color(match, matcher->mean);
    if (like)
        memcpy(matcher->mean, like->mean, sizeof matcher->mean);
    for (int32_t l = 0; l < matcher->level_count; ++l)
        OTX_TRY(otx_plane_create(
            run, match, wrap_x, wrap_y, l, matcher->mean, matcher->overhang,
            BEYOND * sigma * sigma, l >= matcher->finest_level,
            &matcher->planes[l]));
    *out = matcher;
    return OSDTEX_OK;
}

/* Shifts that keep [low, high] inside [margin, size - margin]. */
static void
limit_axis(
    double low, double high, double margin, int32_t size, double *shift_low,
    double *shift_high)
{
    *shift_low = fmax(*shift_low, margin - low);
    *shift_high = fmin(*shift_high, size - margin - high);
}

otx_matcher_range
otx_matcher_shifts(
    const otx_matcher *matcher, const otx_mask *mask,
    const otx_match_query *query, double angle)
{
    const otx_mask_frame frame = {
        .rotation = otx_vec2_polar(angle), .pixel = {1.0, 1.0}};
    const otx_mask_box box = otx_mask_bounds(mask, &frame);
    otx_matcher_range range = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
    const double over = query->overhang ? 1.0 : 0.0;

    if (!matcher->wrap_x)
        limit_axis(
            box.low.x, box.high.x, -over * matcher->overhang.x, matcher->width,
            &range.low.x, &range.high.x);
    if (!matcher->wrap_y)
        limit_axis(
            box.low.y, box.high.y, -over * matcher->overhang.y, matcher->height,
            &range.low.y, &range.high.y);
    for (int32_t i = 0; i < query->cover_count; ++i)
    {
        const otx_vec2 p = otx_mask_place(&frame, query->cover[i]);

        if (!matcher->wrap_x)
            limit_axis(
                p.x, p.x, 0.5, matcher->width, &range.low.x, &range.high.x);
        if (!matcher->wrap_y)
            limit_axis(
                p.y, p.y, 0.5, matcher->height, &range.low.y, &range.high.y);
    }
    return range;
}

typedef struct scorer
{
    const otx_mask *mask;
    const otx_plane *plane;
    double sum;
    double weight;
} scorer;

/* Squared difference of the mask's colour at `source` of a plane and a texel.
 */
static inline double
square_at(const otx_plane *plane, otx_vec2 source, const float *texel)
{
    float color[OTX_PLANE_LANES];
    double square = 0.0;

    otx_plane_sample(
        plane, otx_plane_wrap(source.x, plane->width, plane->wrap_x),
        otx_plane_wrap(source.y, plane->height, plane->wrap_y), color);
    /* All lanes at once, before they are widened and added up in order. */
    for (int k = 0; k < OTX_PLANE_LANES; ++k)
        color[k] -= texel[k];
    for (int k = 0; k < OTX_PLANE_LANES; ++k)
        square += (double)color[k] * (double)color[k];
    return square;
}

static void
score_span(void *context, const otx_mask_span *span)
{
    static const float mean[OTX_PLANE_LANES] = {0};
    scorer *s = context;
    const otx_plane *plane = s->plane;
    const otx_plane *from =
        otx_matcher_source(s->mask->triangles[span->triangle].from, plane);
    const int32_t y = otx_view_fold(span->y, plane->height, plane->wrap_y);
    const bool beyond = otx_plane_ends(span->y, plane->height, plane->wrap_y);
    double sum = 0.0, weights = 0.0;

    for (int32_t n = 0; n < span->count; ++n)
    {
        const int32_t x =
            otx_view_fold(span->x + n, plane->width, plane->wrap_x);
        const double linear = span->weight + n * span->weight_step;
        const double weight = linear > 0.0 ? linear : 0.0;
        const otx_vec2 source = {
            span->source.x + n * span->source_step.x,
            span->source.y + n * span->source_step.y};

        if (beyond || otx_plane_ends(span->x + n, plane->width, plane->wrap_x))
            sum += weight * (plane->beyond + square_at(from, source, mean));
        else
            sum += weight * square_at(from, source, otx_plane_at(plane, x, y));
        weights += weight;
    }
    s->sum += sum;
    s->weight += weights;
}

double
otx_matcher_square(
    const otx_matcher *matcher, const otx_mask *mask,
    const otx_match *placement)
{
    const otx_mask_frame frame = {
        .rotation = otx_vec2_polar(placement->angle),
        .shift = placement->shift,
        .pixel = {1.0, 1.0}};
    scorer s = {.mask = mask, .plane = &matcher->planes[0]};

    otx_mask_draw(mask, &frame, score_span, &s);
    return s.weight > 0.0 ? s.sum / s.weight : INFINITY;
}

double
otx_matcher_score(
    const otx_matcher *matcher, const otx_mask *mask,
    const otx_match *placement)
{
    const double rms = sqrt(otx_matcher_square(matcher, mask, placement));

    return matcher->sigma > 0.0 ? rms / matcher->sigma : rms;
}

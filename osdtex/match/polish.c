/* polish.c -- direct evaluation on samples of the mask.
 *
 * The window compares colours at texel centres: each sample is moved to the
 * centre it falls next to, and takes the colour it has there. Interpolating
 * the exemplar instead would blur it, and would favour angles and shifts that
 * blur it most. Gauss-Newton has to interpolate; what it finds is therefore
 * judged by the exact score. */
#include "match/polish.h"

#include <string.h>

enum
{
    MAX_RADIUS = 2,
    MAX_SIDE = 2 * MAX_RADIUS + 1,
    NEWTON_STEPS = 5,
    RUN = 64 /* samples summed in floats */
};

/* Texels that Gauss-Newton may move: beyond, it is another minimum. */
static const double NEWTON_REACH = 1.5;

/* ------------------------------------------------------------- samples */

typedef struct picker
{
    otx_polish_picks *picks; /* list NULL while counting */
    const otx_mask *mask;
    int64_t total;
    int64_t seen;
    int32_t limit;
} picker;

static void
count_span(void *context, const otx_mask_span *span)
{
    ((picker *)context)->total += span->count;
}

/* Index of the texel that becomes sample `k` of `limit`: the middle of the
 * k-th of equal runs. */
static int64_t
picked_texel(const picker *p, int64_t k)
{
    return p->total <= p->limit ? k : (2 * k + 1) * p->total / (2 * p->limit);
}

static void
pick_span(void *context, const otx_mask_span *span)
{
    picker *p = context;
    otx_polish_picks *picks = p->picks;
    const otx_mask_triangle *triangle = &p->mask->triangles[span->triangle];
    const int64_t end = p->seen + span->count;
    otx_mask_ramp ramp;

    if (picks->count < p->limit && picked_texel(p, picks->count) < end &&
        otx_mask_ramp_make(triangle, triangle->flat, &ramp))
        while (picks->count < p->limit && picked_texel(p, picks->count) < end)
        {
            const int64_t n = picked_texel(p, picks->count) - p->seen;
            const otx_vec2 flat = {span->x + (double)n + 0.5, span->y + 0.5};
            const double weight = otx_mask_ramp_weight(&ramp, flat);

            picks->list[picks->count++] = (otx_polish_pick){
                .flat = flat,
                .source = otx_mask_ramp_source(&ramp, flat),
                .dx = ramp.dx,
                .dy = ramp.dy,
                .weight = weight > 0.0 ? (float)weight : 0.0f,
                .from = triangle->from};
        }
    p->seen = end;
}

otx_status
otx_polish_pick_samples(
    otx_arena *arena, const otx_mask *mask, int32_t limit,
    otx_polish_picks *out)
{
    const otx_mask_frame frame = {.rotation = {1.0, 0.0}, .pixel = {1.0, 1.0}};
    picker p = {.picks = out, .mask = mask, .limit = limit};

    *out = (otx_polish_picks){0};
    otx_mask_draw(mask, &frame, count_span, &p);
    if (p.total < p.limit)
        p.limit = (int32_t)p.total;
    out->list = OTX_NEW(arena, otx_polish_pick, p.limit);
    if (!out->list)
        return OSDTEX_ERROR_MEMORY;
    otx_mask_draw(mask, &frame, pick_span, &p);
    return OSDTEX_OK;
}

/* -------------------------------------------------------------- window */

typedef struct sample
{
    float color[OTX_PLANE_LANES];
    float weight;
    int32_t x, y; /* pixel of the level */
} sample;

/* libm's floor is a call where the processor is not known to be recent. */
static inline double
floor_of(double x)
{
    const double i = (double)(int32_t)x;

    return x < i ? i - 1.0 : i;
}

/* The pick as it falls on the pixels of the level under a placement. False
 * when it falls beyond the rim. */
static bool
snap(
    const otx_polish_pick *pick, const otx_plane *plane,
    const otx_mask_frame *frame, sample *out)
{
    const otx_plane *from = otx_matcher_source(pick->from, plane);
    const otx_vec2 q = otx_mask_place(frame, pick->flat);
    const otx_vec2 cell = {floor_of(q.x), floor_of(q.y)};
    const otx_vec2 back = {frame->rotation.x, -frame->rotation.y};
    const otx_vec2 move = otx_vec2_mul(
        back, (otx_vec2){
                  (cell.x + 0.5 - q.x) * plane->pixel.x,
                  (cell.y + 0.5 - q.y) * plane->pixel.y});
    const double x = pick->source.x + pick->dx.x * move.x + pick->dy.x * move.y;
    const double y = pick->source.y + pick->dx.y * move.x + pick->dy.y * move.y;
    sample s = {.weight = pick->weight};

    otx_plane_sample(
        from, otx_plane_wrap(x / from->pixel.x, from->width, from->wrap_x),
        otx_plane_wrap(y / from->pixel.y, from->height, from->wrap_y), s.color);
    s.x = otx_view_fold((int32_t)cell.x, plane->width, plane->wrap_x);
    s.y = otx_view_fold((int32_t)cell.y, plane->height, plane->wrap_y);
    *out = s;
    return !otx_plane_ends((int32_t)cell.x, plane->width, plane->wrap_x) &&
           !otx_plane_ends((int32_t)cell.y, plane->height, plane->wrap_y);
}

/* What a sample costs that falls beyond the rim. */
static double
cost_beyond(
    const otx_plane *plane, const float color[OTX_PLANE_LANES], float weight)
{
    double square = plane->beyond;

    for (int k = 0; k < OTX_PLANE_LANES; ++k)
        square += (double)(color[k] * color[k]);
    return (double)weight * square;
}

/* sums[dy][dx] of the squared differences around the snapped samples. */
static void
sum_window(
    const otx_plane *plane, const sample *samples, int32_t count,
    int32_t radius, double sums[MAX_SIDE * MAX_SIDE])
{
    const int32_t side = 2 * radius + 1;
    float lanes[MAX_SIDE * MAX_SIDE][OTX_PLANE_LANES] = {{0.0f}};

    for (int32_t i = 0; i < count; ++i)
    {
        const sample s = samples[i];

        for (int32_t dy = 0; dy < side; ++dy)
        {
            const float *row =
                otx_plane_at(plane, s.x - radius, s.y - radius + dy);

            for (int32_t dx = 0; dx < side; ++dx)
                for (int k = 0; k < OTX_PLANE_LANES; ++k)
                {
                    const float d = row[dx * OTX_PLANE_LANES + k] - s.color[k];

                    lanes[dy * side + dx][k] += s.weight * (d * d);
                }
        }
    }
    for (int32_t n = 0; n < side * side; ++n)
        sums[n] = (double)lanes[n][0] + (double)lanes[n][1] +
                  (double)lanes[n][2] + (double)lanes[n][3];
}

otx_status
otx_polish_window(
    otx_arena *scratch, const otx_matcher *matcher,
    const otx_polish_picks *picks, int32_t pick_count,
    const otx_matcher_range *range, int32_t level, int32_t radius,
    otx_match *match)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    const otx_plane *plane = &matcher->planes[level];
    const otx_mask_frame frame = {
        .rotation = otx_vec2_polar(match->angle),
        .shift = match->shift,
        .pixel = plane->pixel};
    const int32_t count = pick_count < picks->count ? pick_count : picks->count;
    const int32_t side = 2 * radius + 1;
    sample *samples = OTX_NEW(scratch, sample, count);
    double sums[MAX_SIDE * MAX_SIDE];
    double weight = 0.0, beyond = 0.0, best = INFINITY;
    int32_t inside = 0;

    if (!samples)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < count; ++i)
    {
        /* Every n-th pick, so that few samples still cover the mask. */
        sample *s = &samples[inside];

        if (snap(
                &picks->list[(int64_t)i * picks->count / count], plane, &frame,
                s))
            ++inside;
        else
            beyond += cost_beyond(plane, s->color, s->weight);
        weight += (double)s->weight;
    }
    sum_window(plane, samples, inside, radius, sums);
    for (int32_t n = 0; n < side * side; ++n)
    {
        const otx_vec2 shift = {
            frame.shift.x + (n % side - radius) * plane->pixel.x,
            frame.shift.y + (n / side - radius) * plane->pixel.y};

        if (!(sums[n] < best) || !otx_matcher_allows(range, shift))
            continue;
        best = sums[n];
        match->shift = shift;
    }
    match->error = weight > 0.0 ? (best + beyond) / weight : INFINITY;
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

/* -------------------------------------------------------- Gauss-Newton */

/* Normal equations of sum w |I - T(p)|^2 in (x, y, angle about the centroid).
 * Of the symmetric matrix only the upper triangle is summed. */
typedef struct normal
{
    double a[3][3];
    double b[3];
    double error;
    double weight;
} normal;

/* The same, each channel in a lane of its own, of few samples. */
typedef struct lanes
{
    float a[3][3][OTX_PLANE_LANES];
    float b[3][OTX_PLANE_LANES];
    float error[OTX_PLANE_LANES];
} lanes;

/* The texels around a place, and where between them it is. */
typedef struct cell
{
    const float *low, *high; /* left texel of the lower and the upper row */
    float u, v;
} cell;

static inline cell
cell_at(const otx_plane *plane, otx_vec2 p)
{
    const double x = otx_plane_wrap(p.x, plane->width, plane->wrap_x);
    const double y = otx_plane_wrap(p.y, plane->height, plane->wrap_y);
    const int32_t i = (int32_t)(x + 0.5) - 1;
    const int32_t j = (int32_t)(y + 0.5) - 1;
    const float *low = otx_plane_at(plane, i, j);

    return (cell){
        low, low + plane->row_floats, (float)(x - 0.5 - i),
        (float)(y - 0.5 - j)};
}

static bool
is_beyond(const otx_plane *plane, otx_vec2 p)
{
    return (!plane->wrap_x && !(p.x >= 0.0 && p.x <= plane->width)) ||
           (!plane->wrap_y && !(p.y >= 0.0 && p.y <= plane->height));
}

/* One sample, all channels. */
static inline void
add_residuals(
    const cell *at, const float arm[2], const float *color, float weight,
    lanes *out)
{
    for (int k = 0; k < OTX_PLANE_LANES; ++k)
    {
        const float t00 = at->low[k], t10 = at->low[k + OTX_PLANE_LANES];
        const float t01 = at->high[k], t11 = at->high[k + OTX_PLANE_LANES];
        const float low = t00 + at->u * (t10 - t00);
        const float high = t01 + at->u * (t11 - t01);
        const float gx = (t10 - t00) + at->v * ((t11 - t01) - (t10 - t00));
        const float gy = high - low;
        const float turn = gy * arm[0] - gx * arm[1];
        const float r = color[k] - (low + at->v * gy);
        const float wx = weight * gx, wy = weight * gy, wt = weight * turn;

        out->a[0][0][k] += wx * gx;
        out->a[0][1][k] += wx * gy;
        out->a[0][2][k] += wx * turn;
        out->a[1][1][k] += wy * gy;
        out->a[1][2][k] += wy * turn;
        out->a[2][2][k] += wt * turn;
        out->b[0][k] += wx * r;
        out->b[1][k] += wy * r;
        out->b[2][k] += wt * r;
        out->error[k] += weight * r * r;
    }
}

static double
sum_lanes(const float lane[OTX_PLANE_LANES])
{
    double sum = 0.0;

    for (int k = 0; k < OTX_PLANE_LANES; ++k)
        sum += (double)lane[k];
    return sum;
}

static void
add_lanes(const lanes *from, normal *out)
{
    for (int m = 0; m < 3; ++m)
    {
        for (int n = m; n < 3; ++n)
            out->a[m][n] += sum_lanes(from->a[m][n]);
        out->b[m] += sum_lanes(from->b[m]);
    }
    out->error += sum_lanes(from->error);
}

/* Cramer's rule on the damped matrix; false where it is singular. */
static bool
solve3(const normal *e, double x[3])
{
    double m[3][3];

    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m[i][j] = e->a[i][j] * (i == j ? 1.001 : 1.0);
    /* Cofactors; m is symmetric, and only its upper triangle is read. */
    const double c00 = m[1][1] * m[2][2] - m[1][2] * m[1][2];
    const double c01 = m[0][2] * m[1][2] - m[0][1] * m[2][2];
    const double c02 = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double c11 = m[0][0] * m[2][2] - m[0][2] * m[0][2];
    const double c12 = m[0][1] * m[0][2] - m[0][0] * m[1][2];
    const double c22 = m[0][0] * m[1][1] - m[0][1] * m[0][1];

    const double det = m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02;
    if (!(det > 1e-12 * m[0][0] * m[1][1] * m[2][2]))
        return false;
    x[0] = (c00 * e->b[0] + c01 * e->b[1] + c02 * e->b[2]) / det;
    x[1] = (c01 * e->b[0] + c11 * e->b[1] + c12 * e->b[2]) / det;
    x[2] = (c02 * e->b[0] + c12 * e->b[1] + c22 * e->b[2]) / det;
    return true;
}

/* Rotates by x[2] about where the centroid lands, and moves by x[0], x[1]. */
static otx_match
move_match(const otx_match *match, otx_vec2 centroid, const double x[3])
{
    const otx_vec2 landed = otx_vec2_add(
        otx_vec2_mul(otx_vec2_polar(match->angle), centroid), match->shift);
    const otx_vec2 turned =
        otx_vec2_mul(otx_vec2_polar(x[2]), otx_vec2_sub(match->shift, landed));
    otx_match moved = *match;

    moved.angle += x[2];
    moved.shift.x = landed.x + turned.x + x[0];
    moved.shift.y = landed.y + turned.y + x[1];
    return moved;
}

/* The picks [first, end). */
static void
evaluate_run(
    const otx_plane *plane, const otx_polish_picks *picks,
    const float (*colors)[OTX_PLANE_LANES], otx_vec2 centroid,
    const otx_match *match, int32_t first, int32_t end, normal *out)
{
    const otx_vec2 rotation = otx_vec2_polar(match->angle);
    const otx_vec2 middle =
        otx_vec2_add(otx_vec2_mul(rotation, centroid), match->shift);
    lanes sum = {0};

    for (int32_t i = first; i < end; ++i)
    {
        const otx_polish_pick *pick = &picks->list[i];
        const otx_vec2 p =
            otx_vec2_add(otx_vec2_mul(rotation, pick->flat), match->shift);
        const float arm[2] = {(float)(p.x - middle.x), (float)(p.y - middle.y)};
        const cell at = cell_at(plane, p);

        out->weight += (double)pick->weight;
        if (is_beyond(plane, p))
            out->error += cost_beyond(plane, colors[i], pick->weight);
        else
            add_residuals(&at, arm, colors[i], pick->weight, &sum);
    }
    add_lanes(&sum, out);
}

static void
evaluate(
    const otx_plane *plane, const otx_polish_picks *picks,
    const float (*colors)[OTX_PLANE_LANES], otx_vec2 centroid,
    const otx_match *match, normal *out)
{
    *out = (normal){0};
    for (int32_t first = 0; first < picks->count; first += RUN)
        evaluate_run(
            plane, picks, colors, centroid, match, first,
            first + RUN < picks->count ? first + RUN : picks->count, out);
}

/* Centroid of the picks and their RMS distance from it. */
static double
spread_of(const otx_polish_picks *picks, otx_vec2 *centroid)
{
    double square = 0.0;

    *centroid = (otx_vec2){0.0, 0.0};
    for (int32_t i = 0; i < picks->count; ++i)
        *centroid = otx_vec2_add(*centroid, picks->list[i].flat);
    *centroid = otx_vec2_scale(1.0 / picks->count, *centroid);
    for (int32_t i = 0; i < picks->count; ++i)
    {
        const otx_vec2 d = otx_vec2_sub(picks->list[i].flat, *centroid);

        square += otx_vec2_dot(d, d);
    }
    return sqrt(square / picks->count);
}

static void
sample_colors(
    const otx_plane *plane, const otx_polish_picks *picks,
    float (*colors)[OTX_PLANE_LANES])
{
    for (int32_t i = 0; i < picks->count; ++i)
    {
        const otx_vec2 source = picks->list[i].source;
        const otx_plane *from = otx_matcher_source(picks->list[i].from, plane);

        otx_plane_sample(
            from, otx_plane_wrap(source.x, from->width, from->wrap_x),
            otx_plane_wrap(source.y, from->height, from->wrap_y), colors[i]);
    }
}

otx_status
otx_polish_gauss_newton(
    otx_arena *scratch, const otx_matcher *matcher,
    const otx_polish_picks *picks, otx_match *match)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    const otx_plane *plane = &matcher->planes[0];
    float(*colors)[OTX_PLANE_LANES] =
        otx_arena_alloc(scratch, (size_t)picks->count, sizeof *colors);
    otx_vec2 centroid;
    double reach = NEWTON_REACH;
    normal here, there;

    if (picks->count == 0)
        return OSDTEX_OK;
    if (!colors)
        return OSDTEX_ERROR_MEMORY;
    sample_colors(plane, picks, colors);
    const double spread = spread_of(picks, &centroid);

    evaluate(plane, picks, colors, centroid, match, &here);
    for (int step = 0; step < NEWTON_STEPS; ++step)
    {
        double x[3];

        if (!solve3(&here, x))
            break;
        const double length = hypot(hypot(x[0], x[1]), x[2] * spread);

        if (!(length <= reach))
            break;
        const otx_match moved = move_match(match, centroid, x);

        evaluate(plane, picks, colors, centroid, &moved, &there);
        if (!(there.error < here.error))
            break;
        *match = moved;
        here = there;
        reach -= length;
        if (length < 0.01)
            break;
    }
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

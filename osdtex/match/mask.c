/* mask.c -- triangles to spans, watertight.
 *
 * Where a row of pixel centres crosses an edge is computed from the edge's
 * corners in a canonical order, so two triangles that share an edge agree to
 * the last bit and a centre is counted once. */
#include "match/mask.h"

/* Texels; far beyond any exemplar, and safe to convert to int32. */
static const double LARGEST = 1e6;

static bool
is_sane(otx_vec2 p)
{
    /* Written so that NaN fails. */
    return fabs(p.x) < LARGEST && fabs(p.y) < LARGEST;
}

/* libm's fmin, fmax and ceil are calls where the processor is not known to be
 * recent; here they are a third of the time to draw small triangles. */
static inline double
least(double a, double b)
{
    return a < b ? a : b;
}

static inline double
most(double a, double b)
{
    return a > b ? a : b;
}

/* The first pixel whose centre is at `x` or beyond. */
static inline int32_t
first_centre(double x)
{
    const int32_t i = (int32_t)(x - 0.5);

    return i + (x - 0.5 > i);
}

bool
otx_mask_is_valid(const otx_mask *mask)
{
    for (int32_t t = 0; t < mask->triangle_count; ++t)
    {
        const otx_mask_triangle *triangle = &mask->triangles[t];

        for (int c = 0; c < 3; ++c)
        {
            const double weight = (double)triangle->weight[c];

            if (!is_sane(triangle->flat[c]) || !is_sane(triangle->source[c]) ||
                !(weight >= 0.0 && weight < LARGEST))
                return false;
        }
    }
    return true;
}

otx_mask_box
otx_mask_bounds(const otx_mask *mask, const otx_mask_frame *frame)
{
    otx_mask_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

    for (int32_t t = 0; t < mask->triangle_count; ++t)
        for (int c = 0; c < 3; ++c)
        {
            const otx_vec2 p =
                otx_mask_place(frame, mask->triangles[t].flat[c]);

            box.low.x = least(box.low.x, p.x);
            box.low.y = least(box.low.y, p.y);
            box.high.x = most(box.high.x, p.x);
            box.high.y = most(box.high.y, p.y);
        }
    return box;
}

double
otx_mask_area(const otx_mask *mask)
{
    double sum = 0.0;

    for (int32_t t = 0; t < mask->triangle_count; ++t)
    {
        const otx_vec2 *p = mask->triangles[t].flat;

        sum += 0.5 * fabs(otx_vec2_cross(
                         otx_vec2_sub(p[1], p[0]), otx_vec2_sub(p[2], p[0])));
    }
    return sum;
}

bool
otx_mask_ramp_make(
    const otx_mask_triangle *triangle, const otx_vec2 corners[3],
    otx_mask_ramp *out)
{
    const otx_vec2 a = otx_vec2_sub(corners[1], corners[0]);
    const otx_vec2 b = otx_vec2_sub(corners[2], corners[0]);
    const double area2 = otx_vec2_cross(a, b);
    const otx_vec2 s = otx_vec2_sub(triangle->source[1], triangle->source[0]);
    const otx_vec2 t = otx_vec2_sub(triangle->source[2], triangle->source[0]);
    const double w0 = (double)triangle->weight[0];
    const double w1 = (double)triangle->weight[1] - w0;
    const double w2 = (double)triangle->weight[2] - w0;

    /* Below this no pixel centre is hit but by rounding. */
    if (!(fabs(area2) > 1e-9))
        return false;
    out->dx = (otx_vec2){
        (s.x * b.y - t.x * a.y) / area2, (s.y * b.y - t.y * a.y) / area2};
    out->dy = (otx_vec2){
        (t.x * a.x - s.x * b.x) / area2, (t.y * a.x - s.y * b.x) / area2};
    out->weight_dx = (w1 * b.y - w2 * a.y) / area2;
    out->weight_dy = (w2 * a.x - w1 * b.x) / area2;
    out->at = (otx_vec2){0.0, 0.0};
    out->at = otx_vec2_sub(
        triangle->source[0],
        (otx_vec2){
            out->dx.x * corners[0].x + out->dy.x * corners[0].y,
            out->dx.y * corners[0].x + out->dy.y * corners[0].y});
    out->weight_at =
        w0 - out->weight_dx * corners[0].x - out->weight_dy * corners[0].y;
    return true;
}

/* x where the edge crosses height y; the lower end first, whatever the order
 * in which the triangle names it. */
static double
edge_crossing(otx_vec2 a, otx_vec2 b, double y)
{
    if (a.y > b.y || (a.y == b.y && a.x > b.x))
    {
        const otx_vec2 c = a;

        a = b;
        b = c;
    }
    return a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y));
}

/* The interval of a row; false where the triangle does not reach it. */
static bool
row_interval(const otx_vec2 p[3], double y, double *begin, double *end)
{
    int found = 0;
    double x[2] = {0.0, 0.0};

    for (int c = 0; c < 3 && found < 2; ++c)
    {
        const otx_vec2 a = p[c];
        const otx_vec2 b = p[(c + 1) % 3];

        if ((a.y <= y) != (b.y <= y))
            x[found++] = edge_crossing(a, b, y);
    }
    *begin = least(x[0], x[1]);
    *end = most(x[0], x[1]);
    return found == 2;
}

static void
draw_triangle(
    const otx_mask_triangle *triangle, const otx_vec2 p[3], otx_mask_span *span,
    otx_mask_span_fn fn, void *context)
{
    const double low = least(p[0].y, least(p[1].y, p[2].y));
    const double high = most(p[0].y, most(p[1].y, p[2].y));
    const int32_t last = first_centre(high);
    otx_mask_ramp ramp;

    if (!otx_mask_ramp_make(triangle, p, &ramp))
        return;
    span->source_step = ramp.dx;
    span->weight_step = ramp.weight_dx;
    for (int32_t y = first_centre(low); y < last; ++y)
    {
        double begin, end;

        if (!row_interval(p, y + 0.5, &begin, &end))
            continue;
        span->x = first_centre(begin);
        span->count = first_centre(end) - span->x;
        if (span->count <= 0)
            continue;
        const otx_vec2 centre = {span->x + 0.5, y + 0.5};

        span->y = y;
        span->source = otx_mask_ramp_source(&ramp, centre);
        span->weight = otx_mask_ramp_weight(&ramp, centre);
        fn(context, span);
    }
}

void
otx_mask_draw(
    const otx_mask *mask, const otx_mask_frame *frame, otx_mask_span_fn fn,
    void *context)
{
    for (int32_t t = 0; t < mask->triangle_count; ++t)
    {
        const otx_mask_triangle *triangle = &mask->triangles[t];
        otx_mask_span span = {.triangle = t};
        otx_vec2 corners[3];

        for (int c = 0; c < 3; ++c)
            corners[c] = otx_mask_place(frame, triangle->flat[c]);
        draw_triangle(triangle, corners, &span, fn, context);
    }
}

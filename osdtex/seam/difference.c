/* difference.c -- sums over the samples of an edge, in their order. */
#include "seam/difference.h"

double
otx_difference_mean(const float *a, const float *b, int32_t count)
{
    double sum = 0.0;

    for (int32_t i = 0; i < 3 * count; i += 3)
        sum += otx_difference(a + i, b + i);
    return sum / count;
}

void
otx_difference_look(
    const otx_seam_side *side, double t, double color[3], otx_vec2 slope[3])
{
    const otx_vec2 texel = otx_vec2_lerp(side->ends[0], side->ends[1], t);

    otx_view_slope(
        side->view,
        (otx_vec2){texel.x * side->pixels.x, texel.y * side->pixels.y}, color,
        slope);
    for (int c = 0; c < 3; ++c)
    {
        slope[c].x *= side->pixels.x;
        slope[c].y *= side->pixels.y;
    }
}

double
otx_difference_sum(
    const otx_seam_side *a, const otx_seam_side *b, int32_t count)
{
    double sum = 0.0;

    for (int32_t i = 0; i < count; ++i)
    {
        const double t = (i + 0.5) / count;
        double p[3], q[3];
        otx_vec2 unused[3];

        otx_difference_look(a, t, p, unused);
        otx_difference_look(b, t, q, unused);
        sum = otx_difference_add_sq(sum, p, q);
    }
    return sum;
}

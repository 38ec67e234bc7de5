/* band.c -- the part of a mask triangle that lies in the band.
 *
 * Near the leaves a face is wider than the band, so faces are cut along the
 * band's end rather than taken or left [Soler02, sec. 4.1]. */
#include "patch/band.h"

/* Where the side from `in` to `out` crosses the limit, with the same bits for
 * both triangles of the side. */
static void
cross(
    const otx_mask_triangle *t, const double reach[3], double limit, int in,
    int out, otx_mask_triangle *to, int k)
{
    const double part = (limit - reach[in]) / (reach[out] - reach[in]);

    to->flat[k] = otx_vec2_lerp(t->flat[in], t->flat[out], part);
    to->source[k] = otx_vec2_lerp(t->source[in], t->source[out], part);
    to->weight[k] = t->weight[in];
}

static void
copy(const otx_mask_triangle *t, int from, otx_mask_triangle *to, int k)
{
    to->flat[k] = t->flat[from];
    to->source[k] = t->source[from];
    to->weight[k] = t->weight[from];
}

int32_t
otx_band_clip(
    const otx_mask_triangle *t, const double reach[3], double limit,
    otx_mask_triangle out[2])
{
    int inside = 0, first = 0;

    for (int k = 0; k < 3; ++k)
        inside += reach[k] < limit;
    if (inside == 0)
        return 0;
    out[0] = *t;
    if (inside == 3)
        return 1;
    /* `first` is the corner that is alone on its side. */
    while ((reach[first] < limit) != (inside == 1))
        ++first;

    const int b = (first + 1) % 3, c = (first + 2) % 3;

    if (inside == 1)
    {
        copy(t, first, &out[0], 0);
        cross(t, reach, limit, first, b, &out[0], 1);
        cross(t, reach, limit, first, c, &out[0], 2);
        return 1;
    }
    cross(t, reach, limit, b, first, &out[0], 0);
    copy(t, b, &out[0], 1);
    copy(t, c, &out[0], 2);
    out[1] = out[0];
    copy(t, c, &out[1], 1);
    cross(t, reach, limit, c, first, &out[1], 2);
    return 2;
}

void
otx_band_keep_near(
    otx_mask_triangle *triangles, int32_t *count, otx_vec2 middle, double sight)
{
    int32_t kept = 0;

    for (int32_t i = 0; i < *count; ++i)
    {
        double far = 0.0;

        for (int k = 0; k < 3; ++k)
        {
            const otx_vec2 d = otx_vec2_sub(triangles[i].flat[k], middle);

            far = fmax(far, fmax(fabs(d.x), fabs(d.y)));
        }
        if (far <= sight)
            triangles[kept++] = triangles[i];
    }
    *count = kept;
}

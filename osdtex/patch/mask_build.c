/* mask_build.c -- what the neighbours of a patch show [Soler02, sec. 4.1].
 *
 * The mask is what the textured part of the collar shows, in the plane of the
 * chart. The paper takes a narrow band of it at full weight; here the band
 * counts fully and the rest of the collar with a weight that falls off, since
 * a wider view tells structures apart that agree along the border. */
#include "patch/mask_build.h"
#include "patch/band.h"

/* Share of the side of an exemplar that does not tile that a patch and its mask
 * may take up. */
static const double MASK_SHARE = 0.6;

static double
mask_weight(double reach, double band, double collar)
{
    if (reach <= band)
        return 1.0;
    return fmax(0.05, 1.0 - (reach - band) / fmax(collar - band, 1.0)) * 0.5;
}

/* Where vertices have position values the mask is the paper's: all of the band
 * and nothing else. Elsewhere the triangle as it is. */
static int32_t
add_triangle(
    const otx_chart *chart, otx_mask_triangle *t, int32_t first,
    const int32_t at[3], double band, otx_mask_triangle *out)
{
    double reach[3];

    if (!chart->vert_reach)
    {
        *out = *t;
        return 1;
    }
    for (int j = 0; j < 3; ++j)
    {
        reach[j] = chart->vert_reach[chart->corners[first + at[j]]];
        t->weight[j] = 1.0f;
    }
    return otx_band_clip(t, reach, band, out);
}

/* How far the mask may reach round a patch of `size`. All of the mask must
 * land inside an exemplar that does not tile, so a wide one leaves few places
 * to choose from, and keeps the patch away from the exemplar's rim. */
static double
widest_mask(const otx_exemplar *e, double size)
{
    const double width = e->wrap_x ? INFINITY : e->match.width;
    const double height = e->wrap_y ? INFINITY : e->match.height;

    return 0.5 * (MASK_SHARE * fmin(width, height) - size);
}

otx_status
otx_mask_build(
    const otx_mosaic *m, const otx_node *node, otx_arena *scratch,
    otx_mask_triangle **out, int32_t *out_count)
{
    const otx_chart *chart = &node->chart;
    const otx_level *leaf = m->job.leaves.level;
    const double band = otx_forest_band(m, node);
    const double collar = otx_forest_collar(m, node);
    const double widest = fmax(
        band, widest_mask(
                  otx_supply_of(m, node)->exemplar, otx_forest_size(m, node)));
    /* A triangle that is cut leaves two. */
    otx_mask_triangle *triangles = OTX_NEW(
        scratch, otx_mask_triangle,
        2 * (int64_t)chart->first[chart->face_count]);
    int32_t count = 0;

    if (!triangles)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = chart->core_count; i < chart->face_count; ++i)
    {
        const int32_t face = chart->faces[i];
        const int32_t corner = leaf->face_first[face];
        const int32_t first = chart->first[i];
        const float weight = (float)mask_weight(chart->reach[i], band, collar);

        if (m->cover.face_patch[face] < 0 || chart->reach[i] > widest)
            continue;

        const int32_t from =
            otx_cover_exemplar(&m->cover, m->cover.face_patch[face]);

        for (int32_t k = 1; k + 1 < chart->first[i + 1] - first; ++k)
        {
            const int32_t at[3] = {0, k, k + 1};
            otx_mask_triangle t = {
                .from = from == node->supply ? NULL
                                             : m->supplies.items[from].matcher};

            for (int j = 0; j < 3; ++j)
            {
                t.flat[j] = chart->flat[chart->corners[first + at[j]]];
                t.source[j] = m->cover.uvs[corner + at[j]];
                t.weight[j] = weight;
            }
            count +=
                add_triangle(chart, &t, first, at, band, triangles + count);
        }
    }
    *out = triangles;
    *out_count = count;
    return OSDTEX_OK;
}

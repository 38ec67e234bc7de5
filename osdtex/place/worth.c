/* worth.c -- what a chart is worth as the ground of a picture. */
#include "place/worth.h"

#include "flatten/stretch.h"
#include "surface/facet.h"

#include <stdlib.h>

/* What is judged. */
typedef struct worth
{
    const otx_footprint_ask *ask;
    const otx_footprint_space *space;
    const otx_footprint *chart;
} worth;

enum
{
    CLIP_MOST = 12 /* corners of a triangle that four lines have cut */
};

/* The part of a polygon where side * coordinate <= limit; its corners. */
static int
clip(
    const otx_vec2 *in, int count, bool is_y, double side, double limit,
    otx_vec2 *out)
{
    int kept = 0;

    for (int i = 0; i < count; ++i)
    {
        const otx_vec2 a = in[i], b = in[(i + 1) % count];
        const double da = side * (is_y ? a.y : a.x) - side * limit;
        const double db = side * (is_y ? b.y : b.x) - side * limit;

        if (da <= 0.0)
            out[kept++] = a;
        if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0))
            out[kept++] = otx_vec2_lerp(a, b, da / (da - db));
    }
    return kept;
}

/* The area that a triangle has within the box, whatever its sense. */
static double
area_within(const otx_vec2 t[3], const otx_footprint_box *box)
{
    otx_vec2 a[CLIP_MOST] = {t[0], t[1], t[2]}, b[CLIP_MOST];
    int count = clip(a, 3, false, 1.0, box->high.x, b);
    double sum = 0.0;

    count = clip(b, count, false, -1.0, box->low.x, a);
    count = clip(a, count, true, 1.0, box->high.y, b);
    count = clip(b, count, true, -1.0, box->low.y, a);
    for (int k = 1; k + 1 < count; ++k)
        sum += otx_vec2_cross(
            otx_vec2_sub(a[k], a[0]), otx_vec2_sub(a[k + 1], a[0]));
    return 0.5 * fabs(sum);
}

/* A triangle of the chart by its departure from an isometry. */
typedef struct stretched
{
    double stretch, area;
} stretched;

static int
by_stretch(const void *a, const void *b)
{
    const double p = ((const stretched *)a)->stretch;
    const double q = ((const stretched *)b)->stretch;

    return (p > q) - (p < q);
}

static stretched
judge_facet(const worth *u, const otx_facet *facet)
{
    const otx_level *leaf = otx_surface_leaf(u->ask->surface);
    otx_vec3 p[3];
    otx_vec2 t[3];
    double sigma[2], area;

    for (int k = 0; k < 3; ++k)
    {
        const int32_t v = leaf->face_verts[facet->corners[k]];

        p[k] = otx_vec3_scale(
            1.0 / u->ask->width, otx_vec3_load(u->ask->surface->points, v));
        t[k] = u->chart->flat[u->space->vert_slot[v]];
    }
    otx_stretch_singular(p, t, sigma);
    area = area_within(t, &u->ask->box);
    return (stretched){
        sigma[1] > 0.0 ? fmax(sigma[0], 1.0 / sigma[1]) : (double)INFINITY,
        area};
}

/* Mean and 95th percentile over the area of a sorted list. */
static void
summarise(const stretched *list, int64_t count, otx_footprint *out)
{
    double area = 0.0, sum = 0.0, passed = 0.0;

    for (int64_t i = 0; i < count; ++i)
    {
        area += list[i].area;
        sum += list[i].area > 0.0 ? list[i].area * list[i].stretch : 0.0;
    }
    out->stretch_mean = area > 0.0 ? sum / area : 1.0;
    out->stretch_p95 = 1.0;
    for (int64_t i = 0; i < count && passed < 0.95 * area; ++i)
    {
        passed += list[i].area;
        out->stretch_p95 = list[i].stretch;
    }
    out->covered = area;
}

static int32_t
slot_of(const worth *u, int32_t face, int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(u->ask->surface);

    return u->space->vert_slot[leaf->face_verts[leaf->face_first[face] + k]];
}

/* Whether a stretch comes inside of the box. */
static bool
enters(const otx_vec2 ends[2], const otx_footprint_box *box)
{
    const otx_vec2 d = otx_vec2_sub(ends[1], ends[0]);
    const double from[2] = {ends[0].x, ends[0].y}, by[2] = {d.x, d.y};
    const double low[2] = {box->low.x, box->low.y};
    const double high[2] = {box->high.x, box->high.y};
    double begin = 0.0, end = 1.0;

    for (int k = 0; k < 2; ++k)
    {
        if (fabs(by[k]) < 1e-12)
        {
            if (from[k] <= low[k] || from[k] >= high[k])
                return false;
            continue;
        }

        const double a = (low[k] - from[k]) / by[k];
        const double b = (high[k] - from[k]) / by[k];

        begin = fmax(begin, fmin(a, b));
        end = fmin(end, fmax(a, b));
    }
    return begin < end - 1e-9;
}

/* Whether the surface goes on beyond the rim of the chart inside of the box. */
static bool
is_cut(const worth *u)
{
    const otx_level *leaf = otx_surface_leaf(u->ask->surface);

    for (int32_t i = 0; i < u->chart->face_count; ++i)
    {
        const int32_t face = u->chart->faces[i];
        const int32_t size = otx_level_face_size(leaf, face);

        for (int32_t k = 0; k < size; ++k)
        {
            const int32_t next = otx_level_neighbour(leaf, face, k);
            const otx_vec2 ends[2] = {
                u->chart->flat[slot_of(u, face, k)],
                u->chart->flat[slot_of(u, face, (k + 1) % size)]};

            if (next >= 0 && !leaf->face_hole[next] &&
                u->space->face_slot[next] < 0 && enters(ends, &u->ask->box))
                return true;
        }
    }
    return false;
}

otx_status
otx_worth_judge(
    otx_arena *arena, const otx_footprint_ask *ask,
    const otx_footprint_space *space, otx_footprint *c)
{
    const worth how = {ask, space, c}, *u = &how;

    const otx_level *leaf = otx_surface_leaf(u->ask->surface);
    const otx_footprint_box *box = &u->ask->box;
    const double area = (box->high.x - box->low.x) * (box->high.y - box->low.y);
    stretched *list = OTX_NEW(arena, stretched, c->first[c->face_count]);
    int64_t count = 0;

    if (!list)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t k = 0; k < otx_facet_count(leaf, c->faces[i]); ++k)
        {
            const otx_facet facet = otx_facet_at(leaf, c->faces[i], k);

            list[count++] = judge_facet(u, &facet);
        }
    qsort(list, (size_t)count, sizeof *list, by_stretch);
    summarise(list, count, c);
    c->covered /= area;
    c->is_cut = is_cut(u);
    return OSDTEX_OK;
}

/* cage_mend.c -- what is changed of a mesh on its way into a cage. */
#include "surface/cage_mend.h"

#include "surface/uv_fold.h"
#include "surface/weld.h"

#include <math.h>

#define STAGE "cage"

/* A point at which nothing can be welded stands for one that is no number. */
static double
default_distance(const otx_cage_input *in)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double sum = 0.0;
    const int32_t corners = in->face_first[in->face_count];

    for (int32_t c = 0; c < corners; ++c)
        for (int k = 0; k < 3; ++k)
        {
            const double x =
                (double)in->points[3 * (size_t)in->face_verts[c] + k];

            low[k] = fmin(low[k], x);
            high[k] = fmax(high[k], x);
        }
    for (int k = 0; k < 3; ++k)
        sum += (high[k] - low[k]) * (high[k] - low[k]);
    return OTX_WELD_SHARE * sqrt(sum);
}

/* The same indices through a map; NULL when memory is out. */
static const int32_t *
mapped(
    otx_arena *arena, const int32_t *map, const int32_t *verts, size_t count,
    int32_t vert_count)
{
    int32_t *to = OTX_NEW(arena, int32_t, count);

    /* Tags have not been checked yet. */
    for (size_t i = 0; to && i < count; ++i)
        to[i] =
            verts[i] >= 0 && verts[i] < vert_count ? map[verts[i]] : verts[i];
    return to;
}

otx_status
otx_cage_weld(otx_run *run, double distance, otx_cage_input *in)
{
    otx_where where = OTX_NOWHERE;
    const int32_t *first;
    int32_t count = 0;

    where.file = in->path;
    if (distance == 0.0)
        distance = default_distance(in);
    first =
        otx_weld_find(run->scratch, in->points, in->vert_count, NULL, distance);
    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < in->vert_count; ++v)
        count += first[v] != v;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, where,
        "%d vertices are welded to others within %g", count, distance);
    in->welded = first;
    in->face_verts = mapped(
        run->scratch, first, in->face_verts,
        (size_t)in->face_first[in->face_count], in->vert_count);
    in->crease_verts = mapped(
        run->scratch, first, in->crease_verts, 2 * (size_t)in->crease_count,
        in->vert_count);
    in->corner_tag_verts = mapped(
        run->scratch, first, in->corner_tag_verts, (size_t)in->corner_tag_count,
        in->vert_count);
    OTX_TRY(otx_run_ok(run));
    return OSDTEX_OK;
}

otx_status
otx_cage_note_gaps(
    otx_run *run, const otx_cage_input *in, const otx_topology *t)
{
    otx_where where = OTX_NOWHERE;
    otx_weld_gaps gaps;

    if (!otx_weld_find_gaps(
            run->scratch, t, in->points, default_distance(in), &gaps))
        return otx_fail_memory(run, STAGE);
    where.file = in->path;
    where.vertex = gaps.first;
    where.line =
        in->vert_line && gaps.first >= 0 ? in->vert_line[gaps.first] : 0;
    if (gaps.vert_count > 0)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "%d vertices lie at only %d places (first is vertex %d), along "
            "edges that are open there: the surface comes apart at them; "
            "{weld} joins what lies in one place",
            gaps.vert_count, gaps.place_count, gaps.first);
    return OSDTEX_OK;
}

otx_status
otx_cage_split_folds(otx_run *run, const otx_topology *t, otx_cage_input *in)
{
    otx_where where = OTX_NOWHERE;
    otx_uv_fold fold;

    if (!otx_uv_fold_split(
            run->scratch, t, in->uv_count, in->uvs, in->face_uvs, &fold))
        return otx_fail_memory(run, STAGE);
    in->uv_count = fold.uv_count;
    in->uvs = fold.uvs;
    in->face_uvs = fold.face_uvs;
    if (fold.edge_count == 0)
        return OSDTEX_OK;
    where.file = in->path;
    where.face = fold.face;
    where.line = in->face_line ? in->face_line[fold.face] : 0;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, where,
        "the cage's UVs fold back at %d edges, as mirrored halves do (first at "
        "face %d); they are cut there in what is written, so that all readers "
        "smooth them alike",
        fold.edge_count, fold.face);
    return OSDTEX_OK;
}

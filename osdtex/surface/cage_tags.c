/* cage_tags.c -- creases, corners and holes of a cage. */
#include "surface/cage_tags.h"

#include <math.h>

#define STAGE "cage"

static otx_where
at_tag(const otx_cage_input *in, const int64_t *lines, int32_t tag)
{
    otx_where where = OTX_NOWHERE;

    where.file = in->path;
    where.line = lines ? lines[tag] : 0;
    return where;
}

static otx_status
check_vertex(
    otx_run *run, const otx_cage_input *in, otx_where where, const char *what,
    int32_t vertex)
{
    if (vertex >= 0 && vertex < in->vert_count)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, STAGE, where,
        "a %s refers to vertex %d, but there are only vertices 0 to %d; "
        "export the file again",
        what, vertex, in->vert_count - 1);
}

/* Infinity is a number here: it means what 10 means. */
static otx_status
check_sharpness(
    otx_run *run, otx_where where, const char *what, float sharpness)
{
    if (sharpness >= 0.0f)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, STAGE, where,
        "a %s has sharpness %g; it must be from 0 (smooth) to 10 (infinitely "
        "sharp)",
        what, (double)sharpness);
}

static otx_status
read_creases(
    otx_run *run, const otx_cage_input *in, const otx_topology *t,
    otx_cage *cage)
{
    int32_t *verts = OTX_NEW(run->arena, int32_t, 2 * (size_t)in->crease_count);
    float *sharpness = OTX_NEW(run->arena, float, in->crease_count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < in->crease_count; ++i)
    {
        const int32_t a = in->crease_verts[2 * (size_t)i];
        const int32_t b = in->crease_verts[2 * (size_t)i + 1];
        const otx_where where = at_tag(in, in->crease_line, i);

        OTX_TRY(check_vertex(run, in, where, "crease", a));
        OTX_TRY(check_vertex(run, in, where, "crease", b));
        OTX_TRY(check_sharpness(run, where, "crease", in->crease_sharpness[i]));
        if (otx_topology_find_edge(t, a, b) < 0)
        {
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE, where,
                "there is no edge between vertices %d and %d, so the crease "
                "on it is left out",
                a, b);
            continue;
        }
        verts[2 * (size_t)count] = a;
        verts[2 * (size_t)count + 1] = b;
        sharpness[count++] =
            fminf(in->crease_sharpness[i], OTX_CAGE_SHARPNESS_MAX);
    }
    cage->crease_count = count;
    cage->crease_verts = verts;
    cage->crease_sharpness = sharpness;
    return OSDTEX_OK;
}

static otx_status
read_corners(otx_run *run, const otx_cage_input *in, otx_cage *cage)
{
    int32_t *verts = OTX_NEW(run->arena, int32_t, in->corner_tag_count);
    float *sharpness = OTX_NEW(run->arena, float, in->corner_tag_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < in->corner_tag_count; ++i)
    {
        const otx_where where = at_tag(in, in->corner_tag_line, i);

        OTX_TRY(
            check_vertex(run, in, where, "corner", in->corner_tag_verts[i]));
        OTX_TRY(
            check_sharpness(run, where, "corner", in->corner_tag_sharpness[i]));
        verts[i] = in->corner_tag_verts[i];
        sharpness[i] =
            fminf(in->corner_tag_sharpness[i], OTX_CAGE_SHARPNESS_MAX);
    }
    cage->corner_tag_count = in->corner_tag_count;
    cage->corner_tag_verts = verts;
    cage->corner_tag_sharpness = sharpness;
    return OSDTEX_OK;
}

static otx_status
read_holes(otx_run *run, const otx_cage_input *in, otx_cage *cage)
{
    uint8_t *hole = OTX_ZNEW(run->arena, uint8_t, in->face_count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < in->hole_count; ++i)
    {
        const int32_t face = in->hole_faces[i];

        if (face < 0 || face >= in->face_count)
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE, at_tag(in, in->hole_line, i),
                "a hole refers to face %d, but there are only faces 0 to %d; "
                "export the file again",
                face, in->face_count - 1);
        count += !hole[face];
        hole[face] = 1;
    }
    if (count == in->face_count)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, at_tag(in, in->hole_line, 0),
            "every face is tagged as a hole; untag those that should be "
            "textured");
    cage->face_hole = hole;
    return OSDTEX_OK;
}

otx_status
otx_cage_tags_read(
    otx_run *run, const otx_cage_input *in, const otx_topology *t,
    otx_cage *cage)
{
    OTX_TRY(read_creases(run, in, t, cage));
    OTX_TRY(read_corners(run, in, cage));
    return read_holes(run, in, cage);
}

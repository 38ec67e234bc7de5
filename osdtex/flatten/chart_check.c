/* chart_check.c -- what holds of every chart. */
#include "flatten/chart_check.h"

#include <math.h>

static const char *
check_face(const otx_chart *chart, const otx_level *leaf, int32_t i)
{
    const int32_t face = chart->faces[i], first = chart->first[i];

    if (face < 0 || face >= leaf->face_count)
        return "a face is no leaf";
    if (chart->first[i + 1] - first != otx_level_face_size(leaf, face))
        return "a face has not as many corners as its leaf";
    for (int32_t c = first; c < chart->first[i + 1]; ++c)
    {
        const int32_t v = chart->corners[c];

        if (v < 0 || v >= chart->vert_count)
            return "a corner is no vertex of the chart";
        if (chart->verts[v] !=
            leaf->face_verts[leaf->face_first[face] + c - first])
            return "a corner is not its leaf's";
    }
    if (i < chart->core_count ? chart->reach[i] != 0.0f
                              : !(chart->reach[i] >= 0.0f))
        return "a face's distance from the core is not its own";
    return NULL;
}

const char *
otx_chart_check(const otx_chart *chart, const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    if (chart->core_count < 1 || chart->core_count > chart->face_count)
        return "the core is empty, or more than all";
    if (chart->first[0] != 0)
        return "the corners do not begin at 0";
    for (int32_t i = 0; i < chart->face_count; ++i)
    {
        const char *wrong = check_face(chart, leaf, i);

        if (wrong)
            return wrong;
    }
    for (int32_t v = 0; v < chart->vert_count; ++v)
        if (!isfinite(chart->flat[v].x) || !isfinite(chart->flat[v].y))
            return "a vertex lies nowhere";
    return NULL;
}

/* scale_check.c -- whether a scale and the size of a surface go together. */
#include "method/scale_check.h"

#include "math/vec.h"

static const char STAGE[] = "map";

/* Pictures along a leaf edge, at most: UVs are floats, and seams are looked at
 * texel by texel. */
static const double PICTURES_MAX = 1024.0;

/* Pictures along the mean leaf edge, at least. Floats near 1 are 2^-24 apart:
 * this leaves 64 steps to an edge, and to those of a fourth of its length
 * still enough for a triangle to keep its sense. */
static const double EDGE_MIN = 0x1p-18;

/* Pictures across the cage's bounding box, from corner to corner, between
 * which a scale is not remarkable; 5 is the default. */
static const double ACROSS_MAX = 40.0, ACROSS_MIN = 0.25;
static const double ACROSS_USUAL = 5.0;

/* Pictures along an edge from which seams have nothing to follow. */
static const double EDGE_LONG = 1.0;

static double
longest_edge(const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    double longest = 0.0;

    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *v = leaf->edge_verts + 2 * (size_t)e;
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(surface->points, v[0]),
            otx_vec3_load(surface->points, v[1]));

        longest = fmax(longest, otx_vec3_dot(d, d));
    }
    return sqrt(longest);
}

otx_status
otx_scale_check(
    otx_run *run, const otx_surface *surface, double finer,
    const otx_exemplar *exemplar, double scale)
{
    const otx_where where = otx_where_file(surface->cage->path);
    const double longest = longest_edge(surface) / finer / scale;
    const double mean = surface->mean_edge_length / finer / scale;
    const double texels =
        sqrt(surface->area) / scale * (double)exemplar->match.width;

    if (longest > PICTURES_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, where,
            "at a scale of %g an edge of the mesh is %.3g pictures long, over "
            "the limit of %g; raise {scale} or {level}; or are scale and "
            "cage in different units?",
            scale, longest, PICTURES_MAX);
    /* Written so that NaN is refused, too. */
    if (texels >= 1.0 && mean >= EDGE_MIN)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_LIMIT, STAGE, where,
        "at a scale of %g the whole surface is %.3g texels of the exemplar "
        "wide, and its edges %.3g; lower {scale}; or are scale and cage in "
        "different units?",
        scale, texels, mean * (double)exemplar->match.width);
}

void
otx_scale_warn(otx_run *run, const otx_cage *cage, int32_t level, double scale)
{
    const otx_where where = otx_where_file(cage->path);
    const double across = cage->diagonal / scale;
    const double edge = ldexp(cage->mean_edge_length, -level) / scale;
    const double usual = cage->diagonal / ACROSS_USUAL;

    if (edge > EDGE_LONG)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "wrong units? The exemplar is %g scene units wide and the cage %g "
            "across, and at level %d an edge is still %.2g pictures long, "
            "where seams can only run along edges; a scale of %.3g shows five "
            "pictures across",
            scale, cage->diagonal, level, edge, usual);
    else if (across > ACROSS_MAX)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "wrong units? The exemplar is %g scene units wide and the cage %g "
            "across: %.0f pictures side by side on %.0f faces; a scale of "
            "%.3g shows five",
            scale, cage->diagonal, across, otx_surface_face_count(cage, level),
            usual);
    else if (across < ACROSS_MIN)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "wrong units? The exemplar is %g scene units wide and the cage %g "
            "across, so all of it shows %.2g of the picture's width; a scale "
            "of %.3g shows five pictures across",
            scale, cage->diagonal, across, usual);
}

/* mapping_check.c -- does a mapping hold what everything behind it relies on?
 */
#include "mapping/mapping_check.h"

#include "mapping/laid_face.h"
#include "mapping/seam.h"
#include "mapping/source.h"
#include "surface/limit.h"

#include <math.h>

/* Texels beyond the border of an exemplar that ends; up to there a lookup
 * shows the border's texel, as it should. */
static const double BEYOND_MAX = 0.5;

/* Share of the area that may be reversed. */
static const double REVERSED_MAX = 0.25;

/* Departure of the sum of a corner's weights from 1: they are floats. */
static const double WEIGHT_ERROR = 1e-3;

typedef struct checker
{
    otx_run *run;
    const otx_mapping *mapping;
    const otx_surface *surface;
    const otx_level *leaf;
    const otx_exemplar *exemplars;
    int32_t exemplar_count;
    const char *method;
    const char *path; /* of the file it was read from; NULL: `method` made it */
} checker;

/* A leaf face as the cage's face that it is of; -1 none. */
static otx_where
where(const checker *c, int32_t face)
{
    const otx_cage *cage = c->surface->cage;

    return (otx_where){
        cage ? cage->path : NULL, 0, face >= 0 ? c->leaf->face_cage[face] : -1,
        -1};
}

static otx_status
fail(const checker *c, int32_t face, const char *what)
{
    if (c->path)
        return otx_fail(
            c->run, OSDTEX_ERROR_FORMAT, "mapping",
            (otx_where){c->path, 0, where(c, face).face, -1},
            "the saved mapping is damaged: %s", what);
    return otx_fail(
        c->run, OSDTEX_ERROR_INTERNAL, "map", where(c, face),
        "the method '%s' returned a mapping that is not valid: %s; please "
        "report this with the cage, the exemplar and the options",
        c->method, what);
}

/* ----------------------------------------------------------------- shape */

static otx_status
check_shape(const checker *c)
{
    const otx_mapping *m = c->mapping;

    if (!m->surface ||
        otx_surface_leaf(m->surface)->face_count != c->leaf->face_count ||
        otx_surface_leaf(m->surface)->corner_count != c->leaf->corner_count)
        return fail(c, -1, "it is of another surface");
    if (!m->uvs || !m->face_patch)
        return fail(c, -1, "it has no UVs or no patches");
    if (!(m->scale > 0.0) || !isfinite(m->scale))
        return fail(c, -1, "its scale is not a positive number");
    if (m->patch_count < 0 || m->patch_count > c->leaf->face_count)
        return fail(c, -1, "it has more patches than faces");
    if (m->patch_exemplar &&
        (m->exemplar_count < 1 || m->exemplar_count > c->exemplar_count))
        return fail(c, -1, "it takes from more exemplars than there are");
    return OSDTEX_OK;
}

static otx_status
check_sources(const checker *c)
{
    const otx_mapping *m = c->mapping;

    for (int32_t p = 0; m->patch_exemplar && p < m->patch_count; ++p)
        if (m->patch_exemplar[p] >= m->exemplar_count)
            return fail(c, -1, "a patch takes from an exemplar not given");
    return OSDTEX_OK;
}

/* ----------------------------------------------------------------- faces */

static otx_status
check_patch(const checker *c, int32_t face)
{
    const int32_t patch = c->mapping->face_patch[face];

    if (c->leaf->face_hole[face])
        return patch == -1 ? OSDTEX_OK : fail(c, face, "a hole has a patch");
    if (patch == -1)
        return fail(c, face, "a face that is no hole is not covered");
    if (patch < 0 || patch >= c->mapping->patch_count)
        return fail(c, face, "a face is of a patch that does not exist");
    return OSDTEX_OK;
}

/* Texels by which a coordinate leaves a picture of `size` texels. */
static double
beyond(double uv, int32_t size, bool wraps)
{
    return wraps ? 0.0 : size * fmax(-uv, uv - 1.0);
}

/* How many lookups a face mixes; 0 where its own UVs are looked up. */
static int64_t
lookup_count(const checker *c, int32_t face)
{
    const otx_lookups *lookups = c->mapping->lookups;
    const int64_t items =
        lookups ? lookups->first[face + 1] - lookups->first[face] : 0;

    return items / otx_level_face_size(c->leaf, face);
}

/* What lies over something else may be cut out by a mask well inside of its
 * picture, and its faces may reach further. */
static bool
may_leave(const checker *c, int32_t face)
{
    return lookup_count(c, face) > 0 &&
           c->mapping->lookups->layering == OTX_LAYERING_OVER;
}

static otx_status
check_uv(const checker *c, int32_t face, const float uv[2])
{
    const otx_exemplar *e = &c->exemplars[otx_source_of(c->mapping, face)];

    if (!isfinite(uv[0]) || !isfinite(uv[1]))
        return fail(c, face, "a UV is not finite");
    if (may_leave(c, face))
        return OSDTEX_OK;
    if (beyond((double)uv[0], e->match.width, e->wrap_x) > BEYOND_MAX ||
        beyond((double)uv[1], e->match.height, e->wrap_y) > BEYOND_MAX)
        return fail(
            c, face, "a UV lies outside of an exemplar that does not tile");
    return OSDTEX_OK;
}

static otx_status
check_uvs(const checker *c, int32_t face)
{
    const int32_t end = c->leaf->face_first[face + 1];

    for (int32_t i = c->leaf->face_first[face]; i < end; ++i)
        OTX_TRY(check_uv(c, face, c->mapping->uvs + 2 * (size_t)i));
    return OSDTEX_OK;
}

static otx_status
check_lookups(const checker *c, int32_t face)
{
    const int32_t size = otx_level_face_size(c->leaf, face);
    const int64_t count = lookup_count(c, face);
    const otx_lookup *items;

    if (count == 0)
        return OSDTEX_OK;
    items = c->mapping->lookups->items + c->mapping->lookups->first[face];
    for (int32_t i = 0; i < size; ++i)
    {
        double sum = 0.0;

        for (int64_t k = 0; k < count; ++k)
        {
            OTX_TRY(check_uv(c, face, items[k * size + i].uv));
            sum += (double)items[k * size + i].weight;
        }
        if (c->mapping->lookups->layering == OTX_LAYERING_MEAN &&
            !(fabs(sum - 1.0) <= WEIGHT_ERROR))
            return fail(c, face, "the weights of its lookups are not 1 in sum");
    }
    return OSDTEX_OK;
}

/* --------------------------------------------------------------- winding */

/* Twice the area of a face on the surface, by its fan. */
static double
surface_area2(const checker *c, int32_t face)
{
    const int32_t *verts = c->leaf->face_verts + c->leaf->face_first[face];
    const float *points = c->mapping->surface->points;
    const otx_vec3 origin = otx_vec3_load(points, verts[0]);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t k = 1; k + 1 < otx_level_face_size(c->leaf, face); ++k)
        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(points, verts[k]), origin),
                otx_vec3_sub(otx_vec3_load(points, verts[k + 1]), origin)));
    return otx_vec3_length(sum);
}

/* The sign of a face's area in UV is that of its winding. */
static double
uv_area2(const checker *c, int32_t face)
{
    const float *uv = c->mapping->uvs + 2 * (size_t)c->leaf->face_first[face];
    double sum = 0.0;

    for (int32_t k = 1; k + 1 < otx_level_face_size(c->leaf, face); ++k)
    {
        const float *a = uv + 2 * (size_t)k, *b = a + 2;

        sum += ((double)a[0] - (double)uv[0]) * ((double)b[1] - (double)uv[1]) -
               ((double)a[1] - (double)uv[1]) * ((double)b[0] - (double)uv[0]);
    }
    return sum;
}

/* Faces without area have no winding; those with lookups do not show their
 * UVs. */
static bool
is_reversed(const checker *c, int32_t face)
{
    return !c->leaf->face_hole[face] && lookup_count(c, face) == 0 &&
           !(uv_area2(c, face) > 0.0) &&
           !otx_limit_face_is_flat(c->leaf, c->mapping->surface->points, face);
}

static otx_status
check_winding(const checker *c)
{
    double reversed = 0.0, all = 0.0;
    int32_t count = 0, first = -1;

    for (int32_t f = 0; f < c->leaf->face_count; ++f)
    {
        const double area = surface_area2(c, f);

        all += c->leaf->face_hole[f] ? 0.0 : area;
        if (!is_reversed(c, f))
            continue;
        reversed += area;
        first = count++ == 0 ? f : first;
    }
    if (reversed > REVERSED_MAX * all)
        return fail(c, first, "it shows the exemplar reversed");
    if (count > 0)
        otx_note(
            c->run, OSDTEX_SEVERITY_WARNING, "map", where(c, first),
            "%d faces, %.2g %% of the area, are reversed or have no area in "
            "UV; the texture is torn there",
            (int)count, 100.0 * reversed / all);
    return OSDTEX_OK;
}

/* ----------------------------------------------------------------- folds */

/* A triangle has no corner that could be reversed alone. */
static bool
is_folded(const checker *c, int32_t face)
{
    const otx_exemplar *e = &c->exemplars[otx_source_of(c->mapping, face)];
    otx_laid_face laid;

    if (c->leaf->face_hole[face] || lookup_count(c, face) > 0 ||
        otx_level_face_size(c->leaf, face) < 4 || !(uv_area2(c, face) > 0.0))
        return false;
    otx_laid_face_set(
        c->mapping, e, otx_seam_texels_per_unit(c->mapping, e), face, &laid);
    return otx_laid_face_is_folded(&laid);
}

/* What an artist would see as torn texture is said aloud, not in a report
 * alone. */
static void
say_folds(const checker *c)
{
    int32_t count = 0, first = -1;

    for (int32_t f = 0; f < c->leaf->face_count; ++f)
        if (is_folded(c, f))
            first = count++ == 0 ? f : first;
    if (count > 0)
        otx_note(
            c->run, OSDTEX_SEVERITY_WARNING, "map", where(c, first),
            "%d faces are folded over in UV, and the texture is torn there; a "
            "higher {level} or a smaller {scale} bends it less",
            (int)count);
}

static otx_status
check(const checker *c)
{
    OTX_TRY(check_shape(c));
    OTX_TRY(check_sources(c));
    for (int32_t f = 0; f < c->leaf->face_count; ++f)
    {
        OTX_TRY(check_patch(c, f));
        OTX_TRY(check_uvs(c, f));
        OTX_TRY(check_lookups(c, f));
    }
    OTX_TRY(check_winding(c));
    say_folds(c);
    return OSDTEX_OK;
}

static checker
checker_of(
    otx_run *run, const otx_mapping *mapping, const otx_surface *surface,
    const otx_exemplar *exemplars, int32_t exemplar_count)
{
    return (checker){
        .run = run,
        .mapping = mapping,
        .surface = surface,
        .leaf = otx_surface_leaf(surface),
        .exemplars = exemplars,
        .exemplar_count = exemplar_count,
    };
}

otx_status
otx_mapping_check(
    otx_run *run, const otx_mapping *mapping, const otx_surface *surface,
    const otx_exemplar *exemplars, int32_t exemplar_count, const char *method)
{
    checker c = checker_of(run, mapping, surface, exemplars, exemplar_count);

    c.method = method;
    return check(&c);
}

otx_status
otx_mapping_check_file(
    otx_run *run, const otx_mapping *mapping, const otx_surface *surface,
    const otx_exemplar *exemplars, int32_t exemplar_count, const char *path)
{
    checker c = checker_of(run, mapping, surface, exemplars, exemplar_count);

    c.path = path;
    return check(&c);
}

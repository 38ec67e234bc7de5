/* seam.c -- finds seams by comparing UVs across edges, and samples them.
 *
 * Patch labels play no part: two patches that happen to agree along an edge
 * are continuous there, and a chart that is torn inside one patch is not. */
#include "mapping/seam.h"

#include "mapping/show_decals.h"
#include "seam/difference.h"
#include "seam/unit.h"

double
otx_seam_texels_per_unit(
    const otx_mapping *mapping, const otx_exemplar *exemplars)
{
    return otx_unit_texels(exemplars, mapping->scale);
}

bool
otx_seam_covered(const otx_mapping *mapping, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const size_t first = 2 * (size_t)leaf->face_first[face];
    const size_t end = 2 * (size_t)leaf->face_first[face + 1];

    if (leaf->face_hole[face] || mapping->face_patch[face] < 0)
        return false;
    for (size_t k = first; k < end; ++k)
        if (!isfinite(mapping->uvs[k]))
            return false;
    return true;
}

otx_vec2
otx_seam_texel(
    const otx_mapping *mapping, const otx_exemplar *exemplar, int32_t corner)
{
    const float *uv = mapping->uvs + 2 * (size_t)corner;

    return (otx_vec2){
        (double)uv[0] * exemplar->match.width,
        (double)uv[1] * exemplar->match.height};
}

/* What the search for seams reads, and the list as it grows. */
typedef struct search
{
    const otx_mapping *mapping;
    otx_show_view show;
    const otx_exemplar *exemplars;
    const otx_level *leaf;
    const uint8_t *covered; /* [face_count] */
    double texels_per_unit;
    int32_t *edges;
    uint8_t *transition;
    double *lengths;
    int32_t *sample_first;
    float *samples;
} search;

/*   from  the exemplars of the two sides */
static void
edge_sides(
    const search *s, int32_t edge, otx_vec2 sides[2][2],
    const otx_exemplar *from[2])
{
    for (int f = 0; f < 2; ++f)
    {
        const int32_t face = s->leaf->edge_faces[2 * (size_t)edge + f];
        int32_t corners[2];

        from[f] = &s->exemplars[otx_source_of(s->mapping, face)];
        otx_seam_corners(s->leaf, edge, face, corners);
        for (int k = 0; k < 2; ++k)
            sides[f][k] = otx_seam_texel(s->mapping, from[f], corners[k]);
    }
}

static bool
is_layered(const search *s, int32_t edge)
{
    const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)edge;

    return otx_show_is_layered(&s->show, faces[0]) ||
           otx_show_is_layered(&s->show, faces[1]);
}

/* A face's view of an edge, for the evaluator. */
static otx_show_place
place_on(
    const search *s, int32_t edge, int side, int32_t corners[3], double at[3])
{
    const int32_t face = s->leaf->edge_faces[2 * (size_t)edge + side];

    otx_seam_corners(s->leaf, edge, face, corners);
    corners[2] = corners[1];
    at[2] = 0.0;
    return (otx_show_place){face, corners, at, NULL, NULL};
}

/* What term `index` of one side looks up at both ends of an edge, in texels,
 * and its weights there. */
static otx_show_term
term_on(
    const search *s, int32_t edge, int side, int32_t index, otx_vec2 texels[2],
    double weights[2])
{
    int32_t corners[3];
    double at[3];
    const otx_show_place place = place_on(s, edge, side, corners, at);
    otx_show_term term = {0};

    for (int k = 0; k < 2; ++k)
    {
        const otx_exemplar *from;

        at[0] = 1 - k;
        at[1] = k;
        term = otx_show_term_at(
            &s->show, &place, otx_source_of(s->mapping, place.face), index);
        from = &s->exemplars[term.exemplar];
        weights[k] = term.weight;
        texels[k] = (otx_vec2){
            term.uv.x * from->match.width, term.uv.y * from->match.height};
    }
    return term;
}

/* Weights that differ by less are one, and terms that have less do not count:
 * they are floats that were refined. */
static const double WEIGHT_TOLERANCE = 1e-3;

static bool
is_cut(const otx_show_term *term)
{
    return term->fragment && (term->fragment->mask || term->fragment->outline);
}

static bool
cut_alike(const otx_show_term *a, const otx_show_term *b)
{
    return a->fragment == b->fragment || (!is_cut(a) && !is_cut(b));
}

/* Whether every term of one side that shows along an edge is met by one of the
 * other side. */
static bool
is_met(const search *s, int32_t edge, int side)
{
    const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)edge;
    const int32_t count = otx_show_term_count(&s->show, faces[side]);
    const int32_t others = otx_show_term_count(&s->show, faces[1 - side]);

    for (int32_t i = 0; i < count; ++i)
    {
        otx_vec2 a[2], b[2];
        double v[2], w[2];
        const otx_show_term here = term_on(s, edge, side, i, a, v);
        bool met = fmax(v[0], v[1]) < WEIGHT_TOLERANCE;

        for (int32_t j = 0; j < others && !met; ++j)
        {
            const otx_show_term there = term_on(s, edge, 1 - side, j, b, w);

            met = here.exemplar == there.exemplar && cut_alike(&here, &there) &&
                  fabs(v[0] - w[0]) < WEIGHT_TOLERANCE &&
                  fabs(v[1] - w[1]) < WEIGHT_TOLERANCE &&
                  otx_seam_continuous(&s->exemplars[here.exemplar], a, b);
        }
        if (!met)
            return false;
    }
    return true;
}

static bool
decals_go_on(const search *s, int32_t edge)
{
    const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)edge;
    int32_t corners[2][2];

    if (!otx_decals_has(s->show.decals, faces[0]) &&
        !otx_decals_has(s->show.decals, faces[1]))
        return true;
    for (int side = 0; side < 2; ++side)
        otx_seam_corners(s->leaf, edge, faces[side], corners[side]);
    return otx_show_decals_go_on(&s->show, faces, corners);
}

static bool
is_continuous(
    const search *s, int32_t edge, otx_vec2 sides[2][2],
    const otx_exemplar *from[2])
{
    const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)edge;
    const int made = otx_show_is_made(&s->show, faces[0]) +
                     otx_show_is_made(&s->show, faces[1]);

    if (!decals_go_on(s, edge))
        return false;
    /* What was made texel by texel goes on, and meets the rest where it was
     * held to the rest's own UVs. */
    if (made == 2)
        return from[0] == from[1];
    if (made == 0 && is_layered(s, edge))
        return is_met(s, edge, 0) && is_met(s, edge, 1);
    return from[0] == from[1] &&
           otx_seam_continuous(from[0], sides[0], sides[1]);
}

/* Lists the seams; their samples are only counted. */
static otx_status
find_seams(otx_run *run, search *s, otx_seam_list *out)
{
    int64_t samples = 0;

    s->sample_first[0] = 0;
    for (int32_t e = 0; e < s->leaf->edge_count; ++e)
    {
        const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)e;
        const otx_exemplar *from[2];
        otx_vec2 sides[2][2];

        if (faces[1] < 0 || !s->covered[faces[0]] || !s->covered[faces[1]])
            continue;

        const double length =
            s->texels_per_unit * otx_seam_edge_length(s->mapping->surface, e);

        out->interior_length += length;
        edge_sides(s, e, sides, from);
        if (is_continuous(s, e, sides, from))
            continue;
        samples += otx_seam_sample_count(length);
        if (samples > INT32_MAX)
            return otx_fail(
                run, OSDTEX_ERROR_LIMIT, "measure", OTX_NOWHERE,
                "the seams have more than 2^31 texels; choose a larger scale");
        out->total_length += length;
        out->transition_length += from[0] != from[1] ? length : 0.0;
        s->transition[out->edge_count] = from[0] != from[1];
        s->edges[out->edge_count] = e;
        s->lengths[out->edge_count] = length;
        s->sample_first[++out->edge_count] = (int32_t)samples;
    }
    return OSDTEX_OK;
}

/* Colours along a side of an edge whose faces may have lookups. */
static void
sample_shown(
    const search *s, int32_t edge, int side, int32_t count, float *colors)
{
    int32_t corners[3];
    double at[3];
    const otx_show_place place = place_on(s, edge, side, corners, at);

    for (int32_t i = 0; i < count; ++i)
    {
        at[1] = (i + 0.5) / count;
        at[0] = 1.0 - at[1];
        otx_show_lab(
            &s->show, s->exemplars, &place,
            otx_source_of(s->mapping, place.face), colors + 3 * (size_t)i);
    }
}

static otx_status
sample_seam(void *context, int64_t index, otx_worker *worker)
{
    const search *s = context;
    const int32_t first = s->sample_first[index];
    const int32_t count = s->sample_first[index + 1] - first;
    float *colors = OTX_NEW(worker->scratch, float, 6 * (int64_t)count);
    const otx_exemplar *from[2];
    otx_vec2 sides[2][2];

    if (!colors)
        return OSDTEX_ERROR_MEMORY;
    edge_sides(s, s->edges[index], sides, from);
    for (int f = 0; f < 2; ++f)
        if (is_layered(s, s->edges[index]))
            sample_shown(
                s, s->edges[index], f, count, colors + 3 * (size_t)(f * count));
        else
            otx_seam_sample(
                &from[f]->lab, from[f]->wrap_x, from[f]->wrap_y, sides[f], 0.0,
                count, colors + 3 * (size_t)(f * count));
    for (int32_t i = 0; i < count; ++i)
    {
        const float *a = colors + 3 * (size_t)i;
        const float *b = a + 3 * (size_t)count;

        s->samples[first + i] = (float)otx_difference(a, b);
    }
    return OSDTEX_OK;
}

static otx_status
sample_seams(otx_run *run, search *s, otx_seam_list *out)
{
    s->samples = OTX_NEW(run->arena, float, s->sample_first[out->edge_count]);
    out->samples = s->samples;
    OTX_TRY(otx_run_ok(run));
    return otx_loop_result(
        run, "measure",
        otx_pool_for(run->pool, out->edge_count, sample_seam, s));
}

/* Fills `covered` and the arrays of the list at their largest. */
static bool
prepare(otx_run *run, search *s, otx_seam_list *out)
{
    const int64_t edge_count = s->leaf->edge_count;
    uint8_t *covered = OTX_NEW(run->scratch, uint8_t, s->leaf->face_count);

    out->edges = s->edges = OTX_NEW(run->arena, int32_t, edge_count);
    out->transition = s->transition = OTX_NEW(run->arena, uint8_t, edge_count);
    out->lengths = s->lengths = OTX_NEW(run->arena, double, edge_count);
    out->sample_first = s->sample_first =
        OTX_NEW(run->arena, int32_t, edge_count + 1);
    if (!covered || !s->edges || !s->transition || !s->lengths ||
        !s->sample_first)
        return false;
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
        covered[f] = otx_seam_covered(s->mapping, f);
    s->covered = covered;
    return true;
}

otx_status
otx_seam_collect(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_seam_list *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    search s = {
        .mapping = mapping,
        .show = otx_show_of(mapping),
        .exemplars = exemplars,
        .leaf = otx_surface_leaf(mapping->surface),
        .texels_per_unit = otx_seam_texels_per_unit(mapping, exemplars),
    };

    *out = (otx_seam_list){0};

    otx_status status = prepare(run, &s, out) ? find_seams(run, &s, out)
                                              : otx_fail_memory(run, "measure");

    if (status == OSDTEX_OK)
        status = sample_seams(run, &s, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

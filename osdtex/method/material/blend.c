/* blend.c -- singular faces as their corners see them [Ray09, sec. 3].
 *
 * Around a corner whose ring is singular the coordinates go on by the steps
 * that the field asks for, around others by those that were solved for. Each
 * corner of a face thus has coordinates for all of it; what they look up is
 * mixed, with weights that are 1 at the corner and 0 at the others. Along an
 * edge only the two at its ends have weight, and both of its faces take the
 * same steps along it, so that the colour does not jump. */
#include "method/material/material.h"

#include "method/material/solved_face.h"

#include "cluster/dual.h"

enum
{
    SIDES_MAX = 64 /* of a face; larger ones are left alone */
};

typedef struct blender
{
    otx_material *m;
    const otx_level *level; /* that is solved on */
    const otx_level *leaf;
    int64_t *first;
    otx_lookup *items;
} blender;

otx_status
otx_blend_check(const otx_material *m)
{
    const otx_where where = {m->job->exemplars->source_path, 0, -1, -1};

    if (m->courses.count > 0)
        return otx_fail(
            m->job->run, OSDTEX_ERROR_SUPPORT, "map", where,
            "{set} fill=blend needs a lattice that is laid as a whole, but the "
            "exemplar is laid in courses; say {set} courses=off or {set} "
            "fill=on");
    if (!m->job->exemplars->wrap_x || !m->job->exemplars->wrap_y)
        return otx_fail(
            m->job->run, OSDTEX_ERROR_SUPPORT, "map", where,
            "{set} fill=blend needs an exemplar that tiles; make it tile "
            "({tileable} make), or say {set} fill=on");
    return OSDTEX_OK;
}

/* -- which faces --------------------------------------------------------- */

/* Whether the solved steps are no use around corner k of a face. */
static bool
is_singular(const blender *b, int32_t face, int32_t k)
{
    const int32_t vertex = b->level->face_verts[b->level->face_first[face] + k];

    return b->m->solved.rings.singular[vertex] ||
           b->m->solved.phase.turned[vertex];
}

static bool
is_blended(const blender *b, int32_t face)
{
    const int32_t size = otx_level_face_size(b->level, face);

    if (b->level->face_hole[face] || size > SIDES_MAX)
        return false;
    for (int32_t k = 0; k < size; ++k)
        if (is_singular(b, face, k))
            return true;
    return false;
}

/* Room for as many lookups in a leaf face as the solved face has corners. */
static otx_status
make_room(blender *b)
{
    otx_arena *arena = b->m->job->run->arena;
    int64_t count = 0;

    b->first = OTX_NEW(arena, int64_t, (int64_t)b->leaf->face_count + 1);
    OTX_TRY(otx_run_ok(b->m->job->run));
    for (int32_t f = 0; f < b->leaf->face_count; ++f)
    {
        const int32_t solved = otx_material_solved_face(b->m, f);

        b->first[f] = count;
        if (is_blended(b, solved))
            count += (int64_t)otx_level_face_size(b->leaf, f) *
                     otx_level_face_size(b->level, solved);
    }
    b->first[b->leaf->face_count] = count;
    b->items = OTX_NEW(arena, otx_lookup, count + 1);
    return otx_run_ok(b->m->job->run);
}

/* -- weights ------------------------------------------------------------- */

/* Stores the weights of two lookups, `lookup` and the next one. */
static void
store_weights(const blender *b, int32_t lookup, const otx_vec2 *weights)
{
    for (int32_t f = 0; f < b->leaf->face_count; ++f)
    {
        const int32_t size = otx_level_face_size(b->leaf, f);
        const int64_t count = (b->first[f + 1] - b->first[f]) / size;
        otx_lookup *items = b->items + b->first[f];

        for (int32_t c = 0; c < size; ++c)
        {
            const otx_vec2 w = weights[b->leaf->face_first[f] + c];

            if (lookup < count)
                items[lookup * size + c].weight = (float)w.x;
            if (lookup + 1 < count)
                items[(lookup + 1) * size + c].weight = (float)w.y;
        }
    }
}

/* 1 at one corner of the solved face, 0 at the others, and between them as
 * coordinates are: two lookups at a time. */
static otx_status
weigh(const blender *b)
{
    otx_arena *scratch = b->m->job->run->scratch;
    const otx_arena_mark mark = otx_arena_here(scratch);
    int32_t most = 0;

    for (int32_t f = 0; f < b->level->face_count; ++f)
        if (is_blended(b, f) && otx_level_face_size(b->level, f) > most)
            most = otx_level_face_size(b->level, f);
    for (int32_t k = 0; k < most; k += 2)
    {
        otx_vec2 *corners = OTX_ZNEW(scratch, otx_vec2, b->level->corner_count);
        otx_vec2 *weights;

        OTX_TRY(otx_run_ok(b->m->job->run));
        for (int32_t f = 0; f < b->level->face_count; ++f)
        {
            if (k < otx_level_face_size(b->level, f))
                corners[b->level->face_first[f] + k].x = 1.0;
            if (k + 1 < otx_level_face_size(b->level, f))
                corners[b->level->face_first[f] + k + 1].y = 1.0;
        }
        OTX_TRY(otx_material_refine(b->m, scratch, corners, &weights));
        store_weights(b, k, weights);
        otx_arena_release(scratch, mark);
    }
    return OSDTEX_OK;
}

/* -- coordinates --------------------------------------------------------- */

/* Cells from each corner of a face to the next that the field asks for, in the
 * sense of the face's cells. */
static void
measure_wishes(const blender *b, int32_t face, otx_vec2 *out)
{
    const otx_phase *phase = &b->m->solved.phase;
    const int32_t first = b->level->face_first[face];

    for (int32_t k = 0; k < otx_level_face_size(b->level, face); ++k)
    {
        const int32_t edge = b->level->face_edges[first + k];
        const int along = b->level->edge_faces[2 * (size_t)edge] == face
                              ? 1
                              : -phase->match[edge];

        out[k] = otx_vec2_scale(
            phase->sense[face] * along,
            (otx_vec2){phase->wish[0][edge], phase->wish[1][edge]});
    }
}

static double
nearest(double part, double cell)
{
    return part + round(cell - part);
}

/* Cells of corner k of a face, the same in all faces around its vertex up to
 * whole ones and their sense. */
static otx_vec2
cell_of(const blender *b, int32_t face, int32_t k)
{
    const otx_phase *phase = &b->m->solved.phase;
    const int32_t corner = b->level->face_first[face] + k;
    otx_vec2 part = otx_vec2_scale(phase->sense[face], phase->parts[corner]);

    if (phase->turned[b->level->face_verts[corner]])
        part = (otx_vec2){0.5 * round(2.0 * part.x), 0.5 * round(2.0 * part.y)};
    return (otx_vec2){
        nearest(part.x, phase->cells[corner].x),
        nearest(part.y, phase->cells[corner].y)};
}

/* Cells of all corners of a face as corner k sees them: its neighbours are a
 * step away, the others at the mean of both ways round. */
static void
lay_corner(const blender *b, int32_t face, int32_t k, otx_vec2 *out)
{
    const otx_vec2 *cells =
        b->m->solved.phase.cells + b->level->face_first[face];
    const int32_t size = otx_level_face_size(b->level, face);
    const otx_vec2 own = cell_of(b, face, k);
    otx_vec2 wishes[SIDES_MAX], there = own, back = own;
    const bool singular = is_singular(b, face, k);

    for (int32_t i = 0; i < size; ++i)
        out[i] = singular ? (otx_vec2){0, 0}
                          : otx_vec2_add(own, otx_vec2_sub(cells[i], cells[k]));
    if (!singular)
        return;
    out[k] = own;
    measure_wishes(b, face, wishes);
    for (int32_t i = 1; i + 1 < size; ++i)
    {
        const int32_t ahead = (k + i) % size, behind = (k + size - i) % size;
        const double share = i == 1 ? 1.0 : 0.5;

        there = otx_vec2_add(there, wishes[(k + i - 1) % size]);
        back = otx_vec2_sub(back, wishes[behind]);
        out[ahead] = otx_vec2_add(out[ahead], otx_vec2_scale(share, there));
        out[behind] = otx_vec2_add(out[behind], otx_vec2_scale(share, back));
    }
}

static otx_vec2
to_uv(const otx_material *m, otx_vec2 cell)
{
    const otx_vec2 *g = m->analysis.generators;
    const otx_vec2 at = otx_vec2_add(
        m->analysis.centre,
        otx_vec2_add(
            otx_vec2_scale(cell.x, g[0]), otx_vec2_scale(cell.y, g[1])));

    return (otx_vec2){
        at.x / m->job->exemplars->match.width,
        at.y / m->job->exemplars->match.height};
}

/* UVs of one lookup in a leaf face, from the cells at the corners of the face
 * above it. Whole pictures are taken off, so that floats are fine. */
static void
store_uvs(
    const blender *b, int32_t face, int32_t lookup, const otx_vec2 *cells,
    int32_t count)
{
    const int32_t size = otx_level_face_size(b->leaf, face);
    otx_lookup *items = b->items + b->first[face];
    otx_vec2 shift = {0, 0};

    for (int32_t c = 0; c < size; ++c)
    {
        otx_vec2 cell = {0, 0}, uv;

        for (int32_t i = 0; i < count; ++i)
            cell = otx_vec2_add(
                cell, otx_vec2_scale(items[i * size + c].weight, cells[i]));
        uv = to_uv(b->m, cell);
        if (c == 0)
            shift = (otx_vec2){floor(uv.x), floor(uv.y)};
        uv = otx_vec2_sub(uv, shift);
        items[lookup * size + c].uv[0] = (float)uv.x;
        items[lookup * size + c].uv[1] = (float)uv.y;
        items[lookup * size + c].fragment = -1;
    }
}

/* -- the whole ----------------------------------------------------------- */

static void
note(const blender *b)
{
    otx_material_tally *tally = &b->m->tally;
    double blended = 0.0, all = 0.0;

    for (int32_t f = 0; f < b->level->face_count; ++f)
        tally->blended_faces += is_blended(b, f);
    for (int32_t f = 0; f < b->leaf->face_count; ++f)
    {
        otx_vec3 unused;
        const double area = b->leaf->face_hole[f]
                                ? 0.0
                                : otx_vec3_length(otx_dual_leaf_area(
                                      b->m->job->surface, f, &unused));

        all += area;
        blended += b->first[f + 1] > b->first[f] ? area : 0.0;
    }
    tally->blended_share = blended / all;
    otx_note(
        b->m->job->run, OSDTEX_SEVERITY_INFO, "map", OTX_NOWHERE,
        "%d of %d faces, %.1f %% of the area, are mixed from what their "
        "corners look up; an OBJ cannot say that: UVs alone are torn there",
        (int)tally->blended_faces, (int)b->level->face_count,
        100.0 * tally->blended_share);
}

otx_status
otx_blend_run(otx_material *m, otx_mapping *out)
{
    otx_lookups *lookups = OTX_NEW(m->job->run->arena, otx_lookups, 1);
    blender b = {
        m, m->solved.connection.level, otx_surface_leaf(m->job->surface), 0, 0};

    OTX_TRY(otx_run_ok(m->job->run));
    OTX_TRY(make_room(&b));
    OTX_TRY(weigh(&b));
    for (int32_t f = 0; f < b.leaf->face_count; ++f)
    {
        const int32_t solved = otx_material_solved_face(m, f);
        const int32_t count = otx_level_face_size(b.level, solved);
        otx_vec2 cells[SIDES_MAX];

        for (int32_t k = 0; b.first[f + 1] > b.first[f] && k < count; ++k)
        {
            lay_corner(&b, solved, k, cells);
            store_uvs(&b, f, k, cells, count);
        }
    }
    note(&b);
    *lookups = (otx_lookups){.first = b.first, .items = b.items};
    if (m->tally.blended_faces > 0)
        out->lookups = lookups;
    return OSDTEX_OK;
}

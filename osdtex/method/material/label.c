/* label.c -- cells become patches that other stages understand.
 *
 * A patch gives a vertex one UV. So faces whose cells agree make a patch as
 * long as they also agree wherever they meet again, around a defect or a
 * handle. Where the exemplar does not tile, whole cells are taken off until a
 * face lies inside the picture, which cuts the surface into windows. */
#include "method/material/material.h"

#include "base/csr.h"

#include <string.h>

/* Cells closer than this are the same. */
static const double SAME = 1e-6;

/* -- windows ------------------------------------------------------------- */

/* The range of cells that windows span: columns times rows of whole cells
 * whose parallelogram, with room for a face at its rim, lies in the picture. */
typedef struct window
{
    int32_t columns, rows;
    otx_vec2 first; /* cell coordinates of its lowest corner */
} window;

static bool
fits(const otx_material *m, double rim, window *w)
{
    const otx_vec2 *g = m->analysis.generators;
    const otx_vec2 a = otx_vec2_scale(w->columns, g[0]);
    const otx_vec2 b = otx_vec2_scale(w->rows, g[1]);
    const otx_image *image = &m->job->exemplars->match;
    const double det = otx_vec2_cross(g[0], g[1]);
    const otx_vec2 middle = {0.5 * image->width, 0.5 * image->height};
    const otx_vec2 d = otx_vec2_sub(middle, m->analysis.centre);

    /* Centred in the picture. */
    w->first = (otx_vec2){
        otx_vec2_cross(d, g[1]) / det - 0.5 * w->columns,
        otx_vec2_cross(g[0], d) / det - 0.5 * w->rows};
    return fabs(a.x) + fabs(b.x) + 2.0 * rim <= image->width - 1.0 &&
           fabs(a.y) + fabs(b.y) + 2.0 * rim <= image->height - 1.0;
}

/* The largest window. */
static otx_status
choose_window(const otx_material *m, double rim, window *out)
{
    *out = (window){0};
    for (int32_t rows = 1; rows < 64; ++rows)
        for (int32_t columns = 1; columns < 64; ++columns)
        {
            window w = {.columns = columns, .rows = rows};

            if (fits(m, rim, &w) && columns * rows > out->columns * out->rows)
                *out = w;
        }
    if (out->columns == 0)
        return otx_fail(
            m->job->run, OSDTEX_ERROR_SUPPORT, "map",
            otx_where_file(m->job->exemplars->source_path),
            "the exemplar does not tile, and not one of its lattice cells lies "
            "inside it with room for a face around; give a picture that shows "
            "more of the lattice, or raise {level}");
    return OSDTEX_OK;
}

/* Longest distance of a face's corners, texels. */
static double
face_rim(const otx_material *m, const otx_vec2 *cells, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    const otx_vec2 *g = m->analysis.generators;
    double most = 0.0;

    for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
         ++i)
    {
        const otx_vec2 d =
            otx_vec2_sub(cells[i], cells[leaf->face_first[face]]);

        most = fmax(
            most, otx_vec2_length(otx_vec2_add(
                      otx_vec2_scale(d.x, g[0]), otx_vec2_scale(d.y, g[1]))));
    }
    return most;
}

/* Takes whole windows off each face. */
static void
move_into_window(const otx_material *m, const window *w, otx_vec2 *cells)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t first = leaf->face_first[f];
        const int32_t size = otx_level_face_size(leaf, f);
        otx_vec2 middle = {0, 0}, shift;

        for (int32_t i = first; i < first + size; ++i)
            middle = otx_vec2_add(middle, otx_vec2_scale(1.0 / size, cells[i]));
        shift.x = w->columns * floor((middle.x - w->first.x) / w->columns);
        shift.y = w->rows * floor((middle.y - w->first.y) / w->rows);
        for (int32_t i = first; i < first + size; ++i)
            cells[i] = otx_vec2_sub(cells[i], shift);
    }
}

otx_status
otx_label_windows(const otx_material *m, const uint8_t *open, otx_vec2 *cells)
{
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    double rim = 0.0;
    window w;

    if (m->job->exemplars->wrap_x && m->job->exemplars->wrap_y)
        return OSDTEX_OK;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!open[f] && !leaf->face_hole[f])
            rim = fmax(rim, face_rim(m, cells, f));
    OTX_TRY(choose_window(m, rim + 1.0, &w));
    move_into_window(m, &w, cells);
    return OSDTEX_OK;
}

/* -- patches ------------------------------------------------------------- */

typedef struct labeller
{
    const otx_level *leaf;
    const otx_vec2 *cells;
    int32_t *face_patch;
    /* Corners around each vertex, and their faces. */
    int32_t *first, *corners, *faces;
    int32_t *queue;
} labeller;

static bool
same(otx_vec2 a, otx_vec2 b)
{
    return fabs(a.x - b.x) < SAME && fabs(a.y - b.y) < SAME;
}

/* Whether `face` agrees with all faces of `patch` that it would touch. */
static bool
may_join(const labeller *l, int32_t face, int32_t patch)
{
    for (int32_t i = l->leaf->face_first[face];
         i < l->leaf->face_first[face + 1]; ++i)
    {
        const int32_t v = l->leaf->face_verts[i];

        for (int32_t k = l->first[v]; k < l->first[v + 1]; ++k)
            if (l->face_patch[l->faces[k]] == patch &&
                !same(l->cells[l->corners[k]], l->cells[i]))
                return false;
    }
    return true;
}

/* Whether two neighbours agree along their common edge. */
static bool
agree(const labeller *l, int32_t face, int32_t other, int32_t edge)
{
    for (int k = 0; k < 2; ++k)
    {
        const int32_t v = l->leaf->edge_verts[2 * (size_t)edge + k];
        int32_t a = l->leaf->face_first[face];
        int32_t b = l->leaf->face_first[other];

        while (l->leaf->face_verts[a] != v)
            ++a;
        while (l->leaf->face_verts[b] != v)
            ++b;
        if (!same(l->cells[a], l->cells[b]))
            return false;
    }
    return true;
}

static void
spread(labeller *l, int32_t seed, int32_t patch)
{
    int32_t head = 0, tail = 0;

    l->face_patch[seed] = patch;
    l->queue[tail++] = seed;
    while (head < tail)
    {
        const int32_t face = l->queue[head++];

        for (int32_t k = 0; k < otx_level_face_size(l->leaf, face); ++k)
        {
            const int32_t other = otx_level_neighbour(l->leaf, face, k);

            if (other < 0 || l->face_patch[other] != -1 ||
                !agree(
                    l, face, other,
                    l->leaf->face_edges[l->leaf->face_first[face] + k]) ||
                !may_join(l, other, patch))
                continue;
            l->face_patch[other] = patch;
            l->queue[tail++] = other;
        }
    }
}

static otx_status
prepare(otx_run *run, const otx_level *leaf, labeller *l)
{
    l->first = OTX_ZNEW(run->scratch, int32_t, leaf->vert_count + 2);
    l->corners = OTX_NEW(run->scratch, int32_t, leaf->corner_count);
    l->faces = OTX_NEW(run->scratch, int32_t, leaf->corner_count);
    l->queue = OTX_NEW(run->scratch, int32_t, leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < leaf->corner_count; ++i)
        otx_csr_count(l->first, leaf->face_verts[i], 1);
    otx_csr_sum(l->first, leaf->vert_count);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t i = leaf->face_first[f]; i < leaf->face_first[f + 1]; ++i)
        {
            const int32_t at = otx_csr_place(l->first, leaf->face_verts[i]);

            l->corners[at] = i;
            l->faces[at] = f;
        }
    return OSDTEX_OK;
}

otx_status
otx_label_patches(
    const otx_material *m, const uint8_t *open, const otx_vec2 *cells,
    int32_t *face_patch, int32_t *patch_count)
{
    const otx_arena_mark mark = otx_arena_here(m->job->run->scratch);
    const otx_level *leaf = otx_surface_leaf(m->job->surface);
    labeller l = {.leaf = leaf, .cells = cells, .face_patch = face_patch};

    OTX_TRY(prepare(m->job->run, leaf, &l));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        face_patch[f] = leaf->face_hole[f] || open[f] ? -2 : -1;
    *patch_count = 0;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (face_patch[f] == -1)
            spread(&l, f, (*patch_count)++);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (face_patch[f] == -2)
            face_patch[f] = -1;
    otx_arena_release(m->job->run->scratch, mark);
    return OSDTEX_OK;
}

/* paste_list.c -- pastes as layers of faces. */
#include "export/paste_list.h"

#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "export";

enum
{
    RIM = 2,     /* texels around what is looked up, which filters reach */
    PLACES = 32, /* to a texel: nearer than that is one place */
    SIDE_MOST = 16384
};

typedef struct builder
{
    otx_run *run;
    otx_paste_list *list;
    const otx_level *leaf;
    const otx_lookups *lookups;
    int32_t *cell_of; /* [fragment_count] -1: nothing looks it up */
    uint8_t *fades;   /* [fragment_count] */
} builder;

/* Lookups of a face: 0 of one that shows what its own UVs say. */
static int32_t
lookup_count(const builder *b, int32_t face)
{
    const int64_t *first = b->lookups->first;

    return (
        int32_t)((first[face + 1] - first[face]) / otx_level_face_size(b->leaf, face));
}

/* ---- layers ---- */

static otx_status
count_layers(builder *b)
{
    otx_paste_list *list = b->list;
    int64_t faces = 0, corners = 0;

    for (int32_t f = 0; f < b->leaf->face_count; ++f)
    {
        const int32_t n = lookup_count(b, f) > 1 ? lookup_count(b, f) : 1;

        if (b->leaf->face_hole[f])
            continue;
        faces += n;
        corners += (int64_t)n * otx_level_face_size(b->leaf, f);
        list->layer_count = list->layer_count > n ? list->layer_count : n;
    }
    if (corners > INT32_MAX / 4)
        return otx_fail(
            b->run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "the layers of pastes have %.3g corners, more than files of them "
            "take; lower {level}",
            (double)corners);
    list->corner_count = (int32_t)corners;
    list->layer_first =
        OTX_ZNEW(b->run->scratch, int32_t, (size_t)list->layer_count + 1);
    list->faces = OTX_NEW(b->run->scratch, otx_paste_face, faces);
    return otx_run_ok(b->run);
}

static otx_status
put_layers(builder *b)
{
    otx_paste_list *list = b->list;
    int32_t count = 0;

    for (int32_t layer = 0; layer < list->layer_count; ++layer)
    {
        for (int32_t f = 0; f < b->leaf->face_count; ++f)
        {
            const int32_t n = lookup_count(b, f);
            const int32_t size = otx_level_face_size(b->leaf, f);

            if (b->leaf->face_hole[f] || (layer > 0 && layer >= n))
                continue;
            list->faces[count++] = (otx_paste_face){
                f, -1,
                n > 0 ? b->lookups->items + b->lookups->first[f] +
                            (ptrdiff_t)layer * size
                      : NULL};
        }
        list->layer_first[layer + 1] = count;
        OTX_TRY(otx_progress(
            b->run, "write", 0.1 * (layer + 1) / list->layer_count));
    }
    return OSDTEX_OK;
}

/* Which fragments are looked up above the first layer, and whether they fade
 * by weights. */
static otx_status
see_fragments(builder *b)
{
    const otx_paste_list *list = b->list;

    for (int32_t i = list->layer_first[1];
         i < list->layer_first[list->layer_count]; ++i)
    {
        const otx_paste_face *face = &list->faces[i];
        const int32_t fragment = face->lookup->fragment;

        if (fragment < 0 || b->lookups->fragments[fragment].mask)
            return otx_fail(
                b->run, OSDTEX_ERROR_SUPPORT, STAGE, OTX_NOWHERE,
                "what lies over one another in this mapping are no pastes, so "
                "there is no list of them");
        b->cell_of[fragment] = 0;
        for (int32_t k = 0; k < otx_level_face_size(b->leaf, face->face); ++k)
            if (face->lookup[k].weight < 1.0f)
                b->fades[fragment] = 1;
    }
    return OSDTEX_OK;
}

/* ---- cells ---- */

/* What fragments that share a cell have in common. */
typedef struct shape
{
    const otx_fragment *fragment;
    int64_t x, y;  /* of its origin, in parts of a texel */
    int32_t alone; /* a number of its own where it shares with none, else -1 */
    int32_t index;
} shape;

static int
compare_outlines(const otx_radial *a, const otx_radial *b)
{
    if (a == b)
        return 0;
    if (!a || !b)
        return a ? 1 : -1;
    return memcmp(a, b, sizeof *a);
}

static int
compare_places(const void *a, const void *b)
{
    const shape *p = a, *q = b;
    const int order =
        compare_outlines(p->fragment->outline, q->fragment->outline);

    if (order != 0)
        return order;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return (p->alone > q->alone) - (p->alone < q->alone);
}

static int
compare_shapes(const void *a, const void *b)
{
    const shape *p = a, *q = b;
    const int order = compare_places(a, b);

    return order != 0 ? order : (p->index > q->index) - (p->index < q->index);
}

/* On a picture that tiles, places that look alike are one. */
static int64_t
place_on(float origin, int32_t side, bool wraps)
{
    const double at = (double)origin * side;
    const double folded = wraps ? at - side * floor(at / side) : at;
    const int64_t place = (int64_t)llround(folded * PLACES);

    return wraps ? place % ((int64_t)side * PLACES) : place;
}

static shape *
list_shapes(builder *b, int32_t *count)
{
    const otx_exemplar *e = b->list->exemplar;
    shape *shapes = OTX_NEW(b->run->scratch, shape, b->lookups->fragment_count);

    *count = 0;
    for (int32_t f = 0; shapes && f < b->lookups->fragment_count; ++f)
    {
        const otx_fragment *fragment = &b->lookups->fragments[f];

        if (b->cell_of[f] >= 0)
            shapes[(*count)++] = (shape){
                fragment,
                place_on(fragment->frame[0], e->linear.width, e->wrap_x),
                place_on(fragment->frame[1], e->linear.height, e->wrap_y),
                b->fades[f] ? f : -1, f};
    }
    if (shapes && *count > 1)
        qsort(shapes, (size_t)*count, sizeof *shapes, compare_shapes);
    return shapes;
}

static void
put_shift(builder *b, int32_t from, int32_t to)
{
    const otx_exemplar *e = b->list->exemplar;
    const otx_fragment *list = b->lookups->fragments;

    for (int k = 0; k < 2; ++k)
        b->list->shift[2 * to + k] = (int32_t)lround(
            ((double)list[to].frame[k] - (double)list[from].frame[k]) *
            (k == 0 ? e->linear.width : e->linear.height));
}

static otx_status
share_cells(builder *b)
{
    otx_paste_list *list = b->list;
    int32_t count, first = 0;
    const shape *shapes = list_shapes(b, &count);

    list->cells = OTX_ZNEW(b->run->scratch, otx_paste_cell, count);
    OTX_TRY(otx_run_ok(b->run));
    for (int32_t i = 0; i < count; ++i)
    {
        if (i == 0 || compare_places(&shapes[i - 1], &shapes[i]) != 0)
        {
            first = shapes[i].index;
            list->cells[list->cell_count++] = (otx_paste_cell){
                .fragment = first, .fades = b->fades[first] != 0};
        }
        b->cell_of[shapes[i].index] = list->cell_count - 1;
        put_shift(b, first, shapes[i].index);
    }
    return OSDTEX_OK;
}

/* A box around places in the cell's own texels. */
typedef struct box
{
    double low[2], high[2];
} box;

static otx_status
put_box(builder *b, const box *around, otx_paste_cell *cell)
{
    const double x = floor(around->low[0]) - RIM;
    const double y = floor(around->low[1]) - RIM;
    const double width = ceil(around->high[0]) + RIM - x;
    const double height = ceil(around->high[1]) + RIM - y;

    if (!(fmax(width, height) <= SIDE_MOST && fabs(x) < 1e9 && fabs(y) < 1e9))
        return otx_fail(
            b->run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
            "a paste takes a picture of %.0f x %.0f texels; raise {level} or "
            "{scale}",
            width, height);
    cell->x = (int32_t)x;
    cell->y = (int32_t)y;
    cell->width = (int32_t)width;
    cell->height = (int32_t)height;
    return OSDTEX_OK;
}

/* Cells as large as all that faces look up in them. */
static otx_status
size_cells(builder *b)
{
    otx_paste_list *list = b->list;
    box *boxes = OTX_NEW(b->run->scratch, box, list->cell_count);

    OTX_TRY(otx_run_ok(b->run));
    for (int32_t i = 0; i < list->cell_count; ++i)
        boxes[i] = (box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int32_t i = list->layer_first[1];
         i < list->layer_first[list->layer_count]; ++i)
    {
        otx_paste_face *face = &list->faces[i];

        face->cell = b->cell_of[face->lookup->fragment];
        for (int32_t k = 0; k < otx_level_face_size(b->leaf, face->face); ++k)
        {
            const otx_vec2 at = otx_paste_list_at(list, face, k);
            box *around = &boxes[face->cell];

            around->low[0] = fmin(around->low[0], at.x);
            around->low[1] = fmin(around->low[1], at.y);
            around->high[0] = fmax(around->high[0], at.x);
            around->high[1] = fmax(around->high[1], at.y);
        }
    }
    for (int32_t i = 0; i < list->cell_count; ++i)
        OTX_TRY(put_box(b, &boxes[i], &list->cells[i]));
    return OSDTEX_OK;
}

otx_vec2
otx_paste_list_at(
    const otx_paste_list *list, const otx_paste_face *face, int32_t k)
{
    const otx_exemplar *e = list->exemplar;
    const otx_lookup *at = &face->lookup[k];
    const otx_paste_cell *cell = &list->cells[face->cell];
    const int32_t *shift = list->shift + 2 * (size_t)at->fragment;

    return (otx_vec2){
        (double)at->uv[0] * e->linear.width - shift[0] - cell->x,
        (double)at->uv[1] * e->linear.height - shift[1] - cell->y};
}

otx_status
otx_paste_list_make(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    otx_paste_list *out)
{
    const int32_t fragments = mapping->lookups->fragment_count;
    builder b = {
        .run = run,
        .list = out,
        .leaf = otx_surface_leaf(mapping->surface),
        .lookups = mapping->lookups,
        .cell_of = OTX_NEW(run->scratch, int32_t, fragments),
        .fades = OTX_ZNEW(run->scratch, uint8_t, fragments)};

    *out = (otx_paste_list){
        .mapping = mapping,
        .exemplar = exemplar,
        .layer_count = 1,
        .shift = OTX_ZNEW(run->scratch, int32_t, 2 * (size_t)fragments)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < fragments; ++f)
        b.cell_of[f] = -1;
    OTX_TRY(count_layers(&b));
    OTX_TRY(put_layers(&b));
    OTX_TRY(see_fragments(&b));
    OTX_TRY(share_cells(&b));
    return size_cells(&b);
}

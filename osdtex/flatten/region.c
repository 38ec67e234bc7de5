/* region.c -- level by level, so that a vertex on the border of two regions is
 * placed by the coarser of what they are divided in. */
#include "flatten/region.h"

typedef struct region_walk
{
    const otx_controls *controls;
    const otx_cluster_tree *tree;
    const int32_t *slot;
    const otx_descent *visitor;
    void (*inside)(void *, int32_t, const int32_t *, int32_t);
    otx_arena *scratch;
    uint8_t *known; /* by slot: visited, or given */
    int32_t *side;  /* by slot: of the region that is divided, -1 inside */
} region_walk;

/* The region that is divided: its border, and its control vertices. */
typedef struct parent
{
    otx_outline border;
    int32_t *corners; /* [border.control_count] */
} parent;

static void
visit(region_walk *w, const parent *p, int32_t vert)
{
    const int32_t at = w->slot[vert], sides = p->border.control_count;
    const int32_t side = w->side[at];

    if (w->known[at])
        return;
    w->known[at] = 1;
    if (side >= 0)
        w->visitor->edge(
            w->visitor->context, vert, p->corners[side],
            p->corners[(side + 1) % sides]);
    else
        w->inside(w->visitor->context, vert, p->corners, sides);
}

static otx_status
trace_parent(region_walk *w, int32_t node, parent *p)
{
    const int32_t level = w->tree->nodes[node].level;

    OTX_TRY(
        otx_outline_trace(w->controls, node, level, w->scratch, &p->border));
    p->corners = OTX_NEW(w->scratch, int32_t, p->border.control_count);
    if (!p->corners)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < p->border.control_count; ++k)
        p->corners[k] = p->border.verts[p->border.controls[k]];
    return OSDTEX_OK;
}

/* Notes on which side of the parent each vertex of its border lies, or takes
 * the notes back. */
static void
note_sides(region_walk *w, const parent *p, bool back)
{
    int32_t side = -1;

    for (int32_t i = 0; i < p->border.count; ++i)
    {
        if (side + 1 < p->border.control_count &&
            p->border.controls[side + 1] == i)
            ++side;
        w->side[w->slot[p->border.verts[i]]] = back ? -1 : side;
    }
}

/* Visits the control vertices of a child that are not known yet. */
static otx_status
visit_child(region_walk *w, const parent *p, int32_t child)
{
    const otx_level *base = w->tree->how.dual->level;
    const otx_cluster_node *n = &w->tree->nodes[child];
    otx_outline o;

    if (n->end - n->first == 1)
    {
        const int32_t f = w->tree->faces[n->first];

        for (int32_t c = base->face_first[f]; c < base->face_first[f + 1]; ++c)
            visit(w, p, base->face_verts[c]);
        return OSDTEX_OK;
    }
    OTX_TRY(otx_outline_trace(w->controls, child, n->level, w->scratch, &o));
    for (int32_t k = 0; k < o.control_count; ++k)
        visit(w, p, o.verts[o.controls[k]]);
    return OSDTEX_OK;
}

static otx_status
visit_children(region_walk *w, int32_t node)
{
    const otx_arena_mark mark = otx_arena_here(w->scratch);
    const otx_cluster_node *n = &w->tree->nodes[node];
    otx_status status = OSDTEX_OK;
    parent p;

    OTX_TRY(trace_parent(w, node, &p));
    note_sides(w, &p, false);
    for (int32_t i = 0; status == OSDTEX_OK && i < n->child_count; ++i)
        status = visit_child(w, &p, n->first_child + i);
    note_sides(w, &p, true);
    otx_arena_release(w->scratch, mark);
    return status;
}

/* The regions below a node, each before those that it is divided in, level by
 * level: *out[count]. */
static int32_t *
list_regions(const region_walk *w, int32_t node, int32_t *count)
{
    const otx_cluster_node *nodes = w->tree->nodes;
    /* Regions that are divided in two or more are fewer than faces. */
    int32_t *list =
        OTX_NEW(w->scratch, int32_t, nodes[node].end - nodes[node].first + 1);

    *count = 0;
    if (!list)
        return NULL;
    list[(*count)++] = node;
    for (int32_t i = 0; i < *count; ++i)
        for (int32_t k = 0; k < nodes[list[i]].child_count; ++k)
        {
            const int32_t child = nodes[list[i]].first_child + k;

            if (nodes[child].end - nodes[child].first > 1)
                list[(*count)++] = child;
        }
    return list;
}

static otx_status
begin(region_walk *w, int32_t node, int32_t count)
{
    otx_outline border;

    w->known = OTX_ZNEW(w->scratch, uint8_t, count);
    w->side = OTX_NEW(w->scratch, int32_t, count);
    if (!w->known || !w->side)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < count; ++i)
        w->side[i] = -1;
    OTX_TRY(otx_outline_trace(
        w->controls, node, w->tree->nodes[node].level, w->scratch, &border));
    for (int32_t k = 0; k < border.control_count; ++k)
        w->known[w->slot[border.verts[border.controls[k]]]] = 1;
    return OSDTEX_OK;
}

otx_status
otx_region_walk(
    const otx_controls *controls, int32_t node, const int32_t *slot,
    int32_t count, const otx_descent *visitor,
    void (*inside)(void *, int32_t, const int32_t *, int32_t),
    otx_arena *scratch)
{
    const otx_cluster_tree *tree = controls->tree;
    region_walk w = {
        controls, tree, slot, visitor, inside, scratch, NULL, NULL};
    int32_t regions, *list;

    OTX_TRY(begin(&w, node, count));
    list = list_regions(&w, node, &regions);
    if (!list)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < regions; ++i)
        OTX_TRY(visit_children(&w, list[i]));
    for (int32_t i = tree->nodes[node].first; i < tree->nodes[node].end; ++i)
        otx_descent_walk(tree->surface, tree->base, tree->faces[i], visitor);
    return OSDTEX_OK;
}

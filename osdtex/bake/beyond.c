/* beyond.c -- the facets around one, unfolded into its plane. */
#include "bake/beyond.h"

#include <string.h>

static void
forget(otx_beyond *u)
{
    u->count = 1;
    memset(u->roots, 0, sizeof u->roots);
}

bool
otx_beyond_begin(otx_arena *scratch, otx_beyond *out)
{
    out->nodes = OTX_NEW(scratch, otx_beyond_node, OTX_BEYOND_NODES);
    forget(out);
    return out->nodes != NULL;
}

static int32_t
add(otx_beyond *u, const otx_mip_facet *placed)
{
    u->nodes[u->count] = (otx_beyond_node){*placed, {0, 0, 0}};
    return u->count++;
}

static int32_t
root_of(otx_beyond *u, const otx_mip_facet *placed)
{
    const int64_t id = placed->id;
    int32_t *root =
        &u->roots[((id >> 16) * 2 + (id & 1)) & (OTX_BEYOND_ROOTS - 1)];

    if (*root == 0 || u->nodes[*root].placed.id != id)
        *root = add(u, placed);
    return *root;
}

/* The facet across a side; -1 where the surface ends. */
static int32_t
across(otx_beyond *u, const otx_beyond_scene *scene, int32_t node, int32_t side)
{
    int32_t next = u->nodes[node].next[side];

    if (next == 0)
    {
        const otx_layout *layout = scene->source->layout;
        /* Texel (0, 0), which all others are affine from. */
        otx_walk walk =
            otx_mip_facet_place(&u->nodes[node].placed, (otx_vec2){0.0, 0.0});
        const bool is_there =
            otx_walk_cross(layout->surface, layout->covered, side, &walk);
        const otx_mip_facet placed =
            is_there ? otx_mip_facet_of_walk(
                           scene->source, scene->maps, scene->n, &walk)
                     : (otx_mip_facet){0};

        next = is_there ? add(u, &placed) : -1;
        u->nodes[node].next[side] = next;
    }
    return next;
}

const otx_mip_facet *
otx_beyond_find(
    otx_beyond *u, const otx_beyond_scene *scene, const otx_mip_facet *root,
    otx_vec2 texel, int32_t steps)
{
    int32_t node;

    if (u->count + steps + 1 > OTX_BEYOND_NODES)
        forget(u);
    node = root_of(u, root);
    for (int32_t i = 0; i < steps && node > 0; ++i)
    {
        const otx_mip_facet *placed = &u->nodes[node].placed;
        const otx_walk walk = otx_mip_facet_place(placed, texel);
        const int32_t side = otx_walk_side_beyond(walk.at);

        if (side < 0)
            return placed;
        node = across(u, scene, node, side);
    }
    return NULL;
}

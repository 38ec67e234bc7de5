/* lattice_cells.c -- what the solved level says of the leaves below it. */
#include "method/material/material.h"

/* Cell coordinates of the corners of one face's children. */
static void
share_out(
    const otx_level *level, const otx_level *finer, int32_t face,
    const otx_vec2 *from, otx_vec2 *to)
{
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    const int32_t end = finer->face_first[level->face_child_first[face + 1]];
    otx_vec2 middle = {0, 0};

    for (int32_t k = 0; k < size; ++k)
        middle =
            otx_vec2_add(middle, otx_vec2_scale(1.0 / size, from[first + k]));
    for (int32_t i = finer->face_first[level->face_child_first[face]]; i < end;
         ++i)
    {
        const int32_t vertex = finer->face_verts[i];

        to[i] = middle;
        for (int32_t k = 0; k < size; ++k)
            if (vertex == level->face_verts[first + k])
                to[i] = from[first + k];
            else if (
                vertex == level->edge_child_vert[level->face_edges[first + k]])
                to[i] = otx_vec2_lerp(
                    from[first + k], from[first + (k + 1) % size], 0.5);
    }
}

otx_status
otx_material_refine(
    const otx_material *m, otx_arena *arena, otx_vec2 *from, otx_vec2 **out)
{
    *out = from;
    for (int32_t l = m->solved.level; l + 1 < m->job->surface->level_count; ++l)
    {
        const otx_level *level = &m->job->surface->levels[l];
        const otx_level *finer = level + 1;
        otx_vec2 *cells = OTX_NEW(arena, otx_vec2, finer->corner_count);

        if (!cells)
            return otx_fail_memory(m->job->run, "map");
        for (int32_t f = 0; f < level->face_count; ++f)
            share_out(level, finer, f, *out, cells);
        *out = cells;
    }
    return OSDTEX_OK;
}

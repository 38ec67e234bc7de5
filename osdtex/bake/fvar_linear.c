/* fvar_linear.c -- by matching the vertices of a child with those of its
 * parent: no order of children is taken for granted. */
#include "bake/fvar_linear.h"

#include "math/vec.h"

static const char STAGE[] = "bake";

static otx_vec2
load(const float *uvs, int32_t corner)
{
    const float *uv = uvs + 2 * (size_t)corner;

    return (otx_vec2){uv[0], uv[1]};
}

static otx_vec2
middle_of(const float *uvs, int32_t first, int32_t size)
{
    otx_vec2 sum = {0.0, 0.0};

    for (int32_t k = 0; k < size; ++k)
        sum = otx_vec2_add(sum, load(uvs, first + k));
    return otx_vec2_scale(1.0 / size, sum);
}

/* Coordinates, in face `parent`, of a vertex of one of its children. */
static otx_vec2
find(const otx_level *level, int32_t parent, int32_t vert, const float *uvs)
{
    const int32_t first = level->face_first[parent];
    const int32_t size = otx_level_face_size(level, parent);

    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t next = first + (k + 1 == size ? 0 : k + 1);

        if (level->face_verts[first + k] == vert)
            return load(uvs, first + k);
        if (level->edge_child_vert[level->face_edges[first + k]] == vert)
            return otx_vec2_lerp(load(uvs, first + k), load(uvs, next), 0.5);
    }
    return middle_of(uvs, first, size);
}

static void
spread_level(
    const otx_level *level, const otx_level *next, const float *from, float *to)
{
    for (int32_t face = 0; face < next->face_count; ++face)
        for (int32_t c = next->face_first[face]; c < next->face_first[face + 1];
             ++c)
        {
            const otx_vec2 uv =
                find(level, next->face_parent[face], next->face_verts[c], from);

            to[2 * (size_t)c] = (float)uv.x;
            to[2 * (size_t)c + 1] = (float)uv.y;
        }
}

otx_status
otx_fvar_linear(
    otx_run *run, const otx_surface *surface, const float *cage_uvs,
    float *leaf_uvs)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t last = surface->level_count - 1;
    const float *from = cage_uvs;

    for (int32_t l = 1; l <= last; ++l)
    {
        const otx_level *next = &surface->levels[l];
        float *to =
            l == last
                ? leaf_uvs
                : OTX_NEW(run->scratch, float, 2 * (size_t)next->corner_count);

        if (!to)
        {
            otx_arena_release(run->scratch, mark);
            return otx_fail_memory(run, STAGE);
        }
        spread_level(&surface->levels[l - 1], next, from, to);
        from = to;
    }
    for (size_t i = 0;
         last == 0 && i < 2 * (size_t)surface->levels[0].corner_count; ++i)
        leaf_uvs[i] = cage_uvs[i];
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* cluster.c -- clusters as unions of hierarchy faces, and their leaves. */
#include "cluster/cluster.h"

#include <stdlib.h>

/* Of the leaves below a face; 0 on a hole. */
static double
face_area(const otx_surface *surface, int32_t level, int32_t face)
{
    double area = 0.0;
    int32_t first, end;

    if (surface->levels[level].face_hole[face])
        return 0.0;
    otx_surface_leaves(surface, level, face, &first, &end);
    for (int32_t f = first; f < end; ++f)
    {
        const double density = otx_dual_leaf_density(surface, f);
        otx_vec3 centroid;

        area += 0.5 * density * density *
                otx_vec3_length(otx_dual_leaf_area(surface, f, &centroid));
    }
    return area;
}

otx_status
otx_cluster_children(
    otx_run *run, const otx_surface *surface, const otx_cluster *cluster,
    otx_cluster_list *out)
{
    const otx_level *level = &surface->levels[cluster->level];
    int32_t first, count;
    int32_t *faces;

    *out = (otx_cluster_list){0};
    if (cluster->level + 1 >= surface->level_count)
        return OSDTEX_OK;
    first = level->face_child_first[cluster->faces[0]];
    count = level->face_child_first[cluster->faces[0] + 1] - first;
    faces = OTX_NEW(run->arena, int32_t, count);
    out->clusters = OTX_NEW(run->arena, otx_cluster, count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
    {
        faces[i] = first + i;
        out->clusters[i] = (otx_cluster){
            cluster->level + 1, 1, &faces[i],
            face_area(surface, cluster->level + 1, first + i), -1};
    }
    out->count = count;
    return OSDTEX_OK;
}

static int
compare_index(const void *a, const void *b)
{
    const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;

    return (x > y) - (x < y);
}

/* Faces of a region that is divided do not, see tree.h. */
static bool
ascends(const int32_t *values, int32_t count)
{
    for (int32_t i = 1; i < count; ++i)
        if (values[i - 1] > values[i])
            return false;
    return true;
}

int32_t *
otx_cluster_leaves(
    otx_arena *arena, const otx_surface *surface, const otx_cluster *cluster,
    int32_t *count)
{
    int64_t total = 0;
    int32_t first, end;
    int32_t *leaves;

    for (int32_t i = 0; i < cluster->face_count; ++i)
    {
        otx_surface_leaves(
            surface, cluster->level, cluster->faces[i], &first, &end);
        total += end - first;
    }
    leaves = OTX_NEW(arena, int32_t, total);
    *count = 0;
    if (!leaves)
        return NULL;
    for (int32_t i = 0; i < cluster->face_count; ++i)
    {
        otx_surface_leaves(
            surface, cluster->level, cluster->faces[i], &first, &end);
        for (int32_t f = first; f < end; ++f)
            leaves[(*count)++] = f;
    }
    if (!ascends(cluster->faces, cluster->face_count))
        qsort(leaves, (size_t)*count, sizeof *leaves, compare_index);
    return leaves;
}

/* Distinct values of a list that is sorted in place. `*twice` says whether
 * every value occurs exactly two times. */
static int32_t
count_distinct(int32_t *values, int32_t count, bool *twice)
{
    int32_t distinct = 0;

    qsort(values, (size_t)count, sizeof *values, compare_index);
    *twice = true;
    for (int32_t i = 0; i < count;)
    {
        int32_t end = i + 1;

        while (end < count && values[end] == values[i])
            ++end;
        *twice = *twice && end - i == 2;
        ++distinct;
        i = end;
    }
    return distinct;
}

bool
otx_cluster_is_disc(
    otx_arena *scratch, const otx_level *level, const int32_t *faces,
    int32_t face_count, const int32_t *member, int32_t id)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    int32_t corners = 0, border = 0, inner = 0;
    int32_t *verts, *ends;
    bool twice, disc = false;

    for (int32_t i = 0; i < face_count; ++i)
        corners += otx_level_face_size(level, faces[i]);
    verts = OTX_NEW(scratch, int32_t, corners);
    ends = OTX_NEW(scratch, int32_t, 2 * (int64_t)corners);
    if (verts && ends)
    {
        int32_t n = 0;

        for (int32_t i = 0; i < face_count; ++i)
        {
            const int32_t first = level->face_first[faces[i]];
            const int32_t size = otx_level_face_size(level, faces[i]);

            for (int32_t k = 0; k < size; ++k)
            {
                const int32_t other = otx_level_neighbour(level, faces[i], k);

                verts[n++] = level->face_verts[first + k];
                if (other >= 0 && member[other] == id)
                {
                    ++inner;
                    continue;
                }
                ends[2 * border] = level->face_verts[first + k];
                ends[2 * border + 1] =
                    level->face_verts[first + (k + 1) % size];
                ++border;
            }
        }
        count_distinct(ends, 2 * border, &twice);
        disc = border > 0 && twice;
        n = count_distinct(verts, corners, &twice);
        disc = disc && n - (border + inner / 2) + face_count == 1;
    }
    otx_arena_release(scratch, mark);
    return disc;
}

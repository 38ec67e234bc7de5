/* solved_face.c -- what was solved for above a leaf face. */
#include "method/material/solved_face.h"

int32_t
otx_material_solved_face(const otx_material *m, int32_t leaf_face)
{
    int32_t face = leaf_face;

    for (int32_t l = m->job->surface->level_count - 1; l > m->solved.level; --l)
        face = m->job->surface->levels[l].face_parent[face];
    return face;
}

double
otx_material_density(const otx_material *m, int32_t leaf_face)
{
    const otx_level *level = m->solved.connection.level;
    const int32_t face = otx_material_solved_face(m, leaf_face);
    double sum = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        sum += m->solved.log_scale[level->face_verts[i]];
    return m->texels * exp(sum / otx_level_face_size(level, face));
}

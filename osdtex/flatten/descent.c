/* descent.c -- level by level; descendants of a face are one range. */
#include "flatten/descent.h"

static void
visit_face(const otx_level *level, int32_t face, const otx_descent *visitor)
{
    const int32_t first = level->face_first[face];
    const int32_t end = level->face_first[face + 1];

    for (int32_t c = first; c < end; ++c)
    {
        const int32_t edge = level->face_edges[c];
        const int32_t *ends = level->edge_verts + 2 * (size_t)edge;

        visitor->edge(
            visitor->context, level->edge_child_vert[edge], ends[0], ends[1]);
    }
    if (level->face_child_vert[face] >= 0)
        visitor->face(
            visitor->context, level->face_child_vert[face],
            level->face_verts + first, end - first);
}

void
otx_descent_walk(
    const otx_surface *surface, int32_t level, int32_t face,
    const otx_descent *visitor)
{
    int32_t first = face, end = face + 1;

    for (int32_t l = level; l + 1 < surface->level_count; ++l)
    {
        const otx_level *here = &surface->levels[l];

        for (int32_t f = first; f < end; ++f)
            visit_face(here, f, visitor);
        first = here->face_child_first[first];
        end = here->face_child_first[end];
    }
}

typedef struct averages
{
    const int32_t *slot;
    double *value;
} averages;

static void
average_edge(void *context, int32_t born, int32_t a, int32_t b)
{
    const averages *s = context;

    s->value[s->slot[born]] =
        0.5 * (s->value[s->slot[a]] + s->value[s->slot[b]]);
}

static void
average_face(void *context, int32_t born, const int32_t *corners, int32_t count)
{
    const averages *s = context;
    double sum = 0.0;

    for (int32_t k = 0; k < count; ++k)
        sum += s->value[s->slot[corners[k]]];
    s->value[s->slot[born]] = sum / count;
}

void
otx_descent_average(
    const otx_surface *surface, int32_t level, int32_t face,
    const int32_t *slot, double *value)
{
    averages context = {slot, value};
    const otx_descent visitor = {average_edge, average_face, &context};

    otx_descent_walk(surface, level, face, &visitor);
}

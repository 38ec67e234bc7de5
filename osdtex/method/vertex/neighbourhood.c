/* neighbourhood.c -- squares of colours around vertices and pixels. */
#include "method/vertex/neighbourhood.h"

#include "method/vertex/stroll.h"

/* ---- shapes ---- */

static void
add_square(otx_hood *hood, int32_t reach, int32_t end, bool centre)
{
    for (int32_t j = -reach; j <= end; ++j)
        for (int32_t i = -reach; i <= reach; ++i)
            if (centre || i != 0 || j != 0)
            {
                hood->right[hood->count] = (int8_t)i;
                hood->down[hood->count++] = (int8_t)j;
            }
}

/* Low frequencies over the samples, made orthonormal. */
static void
set_basis(otx_hood *hood)
{
    for (int32_t m = 0; m < OTX_HOOD_BASIS; ++m)
    {
        float *b = hood->basis[m], norm = 0.0f;

        for (int32_t s = 0; s < hood->bounded; ++s)
        {
            const float i = hood->right[s], j = hood->down[s];
            const float values[OTX_HOOD_BASIS] = {
                1.0f,
                i,
                j,
                i * i,
                i * j,
                j * j,
                i * i * i,
                i * i * j,
                i * j * j,
                j * j * j,
                i * i * i * i,
                i * i * i * j,
                i * i * j * j,
                i * j * j * j,
                j * j * j * j};

            b[s] = values[m];
        }
        for (int32_t k = 0; k < m; ++k)
        {
            float dot = 0.0f;

            for (int32_t s = 0; s < hood->bounded; ++s)
                dot += b[s] * hood->basis[k][s];
            for (int32_t s = 0; s < hood->bounded; ++s)
                b[s] -= dot * hood->basis[k][s];
        }
        for (int32_t s = 0; s < hood->bounded; ++s)
            norm += b[s] * b[s];
        for (int32_t s = 0; s < hood->bounded; ++s)
            b[s] = norm > 1e-3f ? b[s] / sqrtf(norm) : 0.0f;
    }
}

void
otx_hood_set(otx_hood *hood, otx_hood_kind kind, int32_t level)
{
    *hood = (otx_hood){.level = level};
    if (kind == OTX_HOOD_SEED)
        add_square(hood, OTX_HOOD_REACH, -1, false);
    if (kind == OTX_HOOD_REFINE)
        add_square(hood, OTX_HOOD_REACH, OTX_HOOD_REACH, false);
    hood->own = hood->count;
    if (kind == OTX_HOOD_EXTRAPOLATE)
        add_square(hood, OTX_HOOD_REACH, OTX_HOOD_REACH, true);
    if (kind == OTX_HOOD_REFINE)
        add_square(hood, 1, 1, true);
    hood->bounded = hood->own > 0 ? hood->own : hood->count;
    set_basis(hood);
}

/* ---- on the surface ---- */

enum
{
    SIDE = 2 * OTX_HOOD_REACH + 1
};

/* Colours on a surface, walked to from a vertex. */
typedef struct square
{
    const otx_quad *values;
    double step; /* scene units */
    int32_t reach;
    otx_quad colors[SIDE][SIDE]; /* columns from left to right, top first */
} square;

/* A column up and down from where it begins.
 *
 *   down  1: that is to the right of the way, -1: to the left */
static void
gather_column(const otx_stroll *from, int32_t down, otx_quad *column, square *q)
{
    column[OTX_HOOD_REACH] = otx_stroll_look(from, q->values);
    for (int32_t way = -1; way <= 1; way += 2)
    {
        otx_stroll s = *from;

        otx_stroll_turn(&s, 0.0, -way * down);
        for (int32_t j = 1; j <= q->reach; ++j)
        {
            otx_stroll_go(&s, q->step);
            column[OTX_HOOD_REACH + way * j] = otx_stroll_look(&s, q->values);
        }
    }
}

static void
gather_square(
    const otx_turk *t, const otx_turk_mesh *mesh, int32_t vertex, square *q)
{
    const otx_vec3 n = otx_vec3_load(t->surface->normals, vertex);
    const otx_vec3 right = otx_vec3_cross(n, t->down[vertex]);

    for (int32_t way = -1; way <= 1; way += 2)
    {
        otx_stroll s;

        if (!otx_stroll_begin(
                mesh, t->surface->points, vertex, otx_vec3_scale(way, right),
                &s))
            return;
        for (int32_t i = way > 0 ? 0 : 1; i <= q->reach; ++i)
        {
            if (i > 0)
                otx_stroll_go(&s, q->step);
            gather_column(&s, way, q->colors[OTX_HOOD_REACH + way * i], q);
        }
    }
}

void
otx_hood_gather(
    const otx_turk *t, const otx_hood *hood, int32_t vertex, otx_quad *out)
{
    const otx_turk_mesh *mesh = &t->meshes[hood->level];
    const double texel =
        1.0 / (t->texels * otx_surface_density(t->surface, &vertex, 1));
    square own = {
        .values = mesh->colors,
        .step = ldexp(texel, hood->level),
        .reach = OTX_HOOD_REACH};
    square above = {
        .values = t->above,
        .step = ldexp(texel, hood->level + 1),
        .reach = hood->own > 0 ? 1 : OTX_HOOD_REACH};

    if (hood->own > 0)
        gather_square(t, mesh, vertex, &own);
    if (hood->own < hood->count)
        gather_square(t, mesh, vertex, &above);
    for (int32_t s = 0; s < hood->count; ++s)
        out[s] = (s < hood->own ? &own : &above)
                     ->colors[OTX_HOOD_REACH + hood->right[s]]
                             [OTX_HOOD_REACH + hood->down[s]];
}

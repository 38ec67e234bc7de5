/* singularity.c -- where a direction field has no direction. */
#include "field/singularity.h"

/* Whether the second face of `edge` follows its first counter-clockwise about
 * `vertex`: it does where the first face's half-edge ends there. */
static double
sense(const otx_connection *c, int32_t edge, int32_t vertex)
{
    const int32_t face = c->level->edge_faces[2 * (size_t)edge];
    const int32_t corner = otx_connection_corner(c, edge, face);

    return c->level->face_verts[corner] == vertex ? -1.0 : 1.0;
}

/* Turns of the field around each vertex against parallel transport. */
static void
add_turns(const otx_direction *field, double *sums)
{
    const otx_connection *c = field->connection;

    for (int32_t e = 0; e < c->level->edge_count; ++e)
        if (c->inner[e])
        {
            const double turn = otx_direction_turn(field, e);

            for (int k = 0; k < 2; ++k)
            {
                const int32_t v = c->level->edge_verts[2 * (size_t)e + k];

                sums[v] += sense(c, e, v) * turn;
            }
        }
}

otx_status
otx_singularity_find(
    otx_run *run, const otx_direction *field, otx_singularity_list *out)
{
    const int32_t count = field->connection->level->vert_count;
    otx_singularity *items;
    double *sums;
    int32_t found = 0;

    OTX_TRY(otx_connection_defects(run, field->connection, &sums));
    add_turns(field, sums);
    for (int32_t v = 0; v < count; ++v)
    {
        sums[v] = round(sums[v] * field->symmetry / (2.0 * OTX_PI));
        found += isfinite(sums[v]) && sums[v] != 0.0;
    }
    items = OTX_NEW(run->arena, otx_singularity, found);
    OTX_TRY(otx_run_ok(run));
    *out = (otx_singularity_list){found, items};
    for (int32_t v = 0; v < count; ++v)
        if (isfinite(sums[v]) && sums[v] != 0.0)
            *items++ = (otx_singularity){v, (int32_t)sums[v]};
    return OSDTEX_OK;
}

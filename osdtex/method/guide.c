/* guide.c -- a direction for every leaf face. */
#include "method/guide.h"

#include "field/nested.h"

otx_status
otx_guide_from_field(
    otx_run *run, const otx_direction *field, double angle, otx_guide *out)
{
    const otx_surface *surface = field->connection->surface;
    const int32_t last = surface->level_count - 1;
    const otx_level *leaf = &surface->levels[last];
    otx_vec3 *directions = OTX_NEW(run->arena, otx_vec3, leaf->face_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        int32_t face = f;

        for (int32_t l = last; l > field->connection->level_index; --l)
            face = surface->levels[l].face_parent[face];
        directions[f] = otx_direction_vector(field, face);
    }
    *out = (otx_guide){directions, field->symmetry, angle};
    return OSDTEX_OK;
}

otx_status
otx_guide_make(
    otx_run *run, const otx_surface *surface, const otx_analysis *analysis,
    const otx_constraint_set *constraints, otx_guide *out)
{
    otx_direction_request asked = {
        .symmetry = analysis->symmetry > 0 ? analysis->symmetry : 1};
    otx_connection *connection = OTX_NEW(run->arena, otx_connection, 1);
    otx_direction field;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_connection_build(
        run, surface, surface->level_count - 1, connection));
    OTX_TRY(otx_constraint_pins(run, constraints, connection, &asked));
    OTX_TRY(otx_nested_solve(run, connection, &asked, &field));
    return otx_guide_from_field(run, &field, analysis->angle, out);
}

/* direction.c -- powers of directions, on a face, across an edge and from level
 * to level. */
#include "field/direction.h"

otx_vec2
otx_direction_power(otx_vec2 v, int32_t symmetry)
{
    const double length = otx_vec2_length(v);
    const otx_vec2 unit =
        length > 0.0 ? otx_vec2_scale(1.0 / length, v) : (otx_vec2){0, 0};
    otx_vec2 power = unit;

    for (int32_t k = 1; k < symmetry; ++k)
        power = otx_vec2_mul(power, unit);
    return otx_vec2_scale(length, power);
}

otx_vec2
otx_direction_unit(otx_vec2 z, otx_vec2 otherwise)
{
    const double length = otx_vec2_length(z);

    return length > 0.0 && isfinite(length) ? otx_vec2_scale(1.0 / length, z)
                                            : otherwise;
}

double
otx_direction_turn(const otx_direction *field, int32_t edge)
{
    const otx_connection *c = field->connection;
    const int32_t *faces = c->level->edge_faces + 2 * (size_t)edge;
    const otx_vec2 carried = otx_vec2_mul(
        otx_vec2_polar(field->symmetry * c->turns[edge]),
        field->powers[faces[0]]);
    const otx_vec2 to = field->powers[faces[1]];

    return atan2(otx_vec2_cross(carried, to), otx_vec2_dot(carried, to)) /
           field->symmetry;
}

otx_status
otx_direction_refine(
    otx_run *run, const otx_direction *field, const otx_connection *finer,
    otx_direction *out)
{
    const otx_surface *surface = finer->surface;
    const int32_t from = field->connection->level_index;

    *out = (otx_direction){
        finer, field->symmetry,
        OTX_NEW(run->arena, otx_vec2, finer->level->face_count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < finer->level->face_count; ++f)
    {
        int32_t parent = f;

        for (int32_t l = finer->level_index; l > from; --l)
            parent = surface->levels[l].face_parent[parent];
        out->powers[f] = otx_direction_unit(
            otx_direction_power(
                otx_connection_project(
                    finer, f, otx_direction_vector(field, parent)),
                field->symmetry),
            (otx_vec2){1, 0});
    }
    return OSDTEX_OK;
}

/* Adds what the faces below say to the powers of their ancestors. */
static void
gather(
    const otx_direction *field, const otx_connection *coarser, otx_vec2 *powers)
{
    const otx_connection *finer = field->connection;

    for (int32_t f = 0; f < finer->level->face_count; ++f)
    {
        int32_t face = f;

        for (int32_t l = finer->level_index; l > coarser->level_index; --l)
            face = finer->surface->levels[l].face_parent[face];
        powers[face] = otx_vec2_add(
            powers[face],
            otx_vec2_scale(
                finer->areas[f],
                otx_direction_power(
                    otx_connection_project(
                        coarser, face, otx_direction_vector(field, f)),
                    field->symmetry)));
    }
}

otx_status
otx_direction_coarsen(
    otx_run *run, const otx_direction *field, const otx_connection *coarser,
    otx_direction *out)
{
    const int32_t count = coarser->level->face_count;

    *out = (otx_direction){
        coarser, field->symmetry, OTX_ZNEW(run->arena, otx_vec2, count)};
    OTX_TRY(otx_run_ok(run));
    gather(field, coarser, out->powers);
    for (int32_t f = 0; f < count; ++f)
        out->powers[f] = otx_direction_unit(out->powers[f], (otx_vec2){1, 0});
    return OSDTEX_OK;
}

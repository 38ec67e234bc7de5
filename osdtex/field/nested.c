/* nested.c -- direction fields on fine levels, in time linear in their faces.
 */
#include "field/nested.h"

enum
{
    FACES_MAX = 24000, /* that are solved for directly */
    ROUNDS = 16        /* of smoothing on each finer level */
};

/* A pin that is shorter than this along the parent is left out there. */
static const double UPRIGHT = 0.05;

/* The request on the level above: pins on parents, means of pulls. */
static otx_status
coarsen_request(
    otx_run *run, const otx_connection *finer, const otx_connection *coarser,
    const otx_direction_request *from, otx_direction_request *to)
{
    const int32_t *parent = finer->level->face_parent;
    otx_direction_pin *pins =
        OTX_NEW(run->arena, otx_direction_pin, from->pin_count);
    otx_vec2 *pull = OTX_ZNEW(run->arena, otx_vec2, coarser->level->face_count);
    const double s = from->symmetry;

    *to = *from;
    OTX_TRY(otx_run_ok(run));
    to->pins = pins;
    to->pin_count = 0;
    for (int32_t i = 0; i < from->pin_count; ++i)
    {
        const otx_direction_pin pin = {
            parent[from->pins[i].face], from->pins[i].vector};

        if (otx_vec2_length(otx_connection_project(
                coarser, pin.face, otx_vec3_unit(pin.vector))) > UPRIGHT)
            pins[to->pin_count++] = pin;
    }
    if (!from->pull)
        return OSDTEX_OK;
    for (int32_t f = 0; f < finer->level->face_count; ++f)
    {
        const otx_vec2 z = from->pull[f];
        const otx_vec2 d = otx_connection_project(
            coarser, parent[f],
            otx_connection_lift(finer, f, otx_vec2_polar(atan2(z.y, z.x) / s)));

        pull[parent[f]] = otx_vec2_add(
            pull[parent[f]],
            otx_vec2_scale(
                finer->areas[f] * otx_vec2_length(z) /
                    fmax(coarser->areas[parent[f]], 1e-12 * coarser->area),
                otx_direction_power(d, from->symmetry)));
    }
    to->pull = pull;
    return OSDTEX_OK;
}

/* Faces that are pinned hold their pin, not what their parents have. */
static void
restore_pins(const otx_direction_request *request, otx_direction *field)
{
    for (int32_t i = 0; i < request->pin_count; ++i)
    {
        const otx_direction_pin *pin = &request->pins[i];
        const otx_vec2 z = otx_direction_power(
            otx_connection_project(
                field->connection, pin->face, otx_vec3_unit(pin->vector)),
            field->symmetry);
        const double length = otx_vec2_length(z);

        if (length > 0.0)
            field->powers[pin->face] = otx_vec2_scale(1.0 / length, z);
    }
}

static otx_status
solve_coarser(
    otx_run *run, const otx_connection *connection,
    const otx_direction_request *request, otx_direction *out)
{
    otx_connection *coarser = OTX_NEW(run->arena, otx_connection, 1);
    otx_direction_request asked;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_connection_build(
        run, connection->surface, connection->level_index - 1, coarser));
    OTX_TRY(coarsen_request(run, connection, coarser, request, &asked));
    return otx_nested_solve(run, coarser, &asked, out);
}

otx_status
otx_nested_solve(
    otx_run *run, const otx_connection *connection,
    const otx_direction_request *request, otx_direction *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_run aside = *run;
    otx_direction coarse;

    if (connection->level_index == 0 ||
        connection->level->face_count <= FACES_MAX)
        return otx_direction_solve(run, connection, request, out);
    OTX_TRY(otx_direction_check(run, connection, request));
    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, "field");

    otx_status status = solve_coarser(&aside, connection, request, &coarse);

    if (status == OSDTEX_OK)
        status = otx_direction_refine(run, &coarse, connection, out);
    otx_arena_destroy(aside.arena);
    OTX_TRY(status);
    restore_pins(request, out);
    status = otx_direction_smooth(run, request, ROUNDS, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

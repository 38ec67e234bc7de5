/* field_handle.c -- fields, and edits that stay where they were made. */
#include "api/call.h"
#include "api/field_given.h"
#include "api/handle.h"
#include "api/map_input.h"
#include "field/nested.h"
#include "field/singularity.h"

#include <string.h>

/* -- what is lent -------------------------------------------------------- */

static otx_status
lend_directions(otx_run *run, osdtex_field *h)
{
    const int32_t count = h->info.face_count;
    const uint8_t *holes = h->connection.level->face_hole;
    otx_vec3 *vectors = OTX_NEW(run->arena, otx_vec3, count);
    float *lent = OTX_ZNEW(run->arena, float, 3 * (size_t)count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
    {
        const otx_vec3 d = otx_direction_vector(&h->direction, f);

        vectors[f] = d;
        if (holes[f])
            continue;
        lent[3 * (size_t)f] = (float)d.x;
        lent[3 * (size_t)f + 1] = (float)d.y;
        lent[3 * (size_t)f + 2] = (float)d.z;
    }
    h->info.directions = lent;
    h->guide = (otx_guide){vectors, h->direction.symmetry, 0.0};
    return OSDTEX_OK;
}

static otx_status
lend_scalars(otx_run *run, osdtex_field *h)
{
    const int32_t count = h->info.vert_count;
    float *scales = OTX_NEW(run->arena, float, count);
    float *materials = OTX_NEW(run->arena, float, count);

    OTX_TRY(otx_run_ok(run));
    h->info.scale_min = INFINITY;
    h->info.scale_max = 0.0;
    for (int32_t v = 0; v < count; ++v)
    {
        const double scale =
            exp(-h->asked_scale[v] - otx_scale_value(&h->correction, v));

        scales[v] = (float)scale;
        materials[v] = (float)h->material[v];
        h->info.scale_min = fmin(h->info.scale_min, scale);
        h->info.scale_max = fmax(h->info.scale_max, scale);
    }
    h->info.scales = scales;
    h->info.materials = materials;
    return OSDTEX_OK;
}

static otx_status
lend_singularities(otx_run *run, osdtex_field *h)
{
    const float *points = h->surface->surface.points;
    const double *origin = h->surface->surface.cage->origin;
    osdtex_singularity *lent;
    otx_singularity_list list;

    OTX_TRY(otx_singularity_find(run, &h->direction, &list));
    lent = OTX_ZNEW(run->arena, osdtex_singularity, list.count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < list.count; ++i)
    {
        lent[i].vertex = list.items[i].vertex;
        lent[i].index = (double)list.items[i].turns / h->direction.symmetry;
        for (int k = 0; k < 3; ++k)
            lent[i].point[k] =
                origin[k] + (double)points[3 * (size_t)lent[i].vertex + k];
    }
    h->info.singularities = lent;
    h->info.singularity_count = list.count;
    return OSDTEX_OK;
}

static otx_status
lend(otx_run *run, osdtex_field *h)
{
    h->info.symmetry = h->direction.symmetry;
    h->info.face_count = h->connection.level->face_count;
    h->info.vert_count = h->connection.level->vert_count;
    OTX_TRY(lend_directions(run, h));
    OTX_TRY(lend_scalars(run, h));
    return lend_singularities(run, h);
}

/* -- making -------------------------------------------------------------- */

/* A handle without fields. */
static otx_status
begin(otx_run *run, const osdtex_surface *surface, osdtex_field **out)
{
    const int32_t leaf = surface->surface.level_count - 1;
    const int32_t verts = surface->surface.levels[leaf].vert_count;
    osdtex_field *h = OTX_ZNEW(run->arena, osdtex_field, 1);

    OTX_TRY(otx_run_ok(run));
    h->arena = run->arena;
    h->surface = surface;
    OTX_TRY(otx_call_hold(run, surface->arena));
    h->asked_scale = OTX_ZNEW(run->arena, double, verts);
    h->material = OTX_ZNEW(run->arena, double, verts);
    OTX_TRY(otx_run_ok(run));
    *out = h;
    return otx_connection_build(run, &surface->surface, leaf, &h->connection);
}

static otx_status
solve(otx_run *run, double octaves, osdtex_field *h)
{
    OTX_TRY(otx_constraint_pins(run, &h->set, &h->connection, &h->request));
    OTX_TRY(otx_nested_solve(run, &h->connection, &h->request, &h->direction));
    OTX_TRY(otx_scale_correct(
        run, &h->direction, octaves * log(2.0), &h->correction));
    OTX_TRY(otx_constraint_interpolate(
        run, &h->set, &h->connection, OTX_CONSTRAINT_SCALE, NULL,
        h->asked_scale));
    return otx_constraint_interpolate(
        run, &h->set, &h->connection, OTX_CONSTRAINT_MATERIAL, NULL,
        h->material);
}

/* Exemplars are not interpolated here and would be lost in what is written. */
static void
warn_of_exemplars(otx_run *run, const otx_constraint_set *set)
{
    for (int32_t i = 0; i < set->count; ++i)
        if (set->items[i].exemplar > 0 || set->items[i].exemplar_name)
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, "field",
                otx_where_file(set->path),
                "constraint %d names an exemplar, which a field does not hold; "
                "give the file to map",
                (int)i + 1);
}

static otx_status
create(
    otx_run *run, const osdtex_surface *surface,
    const osdtex_field_options *options, osdtex_field **out)
{
    osdtex_field_options ours = osdtex_field_options_default();
    const otx_constraint_set *set;
    osdtex_field *h;

    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    if (!surface)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "no surface is given");
    if (!(ours.octaves >= 0.0 && ours.octaves <= 4.0))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "the size of the texture may give way by 0 to 4 octaves, not %g",
            ours.octaves);
    OTX_TRY(begin(run, surface, &h));
    OTX_TRY(
        otx_map_input_constraints(run, ours.constraints, ours.follow, &set));
    if (set)
        h->set = *set;
    warn_of_exemplars(run, &h->set);
    if (ours.whole_table)
        OTX_TRY(otx_constraint_check_table(
            run, &h->set, surface->surface.cage->face_count));
    if (ours.symmetry != 0)
        h->set.symmetry = ours.symmetry;
    h->request.symmetry = h->set.symmetry > 0 ? h->set.symmetry : 2;
    OTX_TRY(otx_field_given_read(
        run, &h->connection, h->request.symmetry, &ours, &h->set.field));
    OTX_TRY(solve(run, ours.octaves, h));
    OTX_TRY(lend(run, h));
    *out = h;
    return OSDTEX_OK;
}

osdtex_status
osdtex_field_create(
    osdtex_context *context, const osdtex_surface *surface,
    const osdtex_field_options *options, osdtex_field **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "field", &call));
    return otx_call_end(&call, create(&call.run, surface, options, out), out);
}

/* -- editing ------------------------------------------------------------- */

/* Vertices all of whose faces are free. */
static otx_status
free_vertices(
    otx_run *run, const osdtex_field *h, const uint8_t *faces, uint8_t **out)
{
    const otx_level *level = h->connection.level;

    *out = OTX_NEW(run->scratch, uint8_t, level->vert_count);
    OTX_TRY(otx_run_ok(run));
    memset(*out, 1, (size_t)level->vert_count);
    for (int32_t f = 0; f < level->face_count; ++f)
        for (int32_t i = level->face_first[f];
             !faces[f] && i < level->face_first[f + 1]; ++i)
            (*out)[level->face_verts[i]] = 0;
    return OSDTEX_OK;
}

/* Everything but the connection is a copy of what the old field has. */
static otx_status
copy_fields(otx_run *run, const osdtex_field *from, osdtex_field *h)
{
    const size_t faces = (size_t)from->info.face_count;
    const size_t verts = (size_t)from->info.vert_count;

    h->request = (otx_direction_request){
        .symmetry = from->request.symmetry,
        .pull_length = from->request.pull_length};
    h->direction = (otx_direction){
        &h->connection, from->direction.symmetry,
        OTX_NEW(run->arena, otx_vec2, faces)};
    h->correction = from->correction;
    h->correction.raw = OTX_NEW(run->arena, double, verts);
    OTX_TRY(otx_run_ok(run));
    memcpy(
        h->direction.powers, from->direction.powers, faces * sizeof(otx_vec2));
    memcpy(h->correction.raw, from->correction.raw, verts * sizeof(double));
    memcpy(h->asked_scale, from->asked_scale, verts * sizeof(double));
    memcpy(h->material, from->material, verts * sizeof(double));
    if (from->request.pull)
    {
        otx_vec2 *pull = OTX_NEW(run->arena, otx_vec2, faces);

        OTX_TRY(otx_run_ok(run));
        memcpy(pull, from->request.pull, faces * sizeof *pull);
        h->request.pull = pull;
    }
    return OSDTEX_OK;
}

/* Solves again what the constraint asks for, within the area of effect. */
static otx_status
resolve(
    otx_run *run, const otx_constraint *item, const uint8_t *faces,
    osdtex_field *h)
{
    uint8_t *verts;

    OTX_TRY(free_vertices(run, h, faces, &verts));
    if (item->has_direction)
    {
        OTX_TRY(otx_direction_edit(run, &h->request, faces, &h->direction));
        OTX_TRY(otx_scale_edit(run, &h->direction, verts, &h->correction));
    }
    if (item->scale > 0.0)
        OTX_TRY(otx_constraint_interpolate(
            run, &h->set, &h->connection, OTX_CONSTRAINT_SCALE, verts,
            h->asked_scale));
    if (item->has_material)
        OTX_TRY(otx_constraint_interpolate(
            run, &h->set, &h->connection, OTX_CONSTRAINT_MATERIAL, verts,
            h->material));
    return OSDTEX_OK;
}

static otx_status
edit(
    otx_run *run, const osdtex_field *field,
    const osdtex_constraint *constraint, double reach, osdtex_field **out)
{
    otx_direction_request pins;
    const otx_constraint *item;
    uint8_t *faces;
    osdtex_field *h;

    if (!field || !constraint || !(reach >= 0.0))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "no field or no constraint is given, or its reach is negative or "
            "not a number");
    OTX_TRY(begin(run, field->surface, &h));
    OTX_TRY(copy_fields(run, field, h));
    OTX_TRY(otx_map_input_add(run, &field->set, constraint, 1, &h->set));
    /* It is in what was copied, and gives way where the edit reaches. */
    h->set.field = (otx_constraint_field){0};
    item = &h->set.items[h->set.count - 1];
    if (!item->has_direction && item->scale == 0.0 && !item->has_material)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "the constraint asks for nothing: give a direction that is not "
            "zero, a scale or a material");
    OTX_TRY(otx_constraint_effect(run, &h->connection, item, reach, &faces));
    pins = (otx_direction_request){.symmetry = h->request.symmetry};
    OTX_TRY(otx_constraint_hold(run, &h->set, &h->connection, faces, &pins));
    h->request.pins = pins.pins;
    h->request.pin_count = pins.pin_count;
    OTX_TRY(resolve(run, item, faces, h));
    OTX_TRY(lend(run, h));
    *out = h;
    return OSDTEX_OK;
}

osdtex_status
osdtex_field_edit(
    osdtex_context *context, const osdtex_field *field,
    const osdtex_constraint *constraint, double reach, osdtex_field **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "field", &call));
    return otx_call_end(
        &call, edit(&call.run, field, constraint, reach, out), out);
}

const osdtex_field_info *
osdtex_field_describe(const osdtex_field *field)
{
    return field ? &field->info : NULL;
}

void
osdtex_field_destroy(osdtex_field *field)
{
    if (field)
        otx_arena_destroy(field->arena);
}

/* map_input.c -- what a user says about fields and the exemplar, checked. */
#include "api/map_input.h"

#include "analysis/exemplar_analysis.h"
#include "api/call.h"
#include "api/field_given.h"
#include "bridge/charconv.h"
#include "file/constraint_file.h"

#include <string.h>

static otx_vec3
vector(const double v[3])
{
    return (otx_vec3){v[0], v[1], v[2]};
}

/* What the whole field is to follow: a word, or a vector as text. */
static otx_status
read_follow(otx_run *run, const char *text, otx_constraint_set *set)
{
    const char *end = text + strlen(text), *at = text;
    double v[3];
    int count = 0;

    set->follows = true;
    set->axis = (otx_vec3){0, 1, 0};
    set->follow = strcmp(text, "up") == 0          ? OTX_FOLLOW_AXIS
                  : strcmp(text, "edges") == 0     ? OTX_FOLLOW_EDGES
                  : strcmp(text, "curvature") == 0 ? OTX_FOLLOW_CURVATURE
                                                   : OTX_FOLLOW_NOTHING;
    if (set->follow != OTX_FOLLOW_NOTHING || strcmp(text, "smooth") == 0)
        return OSDTEX_OK;
    while (count < 3 &&
           otx_charconv_read_double(at, end, &v[count], &at) == OTX_CHARCONV_OK)
    {
        ++count;
        at += count < 3 && *at == ',';
    }
    if (count < 3 || at != end)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "a field follows smooth, up, edges, curvature or an axis X,Y,Z, "
            "not '%.60s'",
            text);
    set->follow = OTX_FOLLOW_AXIS;
    set->axis = vector(v);
    return OSDTEX_OK;
}

static otx_status
take_file(
    otx_run *run, const otx_constraint_file *from, otx_constraint_set *set)
{
    const otx_constraint_file file = *from;
    otx_constraint *items = OTX_NEW(run->arena, otx_constraint, file.count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < file.count; ++i)
        items[i] = (otx_constraint){
            .face = file.lines[i].face,
            .point = vector(file.lines[i].point),
            .radius = file.lines[i].radius,
            .has_direction = file.lines[i].has_direction,
            .direction = vector(file.lines[i].direction),
            .scale = file.lines[i].scale,
            .has_material = file.lines[i].has_material,
            .material = file.lines[i].material,
            .exemplar = file.lines[i].exemplar,
            .exemplar_name = file.lines[i].exemplar_name,
            .edit = file.lines[i].edit,
            .redo = file.lines[i].redo,
            .reach = file.lines[i].reach,
        };
    set->path = file.path;
    set->symmetry = file.symmetry;
    set->follow_length = file.follow_length;
    set->is_table = file.is_table;
    set->count = file.count;
    set->items = items;
    if (file.follow && strcmp(file.follow, "axis") != 0)
        return read_follow(run, file.follow, set);
    if (file.follow)
    {
        set->follow = OTX_FOLLOW_AXIS;
        set->follows = true;
    }
    set->axis = vector(file.axis);
    return OSDTEX_OK;
}

static otx_status
read_file(otx_run *run, const char *path, otx_constraint_set *set)
{
    otx_constraint_file file;

    OTX_TRY(otx_constraint_file_read(run, path, &file));
    return take_file(run, &file, set);
}

otx_status
otx_map_input_parse(
    otx_run *run, const char *path, const char *json,
    const otx_constraint_set **out)
{
    otx_constraint_set *set = OTX_ZNEW(run->arena, otx_constraint_set, 1);
    otx_constraint_file file;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_constraint_file_parse(run, path, json, &file));
    *out = set;
    return take_file(run, &file, set);
}

otx_status
otx_map_input_constraints(
    otx_run *run, const char *path, const char *follow,
    const otx_constraint_set **out)
{
    otx_constraint_set *set;

    *out = NULL;
    if (!path && !follow)
        return OSDTEX_OK;
    set = OTX_ZNEW(run->arena, otx_constraint_set, 1);
    OTX_TRY(otx_run_ok(run));
    if (path)
        OTX_TRY(read_file(run, path, set));
    *out = set;
    return follow ? read_follow(run, follow, set) : OSDTEX_OK;
}

static otx_constraint
constraint_of(const osdtex_constraint *theirs)
{
    const otx_vec3 direction = vector(theirs->direction);

    return (otx_constraint){
        .face = theirs->face,
        .point = vector(theirs->point),
        .radius = theirs->radius,
        .has_direction = otx_vec3_length(direction) != 0.0,
        .direction = direction,
        .scale = theirs->scale,
        .has_material = theirs->has_material != 0,
        .material = theirs->material,
        .exemplar = theirs->exemplar,
        .edit = theirs->edit,
        .redo = theirs->redo,
        .reach = theirs->reach,
    };
}

otx_status
otx_map_input_add(
    otx_run *run, const otx_constraint_set *from,
    const osdtex_constraint *items, int32_t count, otx_constraint_set *out)
{
    const otx_constraint_set none = {.axis = {0, 1, 0}};
    const int32_t had = from ? from->count : 0;
    otx_constraint *all =
        OTX_NEW(run->arena, otx_constraint, (size_t)had + (size_t)count);

    OTX_TRY(otx_run_ok(run));
    if (had > 0)
        memcpy(all, from->items, (size_t)had * sizeof *all);
    for (int32_t i = 0; i < count; ++i)
    {
        const char *at = (const char *)items + (size_t)i * items->size;
        osdtex_constraint ours = osdtex_constraint_none();

        OTX_TRY(otx_call_options(run, &ours, sizeof ours, at));
        all[had + i] = constraint_of(&ours);
    }
    *out = from ? *from : none;
    out->path = NULL;
    out->is_table = false;
    out->items = all;
    out->count = had + count;
    return OSDTEX_OK;
}

/* Whether the host asks for directions or sizes beside its field. */
static bool
asks_beside_field(const osdtex_map_options *options)
{
    for (int32_t i = 0;
         options->constraint_items && i < options->constraint_count; ++i)
    {
        const osdtex_constraint *item =
            (const osdtex_constraint
                 *)((const char *)options->constraint_items +
                    (size_t)i * options->constraint_items->size);

        if (item->scale != 0.0 ||
            otx_vec3_length(vector(item->direction)) != 0.0)
            return true;
    }
    return options->constraints || options->follow;
}

/* What the field asks for, or a file and a word. */
static otx_status
read_base(
    otx_run *run, const osdtex_map_options *options,
    const otx_constraint_set **out)
{
    if (!options->field)
        return otx_map_input_constraints(
            run, options->constraints, options->follow, out);
    if (asks_beside_field(options))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "a field is given, and directions or sizes besides; make the field "
            "with them, or edit it");
    return otx_field_given_constraints(run, options->field, out);
}

otx_status
otx_map_input_options(
    otx_run *run, const osdtex_map_options *options,
    const otx_constraint_set **out)
{
    otx_constraint_set *set;

    OTX_TRY(read_base(run, options, out));
    if (options->constraint_count == 0)
        return OSDTEX_OK;
    if (options->constraint_count < 0 || !options->constraint_items)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "constraints", OTX_NOWHERE,
            "the count of constraints is negative, or there is no array");
    set = OTX_ZNEW(run->arena, otx_constraint_set, 1);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_map_input_add(
        run, *out, options->constraint_items, options->constraint_count, set));
    *out = set;
    return OSDTEX_OK;
}

static otx_status
find_class(otx_run *run, const char *name, otx_analysis_class *out)
{
    for (int i = 0; i < OTX_ANALYSIS_CLASS_COUNT; ++i)
        if (strcmp(name, otx_analysis_name((otx_analysis_class)i)) == 0)
        {
            *out = (otx_analysis_class)i;
            return OSDTEX_OK;
        }
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
        "an exemplar is isotropic, directional, weak-lattice or lattice, not "
        "'%.40s'",
        name);
}

otx_status
otx_map_input_analysis(
    otx_run *run, const osdtex_map_options *options,
    const otx_exemplar *exemplar, const otx_analysis **out)
{
    const double *g = options->generators;
    const otx_vec2 generators[2] = {{g[0], g[1]}, {g[2], g[3]}};
    const bool has_generators =
        g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0 || g[3] != 0.0;
    otx_analysis *a = OTX_NEW(run->arena, otx_analysis, 1);
    otx_analysis_class kind = OTX_ANALYSIS_LATTICE;

    *out = NULL;
    OTX_TRY(otx_run_ok(run));
    if (options->exemplar_class)
        OTX_TRY(find_class(run, options->exemplar_class, &kind));
    if (!options->exemplar_class && !has_generators)
        return OSDTEX_OK;
    *out = a;
    if (has_generators && kind == OTX_ANALYSIS_LATTICE)
        return otx_analysis_force_lattice(run, &exemplar->lab, generators, a);
    OTX_TRY(otx_exemplar_analysis(run, exemplar, a));
    if (kind == OTX_ANALYSIS_LATTICE && a->kind != kind)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "no lattice was found in the exemplar; say what it is with "
            "{generators} X,Y,X,Y, in texels");
    if (kind == OTX_ANALYSIS_ISOTROPIC)
        a->symmetry = 0;
    else if (a->symmetry == 0)
        a->symmetry = 1;
    a->kind = kind;
    a->upright = false; /* it was said what it is */
    return OSDTEX_OK;
}

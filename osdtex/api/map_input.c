/* map_input.c -- what a user says about fields and the exemplar, checked. */
#include "api/map_input.h"

#include "file/constraint_file.h"

#include <string.h>

static otx_vec3
vector(const double v[3])
{
    return (otx_vec3){v[0], v[1], v[2]};
}

otx_status
otx_map_input_constraints(
    otx_run *run, const osdtex_map_options *options,
    const otx_constraint_set **out)
{
    otx_constraint_set *set;
    otx_constraint *items;
    otx_constraint_file file;

    *out = NULL;
    if (!options->constraints)
        return OSDTEX_OK;
    OTX_TRY(otx_constraint_file_read(run, options->constraints, &file));
    set = OTX_NEW(run->arena, otx_constraint_set, 1);
    items = OTX_NEW(run->arena, otx_constraint, file.count);
    if (!set || !items)
        return otx_fail_memory(run, "constraints");
    for (int32_t i = 0; i < file.count; ++i)
        items[i] = (otx_constraint){
            .face = file.lines[i].face,
            .point = vector(file.lines[i].point),
            .radius = file.lines[i].radius,
            .has_direction = file.lines[i].has_direction,
            .direction = vector(file.lines[i].direction),
            .scale = file.lines[i].scale,
        };
    *set = (otx_constraint_set){
        .path = file.path,
        .symmetry = file.symmetry,
        .axis = vector(file.axis),
        .axis_length = file.axis_length,
        .count = file.count,
        .items = items,
    };
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
    if (!a)
        return otx_fail_memory(run, "map");
    if (options->exemplar_class)
        OTX_TRY(find_class(run, options->exemplar_class, &kind));
    if (!options->exemplar_class && !has_generators)
        return OSDTEX_OK;
    *out = a;
    if (has_generators && kind == OTX_ANALYSIS_LATTICE)
        return otx_analysis_force_lattice(run, &exemplar->lab, generators, a);
    OTX_TRY(otx_analysis_run(
        run, &exemplar->lab, exemplar->wrap_x, exemplar->wrap_y, a));
    if (kind == OTX_ANALYSIS_LATTICE && a->kind != kind)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
            "no lattice was found in the exemplar; say what it is with "
            "--generators X,Y,X,Y, in texels");
    if (kind == OTX_ANALYSIS_ISOTROPIC)
        a->symmetry = 0;
    else if (a->symmetry == 0)
        a->symmetry = 1;
    a->kind = kind;
    return OSDTEX_OK;
}

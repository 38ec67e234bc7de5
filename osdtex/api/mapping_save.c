/* mapping_save.c -- mappings written to files. */
#include "api/call.h"
#include "api/saved_about.h"
#include "api/saved_decals.h"
#include "api/saved_field.h"
#include "api/saved_lookups.h"
#include "file/atomic_file.h"
#include "file/tensors.h"

#include <assert.h>
#include <stdio.h>

static const char STAGE[] = "mapping";

/* Vectors are arrays of doubles in a file. */
static_assert(sizeof(otx_vec2) == 16 && sizeof(otx_vec3) == 24, "packed");

/* Which texel of its file each texel of an exemplar is, where it was cut. */
static void
gather_cuts(const osdtex_mapping *mapping, otx_tensors *out)
{
    for (int32_t k = 0; k < mapping->source_count; ++k)
    {
        const otx_exemplar_cuts *c = &mapping->sources[k]->cuts;
        char name[OTX_TENSOR_NAME_BYTES];

        snprintf(name, sizeof name, "exemplar_texels_%d", (int)k);
        if (c->texels)
            otx_tensors_add(
                out, name, OTX_TENSOR_I32, (int64_t)c->width * c->height, 0,
                c->texels);
    }
}

/* Arrays of eight bytes an element. */
static void
gather_wide(const otx_mapping *m, otx_tensors *out)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);

    otx_tensors_add(
        out, "cage_origin", OTX_TENSOR_F64, 3, 0, m->surface->cage->origin);
    if (m->guide)
        otx_tensors_add(
            out, "guide", OTX_TENSOR_F64, leaf->face_count, 3,
            m->guide->directions);
    if (m->lattice)
    {
        otx_tensors_add(
            out, "cells", OTX_TENSOR_F64, leaf->corner_count, 2,
            m->lattice->cells);
        otx_tensors_add(
            out, "defects", OTX_TENSOR_F64, m->lattice->defect_count, 3,
            m->lattice->defects);
    }
    otx_saved_lookups_add_offsets(m, out);
    otx_saved_decals_add_offsets(m, out);
}

/* Arrays in the order of their types' sizes, so that all are aligned. */
static otx_status
gather(otx_run *run, const osdtex_mapping *mapping, otx_tensors *out)
{
    const otx_mapping *m = &mapping->mapping;
    const otx_level *leaf = otx_surface_leaf(m->surface);
    const otx_cage *cage = m->surface->cage;

    gather_wide(m, out);
    otx_tensors_add(
        out, "cage_points", OTX_TENSOR_F32, cage->vert_count, 3,
        mapping->made_for ? mapping->made_for : cage->points);
    otx_tensors_add(out, "uvs", OTX_TENSOR_F32, leaf->corner_count, 2, m->uvs);
    OTX_TRY(otx_saved_lookups_add_reals(run, m, out));
    OTX_TRY(otx_saved_decals_add_reals(run, m, out));
    otx_saved_field_add_reals(m, out);
    if (m->surface->density)
        otx_tensors_add(
            out, "density", OTX_TENSOR_F32, leaf->vert_count, 0,
            m->surface->density);
    if (m->along)
        otx_tensors_add(
            out, "along", OTX_TENSOR_F32, leaf->vert_count, 0, m->along);
    otx_tensors_add(
        out, "face_cage", OTX_TENSOR_I32, leaf->face_count, 0, leaf->face_cage);
    otx_tensors_add(
        out, "face_first", OTX_TENSOR_I32, (int64_t)leaf->face_count + 1, 0,
        leaf->face_first);
    otx_tensors_add(
        out, "face_patch", OTX_TENSOR_I32, leaf->face_count, 0, m->face_patch);
    OTX_TRY(otx_saved_lookups_add_numbers(run, m, out));
    OTX_TRY(otx_saved_decals_add_numbers(run, m, out));
    OTX_TRY(otx_saved_field_add_numbers(run, m, out));
    gather_cuts(mapping, out);
    if (m->lattice)
        otx_tensors_add(
            out, "cells_open", OTX_TENSOR_U8, leaf->face_count, 0,
            m->lattice->open);
    if (m->patch_exemplar)
        otx_tensors_add(
            out, "patch_exemplar", OTX_TENSOR_U8, m->patch_count, 0,
            m->patch_exemplar);
    return OSDTEX_OK;
}

static otx_status
save(otx_run *run, const osdtex_mapping *mapping, const char *path)
{
    otx_tensors *tensors = OTX_ZNEW(run->scratch, otx_tensors, 1);
    otx_atomic_file_set *set;
    const char *temporary;

    if (!mapping || !path)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping or no path is given");
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_saved_about_print(run, mapping, &tensors->about));
    OTX_TRY(gather(run, mapping, tensors));
    OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    OTX_TRY(otx_tensors_write(run, tensors, temporary, path));
    return otx_atomic_file_commit(run, set, true);
}

osdtex_status
osdtex_mapping_save(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(&call, save(&call.run, mapping, path));
}

/* copy.c -- a mapping that outlives the one that it was made from. */
#include "edit/apply.h"

#include <string.h>

/* Memory is looked at by the caller, once. */
static void *
copy_array(otx_run *run, const void *from, int64_t count, size_t size)
{
    void *to = from ? otx_arena_alloc(run->arena, (size_t)count, size) : NULL;

    if (to)
        memcpy(to, from, (size_t)count * size);
    return to;
}

static otx_status
copy_surface(otx_run *run, otx_mapping *out)
{
    const otx_surface *from = out->surface;
    otx_surface *surface;

    if (!from->density)
        return OSDTEX_OK;
    surface = OTX_NEW(run->arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(run));
    *surface = *from;
    surface->density = copy_array(
        run, from->density, otx_surface_leaf(from)->vert_count,
        sizeof *from->density);
    out->surface = surface;
    return OSDTEX_OK;
}

static otx_status
copy_guide(otx_run *run, int32_t faces, otx_mapping *out)
{
    const otx_guide *from = out->guide;
    otx_guide *guide;

    if (!from)
        return OSDTEX_OK;
    guide = OTX_NEW(run->arena, otx_guide, 1);
    OTX_TRY(otx_run_ok(run));
    *guide = *from;
    guide->directions =
        copy_array(run, from->directions, faces, sizeof *from->directions);
    out->guide = guide;
    return OSDTEX_OK;
}

static otx_status
copy_lattice(otx_run *run, const otx_level *leaf, otx_mapping *out)
{
    const otx_cell_map *from = out->lattice;
    otx_cell_map *map;

    if (!from)
        return OSDTEX_OK;
    map = OTX_NEW(run->arena, otx_cell_map, 1);
    OTX_TRY(otx_run_ok(run));
    *map = *from;
    map->cells =
        copy_array(run, from->cells, leaf->corner_count, sizeof *from->cells);
    map->open = copy_array(run, from->open, leaf->face_count, 1);
    map->defects = copy_array(
        run, from->defects, from->defect_count, sizeof *from->defects);
    out->lattice = map;
    return OSDTEX_OK;
}

static int64_t
texel_count(const otx_source_field *field)
{
    int64_t count = 0;

    for (int32_t k = 0; k < field->chart_count; ++k)
        count += (int64_t)field->charts[k].width * field->charts[k].height;
    return count;
}

static otx_status
copy_field(otx_run *run, const otx_level *leaf, otx_mapping *out)
{
    const otx_source_field *from = out->field;
    otx_source_field *field;

    if (!from)
        return OSDTEX_OK;
    field = OTX_NEW(run->arena, otx_source_field, 1);
    OTX_TRY(otx_run_ok(run));
    *field = *from;
    field->charts =
        copy_array(run, from->charts, from->chart_count, sizeof *from->charts);
    field->texels =
        copy_array(run, from->texels, texel_count(from), sizeof *from->texels);
    field->face_chart = copy_array(
        run, from->face_chart, leaf->face_count, sizeof *from->face_chart);
    field->places = copy_array(
        run, from->places, 2 * (int64_t)leaf->corner_count,
        sizeof *from->places);
    field->metric = copy_array(
        run, from->metric, 3 * (int64_t)leaf->face_count, sizeof *from->metric);
    out->field = field;
    return OSDTEX_OK;
}

otx_status
otx_edit_copy(otx_run *run, const otx_mapping *from, otx_mapping *out)
{
    const otx_level *leaf = otx_surface_leaf(from->surface);

    *out = *from;
    out->uvs = copy_array(
        run, from->uvs, 2 * (int64_t)leaf->corner_count, sizeof *from->uvs);
    out->face_patch = copy_array(
        run, from->face_patch, leaf->face_count, sizeof *from->face_patch);
    out->patch_exemplar =
        copy_array(run, from->patch_exemplar, from->patch_count, 1);
    out->along =
        copy_array(run, from->along, leaf->vert_count, sizeof *from->along);
    OTX_TRY(copy_surface(run, out));
    OTX_TRY(copy_guide(run, leaf->face_count, out));
    OTX_TRY(copy_lattice(run, leaf, out));
    OTX_TRY(copy_field(run, leaf, out));
    return otx_run_ok(run);
}

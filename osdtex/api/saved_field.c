/* saved_field.c -- what was made texel by texel, as arrays of a saved mapping.
 */
#include "api/saved_field.h"

#define FAR 1e6f /* no place or UV is as large */

static int64_t
texels_of(const otx_source_field *f)
{
    int64_t count = 0;

    for (int32_t k = 0; k < f->chart_count; ++k)
        count += (int64_t)f->charts[k].width * f->charts[k].height;
    return count;
}

void
otx_saved_field_add_reals(const otx_mapping *mapping, otx_tensors *out)
{
    const otx_source_field *f = mapping->field;
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    if (!f)
        return;
    otx_tensors_add(
        out, "made_texels", OTX_TENSOR_F32, texels_of(f), 4, f->texels);
    otx_tensors_add(
        out, "made_places", OTX_TENSOR_F32, leaf->corner_count, 2, f->places);
    otx_tensors_add(
        out, "made_metric", OTX_TENSOR_F32, leaf->face_count, 3, f->metric);
}

otx_status
otx_saved_field_add_numbers(
    otx_run *run, const otx_mapping *mapping, otx_tensors *out)
{
    const otx_source_field *f = mapping->field;
    int32_t *charts;

    if (!f)
        return OSDTEX_OK;
    charts = OTX_NEW(run->scratch, int32_t, 3 * (int64_t)f->chart_count);
    if (!charts)
        return otx_fail_memory(run, "save");
    for (int32_t k = 0; k < f->chart_count; ++k)
    {
        charts[3 * k] = f->charts[k].width;
        charts[3 * k + 1] = f->charts[k].height;
        charts[3 * k + 2] = f->charts[k].exemplar;
    }
    otx_tensors_add(
        out, "made_charts", OTX_TENSOR_I32, f->chart_count, 3, charts);
    otx_tensors_add(
        out, "made_face_chart", OTX_TENSOR_I32,
        otx_surface_leaf(mapping->surface)->face_count, 0, f->face_chart);
    return OSDTEX_OK;
}

static bool
are_near(const float *values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i)
        if (!(values[i] > -FAR && values[i] < FAR))
            return false;
    return true;
}

/* Lists the charts; false where one is not possible. */
static bool
join_charts(
    const otx_tensor *list, const otx_vec2 *unit, int32_t exemplar_count,
    otx_source_chart *charts, int64_t *texels)
{
    const int32_t *row = list->data;

    *texels = 0;
    for (int64_t k = 0; k < list->rows; ++k, row += 3)
    {
        if (row[0] < 0 || row[1] < 0 || row[0] > OTX_IMAGE_MAX_SIDE ||
            row[1] > OTX_IMAGE_MAX_SIDE || row[2] < 0 ||
            row[2] >= exemplar_count)
            return false;
        charts[k] =
            (otx_source_chart){row[0], row[1], *texels, unit[row[2]], row[2]};
        *texels += (int64_t)row[0] * row[1];
    }
    return true;
}

static bool
have_texels(const otx_source_field *f, int32_t face_count)
{
    for (int32_t i = 0; i < face_count; ++i)
    {
        const int32_t k = f->face_chart[i];

        if (k < -1 || k >= f->chart_count ||
            (k >= 0 && (f->charts[k].width == 0 || f->charts[k].height == 0)))
            return false;
    }
    return true;
}

otx_status
otx_saved_field_join(
    otx_run *run, const otx_tensors *from, const otx_vec2 *unit,
    int32_t exemplar_count, otx_mapping *mapping, const char **damaged)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const otx_tensor *list =
        otx_tensors_find(from, "made_charts", OTX_TENSOR_I32, -1, 3);
    const otx_tensor *face_chart = otx_tensors_find(
        from, "made_face_chart", OTX_TENSOR_I32, leaf->face_count, 0);
    const otx_tensor *places = otx_tensors_find(
        from, "made_places", OTX_TENSOR_F32, leaf->corner_count, 2);
    const otx_tensor *metric = otx_tensors_find(
        from, "made_metric", OTX_TENSOR_F32, leaf->face_count, 3);
    const otx_tensor *texels;
    otx_source_field *f;
    otx_source_chart *charts;
    int64_t count;

    *damaged = NULL;
    if (!list)
        return OSDTEX_OK;
    f = OTX_ZNEW(run->arena, otx_source_field, 1);
    charts = OTX_NEW(run->arena, otx_source_chart, list->rows);
    if (!f || !charts)
        return otx_fail_memory(run, "save");
    *damaged = "what was made texel by texel does not fit together";
    if (!face_chart || !places || !metric || list->rows > INT32_MAX ||
        !join_charts(list, unit, exemplar_count, charts, &count))
        return OSDTEX_OK;
    texels = otx_tensors_find(from, "made_texels", OTX_TENSOR_F32, count, 4);
    if (!texels || !are_near(texels->data, 4 * count) ||
        !are_near(places->data, 2 * (int64_t)leaf->corner_count) ||
        !are_near(metric->data, 3 * (int64_t)leaf->face_count))
        return OSDTEX_OK;
    *f = (otx_source_field){(int32_t)list->rows, charts,       texels->data,
                            face_chart->data,    places->data, metric->data};
    if (!have_texels(f, leaf->face_count))
        return OSDTEX_OK;
    *damaged = NULL;
    mapping->field = f;
    return OSDTEX_OK;
}

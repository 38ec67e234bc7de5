/* field_report.c -- what a report says about fields. */
#include "api/field_report.h"

#include "field/singularity.h"
#include "mapping/alignment.h"

static const double DEGREES = 180.0 / OTX_PI;

static void
put_singularities(
    json_t *field, const otx_direction *d, const otx_singularity_list *list)
{
    const float *points = d->connection->surface->points;
    const double *origin = d->connection->surface->cage->origin;
    json_t *all = json_array();

    json_object_set_new(field, "singularities", all);
    for (int32_t i = 0; i < list->count; ++i)
    {
        const otx_vec3 at = otx_vec3_load(points, list->items[i].vertex);

        json_array_append_new(
            all,
            json_pack(
                "{s:i, s:f, s:[f,f,f]}", "vertex", (int)list->items[i].vertex,
                "index", (double)list->items[i].turns / d->symmetry, "place",
                origin[0] + at.x, origin[1] + at.y, origin[2] + at.z));
    }
}

static void
put_alignment(json_t *field, const otx_alignment *a)
{
    json_object_set_new(
        field, "angle",
        json_pack(
            "{s:f, s:f, s:f}", "mean", a->angle_mean * DEGREES, "p50",
            a->angle_p50 * DEGREES, "p95", a->angle_p95 * DEGREES));
    json_object_set_new(
        field, "scale",
        json_pack(
            "{s:f, s:f, s:f}", "p01", a->scale_p01, "p50", a->scale_p50, "p99",
            a->scale_p99));
}

otx_status
otx_field_report_add(otx_run *run, const osdtex_mapping *mapping, json_t *root)
{
    const otx_guide *guide = mapping->mapping.guide;
    const otx_surface *surface = &mapping->surface->surface;
    otx_singularity_list list;
    otx_connection connection;
    otx_alignment alignment;
    otx_direction direction;
    json_t *field;

    if (!guide)
        return OSDTEX_OK;
    OTX_TRY(otx_connection_build(
        run, surface, surface->level_count - 1, &connection));
    OTX_TRY(otx_direction_from_vectors(
        run, &connection, guide->symmetry, guide->directions, &direction));
    OTX_TRY(otx_singularity_find(run, &direction, &list));
    OTX_TRY(otx_alignment_measure(
        run, &mapping->mapping, mapping->exemplars, &alignment));
    field = json_object();
    json_object_set_new(root, "field", field);
    json_object_set_new(field, "symmetry", json_integer(guide->symmetry));
    put_singularities(field, &direction, &list);
    put_alignment(field, &alignment);
    return OSDTEX_OK;
}

/* test_method.c -- the driver: what a method returns is checked before anybody
 * sees it. */
#include "grid.h"
#include "unit/cluster/sheets.h"

#include "method/method.h"

/* Lays everything flat along z as one patch; a trial method to break. */
static otx_status
lay_flat(
    otx_run *run, const otx_surface *surface, const otx_map_request *request,
    otx_mapping *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    *out = (otx_mapping){
        .surface = surface,
        .scale = request->scale,
        .uvs = OTX_NEW(run->arena, float, 2 * (size_t)leaf->corner_count),
        .face_patch = OTX_ZNEW(run->arena, int32_t, leaf->face_count),
        .patch_count = 1,
    };
    if (!out->uvs || !out->face_patch)
        return otx_fail_memory(run, "map");
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const otx_vec3 p = otx_vec3_load(surface->points, leaf->face_verts[c]);

        out->uvs[2 * c] = (float)(p.x / request->scale);
        out->uvs[2 * c + 1] = (float)(p.y / request->scale);
    }
    return OSDTEX_OK;
}

static otx_status
sound(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    (void)exemplar, (void)settings, (void)stats;
    return lay_flat(run, surface, request, out);
}

static otx_status
with_a_patch_that_is_none(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    OTX_TRY(sound(run, surface, exemplar, request, settings, out, stats));
    out->face_patch[7] = 1000000;
    out->patch_count = 2;
    return OSDTEX_OK;
}

static otx_status
with_a_third_covered(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    OTX_TRY(sound(run, surface, exemplar, request, settings, out, stats));
    for (int32_t f = 0; f < otx_surface_leaf(surface)->face_count; ++f)
        out->face_patch[f] = f % 3 == 0 ? 0 : -1;
    return OSDTEX_OK;
}

static otx_status
with_a_uv_that_is_no_number(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    OTX_TRY(sound(run, surface, exemplar, request, settings, out, stats));
    out->uvs[15] = NAN;
    return OSDTEX_OK;
}

static otx_status
with_nothing(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const void *settings, otx_mapping *out,
    otx_map_stats *stats)
{
    (void)run, (void)surface, (void)exemplar, (void)request, (void)settings;
    (void)out, (void)stats;
    return OSDTEX_OK;
}

static otx_status
run_method(otx_status (*map)(
    otx_run *, const otx_surface *, const otx_exemplar *,
    const otx_map_request *, const void *, otx_mapping *, otx_map_stats *))
{
    const otx_method method = {.name = "trial", .map = map};
    const otx_map_request request = {.scale = 2.0, .first_face = -1};
    otx_run *run = test_run_create();
    const otx_surface surface =
        sheet_from_file(run, "models/cages/plane.obj", 2);
    otx_mapping mapping;
    otx_map_stats stats;
    const otx_status status = otx_method_map(
        run, &method, &surface,
        test_exemplar_create(run->arena, 16, 16, true, 1), &request, NULL,
        &mapping, &stats);

    if (status != OSDTEX_OK)
        assert_non_null(strstr(test_last_message(run), "'trial'"));
    test_run_destroy(run);
    return status;
}

static void
rubbish_is_an_internal_error(void **state)
{
    (void)state;
    assert_int_equal(run_method(sound), OSDTEX_OK);
    assert_int_equal(
        run_method(with_a_patch_that_is_none), OSDTEX_ERROR_INTERNAL);
    assert_int_equal(run_method(with_a_third_covered), OSDTEX_ERROR_INTERNAL);
    assert_int_equal(
        run_method(with_a_uv_that_is_no_number), OSDTEX_ERROR_INTERNAL);
    assert_int_equal(run_method(with_nothing), OSDTEX_ERROR_INTERNAL);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rubbish_is_an_internal_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

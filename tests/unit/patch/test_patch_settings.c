/* test_patch_settings.c -- what "auto" comes to, and that it stays so. */
#include "grid.h"

#include "patch/patch_settings.h"

static otx_patch_settings
resolved(int32_t mode, otx_scheme scheme, const otx_exemplar *exemplar)
{
    otx_patch_settings s = {
        .mode = mode, .coarse = -1, .edges = -1, .usage = -1};
    const otx_cage cage = {.scheme = scheme};

    otx_patch_resolve(&s, exemplar, &cage);
    return s;
}

/* A plain mesh has no subdivision that clusters could be. */
static void
plain_meshes_are_grown_over(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *e = test_exemplar_create(run->arena, 64, 64, true, 1);

    (void)state;
    assert_int_equal(
        resolved(OTX_PATCH_PAPER, OTX_SCHEME_CATMARK, e).clusters,
        OTX_PATCH_SUBDIVISION);
    assert_int_equal(
        resolved(OTX_PATCH_PAPER, OTX_SCHEME_NONE, e).clusters,
        OTX_PATCH_GROWN);
    assert_int_equal(
        resolved(OTX_PATCH_BEST, OTX_SCHEME_CATMARK, e).clusters,
        OTX_PATCH_GROWN);
    test_run_destroy(run);
}

static void
what_is_resolved_stays(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar *e = test_exemplar_create(run->arena, 96, 64, true, 1);
    const otx_cage plain = {.scheme = OTX_SCHEME_NONE};

    (void)state;
    for (int32_t mode = OTX_PATCH_BEST; mode <= OTX_PATCH_PAPER; ++mode)
    {
        const otx_patch_settings once = resolved(mode, OTX_SCHEME_CATMARK, e);
        otx_patch_settings twice = once;

        otx_patch_resolve(&twice, e, &plain);
        assert_memory_equal(&once, &twice, sizeof once);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_meshes_are_grown_over),
        cmocka_unit_test(what_is_resolved_stays),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

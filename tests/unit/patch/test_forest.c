/* test_forest.c -- clusters on their way to becoming patches share all leaves
 * out among them, whatever they start from and however they are split. */
#include "unit/patch/mosaics.h"

#include "patch/forest_check.h"

static void
assert_sound(const otx_mosaic *m)
{
    const char *wrong = otx_forest_check(m);

    if (wrong)
        fail_msg("%s", wrong);
}

static int32_t
living(const otx_mosaic *m)
{
    int32_t count = 0;

    for (int32_t i = 0; i < m->forest.count; ++i)
        count += !m->forest.nodes[i].retired;
    return count;
}

static void
roots_cover_all_but_holes(void **state)
{
    static const char *const cages[] = {"torus", "hole", "several_components"};

    (void)state;
    for (int i = 0; i < 6; ++i)
    {
        otx_run *run = test_run_create();
        const otx_mosaic *m = mosaic_begin(
            run, cages[i % 3], i < 3 ? OTX_PATCH_GROWN : OTX_PATCH_SUBDIVISION);
        const otx_level *leaf = m->job.leaves.level;

        assert_sound(m);
        for (int32_t f = 0; f < leaf->face_count; ++f)
            assert_int_equal(
                m->forest.leaf_node[f] < 0, leaf->face_hole[f] != 0);
        test_run_destroy(run);
    }
}

/* Down to the leaves: children take over what their parent had. */
static void
splitting_shares_out(void **state)
{
    (void)state;
    for (int32_t k = OTX_PATCH_GROWN; k <= OTX_PATCH_SUBDIVISION; ++k)
    {
        otx_run *run = test_run_create();
        otx_mosaic *m = mosaic_begin(run, "torus", k);

        for (int32_t i = 0; i < m->forest.count; ++i)
        {
            const int32_t before = living(m);

            if (!otx_forest_can_split(m, &m->forest.nodes[i]))
                continue;
            assert_int_equal(otx_forest_split(m, i), OSDTEX_OK);
            assert_true(m->forest.nodes[i].retired);
            assert_true(living(m) > before);
            if (i % 16 == 0)
                assert_sound(m);
        }
        assert_sound(m);
        assert_int_equal(living(m), m->job.leaves.level->face_count);
        test_run_destroy(run);
    }
}

static void
settled_clusters_are_flat(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = mosaic_begin(run, "torus", OTX_PATCH_GROWN);

    (void)state;
    assert_int_equal(otx_forest_settle(m, 0), OSDTEX_OK);
    assert_sound(m);
    for (int32_t i = 0; i < m->forest.count; ++i)
        assert_true(
            m->forest.nodes[i].retired ||
            otx_forest_is_flat(m, &m->forest.nodes[i]) ||
            !otx_forest_can_split(m, &m->forest.nodes[i]));
    test_run_destroy(run);
}

static void
what_is_spoilt_is_found(void **state)
{
    otx_run *run = test_run_create();
    otx_mosaic *m = mosaic_begin(run, "torus", OTX_PATCH_GROWN);

    (void)state;
    m->forest.leaf_node[5] = m->forest.count - 1 - m->forest.leaf_node[5];
    assert_non_null(strstr(otx_forest_check(m), "another cluster"));
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_cover_all_but_holes),
        cmocka_unit_test(splitting_shares_out),
        cmocka_unit_test(settled_clusters_are_flat),
        cmocka_unit_test(what_is_spoilt_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

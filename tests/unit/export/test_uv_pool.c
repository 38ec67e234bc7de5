/* test_uv_pool.c -- equal UVs of a vertex are one, of two vertices two. */
#include "export/uv_pool.h"
#include "support.h"

static void
a_vertex_shares_its_equal_uvs(void **state)
{
    static const int32_t verts[] = {0, 1, 2, 0, 2, 1, 0};
    static const float uvs[] = {0.0f, 0.5f, 0.0f, 0.5f, 1.0f,  1.0f, -0.0f,
                                0.5f, 1.0f, 1.0f, 0.0f, 0.25f, 0.5f, 0.5f};
    static const int32_t expected[] = {0, 1, 2, 0, 2, 3, 4};
    otx_run *run = test_run_create();
    otx_uv_pool pool;

    (void)state;
    assert_int_equal(
        otx_uv_pool_build(run, run->arena, 7, verts, uvs, &pool), OSDTEX_OK);
    assert_int_equal(pool.count, 5);
    assert_memory_equal(pool.indices, expected, sizeof expected);
    for (int32_t c = 0; c < 7; ++c)
        for (int32_t k = 0; k < 2; ++k)
            assert_true(pool.uvs[2 * pool.indices[c] + k] == uvs[2 * c + k]);
    test_run_destroy(run);
}

static void
a_pole_with_many_uvs_takes_linear_time(void **state)
{
    enum
    {
        COUNT = 200000
    };
    otx_run *run = test_run_create();
    int32_t *verts = OTX_ZNEW(run->arena, int32_t, COUNT);
    float *uvs = OTX_NEW(run->arena, float, 2 * COUNT);
    otx_uv_pool pool;

    (void)state;
    for (int32_t c = 0; c < COUNT; ++c)
    {
        uvs[2 * c] = (float)(c % 1000);
        uvs[2 * c + 1] = (float)(c / 2000);
    }
    assert_int_equal(
        otx_uv_pool_build(run, run->arena, COUNT, verts, uvs, &pool),
        OSDTEX_OK);
    assert_int_equal(pool.count, COUNT / 2);
    test_run_destroy(run);
}

static void
no_corners_are_no_uvs(void **state)
{
    otx_run *run = test_run_create();
    otx_uv_pool pool;

    (void)state;
    assert_int_equal(
        otx_uv_pool_build(run, run->arena, 0, NULL, NULL, &pool), OSDTEX_OK);
    assert_int_equal(pool.count, 0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_vertex_shares_its_equal_uvs),
        cmocka_unit_test(a_pole_with_many_uvs_takes_linear_time),
        cmocka_unit_test(no_corners_are_no_uvs),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

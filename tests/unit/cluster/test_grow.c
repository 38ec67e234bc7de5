/* test_grow.c -- grown clusters partition their region into discs. */
#include "unit/cluster/sheets.h"

static const char *const cages[] = {
    "creature", "torus",        "double_torus",        "sphere",
    "hole",     "high_valence", "several_components",  "open_boundary",
    "jack",     "corner",       "ngons_and_triangles", "plane"};

static otx_cluster_list
grow(otx_run *run, const otx_surface *s, int32_t level, double count)
{
    const otx_dual dual = sheet_dual(run, s, level);
    const otx_cluster all = sheet_all(run, s, level);
    otx_cluster_list list;

    assert_int_equal(
        sheet_grow(run, &dual, &all, s->area / count, 1, &list), OSDTEX_OK);
    return list;
}

/* Labels the faces; every one that is no hole belongs to one cluster. */
static void
check_partition(otx_run *run, const otx_level *level, otx_cluster_list list)
{
    int32_t *label = OTX_NEW(run->scratch, int32_t, level->face_count);

    for (int32_t f = 0; f < level->face_count; ++f)
        label[f] = -1;
    for (int32_t i = 0; i < list.count; ++i)
    {
        const otx_cluster *c = &list.clusters[i];

        assert_true(c->face_count > 0);
        for (int32_t k = 0; k < c->face_count; ++k)
        {
            assert_true(k == 0 || c->faces[k - 1] < c->faces[k]);
            assert_int_equal(label[c->faces[k]], -1);
            label[c->faces[k]] = i;
        }
    }
    for (int32_t f = 0; f < level->face_count; ++f)
        assert_int_equal(label[f] < 0, level->face_hole[f] != 0);
    for (int32_t i = 0; i < list.count; ++i)
        assert_true(
            list.clusters[i].face_count == 1 ||
            otx_cluster_is_disc(
                run->scratch, level, list.clusters[i].faces,
                list.clusters[i].face_count, label, i));
}

static void
clusters_are_discs_that_partition_the_surface(void **state)
{
    (void)state;
    for (int32_t i = 0; i < COUNT(cages); ++i)
        for (int32_t wanted = 1; wanted <= 64; wanted *= 4)
        {
            otx_run *run = test_run_create();
            char path[128];
            otx_surface s;

            snprintf(path, sizeof path, "models/cages/%s.obj", cages[i]);
            s = sheet_from_file(run, path, 1);
            check_partition(run, &s.levels[1], grow(run, &s, 1, wanted));
            test_run_destroy(run);
        }
}

static void
clusters_have_about_the_size_that_was_asked_for(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 40, 40, SHEET_FLAT);
    const otx_cluster_list list = grow(run, &s, 0, 25.0);

    (void)state;
    assert_int_equal(list.count, 25);
    for (int32_t i = 0; i < list.count; ++i)
    {
        assert_true(list.clusters[i].area > 0.4 * 64.0);
        assert_true(list.clusters[i].area < 2.0 * 64.0);
    }
    test_run_destroy(run);
}

static void
at_least_as_many_as_the_minimum(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 3, 1, SHEET_FLAT);
    const otx_dual dual = sheet_dual(run, &s, 0);
    const otx_cluster all = sheet_all(run, &s, 0);
    otx_cluster_list list;

    (void)state;
    assert_int_equal(sheet_grow(run, &dual, &all, 100.0, 2, &list), OSDTEX_OK);
    assert_int_equal(list.count, 2);
    assert_int_equal(sheet_grow(run, &dual, &all, 100.0, 9, &list), OSDTEX_OK);
    assert_int_equal(list.count, 3);
    test_run_destroy(run);
}

static void
borders_follow_a_fold(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 12, 6, SHEET_FOLDED);
    const otx_cluster_list list = grow(run, &s, 0, 2.0);

    (void)state;
    assert_int_equal(list.count, 2);
    for (int32_t i = 0; i < 2; ++i)
        for (int32_t k = 0; k < list.clusters[i].face_count; ++k)
            assert_int_equal(
                list.clusters[i].faces[k] % 12 < 6,
                list.clusters[i].faces[0] % 12 < 6);
    test_run_destroy(run);
}

static void
growing_depends_on_nothing_but_the_mesh(void **state)
{
    otx_run *a = test_run_create_with(NULL, 1);
    otx_run *b = test_run_create_with(NULL, 8);
    const char *path = "models/cages/creature.obj";
    const otx_surface s = sheet_from_file(a, path, 1);
    const otx_surface t = sheet_from_file(b, path, 1);
    const otx_cluster_list p = grow(a, &s, 1, 40.0), q = grow(b, &t, 1, 40.0);

    (void)state;
    assert_int_equal(p.count, q.count);
    for (int32_t i = 0; i < p.count; ++i)
    {
        assert_int_equal(p.clusters[i].face_count, q.clusters[i].face_count);
        assert_memory_equal(
            p.clusters[i].faces, q.clusters[i].faces,
            (size_t)p.clusters[i].face_count * sizeof(int32_t));
    }
    test_run_destroy(a);
    test_run_destroy(b);
}

static bool
count_down(void *user)
{
    int *left = user;

    return --*left > 0;
}

/* Growth asks, wherever it is, whether to go on. */
static void
growth_can_be_stopped(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_create(run, 200, 200, SHEET_FLAT);
    const otx_dual dual = sheet_dual(run, &s, 0);
    const otx_cluster all = sheet_all(run, &s, 0);
    otx_status status = OSDTEX_ERROR_CANCELLED;
    otx_cluster_list list;
    int stops = 0;

    (void)state;
    while (status != OSDTEX_OK)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        int left = 4 * ++stops;

        otx_pool_watch(run->pool, count_down, &left, 0.0);
        status = sheet_grow(run, &dual, &all, s.area / 30.0, 1, &list);
        if (status != OSDTEX_OK)
            assert_int_equal(status, OSDTEX_ERROR_CANCELLED);
        otx_arena_release(run->scratch, mark);
    }
    assert_true(stops > 10);
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clusters_are_discs_that_partition_the_surface),
        cmocka_unit_test(clusters_have_about_the_size_that_was_asked_for),
        cmocka_unit_test(at_least_as_many_as_the_minimum),
        cmocka_unit_test(borders_follow_a_fold),
        cmocka_unit_test(growing_depends_on_nothing_but_the_mesh),
        cmocka_unit_test(growth_can_be_stopped),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_chart_check.c -- charts as they are made are sound, and each way of
 * spoiling one is found. */
#include "unit/flatten/charts.h"

#include "flatten/chart_check.h"

typedef struct fixture
{
    chart_bench *bench;
    otx_surface surface;
    otx_chart chart;
} fixture;

static fixture
make(void)
{
    otx_run *run = test_run_create();
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    fixture f = {.surface = {0}};

    *surface = sheet_from_file(run, "models/cages/torus.obj", 2);
    f.surface = *surface;
    f.bench = chart_bench_create(run, surface, 8.0, 4.0);

    const int32_t *face = OTX_ZNEW(run->arena, int32_t, 1);
    const otx_cluster cluster = {0, 1, face, 1.0, -1};

    f.chart = chart_joint(f.bench, &cluster);
    return f;
}

static void
assert_found(fixture *f, const char *words)
{
    const char *wrong = otx_chart_check(&f->chart, &f->surface);

    assert_non_null(wrong);
    assert_non_null(strstr(wrong, words));
    test_run_destroy(f->bench->run);
}

static void
what_is_made_is_sound(void **state)
{
    fixture f = make();

    (void)state;
    assert_null(otx_chart_check(&f.chart, &f.surface));
    assert_true(f.chart.face_count > f.chart.core_count);
    test_run_destroy(f.bench->run);
}

static void
what_is_spoilt_is_found(void **state)
{
    fixture a = make(), b = make(), c = make(), d = make(), e = make();

    (void)state;
    a.chart.flat[3].x = NAN;
    assert_found(&a, "nowhere");
    b.chart.corners[2] = b.chart.vert_count;
    assert_found(&b, "no vertex");
    c.chart.verts[1] = c.chart.verts[0];
    assert_found(&c, "its leaf's");
    d.chart.core_count = 0;
    assert_found(&d, "empty");
    e.chart.reach[0] = 1.0f;
    assert_found(&e, "distance");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_made_is_sound),
        cmocka_unit_test(what_is_spoilt_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

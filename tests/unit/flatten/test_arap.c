/* test_arap.c -- rounds spread the stretch of unfolding and lower it. */
#include "unit/flatten/charts.h"

/* Sum of squared departures of the singular values from 1: the energy that
 * the rounds lower, over the whole chart, unweighted. */
static double
distortion(const char *path, int32_t rounds)
{
    otx_run *run = test_run_create();
    const otx_surface s = sheet_from_file(run, path, 2);
    chart_bench *b = chart_bench_create(run, &s, 30.0, 20.0);
    const int32_t faces[] = {0, 1};
    const otx_cluster c = {0, 2, faces, 1.0, -1};
    double sum = 0.0;
    otx_chart chart;

    b->request.rounds = rounds;
    chart = chart_joint(b, &c);
    for (int32_t i = 0; i < chart.face_count; ++i)
    {
        double sigma[2];

        otx_chart_face_stretch(&chart, &s, 30.0, i, sigma);
        sum += (sigma[0] - 1.0) * (sigma[0] - 1.0) +
               (sigma[1] - 1.0) * (sigma[1] - 1.0);
    }
    test_run_destroy(run);
    return sum;
}

static void
rounds_lower_the_distortion(void **state)
{
    const char *path = "models/cages/sphere.obj";

    (void)state;
    assert_true(distortion(path, 5) < 0.8 * distortion(path, 0));
    assert_true(distortion(path, 20) <= 1.1 * distortion(path, 5));
}

static void
poles_are_not_flipped(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface s =
        sheet_from_file(run, "models/cages/high_valence.obj", 2);
    chart_bench *b = chart_bench_create(run, &s, 30.0, 10.0);

    (void)state;
    for (int32_t f = 0; f < s.levels[0].face_count; f += 5)
    {
        const otx_cluster c = {0, 1, &f, 1.0, -1};
        const otx_chart chart = chart_joint(b, &c);

        for (int32_t i = 0; i < chart.core_count; ++i)
            assert_true(otx_chart_face_area(&chart, i) > 0.0);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rounds_lower_the_distortion),
        cmocka_unit_test(poles_are_not_flipped),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

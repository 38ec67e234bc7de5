/* test_coverage.c -- what is used evenly counts 1, what is used in one place as
 * that share of the cells. */
#include "grid.h"

#include "mapping/coverage.h"

static otx_coverage
make_coverage(otx_run *run, int32_t width, int32_t height, bool wraps)
{
    otx_coverage c;

    assert_true(otx_coverage_begin(
        run->arena, test_exemplar_create(run->arena, width, height, wraps, 1),
        &c));
    return c;
}

/* A rectangle of the picture, as two triangles of its area. */
static void
add_box(otx_coverage *c, double x, double y, double width, double height)
{
    const otx_vec2 p[4] = {
        {x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    const otx_vec2 halves[2][3] = {{p[0], p[1], p[2]}, {p[2], p[3], p[0]}};

    for (int k = 0; k < 2; ++k)
        otx_coverage_add(c, halves[k], 0.5 * width * height);
}

static double
total_of(const otx_coverage *c)
{
    double sum = 0.0;

    for (int32_t i = 0; i < c->cells_x * c->cells_y; ++i)
        sum += c->cells[i];
    return sum;
}

static void
all_of_it_is_even_and_none_is_zero(void **state)
{
    otx_run *run = test_run_create();
    otx_coverage c = make_coverage(run, 64, 32, true);

    (void)state;
    assert_float_equal(otx_coverage_evenness(&c), 0.0, 0.0);
    for (int32_t y = 0; y < c.cells_y; ++y)
        for (int32_t x = 0; x < c.cells_x; ++x)
            add_box(&c, x * c.cell, y * c.cell, c.cell, c.cell);
    assert_float_equal(total_of(&c), 64.0 * 32.0, 1e-6);
    assert_float_equal(otx_coverage_evenness(&c), 1.0, 0.01);
    test_run_destroy(run);
}

static void
one_cell_counts_as_its_share(void **state)
{
    otx_run *run = test_run_create();
    otx_coverage c = make_coverage(run, 64, 64, true);

    (void)state;
    add_box(&c, 0.1 * c.cell, 0.1 * c.cell, 0.8 * c.cell, 0.8 * c.cell);
    assert_float_equal(
        otx_coverage_evenness(&c) * c.cells_x * c.cells_y, 1.0, 1e-12);
    test_run_destroy(run);
}

/* Beyond the border: in the picture's next copy where it tiles, at the border
 * where it ends. */
static void
what_is_beyond_wraps_where_the_picture_does(void **state)
{
    for (int wraps = 0; wraps < 2; ++wraps)
    {
        otx_run *run = test_run_create();
        otx_coverage inside = make_coverage(run, 64, 64, wraps);
        otx_coverage beyond = make_coverage(run, 64, 64, wraps);
        const size_t bytes =
            sizeof(double) * (size_t)(inside.cells_x * inside.cells_y);

        (void)state;
        add_box(&inside, 10.0, 20.0, 8.0, 8.0);
        add_box(&beyond, 10.0 + 64.0, 20.0 - 128.0, 8.0, 8.0);
        assert_float_equal(total_of(&inside), total_of(&beyond), 1e-9);
        assert_int_equal(memcmp(inside.cells, beyond.cells, bytes) == 0, wraps);
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_of_it_is_even_and_none_is_zero),
        cmocka_unit_test(one_cell_counts_as_its_share),
        cmocka_unit_test(what_is_beyond_wraps_where_the_picture_does),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

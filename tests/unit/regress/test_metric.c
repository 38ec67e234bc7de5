/* test_metric.c -- how far figures may move, and which way. */
#include "support.h"

#include "regress/metric.h"

#include <math.h>
#include <string.h>

/* The status of one figure against its reference. */
static void
expect(
    const char *name, double value, double reference, const json_t *tolerances,
    const char *status)
{
    json_t *values = json_pack("{s:f}", name, value);
    json_t *references = json_pack("{s:f}", name, reference);
    json_t *rows = otx_metric_judge(values, references, tolerances);
    const json_t *row = json_array_get(rows, 0);

    assert_int_equal(json_array_size(rows), 1);
    if (strcmp(json_string_value(json_object_get(row, "status")), status) != 0)
        fail_msg("%s: %g against %g is not %s", name, value, reference, status);
    json_decref(rows);
    json_decref(references);
    json_decref(values);
}

static void
what_is_equal_passes(void **state)
{
    static const char *const names[] = {
        "seam_energy", "flips",           "patches",
        "time.map",    "memory.heap_mib", "of another version"};
    static const double values[] = {0.0, 1e-9, 0.25, 1.0, 12345.0};

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        for (size_t k = 0; k < sizeof values / sizeof values[0]; ++k)
            expect(names[i], values[k], values[k], NULL, "pass");
}

/* Quality is held both ways; times and memory may only not grow. */
static void
only_costs_may_fall(void **state)
{
    (void)state;
    expect("patches", 103.0, 100.0, NULL, "fail");
    expect("patches", 97.0, 100.0, NULL, "fail");
    expect("patches", 101.0, 100.0, NULL, "pass");
    expect("flips", 1.0, 0.0, NULL, "fail");
    expect("time.map", 1.0, 100.0, NULL, "pass");
    expect("time.map", 200.0, 100.0, NULL, "fail");
    expect("memory.heap_mib", 1.0, 100.0, NULL, "pass");
    expect("memory.heap_mib", 120.0, 100.0, NULL, "fail");
    expect("of another version", 1.001, 1.0, NULL, "fail");
}

/* One of a stage goes before one of all times. */
static void
tables_set_tolerances(void **state)
{
    json_t *own = json_pack("{s:f,s:f}", "time.*", 3.0, "time.bake", 0.1);

    (void)state;
    expect("time.map", 390.0, 100.0, own, "pass");
    expect("time.bake", 390.0, 100.0, own, "fail");
    expect("patches", 103.0, 100.0, own, "fail");
    json_decref(own);
}

static void
figures_that_come_or_go_are_told(void **state)
{
    json_t *values = json_pack("{s:f}", "patches", 3.0);
    json_t *references = json_pack("{s:f}", "flips", 0.0);
    json_t *rows = otx_metric_judge(values, references, NULL);

    (void)state;
    assert_int_equal(json_array_size(rows), 2);
    assert_string_equal(
        json_string_value(json_object_get(json_array_get(rows, 0), "status")),
        "missing");
    assert_string_equal(
        json_string_value(json_object_get(json_array_get(rows, 1), "status")),
        "fail");
    json_decref(rows);
    json_decref(references);
    json_decref(values);
}

static void
the_faster_of_two_is_kept(void **state)
{
    json_t *into = json_pack(
        "{s:f,s:f,s:f}", "time.map", 3.0, "time.bake", 1.0, "patches", 5.0);
    json_t *other = json_pack(
        "{s:f,s:f,s:f}", "time.map", 2.0, "time.bake", 4.0, "patches", 1.0);

    (void)state;
    otx_metric_keep_faster(into, other);
    assert_true(json_number_value(json_object_get(into, "time.map")) == 2.0);
    assert_true(json_number_value(json_object_get(into, "time.bake")) == 1.0);
    assert_true(json_number_value(json_object_get(into, "patches")) == 5.0);
    json_decref(other);
    json_decref(into);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_equal_passes),
        cmocka_unit_test(only_costs_may_fall),
        cmocka_unit_test(tables_set_tolerances),
        cmocka_unit_test(figures_that_come_or_go_are_told),
        cmocka_unit_test(the_faster_of_two_is_kept),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_names.c -- names of files that every reader can follow. */
#include "export/names.h"
#include "support.h"

static void
names_stand_beside_the_obj(void **state)
{
    otx_run *run = test_run_create();
    otx_names names;

    (void)state;
    assert_int_equal(
        otx_names_derive(run, run->arena, "a b/c.d/shirt.v2.OBJ", &names),
        OSDTEX_OK);
    assert_string_equal(names.obj, "a b/c.d/shirt.v2.OBJ");
    assert_string_equal(names.mtl, "a b/c.d/shirt.v2.mtl");
    assert_string_equal(names.exr, "a b/c.d/shirt.v2.exr");
    assert_string_equal(names.mtl_name, "shirt.v2.mtl");
    assert_string_equal(names.exr_name, "shirt.v2.exr");
    assert_string_equal(names.stem, "shirt.v2");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 0);
    test_run_destroy(run);
}

static void
what_readers_split_is_replaced(void **state)
{
    otx_run *run = test_run_create();
    otx_names names;

    (void)state;
    assert_int_equal(
        otx_names_derive(run, run->arena, "-my red#shirt.obj", &names),
        OSDTEX_OK);
    assert_string_equal(names.obj, "-my red#shirt.obj");
    assert_string_equal(names.mtl, "_my_red_shirt.mtl");
    assert_string_equal(names.exr_name, "_my_red_shirt.exr");
    assert_int_equal(otx_diagnostics_count(run->diagnostics), 1);
    test_run_destroy(run);
}

static void
other_names_are_refused(void **state)
{
    static const char *const bad[] = {
        "", "shirt", "shirt.exr", ".obj", "folder/.obj", "folder.obj/"};
    otx_run *run = test_run_create();
    otx_names names;

    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
        assert_int_equal(
            otx_names_derive(run, run->arena, bad[i], &names),
            OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_stand_beside_the_obj),
        cmocka_unit_test(what_readers_split_is_replaced),
        cmocka_unit_test(other_names_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

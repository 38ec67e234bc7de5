/* test_foreign.c -- what is no OBJ is called by its name. */
#include "file/foreign.h"
#include "file/obj.h"
#include "support.h"

static void
read_fails(const char *bytes, size_t size, const char *words)
{
    otx_run *run = test_run_create();
    otx_obj obj;

    assert_int_equal(
        otx_obj_parse(run, "cage", bytes, size, &obj), OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), words));
    test_run_destroy(run);
}

static void
other_files_are_named(void **state)
{
    static const char usda[] = "#usda 1.0\ndef Mesh \"m\" {}\n";
    static const char usdc[] = "PXR-USDC\0\0\1";
    static const char ply[] = "ply\nformat ascii 1.0\n";

    (void)state;
    read_fails(usda, sizeof usda - 1, "this is a USD file");
    read_fails(usdc, sizeof usdc - 1, "this is a USD file");
    read_fails(ply, sizeof ply - 1, "this is a PLY file");
    assert_null(otx_foreign_kind("v 0 0 0\n", 8));
    assert_null(otx_foreign_kind("# usda\n", 7));
    assert_null(otx_foreign_kind("", 0));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(other_files_are_named)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

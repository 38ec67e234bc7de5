/* test_udim_name.c -- names of tiles, and their numbers. */
#include "support.h"

#include "file/udim_name.h"
#include "image/udim.h"

#include <string.h>

static void
tiles_count_in_rows_of_ten(void **state)
{
    (void)state;
    assert_int_equal(otx_udim_tile(0, 0), 1001);
    assert_int_equal(otx_udim_tile(9, 0), 1010);
    assert_int_equal(otx_udim_tile(0, 1), 1011);
    for (int32_t tile = OTX_UDIM_FIRST; tile <= OTX_UDIM_LAST; ++tile)
        assert_int_equal(
            otx_udim_tile(otx_udim_column(tile), otx_udim_row(tile)), tile);
}

static void
tokens_become_numbers(void **state)
{
    static const char *const names[][2] = {
        {"mask.<UDIM>.exr", "mask.1023.exr"},
        {"a/<udim>_mask.tif", "a/1023_mask.tif"},
        {"a.b/mask_<UVTILE>.png", "a.b/mask_u3_v3.png"},
        {"<uvtile>", "u3_v3"}};
    otx_run *run = test_run_create();

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    {
        assert_true(otx_udim_name_is_pattern(names[i][0]));
        assert_string_equal(
            otx_udim_name_of(run->arena, names[i][0], 1023), names[i][1]);
    }
    test_run_destroy(run);
}

/* Neither in the folder's name, nor cut short. */
static void
other_names_are_plain(void **state)
{
    (void)state;
    assert_false(otx_udim_name_is_pattern("mask.1001.exr"));
    assert_false(otx_udim_name_is_pattern("<UDIM>/mask.exr"));
    assert_false(otx_udim_name_is_pattern("mask.<UDIM"));
    assert_false(otx_udim_name_is_pattern(""));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_count_in_rows_of_ten),
        cmocka_unit_test(tokens_become_numbers),
        cmocka_unit_test(other_names_are_plain),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

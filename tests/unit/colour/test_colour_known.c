/* test_colour_known.c -- spaces are known by what they do, not by name. */
#include "colour_support.h"

static void
test_primaries_are_measured(void **state)
{
    static const struct
    {
        const char *space, *id;
        float red_x;
        bool linear;
    } table[] = {
        {"ACEScg", "lin_ap1_scene", 0.713F, true},
        {"ACES2065-1", "lin_ap0_scene", 0.7347F, true},
        {"Linear Rec.709 (sRGB)", "lin_rec709_scene", 0.64F, true},
        {"sRGB - Texture", "srgb_rec709_scene", 0.0F, false},
        {"Raw", "data", 0.0F, false},
    };
    otx_run *run = test_run_create();
    otx_colour colour;
    (void)state;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
    {
        float xy[8];

        assert_int_equal(
            otx_colour_is_linear(&colour, table[i].space), table[i].linear);
        assert_int_equal(
            otx_colour_chromaticities(&colour, table[i].space, xy),
            table[i].linear);
        if (table[i].linear)
            assert_true(xy[0] == table[i].red_x);
        assert_string_equal(
            otx_colour_interop_id(&colour, table[i].space), table[i].id);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_primaries_are_measured),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

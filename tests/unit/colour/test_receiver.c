#include "colour/receiver.h"

#include "support.h"

#include <unistd.h>

#define CG SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"
#define MINI SHARED_DATA "/ocio/mini_rec709_v2.0.ocio"

typedef struct row
{
    otx_receiver receiver;
    const char *to, *space;
    bool as_png;
} row;

static void
check_rows(otx_run *run, const otx_colour *colour, const row *rows, size_t n)
{
    for (size_t i = 0; i < n; ++i)
    {
        otx_receiver_choice choice;

        assert_int_equal(
            otx_receiver_resolve(
                run, colour, rows[i].receiver, rows[i].to, OTX_TEXTURE_ANY,
                &choice),
            OSDTEX_OK);
        assert_string_equal(choice.space, rows[i].space);
        assert_int_equal(
            choice.type, rows[i].as_png ? OTX_TEXTURE_PNG : OTX_TEXTURE_EXR);
    }
}

/* Without a configuration: what each takes a texture to be; --to wins. */
static void
everyone_has_a_space(void **state)
{
    static const char rec709[] = "Linear Rec.709 (sRGB)";
    static const row rows[] = {
        {OTX_RECEIVER_ANY, NULL, rec709, false},
        {OTX_RECEIVER_BLENDER, NULL, rec709, false},
        {OTX_RECEIVER_MAYA, NULL, "ACEScg", false},
        {OTX_RECEIVER_HOUDINI, NULL, rec709, false},
        {OTX_RECEIVER_USD, "", rec709, false},
        {OTX_RECEIVER_WEB, NULL, rec709, true},
        {OTX_RECEIVER_MAYA, "lin_ap0", "ACES2065-1", false},
        {OTX_RECEIVER_WEB, "ACEScg", "ACEScg", false},
    };
    otx_run *run = test_run_create();
    otx_colour colour;
    (void)state;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    check_rows(run, &colour, rows, sizeof rows / sizeof rows[0]);
    test_run_destroy(run);
}

/* A configuration in $OCIO is that of Blender and Maya too, one that is given
 * to osdtex alone is not. */
static void
a_configuration_is_shared_by_the_environment(void **state)
{
    static const row alone[] = {
        {OTX_RECEIVER_ANY, NULL, "ACEScg", false},
        {OTX_RECEIVER_BLENDER, NULL, "Linear Rec.709 (sRGB)", false},
        {OTX_RECEIVER_USD, NULL, "Linear Rec.709 (sRGB)", false},
        {OTX_RECEIVER_MAYA, NULL, "ACEScg", false},
    };
    static const row shared[] = {
        {OTX_RECEIVER_BLENDER, NULL, "ACEScg", false},
        {OTX_RECEIVER_HOUDINI, NULL, "ACEScg", false},
        {OTX_RECEIVER_USD, NULL, "Linear Rec.709 (sRGB)", false},
        {OTX_RECEIVER_WEB, NULL, "Linear Rec.709 (sRGB)", true},
    };
    otx_run *run;
    otx_colour colour;
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA "/ocio");
    run = test_run_create();
    assert_int_equal(otx_colour_open(run, CG, NULL, &colour), OSDTEX_OK);
    check_rows(run, &colour, alone, sizeof alone / sizeof alone[0]);
    assert_int_equal(otx_colour_open(run, NULL, CG, &colour), OSDTEX_OK);
    check_rows(run, &colour, shared, sizeof shared / sizeof shared[0]);
    test_run_destroy(run);
}

static void
a_space_that_is_missing_is_said(void **state)
{
    otx_run *run;
    otx_colour colour;
    otx_receiver_choice choice;
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA "/ocio");
    run = test_run_create();
    assert_int_equal(otx_colour_open(run, MINI, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_receiver_resolve(
            run, &colour, OTX_RECEIVER_MAYA, NULL, OTX_TEXTURE_ANY, &choice),
        OSDTEX_ERROR_COLOUR);
    assert_non_null(strstr(test_last_message(run), "for maya"));
    assert_non_null(strstr(test_last_message(run), "to"));
    test_run_destroy(run);
}

static void
integers_are_srgb_for_all(void **state)
{
    otx_run *run = test_run_create();
    otx_receiver_choice choice;
    otx_colour colour;

    (void)state;
    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    for (int type = OTX_TEXTURE_PNG; type < OTX_TEXTURE_COUNT; ++type)
        for (int r = 0; r < OTX_RECEIVER_COUNT; ++r)
        {
            assert_int_equal(
                otx_receiver_resolve(
                    run, &colour, (otx_receiver)r, NULL, (otx_texture_type)type,
                    &choice),
                OSDTEX_OK);
            assert_int_equal(choice.type, type);
            assert_string_equal(choice.space, "Linear Rec.709 (sRGB)");
        }
    assert_int_equal(
        otx_receiver_resolve(
            run, &colour, OTX_RECEIVER_WEB, NULL, OTX_TEXTURE_EXR, &choice),
        OSDTEX_OK);
    assert_int_equal(choice.type, OTX_TEXTURE_EXR);
    assert_int_equal(
        otx_receiver_resolve(
            run, &colour, OTX_RECEIVER_ANY, "ACEScg", OTX_TEXTURE_TIFF,
            &choice),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyone_has_a_space),
        cmocka_unit_test(a_configuration_is_shared_by_the_environment),
        cmocka_unit_test(a_space_that_is_missing_is_said),
        cmocka_unit_test(integers_are_srgb_for_all),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

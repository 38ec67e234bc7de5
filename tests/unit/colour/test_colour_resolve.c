/* test_colour_resolve.c -- which rule decides, on every configuration at hand.
 */
#include "colour_support.h"

/* One line a rule: what is known of the file, what comes out, and a word of
 * the finding that says why. */
typedef struct row
{
    otx_colour_source source;
    const char *space;
    const char *why;
} row;

static void
check_rows(otx_run *run, const otx_colour *colour, const row *rows, size_t n)
{
    for (size_t i = 0; i < n; ++i)
    {
        const char *space = NULL;

        assert_int_equal(
            otx_colour_resolve(run, colour, &rows[i].source, &space, NULL),
            OSDTEX_OK);
        assert_string_equal(space, rows[i].space);
        if (!strstr(test_last_message(run), rows[i].why))
            fail_msg("row %zu: %s", i, test_last_message(run));
    }
}

/* Findings are folded by their format, so each row has its own path. */
static void
test_order(void **state)
{
    static const row rows[] = {
        {{.path = "a_nrm_1.png",
          .from = "lin_ap0",
          .interop_id = "lin_ap1_scene"},
         "ACES2065-1",
         "from"},
        {{.path = "b_nrm_.exr",
          .interop_id = "lin_rec709_scene",
          .oiio_space = "ACEScg",
          .is_float = true},
         "Linear Rec.709 (sRGB)",
         "colorInteropID"},
        {{.path = "c_nrm_.exr",
          .interop_id = "unknown",
          .oiio_space = "lin_ap0",
          .has_chromaticities = true,
          .chromaticities = REC709,
          .is_float = true},
         "ACES2065-1",
         "oiio:ColorSpace"},
        {{.path = "d_nrm_.exr",
          .has_chromaticities = true,
          .chromaticities = REC709,
          .is_float = true},
         "Linear Rec.709 (sRGB)",
         "chromaticities"},
        {{.path = "e_nrm_.exr", .is_float = true}, "Raw", "file rule Data"},
        {{.path = "f.exr", .is_float = true},
         "Linear Rec.709 (sRGB)",
         "scene_linear"},
        {{.path = "g.png"}, "sRGB - Texture", "integer"},
        {{.path = "h.exr", .interop_id = "data"}, "Raw", "colorInteropID"},
        {{.path = "i.png", .interop_id = "srgb_rec709_scene"},
         "sRGB - Texture",
         "colorInteropID"},
    };
    otx_run *run = test_run_create();
    otx_colour colour;
    (void)state;

    assert_int_equal(otx_colour_open(run, NULL, "", &colour), OSDTEX_OK);
    assert_non_null(strstr(test_last_message(run), "built in"));
    check_rows(run, &colour, rows, sizeof rows / sizeof rows[0]);
    test_run_destroy(run);
}

static void
test_unknown_tags_are_passed_over(void **state)
{
    static const float nowhere[8] = {
        0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.0F};
    otx_colour_source source = {
        .path = "x.exr",
        .interop_id = "g24_fantasy",
        .oiio_space = "Linear",
        .has_chromaticities = true,
        .is_float = true};
    otx_run *run = test_run_create();
    const otx_decoder *decoder;
    const char *space = NULL;
    otx_colour colour;
    (void)state;

    memcpy(source.chromaticities, nowhere, sizeof nowhere);
    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(warning_count(run), 0);
    assert_int_equal(
        otx_colour_resolve(run, &colour, &source, &space, &decoder), OSDTEX_OK);
    assert_string_equal(space, "Linear Rec.709 (sRGB)");
    assert_null(decoder);
    assert_int_equal(warning_count(run), 3);
    test_run_destroy(run);
}

/* Every configuration resolves an 8-bit and a float picture, an output space
 * and a space to match in. */
static void
test_configurations(void **state)
{
    static const struct
    {
        const char *path, *byte, *linear, *match, *id;
    } table[] = {
        {CG, "sRGB - Texture", "ACEScg", "sRGB - Texture", "lin_ap1_scene"},
        {MINI, "srgb_tex", "lin_rec709", "srgb_tex", "lin_rec709_scene"},
        {DEMO, "sRGB", "ACEScg", "sRGB", "lin_ap1_scene"},
        {HOSTILE "ocio_no_roles.ocio", "sRGB - Texture", "ACEScg",
         "sRGB - Texture", "lin_ap1_scene"},
    };
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
    {
        const otx_colour_source byte = {.path = "brick.png"};
        otx_run *run = test_run_create();
        const char *space = NULL;
        bool linear = true;
        otx_colour colour;

        assert_int_equal(
            otx_colour_open(run, NULL, table[i].path, &colour), OSDTEX_OK);
        assert_string_equal(colour.path, table[i].path);
        assert_int_equal(
            otx_colour_resolve(run, &colour, &byte, &space, NULL), OSDTEX_OK);
        assert_string_equal(space, table[i].byte);
        assert_int_equal(
            otx_colour_resolve_linear(run, &colour, NULL, &space), OSDTEX_OK);
        assert_string_equal(space, table[i].linear);
        assert_string_equal(otx_colour_interop_id(&colour, space), table[i].id);
        assert_int_equal(
            otx_colour_resolve_match(run, &colour, NULL, &space, &linear),
            OSDTEX_OK);
        assert_string_equal(space, table[i].match);
        assert_false(linear);
        test_run_destroy(run);
    }
}

/* The demo configuration looks for names of spaces in paths. */
static void
test_names_in_paths_are_words(void **state)
{
    static const row rows[] = {
        {{.path = "/drawings/a.png"}, "sRGB", "integer"},
        {{.path = "/b/brick_raw.png"}, "Raw", "ColorSpaceNamePathSearch"},
        {{.path = "/ACEScg/c.png"}, "ACEScg", "ColorSpaceNamePathSearch"},
        {{.path = "/drawings/d_Raw.png"}, "Raw", "ColorSpaceNamePathSearch"},
    };
    otx_run *run = test_run_create();
    otx_colour colour;
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
    {
        test_run_destroy(run);
        test_skip("no " SHARED_DATA);
    }
    assert_int_equal(otx_colour_open(run, DEMO, NULL, &colour), OSDTEX_OK);
    check_rows(run, &colour, rows, sizeof rows / sizeof rows[0]);
    test_run_destroy(run);
}

static void
test_match_space_is_checked(void **state)
{
    otx_run *run = test_run_create();
    const char *space = NULL;
    bool linear = false;
    otx_colour colour;
    (void)state;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_colour_resolve_match(run, &colour, "ACEScg", &space, &linear),
        OSDTEX_OK);
    assert_true(linear);
    assert_non_null(strstr(test_last_message(run), "curve"));
    assert_int_equal(
        otx_colour_resolve_match(run, &colour, "Raw", &space, &linear),
        OSDTEX_OK);
    assert_string_equal(space, "sRGB - Texture");
    assert_false(linear);
    assert_int_equal(
        otx_colour_resolve_match(run, &colour, "nowhere", &space, &linear),
        OSDTEX_ERROR_COLOUR);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_unknown_tags_are_passed_over),
        cmocka_unit_test(test_configurations),
        cmocka_unit_test(test_names_in_paths_are_words),
        cmocka_unit_test(test_match_space_is_checked),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

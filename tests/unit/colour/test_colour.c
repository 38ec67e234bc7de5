/* test_colour.c -- which rule decides, on every configuration at hand. */
#include "colour/decoder.h"
#include "colour/primaries.h"
#include "support.h"

#include <math.h>
#include <unistd.h>

#define CG SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"
#define MINI SHARED_DATA "/ocio/mini_rec709_v2.0.ocio"
#define DEMO SHARED_DATA "/ocio/ocio-v2_demo.ocio"
#define HOSTILE SHARED_DATA "/hostile/"

#define REC709                                                                 \
    {                                                                          \
        0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F             \
    }
#define ODD                                                                    \
    {                                                                          \
        0.60F, 0.33F, 0.25F, 0.60F, 0.15F, 0.10F, 0.3127F, 0.3290F             \
    }

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

static int32_t
warning_count(const otx_run *run)
{
    int32_t count = 0;

    for (int32_t i = 0; i < otx_diagnostics_count(run->diagnostics); ++i)
    {
        osdtex_diagnostic d;
        otx_diagnostics_get(run->diagnostics, i, &d);
        if (d.severity == OSDTEX_SEVERITY_WARNING)
            count += (int32_t)d.count;
    }
    return count;
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

/* Primaries of no space of the configuration are a matrix: the brightest red of
 * Adobe's is the same light by both ways, up to the rounding of three digits.
 */
static void
test_odd_chromaticities_are_a_matrix(void **state)
{
    const otx_colour_source source = {
        .path = "x.exr",
        .has_chromaticities = true,
        .chromaticities = ODD,
        .is_float = true};
    static const float xy[8] = ODD;
    float pixels[8 * 3];
    otx_image image = {8, 1, 3, pixels};
    otx_run *run = test_run_create();
    const otx_decoder *decoder;
    const char *space = NULL;
    otx_primaries_matrix file, ours;
    static const float rec709[8] = REC709;
    otx_colour colour;
    (void)state;

    for (int i = 0; i < 24; ++i)
        pixels[i] = (float)((i / 3) >> (i % 3) & 1) * 2.0F;
    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_colour_resolve(run, &colour, &source, &space, &decoder), OSDTEX_OK);
    assert_non_null(decoder);
    assert_int_equal(warning_count(run), 0);
    assert_int_equal(otx_decoder_apply(run, decoder, &image), OSDTEX_OK);
    assert_true(otx_primaries_to_aces(xy, &file));
    assert_true(otx_primaries_to_aces(rec709, &ours));
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k)
        {
            double theirs = 0.0, mine = 0.0;

            for (int j = 0; j < 3; ++j)
            {
                theirs += file.m[k][j] * ((i >> j & 1) * 2.0);
                mine += ours.m[k][j] * (double)pixels[3 * i + j];
            }
            assert_true(fabs(theirs - mine) < 2e-5);
        }
    test_run_destroy(run);
}

static void
test_unknown_name_lists_near_ones(void **state)
{
    const otx_colour_source source = {.from = "ACESgc"};
    otx_run *run = test_run_create();
    const char *space = NULL;
    otx_colour colour;
    (void)state;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_colour_resolve(run, &colour, &source, &space, NULL),
        OSDTEX_ERROR_COLOUR);
    assert_null(space);
    assert_non_null(strstr(test_last_message(run), "from"));
    assert_non_null(strstr(test_last_message(run), "'ACEScg'"));
    test_run_destroy(run);
}

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

/* A configuration that cannot be used is one finding, with its file. */
static void
test_bad_configurations(void **state)
{
    static const char *const paths[] = {
        "no/such.ocio",
        HOSTILE "ocio_tabs.ocio",
        HOSTILE "ocio_truncated.ocio",
        HOSTILE "ocio_unknown_transform.ocio",
        HOSTILE "ocioz_missing_luts.ocioz",
        HOSTILE "too_new_cg-config_ocio-v2.5.ocio",
    };
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA);
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; ++i)
    {
        otx_run *run = test_run_create();
        osdtex_diagnostic d;
        otx_colour colour;

        assert_int_equal(
            otx_colour_open(run, paths[i], CG, &colour), OSDTEX_ERROR_COLOUR);
        assert_null(colour.config);
        assert_int_equal(otx_diagnostics_count(run->diagnostics), 1);
        otx_diagnostics_get(run->diagnostics, 0, &d);
        assert_string_equal(d.file, paths[i]);
        assert_int_equal(d.status, OSDTEX_ERROR_COLOUR);
        test_run_destroy(run);
    }
}

/* The missing table is only missed by those who need it. */
static void
test_missing_table(void **state)
{
    const otx_colour_source source = {.path = "x.exr", .is_float = true};
    otx_run *run = test_run_create();
    float pixel[3] = {0.5F, 0.5F, 0.5F};
    otx_image image = {1, 1, 3, pixel};
    const char *space = NULL;
    otx_colour colour;
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
    {
        test_run_destroy(run);
        test_skip("no " SHARED_DATA);
    }
    assert_int_equal(
        otx_colour_open(run, HOSTILE "ocio_missing_lut.ocio", NULL, &colour),
        OSDTEX_OK);
    assert_int_equal(warning_count(run), 1);
    assert_int_equal(
        otx_colour_resolve(run, &colour, &source, &space, NULL), OSDTEX_OK);
    assert_string_equal(space, "lin");
    assert_int_equal(
        otx_colour_convert(run, &colour, "lin", "raw", &image), OSDTEX_OK);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_unknown_tags_are_passed_over),
        cmocka_unit_test(test_odd_chromaticities_are_a_matrix),
        cmocka_unit_test(test_unknown_name_lists_near_ones),
        cmocka_unit_test(test_primaries_are_measured),
        cmocka_unit_test(test_configurations),
        cmocka_unit_test(test_names_in_paths_are_words),
        cmocka_unit_test(test_match_space_is_checked),
        cmocka_unit_test(test_bad_configurations),
        cmocka_unit_test(test_missing_table),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_ocio.c -- OpenColorIO answers, and its failures are sentences. */
#include "bridge/ocio.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

static otx_ocio *
builtin(void)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio = NULL;

    assert_int_equal(otx_ocio_open_builtin(&ocio, message), OSDTEX_OK);
    assert_string_equal(message, "");
    return ocio;
}

static void
convert(
    const otx_ocio *ocio, const char *from, const char *to, float *pixels,
    int64_t count, int32_t channels)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio_conversion *c = NULL;

    assert_int_equal(otx_ocio_convert(ocio, from, to, &c, message), OSDTEX_OK);
    assert_int_equal(
        otx_ocio_conversion_apply(c, pixels, count, channels, message),
        OSDTEX_OK);
    otx_ocio_conversion_destroy(c);
}

static void
test_builtin_is_valid(void **state)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio = builtin();
    (void)state;

    assert_int_equal(otx_ocio_validate(ocio, message), OSDTEX_OK);
    assert_int_equal(otx_ocio_space_count(ocio), 5);
    otx_ocio_close(ocio);
}

static void
test_names_aliases_and_roles(void **state)
{
    static const char *const table[][2] = {
        {"ACEScg", "ACEScg"},
        {"acescg", "ACEScg"},
        {"lin_ap1_scene", "ACEScg"},
        {"scene_linear", "Linear Rec.709 (sRGB)"},
        {"ACES - ACES2065-1", "ACES2065-1"},
        {"aces_interchange", "ACES2065-1"},
        {"lin_rec709_scene", "Linear Rec.709 (sRGB)"},
        {"lin_srgb", "Linear Rec.709 (sRGB)"},
        {"srgb_tx", "sRGB - Texture"},
        {"sRGB Encoded Rec.709 (sRGB)", "sRGB - Texture"},
        {"texture_paint", "sRGB - Texture"},
        {"color_picking", "sRGB - Texture"},
        {"data", "Raw"},
        {"default", "Raw"},
    };
    otx_ocio *ocio = builtin();
    (void)state;

    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
        assert_string_equal(otx_ocio_find(ocio, table[i][0]), table[i][1]);
    assert_null(otx_ocio_find(ocio, "no such space"));
    assert_null(otx_ocio_find(ocio, ""));
    assert_null(otx_ocio_find(ocio, NULL));
    assert_null(otx_ocio_role(ocio, "ACEScg"));
    assert_string_equal(
        otx_ocio_role(ocio, "scene_linear"), "Linear Rec.709 (sRGB)");
    assert_true(otx_ocio_is_data(ocio, "Raw"));
    assert_false(otx_ocio_is_data(ocio, "ACEScg"));
    assert_false(otx_ocio_is_data(ocio, "no such space"));
    assert_string_equal(otx_ocio_encoding(ocio, "srgb_tx"), "sdr-video");
    assert_string_equal(otx_ocio_encoding(ocio, "no such space"), "");
    otx_ocio_close(ocio);
    otx_ocio_close(NULL);
}

static void
test_names_are_listed_once(void **state)
{
    otx_ocio *ocio = builtin();
    int32_t count = 0;
    (void)state;

    for (; otx_ocio_name(ocio, count); ++count)
        assert_non_null(otx_ocio_find(ocio, otx_ocio_name(ocio, count)));
    assert_true(count > 5 + 9);
    assert_null(otx_ocio_name(ocio, -1));
    assert_string_equal(otx_ocio_space_name(ocio, 99), "");
    otx_ocio_close(ocio);
}

/* Published values of linear Rec.709 red in ACEScg. */
static void
test_known_values(void **state)
{
    float red[3] = {1.0F, 0.0F, 0.0F};
    float grey[3] = {0.5F, 0.5F, 0.5F};
    otx_ocio *ocio = builtin();
    (void)state;

    convert(ocio, "lin_rec709", "ACEScg", red, 1, 3);
    assert_true(fabsf(red[0] - 0.6130974F) < 1e-6F);
    assert_true(fabsf(red[1] - 0.0701937F) < 1e-6F);
    assert_true(fabsf(red[2] - 0.0206156F) < 1e-6F);
    convert(ocio, "sRGB - Texture", "ACEScg", grey, 1, 3);
    for (int k = 0; k < 3; ++k)
        assert_true(fabsf(grey[k] - 0.21404114F) < 1e-6F);
    otx_ocio_close(ocio);
}

/* To rounding of the largest channel, since the matrices mix them. */
static void
test_round_trip(void **state)
{
    static const float values[] = {
        -0.1F, 0.0F, 1e-4F, 0.04F, 0.18F, 0.5F, 1.0F, 2.0F, 8.0F};
    const int count = sizeof values / sizeof values[0];
    otx_ocio *ocio = builtin();
    (void)state;

    for (int i = 0; i < count * count * count; ++i)
    {
        const float in[4] = {
            values[i % count], values[i / count % count],
            values[i / count / count], 0.25F};
        float out[4];

        memcpy(out, in, sizeof in);
        const float largest =
            fmaxf(fmaxf(fabsf(in[0]), fabsf(in[1])), fmaxf(fabsf(in[2]), 1.0F));

        convert(ocio, "ACEScg", "sRGB - Texture", out, 1, 4);
        convert(ocio, "sRGB - Texture", "ACEScg", out, 1, 4);
        for (int k = 0; k < 3; ++k)
            assert_true(fabsf(out[k] - in[k]) <= 2e-6F * largest);
        assert_true(out[3] == 0.25F);
    }
    otx_ocio_close(ocio);
}

static void
test_data_is_not_converted(void **state)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio = builtin();
    otx_ocio_conversion *c = NULL;
    (void)state;

    assert_int_equal(
        otx_ocio_convert(ocio, "Raw", "ACEScg", &c, message), OSDTEX_OK);
    assert_true(otx_ocio_conversion_is_identity(c));
    otx_ocio_conversion_destroy(c);
    assert_int_equal(
        otx_ocio_convert(ocio, "Raw", "nowhere", &c, message),
        OSDTEX_ERROR_COLOUR);
    assert_non_null(strstr(message, "nowhere"));
    assert_null(c);
    otx_ocio_close(ocio);
}

static void
test_file_rules(void **state)
{
    const char *rule = NULL;
    otx_ocio *ocio = builtin();
    (void)state;

    assert_null(otx_ocio_file_rule(ocio, "/drawings/brick.png", &rule));
    assert_null(rule);
    assert_string_equal(
        otx_ocio_file_rule(ocio, "/a/brick_nrm.1001.png", &rule), "Raw");
    assert_string_equal(rule, "Data");
    otx_ocio_close(ocio);
}

static void
expect_refused(const char *path, const char *word)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio = NULL;

    assert_int_equal(otx_ocio_open(path, &ocio, message), OSDTEX_ERROR_COLOUR);
    assert_null(ocio);
    assert_true(strlen(message) > 10);
    assert_null(strchr(message, '\n'));
    if (!strstr(message, word))
        fail_msg("%s: '%s' lacks '%s'", path, message, word);
}

#define HOSTILE SHARED_DATA "/hostile/"

static void
test_hostile_are_refused(void **state)
{
    (void)state;
    expect_refused("no/such/file.ocio", "does not exist");
    expect_refused(".", "not a file");
    expect_refused("README.nothing", "does not exist");
    expect_refused("CMakeLists.txt", "no configuration");
    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA);
    expect_refused(HOSTILE "ocio_tabs.ocio", "line 40");
    expect_refused(HOSTILE "ocio_truncated.ocio", "color_picking");
    expect_refused(HOSTILE "ocio_unknown_transform.ocio", "NoSuchTransform");
    expect_refused(HOSTILE "ocioz_missing_luts.ocioz", "");
    expect_refused(HOSTILE "too_new_cg-config_ocio-v2.5.ocio", "2.5");
}

/* They open; what needs the missing part fails. */
static void
test_hostile_fail_in_use(void **state)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio = NULL;
    otx_ocio_conversion *c = NULL;
    (void)state;

    if (access(SHARED_DATA, R_OK) != 0)
        test_skip("no " SHARED_DATA);
    assert_int_equal(
        otx_ocio_open(HOSTILE "ocio_missing_lut.ocio", &ocio, message),
        OSDTEX_OK);
    assert_int_equal(otx_ocio_validate(ocio, message), OSDTEX_ERROR_COLOUR);
    assert_non_null(strstr(message, "not found"));
    assert_int_equal(
        otx_ocio_convert(ocio, "lin", "lin", &c, message), OSDTEX_OK);
    otx_ocio_conversion_destroy(c);
    otx_ocio_close(ocio);
    assert_int_equal(
        otx_ocio_open(HOSTILE "ocio_no_roles.ocio", &ocio, message), OSDTEX_OK);
    assert_null(otx_ocio_role(ocio, "scene_linear"));
    otx_ocio_close(ocio);
}

/* Any prefix of a good file is refused or usable, never a crash. */
static void
test_prefixes(void **state)
{
    static char text[65536];
    char message[OTX_OCIO_MESSAGE_BYTES];
    char path[] = "/tmp/osdtex-ocio-XXXXXX";
    FILE *in = fopen(
        SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio", "rb");
    (void)state;

    if (!in)
        test_skip("no " SHARED_DATA);

    const size_t bytes = fread(text, 1, sizeof text, in);
    const int handle = mkstemp(path);

    fclose(in);
    assert_true(handle >= 0);
    for (size_t n = 0; n < bytes; n += bytes / 60 + 1)
    {
        otx_ocio *ocio = NULL;

        assert_int_equal(ftruncate(handle, 0), 0);
        assert_int_equal(pwrite(handle, text, n, 0), (ssize_t)n);

        const otx_status status = otx_ocio_open(path, &ocio, message);

        assert_int_equal(status == OSDTEX_OK, ocio != NULL);
        assert_int_equal(status == OSDTEX_OK, message[0] == '\0');
        otx_ocio_close(ocio);
    }
    close(handle);
    unlink(path);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_builtin_is_valid),
        cmocka_unit_test(test_names_aliases_and_roles),
        cmocka_unit_test(test_names_are_listed_once),
        cmocka_unit_test(test_known_values),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_data_is_not_converted),
        cmocka_unit_test(test_file_rules),
        cmocka_unit_test(test_hostile_are_refused),
        cmocka_unit_test(test_hostile_fail_in_use),
        cmocka_unit_test(test_prefixes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

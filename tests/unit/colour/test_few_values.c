/* test_few_values.c -- rows of few values and of many, against the conversion.
 */
#include "colour_support.h"

#include "colour/few_values.h"

#include <string.h>

enum
{
    COUNT = 600
};

/* What both ways give, to the bit. */
static void
assert_same(
    const otx_ocio_conversion *conversion, const float *pixels,
    int32_t channels)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    float a[COUNT * 4], b[COUNT * 4];
    const size_t bytes = (size_t)COUNT * (size_t)channels * sizeof *a;

    memcpy(a, pixels, bytes);
    memcpy(b, pixels, bytes);
    assert_int_equal(
        otx_ocio_conversion_apply(conversion, a, COUNT, channels, message),
        OSDTEX_OK);
    assert_int_equal(
        otx_few_values_apply(conversion, b, COUNT, channels, message),
        OSDTEX_OK);
    assert_memory_equal(a, b, bytes);
}

static void
test_same_bits(void **state)
{
    otx_run *run = test_run_create();
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio_conversion *conversion;
    float few[COUNT * 4], many[COUNT * 4];
    otx_colour colour;

    (void)state;
    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_ocio_convert(
            colour.config, "sRGB - Texture", "Linear Rec.709 (sRGB)",
            &conversion, message),
        OSDTEX_OK);
    for (int i = 0; i < COUNT * 4; ++i)
    {
        few[i] = (float)(i * 2654435769u >> 24) / 255.0f;
        many[i] = (float)i * 1.7e-3f - 0.2f;
    }
    assert_true(otx_ocio_conversion_is_apart(conversion));
    assert_same(conversion, few, 3);
    assert_same(conversion, few, 4);
    few[7] = -0.0f;
    few[8] = 0.0f;
    assert_same(conversion, few, 3);
    few[9] = INFINITY;
    assert_same(conversion, few, 4);
    assert_same(conversion, many, 3);
    assert_same(conversion, many, 4);
    otx_ocio_conversion_destroy(conversion);
    test_run_destroy(run);
}

/* Other primaries mix the channels. */
static void
test_crosstalk_is_known(void **state)
{
    otx_run *run = test_run_create();
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio_conversion *conversion;
    otx_colour colour;

    (void)state;
    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    assert_int_equal(
        otx_ocio_convert(
            colour.config, "sRGB - Texture", "ACEScg", &conversion, message),
        OSDTEX_OK);
    assert_false(otx_ocio_conversion_is_apart(conversion));
    otx_ocio_conversion_destroy(conversion);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_crosstalk_is_known),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

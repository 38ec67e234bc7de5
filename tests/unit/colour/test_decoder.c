/* test_decoder.c -- numbers of a file in no space of the configuration. */
#include "colour_support.h"

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

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_odd_chromaticities_are_a_matrix),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

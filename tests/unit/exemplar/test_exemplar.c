/* test_exemplar.c -- the pictures that an exemplar holds, and their figures. */
#include "exemplar/exemplar.h"

#include "base/random.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>

static otx_image
noise(otx_run *run, int32_t width, int32_t height, int32_t channels)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, channels, &image),
        OSDTEX_OK);
    for (int64_t i = 0; i < (int64_t)width * height * channels; ++i)
        image.pixels[i] = (float)otx_random_unit(3, 5, (uint64_t)i);
    return image;
}

static otx_image
fill(otx_run *run, int32_t side, int32_t channels, const float *texel)
{
    otx_image image = noise(run, side, side, channels);

    for (int64_t i = 0; i < (int64_t)side * side; ++i)
        memcpy(
            image.pixels + i * channels, texel,
            (size_t)channels * sizeof(float));
    return image;
}

static otx_exemplar
build(otx_run *run, const otx_exemplar_input *input)
{
    otx_colour colour;
    otx_exemplar out;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    if (otx_exemplar_build(run, &colour, input, &out) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return out;
}

static otx_status
build_fails(otx_run *run, const otx_exemplar_input *input)
{
    otx_colour colour;
    otx_exemplar out;
    otx_status status;

    assert_int_equal(otx_colour_open(run, NULL, NULL, &colour), OSDTEX_OK);
    status = otx_exemplar_build(run, &colour, input, &out);
    assert_null(out.linear.pixels);
    return status;
}

static void
test_png_like(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar_input input = {
        .pixels = noise(run, 40, 24, 3),
        .source = {.path = "a.png"},
        .hash = "cafe"};
    const otx_exemplar e = build(run, &input);
    (void)state;

    assert_string_equal(e.source_path, "a.png");
    assert_string_equal(e.source_hash, "cafe");
    assert_string_equal(e.source_space, "sRGB - Texture");
    assert_string_equal(e.linear_space, "Linear Rec.709 (sRGB)");
    assert_string_equal(e.match_space, "sRGB - Texture");
    assert_string_equal(e.interop_id, "lin_rec709_scene");
    assert_true(e.has_chromaticities);
    assert_true(e.chromaticities[0] == 0.64F);
    assert_int_equal(e.match.width, 40);
    assert_int_equal(e.match.height, 24);
    assert_int_equal(e.match.channels, 3);
    for (int64_t i = 0; i < 40 * 24; ++i)
    {
        const float *rgb = input.pixels.pixels + 3 * i;
        float point[3];

        /* Matching happens on the picture as the artist sees it. */
        otx_embedding_map(OTX_EMBEDDING_HSV_CONE, rgb, point);
        for (int k = 0; k < 3; ++k)
            assert_true(fabsf(point[k] - e.match.pixels[3 * i + k]) < 1e-5F);
        otx_embedding_map(OTX_EMBEDDING_LAB, rgb, point);
        for (int k = 0; k < 3; ++k)
            assert_true(fabsf(point[k] - e.lab.pixels[3 * i + k]) < 5e-3F);
    }
    test_run_destroy(run);
}

/* What is compared does not depend on the space that is written, byte by byte:
 * not with highlights above 1 nor with alpha either. */
static void
test_output_space_is_no_matter_of_matching(void **state)
{
    static const char *const spaces[] = {
        "ACEScg", "ACES2065-1", "sRGB - Texture", "Raw", "lin_rec709"};
    (void)state;

    for (int32_t channels = 3; channels <= 4; ++channels)
    {
        otx_run *run = test_run_create();
        otx_exemplar_input input = {.pixels = noise(run, 20, 16, channels)};

        input.pixels.pixels[channels] = 7.5F;
        const otx_exemplar usual = build(run, &input);

        for (size_t i = 0; i < sizeof spaces / sizeof spaces[0]; ++i)
        {
            input.to = spaces[i];
            const otx_exemplar e = build(run, &input);
            const size_t bytes = sizeof(float) * 20 * 16 * 3;

            assert_memory_equal(e.match.pixels, usual.match.pixels, bytes);
            assert_memory_equal(e.lab.pixels, usual.lab.pixels, bytes);
            assert_true(e.wrap_x == usual.wrap_x && e.wrap_y == usual.wrap_y);
        }
        test_run_destroy(run);
    }
}

/* The figures against their definitions, by brute force over pairs. */
static void
test_statistics(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar_input input = {
        .pixels = noise(run, 12, 9, 3), .embedding = OTX_EMBEDDING_RGB};
    const otx_exemplar e = build(run, &input);
    const float *p = e.match.pixels;
    double pairs = 0.0;
    double steps = 0.0;
    int step_count = 0;
    (void)state;

    for (int a = 0; a < 108; ++a)
        for (int b = 0; b < 108; ++b)
        {
            const int dx = abs(a % 12 - b % 12);
            const int dy = abs(a / 12 - b / 12);
            double sq = 0.0;

            for (int k = 0; k < 3; ++k)
                sq += pow((double)p[3 * a + k] - (double)p[3 * b + k], 2);
            pairs += sq;
            if (dx + dy == 1)
            {
                steps += sq;
                ++step_count;
            }
        }
    assert_true(fabs(e.match_sigma - sqrt(pairs / (108.0 * 108.0))) < 1e-9);
    assert_true(fabs(e.match_step - sqrt(steps / step_count)) < 1e-9);
    test_run_destroy(run);
}

static void
test_constant(void **state)
{
    static const float texel[3] = {0.3F, 0.5F, 0.1F};
    (void)state;

    for (int k = 0; k < OTX_EMBEDDING_COUNT; ++k)
    {
        otx_run *run = test_run_create();
        otx_exemplar_input input = {
            .pixels = fill(run, 16, 3, texel), .embedding = (otx_embedding)k};
        const otx_exemplar e = build(run, &input);

        assert_true(e.match_sigma == 0.0 && e.match_step == 0.0);
        assert_true(e.lab_sigma == 0.0 && e.lab_step == 0.0);
        assert_true(e.wrap_x && e.wrap_y);
        for (int i = 0; i < 3 * 16 * 16; ++i)
            assert_true(isfinite(e.match.pixels[i] + e.lab.pixels[i]));
        test_run_destroy(run);
    }
}

/* Straight alpha is multiplied in after the conversion; premultiplied colour
 * comes out the same; without a conversion it is not touched at all. */
static void
test_alpha(void **state)
{
    static const float straight[4] = {0.8F, 0.4F, 0.2F, 0.5F};
    static const float opaque[3] = {0.8F, 0.4F, 0.2F};
    static const float premultiplied[4] = {0.4F, 0.2F, 0.1F, 0.5F};
    static const float glow[4] = {0.7F, 0.3F, 0.1F, 0.0F};
    otx_run *run = test_run_create();
    otx_exemplar_input input = {.pixels = fill(run, 8, 3, opaque)};
    const otx_exemplar plain = build(run, &input);
    otx_exemplar e;
    (void)state;

    input.pixels = fill(run, 8, 4, straight);
    e = build(run, &input);
    assert_int_equal(e.linear.channels, 4);
    for (int k = 0; k < 3; ++k)
        assert_true(
            fabsf(e.linear.pixels[k] - 0.5F * plain.linear.pixels[k]) < 1e-6F);
    assert_true(e.linear.pixels[3] == 0.5F);

    input.pixels = fill(run, 8, 4, premultiplied);
    input.alpha_is_premultiplied = true;
    e = build(run, &input);
    for (int k = 0; k < 3; ++k)
        assert_true(
            fabsf(e.linear.pixels[k] - 0.5F * plain.linear.pixels[k]) < 1e-6F);

    input.pixels = fill(run, 8, 4, glow);
    input.source.from = input.to = "ACEScg";
    e = build(run, &input);
    assert_memory_equal(e.linear.pixels, glow, sizeof glow);
    test_run_destroy(run);
}

static void
test_grey(void **state)
{
    static const float grey[2] = {0.5F, 0.25F};
    otx_run *run = test_run_create();
    otx_exemplar_input input = {.pixels = fill(run, 8, 1, grey)};
    otx_exemplar e = build(run, &input);
    (void)state;

    assert_int_equal(e.linear.channels, 3);
    for (int k = 0; k < 3; ++k)
        assert_true(fabsf(e.linear.pixels[k] - 0.2140411F) < 1e-6F);
    input.pixels = fill(run, 8, 2, grey);
    e = build(run, &input);
    assert_int_equal(e.linear.channels, 4);
    assert_true(fabsf(e.linear.pixels[0] - 0.25F * 0.2140411F) < 1e-6F);
    assert_true(e.linear.pixels[3] == 0.25F);
    test_run_destroy(run);
}

/* A highlight of 50 keeps its value, and does not rule the matching. */
static void
test_hdr(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar_input input = {
        .pixels = noise(run, 32, 32, 3), .source = {.is_float = true}};
    otx_exemplar e;
    (void)state;

    input.pixels.pixels[0] = 50.0F;
    input.pixels.pixels[4] = -0.25F;
    e = build(run, &input);
    assert_memory_equal(
        e.linear.pixels, input.pixels.pixels, 3 * 32 * 32 * sizeof(float));
    for (int i = 0; i < 3 * 32 * 32; ++i)
        assert_true(fabsf(e.match.pixels[i]) <= 1.0F);
    assert_true(e.match_sigma < 1.0);
    test_run_destroy(run);
}

static void
test_data(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar_input input = {
        .pixels = noise(run, 16, 16, 3),
        .source = {.path = "bump_height.exr", .is_float = true},
        .embedding = OTX_EMBEDDING_RGB};
    otx_exemplar e;
    (void)state;

    input.pixels.pixels[0] = -3.0F;
    input.pixels.pixels[1] = 5.0F;
    e = build(run, &input);
    assert_string_equal(e.linear_space, "Raw");
    assert_string_equal(e.interop_id, "data");
    assert_false(e.has_chromaticities);
    assert_memory_equal(
        e.linear.pixels, input.pixels.pixels, 3 * 256 * sizeof(float));
    assert_true(e.match.pixels[0] == 0.0F && e.match.pixels[1] == 1.0F);
    test_run_destroy(run);
}

static void
test_wrap_is_asked_for(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar_input input = {.pixels = noise(run, 16, 16, 3)};
    otx_exemplar e;
    (void)state;

    input.wrap = OTX_EXEMPLAR_WRAP_NO;
    e = build(run, &input);
    assert_false(e.wrap_x || e.wrap_y);
    input.wrap = OTX_EXEMPLAR_WRAP_YES;
    e = build(run, &input);
    assert_true(e.wrap_x && e.wrap_y);
    test_run_destroy(run);
}

static void
test_refused(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar_input input = {.pixels = noise(run, 7, 64, 3)};
    (void)state;

    assert_int_equal(build_fails(run, &input), OSDTEX_ERROR_LIMIT);
    assert_non_null(strstr(test_last_message(run), "8 x 8"));
    input.pixels = noise(run, 16, 16, 5);
    assert_int_equal(build_fails(run, &input), OSDTEX_ERROR_ARGUMENT);
    input.pixels = noise(run, 16, 12, 3);
    *otx_image_at(&input.pixels, 5, 4) = NAN;
    assert_int_equal(build_fails(run, &input), OSDTEX_ERROR_NUMERIC);
    assert_non_null(
        strstr(test_last_message(run), "column 5 of row 7 from the top"));
    input.pixels = noise(run, 16, 16, 3);
    input.to = "nowhere";
    assert_int_equal(build_fails(run, &input), OSDTEX_ERROR_COLOUR);
    test_run_destroy(run);
}

/* Same bytes from 1, 2 and 8 threads. */
static void
test_threads(void **state)
{
    static const int32_t counts[] = {1, 2, 8};
    static float linear[3 * 64 * 48];
    static float match[3 * 64 * 48];
    double figures[4] = {0.0, 0.0, 0.0, 0.0};
    (void)state;

    for (int i = 0; i < 3; ++i)
    {
        otx_run *run = test_run_create_with(NULL, counts[i]);
        otx_exemplar_input input = {.pixels = noise(run, 64, 48, 3)};
        const otx_exemplar e = build(run, &input);
        const double now[4] = {
            e.match_sigma, e.match_step, e.lab_sigma, e.lab_step};

        if (i > 0)
        {
            assert_memory_equal(linear, e.linear.pixels, sizeof linear);
            assert_memory_equal(match, e.match.pixels, sizeof match);
            assert_memory_equal(figures, now, sizeof now);
        }
        memcpy(linear, e.linear.pixels, sizeof linear);
        memcpy(match, e.match.pixels, sizeof match);
        memcpy(figures, now, sizeof now);
        test_run_destroy(run);
    }
}

/* Memory that runs out at the k-th block ends in MEMORY, for every k. */
static void
test_memory(void **state)
{
    bool done = false;
    (void)state;

    for (int k = 0; k < 200 && !done; ++k)
    {
        test_ration r = {1 << 30};
        const otx_allocator_hooks hooks = test_ration_hooks(&r);
        otx_run *run = test_run_create_with(&hooks, 2);
        otx_exemplar_input input = {.pixels = noise(run, 200, 180, 3)};
        otx_colour colour;
        otx_exemplar e;
        otx_status status;

        r.left = k;
        status = otx_colour_open(run, NULL, NULL, &colour);
        if (status == OSDTEX_OK)
            status = otx_exemplar_build(run, &colour, &input, &e);
        r.left = 1 << 30;
        done = status == OSDTEX_OK;
        assert_true(done || status == OSDTEX_ERROR_MEMORY);
        test_run_destroy(run);
    }
    assert_true(done);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_png_like),
        cmocka_unit_test(test_output_space_is_no_matter_of_matching),
        cmocka_unit_test(test_statistics),
        cmocka_unit_test(test_constant),
        cmocka_unit_test(test_alpha),
        cmocka_unit_test(test_grey),
        cmocka_unit_test(test_hdr),
        cmocka_unit_test(test_data),
        cmocka_unit_test(test_wrap_is_asked_for),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_memory),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

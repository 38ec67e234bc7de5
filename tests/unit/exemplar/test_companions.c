/* test_companions.c -- maps lie on the texels of the picture, whatever is done
 * to it. */
#include "exemplar/companions.h"

#include "base/random.h"
#include "support.h"

#include <math.h>

enum
{
    SIDE = 16
};

/* Every texel's number as its height, and noise as normals. */
static otx_companion_input
numbers(otx_run *run, int32_t side)
{
    otx_companion_input in = {
        .kind = OTX_COMPANION_HEIGHT, .is_float = true, .bits = 32};

    assert_int_equal(
        otx_image_create(run, run->arena, side, side, 3, &in.pixels),
        OSDTEX_OK);
    for (int32_t i = 0; i < 3 * side * side; ++i)
        in.pixels.pixels[i] = (float)(i / 3);
    return in;
}

static otx_companion_input
normals(otx_run *run, int32_t side, const float texel[3])
{
    otx_companion_input in = numbers(run, side);

    in.kind = OTX_COMPANION_NORMAL;
    in.is_float = false;
    in.bits = 8;
    for (int32_t i = 0; i < 3 * side * side; ++i)
        in.pixels.pixels[i] = texel[i % 3];
    return in;
}

static void
test_cuts(void **state)
{
    otx_run *run = test_run_create();
    const otx_companion_input in = numbers(run, 2 * SIDE);
    int32_t texels[SIDE * SIDE];
    otx_companions set, cut, moved;

    (void)state;
    assert_int_equal(
        otx_companions_build(run, &in, 1, SIDE, SIDE, true, true, &set),
        OSDTEX_OK);
    assert_int_equal(set.image.width, 2 * SIDE);
    assert_int_equal(
        otx_companions_crop(
            run, &set, SIDE, (const int32_t[]){3, 5, 4, 6}, &cut),
        OSDTEX_OK);
    assert_int_equal(cut.image.height, 12);
    for (int32_t y = 0; y < 12; ++y)
        for (int32_t x = 0; x < 8; ++x)
            assert_true(
                *otx_image_at(&cut.image, x, y) ==
                (float)((y + 10) * 2 * SIDE + x + 6));
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        texels[i] = (int32_t)(otx_random_unit(1, 2, (uint64_t)i) * SIDE * SIDE);
    assert_int_equal(
        otx_companions_rearrange(run, &set, SIDE, SIDE, texels, &moved),
        OSDTEX_OK);
    for (int32_t y = 0; y < 2 * SIDE; ++y)
        for (int32_t x = 0; x < 2 * SIDE; ++x)
        {
            const int32_t t = texels[y / 2 * SIDE + x / 2];
            const int32_t from_x = t % SIDE * 2 + x % 2;
            const int32_t from_y = t / SIDE * 2 + y % 2;

            assert_true(
                *otx_image_at(&moved.image, x, y) ==
                (float)(from_y * 2 * SIDE + from_x));
        }
    test_run_destroy(run);
}

static void
test_normals(void **state)
{
    otx_run *run = test_run_create();
    const float flat[3] = {128.0f / 255.0f, 127.0f / 255.0f, 1.0f};
    const float tilted[3] = {0.5f, 0.9f, 0.9f};
    const float down[3] = {0.5f, 0.5f, 0.1f};
    otx_companion_input in = normals(run, SIDE, flat);
    otx_companions set;
    float *p;

    (void)state;
    assert_int_equal(
        otx_companions_build(run, &in, 1, SIDE, SIDE, false, false, &set),
        OSDTEX_OK);
    p = set.image.pixels;
    assert_true(p[0] == 0.0f && p[1] == 0.0f && p[2] == 1.0f);
    otx_companion_encode_normal(p);
    assert_true(p[0] == 0.5f && p[1] == 0.5f && p[2] == 1.0f);
    in = normals(run, SIDE, tilted);
    in.y_down = true;
    assert_int_equal(
        otx_companions_build(run, &in, 1, SIDE, SIDE, false, false, &set),
        OSDTEX_OK);
    p = set.image.pixels;
    assert_float_equal(p[1], -sqrt(0.5), 1e-6);
    assert_float_equal(p[2], sqrt(0.5), 1e-6);
    in = normals(run, SIDE, down);
    assert_int_equal(
        otx_companions_build(run, &in, 1, SIDE, SIDE, false, false, &set),
        OSDTEX_ERROR_FORMAT);
    test_run_destroy(run);
}

static void
test_sizes(void **state)
{
    otx_run *run = test_run_create();
    otx_companion_input in[2] = {numbers(run, SIDE / 2), numbers(run, SIDE)};
    otx_companions set;

    (void)state;
    in[1].kind = OTX_COMPANION_ROUGHNESS;
    assert_int_equal(
        otx_companions_build(run, in, 2, SIDE, SIDE, false, false, &set),
        OSDTEX_OK);
    assert_int_equal(set.image.width, SIDE);
    assert_int_equal(set.image.channels, 2);
    /* Between the first two texels of the small one. */
    assert_float_equal(
        otx_image_at(&set.image, 1, 0)[set.maps[OTX_COMPANION_HEIGHT].first],
        0.25f, 1e-6);
    assert_int_equal(
        otx_companions_build(
            run, in, 2, SIDE + 4, SIDE + 4, false, false, &set),
        OSDTEX_ERROR_FORMAT);
    assert_int_equal(
        otx_companions_build(run, in, 2, SIDE, 2 * SIDE, false, false, &set),
        OSDTEX_ERROR_FORMAT);
    in[1].kind = OTX_COMPANION_HEIGHT;
    assert_int_equal(
        otx_companions_build(run, in, 2, SIDE, SIDE, false, false, &set),
        OSDTEX_ERROR_FORMAT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cuts),
        cmocka_unit_test(test_normals),
        cmocka_unit_test(test_sizes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_tileable.c -- what tiles is told from what does not. */
#include "exemplar/tileable.h"

#include "base/random.h"
#include "colour/embedding.h"
#include "file/picture_read.h"
#include "support.h"

#include <math.h>
#include <unistd.h>

/* A scalar texture at texel (x, y), in Lab lightness. */
typedef double (*texture)(double x, double y);

/* Waves whose periods divide 128 in both axes. */
static double
waves(double x, double y)
{
    const double w = 2.0 * OTX_PI / 128.0;

    return 50.0 + 12.0 * sin(w * (3.0 * x + 2.0 * y)) +
           9.0 * sin(w * (7.0 * x - 5.0 * y) + 1.0) +
           6.0 * cos(w * (11.0 * y + 4.0 * x));
}

/* Bars 16 wide with hard edges, one on the border of a 128 picture. */
static double
weave(double x, double y)
{
    const int column = (int)floor(x / 16.0);
    const int line = (int)floor(y / 16.0);
    const double across = fmod(x + 1600.0, 16.0) / 16.0;

    return (column + line) % 2 == 0 ? 20.0 + 60.0 * sin(OTX_PI * across) : 35.0;
}

static double
grain(double x, double y)
{
    return 20.0 * otx_random_unit(7, 1, (uint64_t)(int64_t)(x + 4096.0 * y));
}

/* Grain that hides the step of 16 between the ends of a slope. */
static double
slope(double x, double y)
{
    return 2.0 * grain(x, y) + 16.0 * x / 128.0;
}

static double
constant(double x, double y)
{
    (void)x;
    (void)y;
    return 42.0;
}

static otx_image
make(otx_run *run, texture f, int32_t width, int32_t height)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, 3, &image), OSDTEX_OK);
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
        {
            float *texel = otx_image_at(&image, x, y);

            texel[0] = (float)f(x, y);
            texel[1] = texel[2] = 0.0F;
        }
    return image;
}

static bool
tiles(otx_run *run, const otx_image *image, int32_t axis)
{
    otx_tileable t;

    assert_int_equal(otx_tileable_test(run, image, axis, &t), OSDTEX_OK);
    assert_true(isfinite(t.border) && isfinite(t.inner));
    return t.tiles;
}

static void
test_synthetic(void **state)
{
    static const struct
    {
        texture f;
        int32_t width, height;
        bool x, y;
    } table[] = {
        {waves, 128, 128, true, true},  {waves, 100, 128, false, true},
        {waves, 128, 90, true, false},  {weave, 128, 128, true, true},
        {weave, 256, 64, true, true},   {weave, 120, 128, false, true},
        {weave, 128, 120, true, false}, {grain, 128, 128, true, true},
        {slope, 128, 128, false, true}, {constant, 128, 128, true, true},
        {constant, 8, 8, true, true},   {waves, 8, 8, false, false},
    };
    otx_run *run = test_run_create();
    (void)state;

    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
    {
        const otx_image image =
            make(run, table[i].f, table[i].width, table[i].height);

        if (tiles(run, &image, 0) != table[i].x ||
            tiles(run, &image, 1) != table[i].y)
            fail_msg("row %zu", i);
    }
    test_run_destroy(run);
}

/* Judged by eye on the picture rolled by half its size. Borders that continue
 * but carry a visible line (bark013, wood004, fabric009 in y) do not tile. */
static void
test_photographs(void **state)
{
    static const struct
    {
        const char *name;
        bool x, y;
    } table[] = {
        {"bark004_128", true, true},         {"bark013_128", false, false},
        {"brick_gray_512", false, false},    {"bricks_1024", true, true},
        {"cheese_490", true, true},          {"cobbles_666", false, true},
        {"concrete_512", true, true},        {"fabric009_128", true, false},
        {"fabric_pattern_1024", true, true}, {"gravel_gray_512", false, false},
        {"rock007_128", true, true},         {"scales_roof001_128", true, true},
        {"text_333", false, true},           {"water_300", false, false},
        {"weave_640", true, true},           {"wood004_128", false, false},
    };
    (void)state;

    if (access(SHARED_DATA "/textures", R_OK) != 0)
        test_skip("no " SHARED_DATA);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
    {
        otx_run *run = test_run_create();
        otx_picture picture;
        char path[256];

        snprintf(
            path, sizeof path, "%s/textures/%s.png", SHARED_DATA,
            table[i].name);
        assert_int_equal(otx_picture_read(run, path, &picture), OSDTEX_OK);
        for (int64_t k = 0;
             k < (int64_t)picture.image.width * picture.image.height; ++k)
        {
            float *texel = picture.image.pixels + 3 * k;
            otx_embedding_map(OTX_EMBEDDING_LAB, texel, texel);
        }
        if (tiles(run, &picture.image, 0) != table[i].x ||
            tiles(run, &picture.image, 1) != table[i].y)
            fail_msg("%s", table[i].name);
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_synthetic),
        cmocka_unit_test(test_photographs),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

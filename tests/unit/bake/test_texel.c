/* test_texel.c -- blocks of texels: where a texture is cut into blocks is not
 * to be seen, and maps come with the colour without touching it. */
#include "unit/bake/noise.h"

#include "bake/mip_level.h"
#include "bake/texel.h"

enum
{
    N = 2,
    SIDE = 256,
    MARGIN = 8
};

typedef struct trial
{
    otx_run *run;
    otx_layout layout;
    otx_bake bake;
    otx_mip mip;
} trial;

static void
begin(trial *t, const otx_exemplar *exemplar, const otx_bake_options *options)
{
    const otx_mapping *mapping = flat_mapping(t->run, t->layout.surface, N);

    assert_int_equal(
        otx_bake_create(
            t->run, mapping, exemplar, &t->layout, options, &t->bake),
        OSDTEX_OK);
    t->mip = (otx_mip){.layout = &t->layout};
    assert_int_equal(
        otx_mip_find_rims(
            t->run, t->run->arena, &t->layout, 0, &t->mip.rims,
            &t->mip.rim_count),
        OSDTEX_OK);
    assert_int_equal(otx_mip_build(t->run, t->run->arena, &t->mip), OSDTEX_OK);
}

static trial *
make_trial(otx_run *run)
{
    trial *t = OTX_ZNEW(run->arena, trial, 1);
    const otx_surface *surface = flat_surface(run, N, 2);

    t->run = run;
    t->layout = flat_layout(
        run, flat_mapping(run, surface, N), OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    return t;
}

/* The texture put together from its blocks, with those of the maps. */
static otx_image
bake_all(trial *t, otx_image *maps)
{
    static float pixels[OTX_MIP_BLOCK * OTX_MIP_BLOCK * 4];
    static float store[OTX_COMPANION_COUNT][OTX_MIP_BLOCK * OTX_MIP_BLOCK * 3];
    float *planes[OTX_COMPANION_COUNT];
    const int32_t channels = t->bake.source.channels, side = t->mip.side;
    otx_image out;

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        planes[k] = store[k];
    assert_int_equal(
        otx_image_create(t->run, t->run->arena, side, side, channels, &out),
        OSDTEX_OK);
    for (int32_t row = 0; row < t->mip.columns; ++row)
        for (int32_t column = 0; column < t->mip.columns; ++column)
        {
            const otx_arena_mark mark = otx_arena_here(t->run->scratch);
            const int32_t width = otx_mip_block_size(&t->mip, column);
            const int32_t height = otx_mip_block_size(&t->mip, row);
            const int32_t top = side - row * OTX_MIP_BLOCK;

            assert_true(otx_texel_bake(
                &t->bake.source, maps ? &t->bake.maps : NULL, &t->mip, column,
                row, t->run->scratch, pixels, planes));
            for (int32_t y = 0; y < height; ++y)
            {
                const int32_t to = top - height + y;

                memcpy(
                    otx_image_at(&out, column * OTX_MIP_BLOCK, to),
                    pixels + y * width * channels,
                    (size_t)(width * channels) * sizeof *pixels);
                if (maps)
                    memcpy(
                        otx_image_at(maps, column * OTX_MIP_BLOCK, to),
                        planes[OTX_COMPANION_ROUGHNESS] + y * width,
                        (size_t)width * sizeof *pixels);
            }
            otx_arena_release(t->run->scratch, mark);
        }
    return out;
}

/* The same texels moved by (dx, dy) in a texture of twice the side. */
static trial *
move(const trial *from, double dx, double dy)
{
    trial *t = OTX_ZNEW(from->run->arena, trial, 1);
    const otx_level *leaf = otx_surface_leaf(from->layout.surface);
    float *uvs = OTX_NEW(from->run->arena, float, 2 * leaf->corner_count);

    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        uvs[2 * c] =
            (float)(0.5 * from->layout.leaf_uvs[2 * c] + dx / (2 * SIDE));
        uvs[2 * c + 1] =
            (float)(0.5 * from->layout.leaf_uvs[2 * c + 1] + dy / (2 * SIDE));
    }
    t->run = from->run;
    t->layout = from->layout;
    t->layout.leaf_uvs = uvs;
    t->layout.side = 2 * SIDE;
    return t;
}

/* Moved by no whole number of blocks, so that other texels are at their
 * borders: nothing of it shows, on the surface or beside it. */
static void
blocks_leave_no_trace(void **state)
{
    const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    const otx_bake_options patch = {.kind = OTX_TEXEL_PATCH};
    const otx_exemplar *exemplar = flat_noise(*state, 64);
    trial *t = make_trial(*state), *u = make_trial(*state), *moved;
    otx_image here, there, on;
    int32_t compared = 0;

    begin(t, exemplar, &color);
    here = bake_all(t, NULL);
    begin(u, exemplar, &patch);
    on = bake_all(u, NULL);
    moved = move(t, 40.0, 23.0);
    begin(moved, exemplar, &color);
    there = bake_all(moved, NULL);
    for (int32_t y = 2; y < SIDE - 2; ++y)
        for (int32_t x = 2; x < SIDE - 2; ++x)
        {
            const float *a = otx_image_at(&here, x, y);
            const float *b = otx_image_at(&there, x + 40, y + 23);

            /* Within two texels of the surface. */
            if (otx_image_at(&on, x - 2, y)[2] == 0.0f &&
                otx_image_at(&on, x + 2, y)[2] == 0.0f &&
                otx_image_at(&on, x, y - 2)[2] == 0.0f &&
                otx_image_at(&on, x, y + 2)[2] == 0.0f)
                continue;
            ++compared;
            for (int c = 0; c < 3; ++c)
                assert_float_equal(a[c], b[c], 1e-5);
        }
    assert_true(compared > SIDE * SIDE / 2);
}

/* Sharpening and joining hold colours to the exemplar's range. */
static void
colours_are_of_the_exemplar(void **state)
{
    const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    const otx_exemplar *exemplar = flat_noise(*state, 64);
    trial *t = make_trial(*state);
    otx_image image;

    begin(t, exemplar, &color);
    image = bake_all(t, NULL);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c)
            assert_true(
                image.pixels[3 * i + c] >= t->bake.source.low[c] &&
                image.pixels[3 * i + c] <= t->bake.source.high[c]);
}

/* Numbers are not sharpened: each is that of some face. */
static void
numbers_are_as_they_are(void **state)
{
    const otx_bake_options patch = {.kind = OTX_TEXEL_PATCH};
    trial *t = make_trial(*state);
    otx_image image;
    int32_t faces[N * N] = {0};

    begin(t, flat_noise(*state, 64), &patch);
    image = bake_all(t, NULL);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const float *p = image.pixels + 3 * i;

        assert_true(p[0] == 0.0f && p[1] == floorf(p[1]));
        assert_in_range((int32_t)p[1], 0, N * N - 1);
        ++faces[(int32_t)p[1]];
    }
    for (int f = 0; f < N * N; ++f)
        assert_true(faces[f] > SIDE * SIDE / (2 * N * N));
}

static void
maps_come_with_the_colour(void **state)
{
    otx_run *run = *state;
    otx_bake_options options = {.kind = OTX_TEXEL_COLOR};
    otx_exemplar *exemplar = flat_noise(run, 64);
    otx_companions *set = &exemplar->companions;
    trial *t = make_trial(run), *u = make_trial(run);
    otx_image without, with, roughness;

    begin(t, exemplar, &options);
    without = bake_all(t, NULL);
    assert_int_equal(
        otx_image_create(run, run->arena, 64, 64, 1, &set->image), OSDTEX_OK);
    for (int32_t i = 0; i < 64 * 64; ++i)
        set->image.pixels[i] = exemplar->linear.pixels[3 * i];
    set->maps[OTX_COMPANION_ROUGHNESS].is_there = true;
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 1, &roughness),
        OSDTEX_OK);
    options.maps = OTX_MAP_TEXTURES_ALL;
    begin(u, exemplar, &options);
    with = bake_all(u, &roughness);
    assert_memory_equal(
        without.pixels, with.pixels, SIDE * SIDE * 3 * sizeof(float));
    /* The same picture as the colour's first channel, which alone is
     * sharpened. */
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        assert_float_equal(roughness.pixels[i], with.pixels[3 * i], 0.06);
}

/* Without memory it says so. */
static void
memory_may_be_out(void **state)
{
    const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    static float pixels[OTX_MIP_BLOCK * OTX_MIP_BLOCK * 3];
    trial *t = make_trial(*state);
    int64_t k = 0;

    begin(t, flat_noise(*state, 64), &color);
    for (bool done = false; !done; ++k)
    {
        test_ration ration = {INT64_MAX};
        const otx_allocator_hooks hooks = test_ration_hooks(&ration);
        otx_allocator *allocator = otx_allocator_create(&hooks);
        otx_arena *arena = otx_arena_create(allocator);

        ration.left = k;
        done = otx_texel_bake(
            &t->bake.source, NULL, &t->mip, 1, 1, arena, pixels, NULL);
        otx_arena_destroy(arena);
        otx_allocator_destroy(allocator);
    }
    assert_true(k > 1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(blocks_leave_no_trace),
        test_with_run(colours_are_of_the_exemplar),
        test_with_run(numbers_are_as_they_are),
        test_with_run(maps_come_with_the_colour),
        test_with_run(memory_may_be_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

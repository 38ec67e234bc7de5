/* test_map_source.c -- baked maps: normals turned with the picture, heights in
 * scene units, colours as without them. */
#include "bake/map_source.h"

#include "unit/bake/flat.h"

enum
{
    N = 2,      /* faces of the sheet a side */
    SIDE = 128, /* texels of the bake */
    TEXELS = 32 /* of the picture */
};

/* The sheet with its picture turned by an angle, and of another size. */
static otx_mapping *
turned(otx_run *run, const otx_surface *surface, double angle, double size)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_mapping *mapping = flat_mapping(run, surface, N);

    mapping->scale = 4.0 * N;
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const float *p = surface->points + 3 * leaf->face_verts[c];
        const double x = (p[0] - 0.5 * N) / (size * mapping->scale);
        const double y = (p[1] - 0.5 * N) / (size * mapping->scale);

        /* Places in the picture are turned back. */
        mapping->uvs[2 * c] = (float)(0.5 + cos(angle) * x + sin(angle) * y);
        mapping->uvs[2 * c + 1] =
            (float)(0.5 - sin(angle) * x + cos(angle) * y);
    }
    return mapping;
}

static otx_bake_options
all_maps(bool y_down)
{
    return (otx_bake_options){
        .kind = OTX_TEXEL_COLOR,
        .maps = OTX_MAP_TEXTURES_ALL,
        .normals_y_down = y_down};
}

/* Levels of the maps of a bake, as images. */
typedef struct baked
{
    flat_levels normals, heights;
} baked;

static void
take(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    baked *b = user;
    otx_bake_block one = *block;

    one.pixels = block->maps[OTX_COMPANION_NORMAL];
    one.stride = block->map_strides[OTX_COMPANION_NORMAL];
    if (one.pixels)
        flat_take(&b->normals, slot, lane, &one);
    one.pixels = block->maps[OTX_COMPANION_HEIGHT];
    one.stride = block->map_strides[OTX_COMPANION_HEIGHT];
    if (one.pixels)
        flat_take(&b->heights, slot, lane, &one);
}

static baked
bake(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_layout *layout, const otx_bake_options *options)
{
    const int32_t count = otx_pyramid_count(layout->side, layout->side);
    baked out = {{count, {{0}}}, {count, {{0}}}};
    const otx_bake_sink sink = {
        .take = take, .put = flat_put, .user = &out, .share = 1.0};
    otx_bake job;

    assert_int_equal(
        otx_bake_create(run, mapping, exemplar, layout, options, &job),
        OSDTEX_OK);
    for (int32_t l = 0; l < count; ++l)
    {
        const int32_t side = otx_pyramid_side(layout->side, l);

        assert_int_equal(
            otx_image_create(
                run, run->arena, side, side, 3, &out.normals.levels[l]),
            OSDTEX_OK);
        assert_int_equal(
            otx_image_create(
                run, run->arena, side, side, 1, &out.heights.levels[l]),
            OSDTEX_OK);
    }
    assert_int_equal(otx_bake_tile(run, &job, 0, &sink), OSDTEX_OK);
    return out;
}

/* Degrees between a texel and a vector. */
static double
angle_to(const float *texel, const double n[3])
{
    double dot = 0.0;

    for (int k = 0; k < 3; ++k)
        dot += (2.0 * (double)texel[k] - 1.0) * n[k];
    return acos(fmin(dot, 1.0)) * 180.0 / OTX_PI;
}

/* Whatever the turn and the size, at every level. */
static void
test_normals_are_turned(void **state)
{
    const float normal[3] = {0.6f, 0.0f, 0.8f};

    (void)state;
    for (int turn = 0; turn < 12; ++turn)
    {
        otx_run *run = test_run_create();
        const double angle = turn * OTX_PI / 6.0 + 0.1;
        const otx_surface *surface = flat_surface(run, N, 1);
        const otx_mapping *mapping =
            turned(run, surface, angle, 1.0 + 0.1 * turn);
        otx_exemplar *exemplar = flat_ramp(run, TEXELS);
        const otx_layout layout =
            flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
        const bool y_down = turn % 2 != 0;
        const double wanted[3] = {
            0.6 * cos(angle), (y_down ? -0.6 : 0.6) * sin(angle), 0.8};
        const otx_bake_options how = all_maps(y_down);
        baked b;

        flat_add_ramp(run, TEXELS, normal, 2.0, exemplar);
        b = bake(run, mapping, exemplar, &layout, &how);
        for (int32_t l = 0; l < b.normals.count; ++l)
        {
            const otx_image *image = &b.normals.levels[l];

            for (int32_t i = 0; i < image->width * image->height; ++i)
                if (!(angle_to(image->pixels + 3 * i, wanted) < 0.1))
                    fail_msg(
                        "turn %d level %d texel %d: %g degrees", turn, l, i,
                        angle_to(image->pixels + 3 * i, wanted));
        }
        test_run_destroy(run);
    }
}

/* The middle of the sheet has that of the map, and a step of the picture's
 * width is the range, in the size that it has. */
static void
test_heights_are_scene_units(void **state)
{
    otx_run *run = test_run_create();
    const float up[3] = {0.0f, 0.0f, 1.0f};
    const double size = 1.5;
    const otx_surface *surface = flat_surface(run, N, 1);
    const otx_mapping *mapping = turned(run, surface, 0.0, size);
    otx_exemplar *exemplar = flat_ramp(run, TEXELS);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_bake_options how = all_maps(false);
    baked b;

    (void)state;
    flat_add_ramp(run, TEXELS, up, 2.0, exemplar);
    b = bake(run, mapping, exemplar, &layout, &how);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        double u = 0.0, v = 0.0, x = 0.0;

        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            u += 0.25 * (double)layout.leaf_uvs[2 * c] * SIDE;
            v += 0.25 * (double)layout.leaf_uvs[2 * c + 1] * SIDE;
            x += 0.25 * (double)surface->points[3 * leaf->face_verts[c]];
        }
        /* Range times size times the way in widths, which are size times as
         * wide. */
        const double slope = 2.0 / (4.0 * N);
        const double texel_x = x + ((int32_t)u + 0.5 - u) * N / (N * 16.0);
        const double wanted = slope * (texel_x - 0.5 * N);

        assert_float_equal(
            *otx_image_at(&b.heights.levels[0], (int32_t)u, (int32_t)v), wanted,
            0.02);
    }
    test_run_destroy(run);
}

/* To the bit. */
static void
test_colors_stay(void **state)
{
    otx_run *run = test_run_create();
    const float normal[3] = {0.6f, 0.0f, 0.8f};
    const otx_surface *surface = flat_surface(run, N, 2);
    const otx_mapping *mapping = turned(run, surface, 0.7, 1.0);
    otx_exemplar *exemplar = flat_ramp(run, TEXELS);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const otx_bake_options without = {.kind = OTX_TEXEL_COLOR};
    const otx_bake_options with = {
        .kind = OTX_TEXEL_COLOR, .maps = OTX_MAP_TEXTURES_ALL};
    flat_levels a, b;

    (void)state;
    a = flat_bake(run, mapping, exemplar, &layout, &without, 0);
    flat_add_ramp(run, TEXELS, normal, 2.0, exemplar);
    b = flat_bake(run, mapping, exemplar, &layout, &with, 0);
    for (int32_t l = 0; l < a.count; ++l)
        assert_memory_equal(
            a.levels[l].pixels, b.levels[l].pixels,
            (size_t)a.levels[l].width * (size_t)a.levels[l].height * 3 *
                sizeof(float));
    test_run_destroy(run);
}

static void
assert_same_levels(const flat_levels *a, const flat_levels *b, size_t channels)
{
    for (int32_t l = 0; l < a->count; ++l)
        assert_memory_equal(
            a->levels[l].pixels, b->levels[l].pixels,
            (size_t)a->levels[l].width * (size_t)a->levels[l].height *
                channels * sizeof(float));
}

/* A map by itself is what it is beside the colour and the others, to the bit,
 * and there is no colour then. */
static void
test_one_map_alone(void **state)
{
    otx_run *run = test_run_create();
    const float normal[3] = {0.6f, 0.0f, 0.8f};
    const otx_surface *surface = flat_surface(run, N, 2);
    const otx_mapping *mapping = turned(run, surface, 0.7, 1.0);
    otx_exemplar *exemplar = flat_ramp(run, TEXELS);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    otx_bake_options how = all_maps(false);
    baked all, one;

    (void)state;
    flat_add_ramp(run, TEXELS, normal, 2.0, exemplar);
    all = bake(run, mapping, exemplar, &layout, &how);
    how.maps_alone = true;
    how.maps = 1u << OTX_COMPANION_NORMAL;
    one = bake(run, mapping, exemplar, &layout, &how);
    assert_same_levels(&all.normals, &one.normals, 3);
    how.maps = 1u << OTX_COMPANION_HEIGHT;
    one = bake(run, mapping, exemplar, &layout, &how);
    assert_same_levels(&all.heights, &one.heights, 1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_normals_are_turned),
        cmocka_unit_test(test_heights_are_scene_units),
        cmocka_unit_test(test_colors_stay),
        cmocka_unit_test(test_one_map_alone),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

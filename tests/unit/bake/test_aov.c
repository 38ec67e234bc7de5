/* test_aov.c -- what is baked besides colours is enough to bake by. */
#include "unit/bake/flat.h"

enum
{
    N = 3,
    SIDE = 256
};

/* Waves of several lengths around `level`, which tile. */
static otx_exemplar
waves(otx_run *run, int32_t width, int32_t height, double level)
{
    otx_exemplar exemplar = {.wrap_x = true, .wrap_y = true};

    assert_int_equal(
        otx_image_create(run, run->arena, width, height, 3, &exemplar.linear),
        OSDTEX_OK);
    exemplar.match.width = width;
    exemplar.match.height = height;
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
            for (int32_t c = 0; c < 3; ++c)
                otx_image_at(&exemplar.linear, x, y)[c] =
                    (float)(level + 0.1 * sin(6.2831853 * (2 + c) * x / width) * cos(6.2831853 * (3 + c) * y / height));
    return exemplar;
}

/* The left half shows the first exemplar, the right one the second, turned. */
static otx_mapping *
turned_mapping(otx_run *run, const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_mapping *mapping = flat_mapping(run, surface, N);
    uint8_t *from = OTX_NEW(run->arena, uint8_t, 2);

    from[0] = 0;
    from[1] = 1;
    mapping->patch_count = mapping->exemplar_count = 2;
    mapping->patch_exemplar = from;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        mapping->face_patch[f] = leaf->face_cage[f] % N > 0;
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            float *uv = mapping->uvs + 2 * c;
            const float u = uv[0], v = uv[1];

            if (!mapping->face_patch[f])
                continue;
            uv[0] = 1.6f * u - 1.2f * v;
            uv[1] = 1.2f * u + 1.6f * v;
        }
    }
    return mapping;
}

/* Looked up again by what a texel of the source says. */
static void
look_up(const otx_texture *textures, const float *source, float *color)
{
    const otx_texture *texture = &textures[(int32_t)source[0]];
    const otx_image *image = &texture->pyramid.levels[0];
    const double along = source[3];
    const double up = along * image->width / image->height;

    otx_texture_filter(
        texture, (otx_vec2){source[1], source[2]}, (otx_vec2){along, 0.0},
        (otx_vec2){0.0, up}, color);
}

/* Share of the texels whose colour the source does not give again: `color` and
 * `source` are of one level. */
static double
share_off(
    const otx_texture *textures, const otx_image *color,
    const otx_image *source)
{
    const int64_t count = (int64_t)color->width * color->height;
    int64_t off = 0;

    for (int64_t i = 0; i < count; ++i)
    {
        float again[OTX_IMAGE_MAX_CHANNELS];
        double most = 0.0;

        look_up(textures, source->pixels + 4 * i, again);
        for (int32_t c = 0; c < 3; ++c)
            most =
                fmax(most, fabs((double)again[c] - color->pixels[3 * i + c]));
        off += most > 0.01;
    }
    return (double)off / (double)count;
}

static void
the_source_bakes_the_colour_again(void **state)
{
    static const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    static const otx_bake_options source = {.kind = OTX_TEXEL_SOURCE};
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 2);
    const otx_mapping *mapping = turned_mapping(run, surface);
    const otx_exemplar exemplars[] = {
        waves(run, 128, 128, 0.25), waves(run, 128, 96, 0.75)};
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const flat_levels colors =
        flat_bake(run, mapping, exemplars, &layout, &color, 0);
    const flat_levels sources =
        flat_bake(run, mapping, exemplars, &layout, &source, 0);
    otx_texture textures[2];

    (void)state;
    for (int32_t k = 0; k < 2; ++k)
        assert_int_equal(
            otx_texture_create(
                run, run->arena, &exemplars[k].linear, true, true,
                &textures[k]),
            OSDTEX_OK);
    /* But for the two columns at the cut, which are joined to each other. */
    for (int32_t l = 0; l < 3; ++l)
        assert_true(
            share_off(textures, &colors.levels[l], &sources.levels[l]) <=
            2.0 / SIDE);
    test_run_destroy(run);
}

/* A texel's footprint: its side on the sheet, in widths of the exemplar. */
static void
footprints_are_those_of_texels(void **state)
{
    static const otx_bake_options source = {.kind = OTX_TEXEL_SOURCE};
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 1);
    const otx_mapping *mapping = flat_mapping(run, surface, N);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const double texels =
        ((double)layout.uvs[4] - (double)layout.uvs[0]) * SIDE;
    const flat_levels baked =
        flat_bake(run, mapping, flat_ramp(run, 64), &layout, &source, 0);

    (void)state;
    for (int32_t l = 0; l < 4; ++l)
        for (int32_t i = 0; i < SIDE >> l; ++i)
            assert_float_equal(
                otx_image_at(&baked.levels[l], i, i)[3],
                0.5 / N / texels * (1 << l), 1e-5);
    test_run_destroy(run);
}

/* The coordinate of a stack is linear between vertices, as UVs are. */
static void
slices_lie_as_vertices_say(void **state)
{
    static const otx_bake_options slice = {.kind = OTX_TEXEL_SLICE};
    static const otx_bake_options uv = {.kind = OTX_TEXEL_UV};
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 1);
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    otx_mapping *mapping = flat_mapping(run, surface, N);
    const otx_exemplar exemplar = waves(run, 64, 64, 0.5);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    float *along = OTX_NEW(run->arena, float, count);
    flat_levels slices, uvs;
    int64_t seen = 0;

    (void)state;
    for (int32_t v = 0; v < count; ++v)
        along[v] = surface->points[3 * v] / N;
    mapping->along = along;
    slices = flat_bake(run, mapping, &exemplar, &layout, &slice, 0);
    uvs = flat_bake(run, mapping, &exemplar, &layout, &uv, 0);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const float *at = slices.levels[0].pixels + 3 * i;
        const float *u = uvs.levels[0].pixels + 3 * i;

        assert_true(at[2] == u[2]);
        if (at[2] < 1.0f)
            continue;
        ++seen;
        assert_true(fabs((double)at[0] - 2.0 * ((double)u[0] - 0.25)) < 1e-5);
    }
    assert_true(seen > SIDE);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_source_bakes_the_colour_again),
        cmocka_unit_test(footprints_are_those_of_texels),
        cmocka_unit_test(slices_lie_as_vertices_say),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_show_decals.c -- pictures over what a mapping shows: their alpha, their
 * sides, their filters, and where they end. */
#include "grid.h"

#include "mapping/show_decals.h"

enum
{
    SIDE = 8
};

/* Two quads side by side over black, and a picture of one colour of which the
 * first quad is the left half. */
typedef struct stage
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar below, picture;
    otx_texture texture, decal;
    otx_mapping mapping;
    otx_decals decals;
    int64_t first[3];
    otx_lookup items[8];
    otx_fragment fragment;
    otx_show_view show;
    int32_t corners[3];
    double at[3];
    otx_show_place place;
} stage;

static void
paint(otx_run *run, otx_exemplar *out, const float color[4], int32_t channels)
{
    const otx_exemplar *made =
        test_exemplar_create(run->arena, SIDE, SIDE, false, 1);

    *out = *made;
    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, channels, &out->linear),
        OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int32_t c = 0; c < channels; ++c)
            out->linear.pixels[channels * i + c] = color[c];
}

static void
make_texture(otx_run *run, const otx_exemplar *from, otx_texture *out)
{
    assert_int_equal(
        otx_texture_create(run, run->arena, &from->linear, false, false, out),
        OSDTEX_OK);
}

/* u goes from 0 to 2 along the two quads, v from 0 to 1. */
static void
lay(stage *s, float opacity)
{
    static const float u[2][4] = {{0, 1, 1, 0}, {1, 2, 2, 1}};
    static const float v[4] = {0, 0, 1, 1};

    for (int f = 0; f < 2; ++f)
        for (int k = 0; k < 4; ++k)
            s->items[4 * f + k] =
                (otx_lookup){{0.5f * u[f][k], v[k]}, opacity, 0};
}

static stage *
set(otx_run *run, const float color[4], int32_t channels, float opacity)
{
    static const float black[4] = {0, 0, 0, 1};
    stage *s = OTX_ZNEW(run->arena, stage, 1);

    s->run = run;
    s->surface = test_grid_create(run->arena, 2, 1, 1.0);
    paint(run, &s->below, black, 3);
    paint(run, &s->picture, color, channels);
    make_texture(run, &s->below, &s->texture);
    make_texture(run, &s->picture, &s->decal);
    lay(s, opacity);
    s->first[1] = 4;
    s->first[2] = 8;
    s->decals = (otx_decals){
        .lookups = {s->first, s->items, OTX_LAYERING_OVER, 1, &s->fragment},
        .picture_count = 1,
        .pictures = &s->picture,
        .textures = &s->decal};
    s->mapping =
        *test_mapping_create(run->arena, s->surface, &s->below, 1.0, 0);
    s->mapping.decals = &s->decals;
    s->show = otx_show_of(&s->mapping);
    return s;
}

/* At x, y of a quad, which is its lower left triangle or on its diagonal. */
static const otx_show_place *
at(stage *s, int32_t face, double x, double y)
{
    for (int k = 0; k < 3; ++k)
        s->corners[k] = 4 * face + k;
    s->at[0] = 1.0 - x;
    s->at[1] = x - y;
    s->at[2] = y;
    s->place = (otx_show_place){face, s->corners, s->at, NULL, NULL};
    return &s->place;
}

static float
red_at(stage *s, int32_t face, double x, double y)
{
    float color[4] = {0};

    otx_show_color(&s->show, &s->texture, at(s, face, x, y), 0, 1.0, 3, color);
    return color[0];
}

static void
test_lies_over_what_is_below(void **state)
{
    static const float half[4] = {0.5f, 0, 0, 0.5f}, whole[4] = {1, 0, 0, 1};
    stage *s = set(*state, half, 4, 1.0f);

    assert_true(otx_show_is_layered(&s->show, 0));
    assert_false(otx_show_is_layered_below(&s->show, 0));
    assert_true(fabsf(red_at(s, 0, 0.5, 0.2) - 0.5f) < 1e-6f);
    s = set(*state, whole, 3, 0.25f); /* opacity, and no alpha */
    assert_true(fabsf(red_at(s, 0, 0.5, 0.2) - 0.25f) < 1e-6f);
}

/* Beyond its sides there is nothing; filtered, they are half way at them. */
static void
test_ends_at_its_sides(void **state)
{
    static const float red[4] = {1, 0, 0, 1};
    static const double dx[3] = {-0.1, 0.1, 0}, dy[3] = {0, -0.1, 0.1};
    stage *s = set(*state, red, 4, 1.0f);
    float color[4] = {0};

    for (int i = 0; i < 8; ++i)
        s->items[i].uv[0] *= 2.0f; /* ends with the first quad */
    assert_true(fabsf(red_at(s, 0, 0.99, 0.5) - 1.0f) < 1e-6f);
    assert_true(red_at(s, 1, 0.01, 0.005) == 0.0f);
    at(s, 1, 0.0, 0.0);
    s->place.dx = dx;
    s->place.dy = dy;
    s->items[4].uv[1] = s->items[5].uv[1] = 0.5f;
    otx_show_color(&s->show, &s->texture, &s->place, 0, 1.0, 3, color);
    assert_true(fabsf(color[0] - 0.5f) < 1e-4f);
}

/* Maps of a material stay what they are below: they are not colours. */
static void
test_maps_go_through(void **state)
{
    static const float red[4] = {1, 0, 0, 1};
    static const float scale[6] = {1, 1, 1, 1, 1, 1};
    stage *s = set(*state, red, 4, 1.0f);
    const otx_carry carry = {
        .surface = s->surface, .scale = scale, .normal = -1, .height = -1};

    s->show.carry = &carry;
    assert_true(red_at(s, 0, 0.5, 0.2) == 0.0f);
    s->show.carry = NULL;
    assert_true(red_at(s, 0, 0.5, 0.2) == 1.0f);
}

/* An edge is gone on across where both sides have the same of one decal. */
static void
test_ends_of_charts_are_seen(void **state)
{
    static const float red[4] = {1, 0, 0, 1};
    stage *s = set(*state, red, 4, 1.0f);
    const int32_t faces[2] = {0, 1};
    const int32_t corners[2][2] = {{1, 2}, {4, 7}};

    assert_true(otx_show_decals_go_on(&s->show, faces, corners));
    s->items[4].uv[0] += 0.01f;
    assert_false(otx_show_decals_go_on(&s->show, faces, corners));
    s->first[2] = 4; /* the second quad has none */
    assert_false(otx_show_decals_go_on(&s->show, faces, corners));
    for (int i = 0; i < 4; ++i)
        s->items[i].uv[1] += 1.0f; /* beside of the picture */
    assert_true(otx_show_decals_go_on(&s->show, faces, corners));
}

static void
test_lab_is_mixed_by_alpha(void **state)
{
    static const float half[4] = {0.5f, 0, 0, 0.5f};
    stage *s = set(*state, half, 4, 1.0f);
    float lab[3] = {10, 20, 30}, only[3] = {0, 0, 0};

    for (int32_t i = 0; i < 3 * SIDE * SIDE; ++i)
        s->picture.lab.pixels[i] = 50.0f;
    otx_show_decals_lab(&s->show, at(s, 0, 0.5, 0.2), lab);
    assert_true(fabsf(lab[0] - 30.0f) < 1e-4f);
    assert_true(fabsf(lab[2] - 40.0f) < 1e-4f);
    otx_show_lab(&s->show, &s->below, at(s, 0, 0.5, 0.2), 0, only);
    assert_true(only[0] > 20.0f);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(test_lies_over_what_is_below),
        test_with_run(test_ends_at_its_sides),
        test_with_run(test_maps_go_through),
        test_with_run(test_ends_of_charts_are_seen),
        test_with_run(test_lab_is_mixed_by_alpha),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

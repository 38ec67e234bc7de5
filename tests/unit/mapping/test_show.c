/* test_show.c -- what faces show: one lookup, the mean of several, and one over
 * the other. */
#include "grid.h"

#include "mapping/show.h"

enum
{
    SIDE = 8
};

/* A quad whose UVs are the unit square, and two exemplars of one colour each:
 * red, and green that covers a half. */
typedef struct stage
{
    otx_run *run;
    otx_exemplar exemplars[2];
    otx_texture textures[2];
    float uvs[8];
    int32_t first[2], corners[3];
    double at[3], zero[3];
    otx_lookup items[8];
    otx_fragment fragments[2];
    int64_t runs[2];
    otx_lookups lookups;
    otx_show_view show;
    otx_show_place place;
} stage;

static void
paint(stage *s, int32_t k, const float color[4])
{
    otx_image *image = &s->exemplars[k].linear;

    assert_int_equal(
        otx_image_create(s->run, s->run->arena, SIDE, SIDE, 4, image),
        OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 4; ++c)
            image->pixels[4 * i + c] = color[c];
    assert_int_equal(
        otx_texture_create(
            s->run, s->run->arena, image, true, true, &s->textures[k]),
        OSDTEX_OK);
}

static stage *
set(otx_layering layering, float below, float above)
{
    otx_run *run = test_run_create();
    stage *s = OTX_ZNEW(run->arena, stage, 1);
    const float red[4] = {1.0f, 0.0f, 0.0f, 1.0f};
    const float green[4] = {0.0f, 0.5f, 0.0f, 0.5f};
    const float uvs[8] = {0, 0, 1, 0, 1, 1, 0, 1};

    s->run = run;
    paint(s, 0, red);
    paint(s, 1, green);
    memcpy(s->uvs, uvs, sizeof uvs);
    s->first[1] = 4;
    s->corners[1] = 1;
    s->corners[2] = 3;
    s->at[0] = 0.5;
    s->at[1] = s->at[2] = 0.25;
    for (int i = 0; i < 8; ++i)
        s->items[i] = (otx_lookup){
            {uvs[i % 4 * 2], uvs[i % 4 * 2 + 1]}, i < 4 ? below : above, i / 4};
    s->fragments[1].exemplar = 1;
    s->runs[1] = 8;
    s->lookups = (otx_lookups){s->runs, s->items, layering, 2, s->fragments};
    s->show = (otx_show_view){
        .uvs = s->uvs, .face_first = s->first, .lookups = &s->lookups};
    s->place = (otx_show_place){0, s->corners, s->at, s->zero, s->zero};
    return s;
}

static void
expect(const stage *s, const float wanted[4])
{
    float color[OTX_IMAGE_MAX_CHANNELS];

    otx_show_color(&s->show, s->textures, &s->place, 0, 1.0, 4, color);
    for (int c = 0; c < 4; ++c)
        assert_float_equal(color[c], wanted[c], 1e-6);
}

static void
a_plain_face_shows_its_own_exemplar(void **state)
{
    stage *s = set(OTX_LAYERING_MEAN, 0.5f, 0.5f);

    (void)state;
    s->runs[1] = 0;
    assert_int_equal(otx_show_term_count(&s->show, 0), 1);
    expect(s, (float[4]){1.0f, 0.0f, 0.0f, 1.0f});
    test_run_destroy(s->run);
}

/* Red and green as the slices of a stack: the coordinate of the vertices mixes
 * them, and beyond the ends there is nothing else. */
static void
slices_are_mixed_along_an_axis(void **state)
{
    static const float ends[3] = {-0.5f, 0.25f, 2.0f};
    static const float red[3] = {1.0f, 0.75f, 0.0f};
    static const int32_t verts[4] = {0, 1, 2, 3};
    stage *s = set(OTX_LAYERING_MEAN, 0.5f, 0.5f);
    const otx_image slices[2] = {
        s->exemplars[0].linear, s->exemplars[1].linear};
    float along[4];

    (void)state;
    s->runs[1] = 0;
    s->show.along = along;
    s->show.face_verts = verts;
    assert_int_equal(
        otx_texture_add_slices(
            s->run, s->run->arena, slices, 2, &s->textures[0]),
        OSDTEX_OK);
    assert_true(otx_show_is_layered(&s->show, 0));
    for (int i = 0; i < 3; ++i)
    {
        for (int v = 0; v < 4; ++v)
            along[v] = ends[i];
        expect(
            s, (float[4]){
                   red[i], 0.5f * (1.0f - red[i]), 0.0f, 0.5f + 0.5f * red[i]});
    }
    test_run_destroy(s->run);
}

static void
a_mean_goes_by_weights(void **state)
{
    stage *s = set(OTX_LAYERING_MEAN, 0.75f, 0.25f);

    (void)state;
    assert_int_equal(otx_show_term_count(&s->show, 0), 2);
    expect(s, (float[4]){0.75f, 0.125f, 0.0f, 0.875f});
    test_run_destroy(s->run);
}

static void
the_upper_covers_by_its_alpha(void **state)
{
    stage *s = set(OTX_LAYERING_OVER, 1.0f, 1.0f);

    (void)state;
    expect(s, (float[4]){0.5f, 0.5f, 0.0f, 1.0f});
    test_run_destroy(s->run);
}

static void
a_mask_cuts_the_upper_out(void **state)
{
    stage *s = set(OTX_LAYERING_OVER, 1.0f, 1.0f);
    otx_image mask;
    otx_texture texture;

    (void)state;
    assert_int_equal(
        otx_image_create(s->run, s->run->arena, SIDE, SIDE, 1, &mask),
        OSDTEX_OK);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        mask.pixels[i] = 0.5f;
    assert_int_equal(
        otx_texture_create(s->run, s->run->arena, &mask, true, true, &texture),
        OSDTEX_OK);
    s->fragments[1].mask = &texture;
    expect(s, (float[4]){0.75f, 0.25f, 0.0f, 1.0f});
    test_run_destroy(s->run);
}

/* The place is at (0.25, 0.25): on the rim of a circle about there, and far
 * from one about the other corner. */
static void
an_outline_cuts_the_upper_out(void **state)
{
    stage *s = set(OTX_LAYERING_OVER, 1.0f, 1.0f);
    otx_radial circle = {.feather = 2.0f};

    (void)state;
    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
        circle.radius[i] = 1.0f;
    otx_radial_bound(&circle);
    s->fragments[1].outline = &circle;
    s->fragments[1].frame[0] = s->fragments[1].frame[1] = 0.25f;
    s->fragments[1].frame[2] = s->fragments[1].frame[3] = 0.01f;
    expect(s, (float[4]){0.75f, 0.25f, 0.0f, 1.0f});
    s->fragments[1].frame[0] = 0.75f;
    expect(s, (float[4]){1.0f, 0.0f, 0.0f, 1.0f});
    test_run_destroy(s->run);
}

static void
nothing_covers_where_all_weights_are_0(void **state)
{
    stage *s = set(OTX_LAYERING_MEAN, 0.0f, 0.0f);

    (void)state;
    expect(s, (float[4]){0.0f, 0.0f, 0.0f, 0.0f});
    test_run_destroy(s->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plain_face_shows_its_own_exemplar),
        cmocka_unit_test(slices_are_mixed_along_an_axis),
        cmocka_unit_test(a_mean_goes_by_weights),
        cmocka_unit_test(the_upper_covers_by_its_alpha),
        cmocka_unit_test(a_mask_cuts_the_upper_out),
        cmocka_unit_test(an_outline_cuts_the_upper_out),
        cmocka_unit_test(nothing_covers_where_all_weights_are_0),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_paste_atlas.c -- the pictures of pastes side by side. */
#include "export/paste_atlas.h"
#include "strip_pastes.h"

typedef struct fixture
{
    otx_run *run;
    strip_pastes *s;
    otx_paste_list list;
    otx_paste_atlas atlas;
} fixture;

static void
set_up(fixture *f)
{
    f->run = test_run_create();
    f->s = strip_pastes_create(f->run);
    assert_int_equal(
        otx_paste_list_make(f->run, &f->s->mapping, &f->s->exemplar, &f->list),
        OSDTEX_OK);
    assert_int_equal(
        otx_paste_atlas_pack(f->run, &f->list, &f->atlas), OSDTEX_OK);
}

static void
cells_are_apart_and_aligned(void **state)
{
    fixture f;

    (void)state;
    set_up(&f);
    for (int32_t i = 0; i < f.list.cell_count; ++i)
    {
        const int32_t *p = f.atlas.places + 2 * i, *n = f.atlas.sides + 2 * i;
        const int32_t unit = f.atlas.units[i];

        assert_true(n[0] >= f.list.cells[i].width);
        assert_true(n[1] >= f.list.cells[i].height);
        assert_true(p[0] + n[0] <= f.atlas.width);
        assert_true(p[1] + n[1] <= f.atlas.height);
        assert_int_equal(
            p[0] % unit + p[1] % unit + n[0] % unit + n[1] % unit, 0);
        assert_true(n[0] <= 4 * unit && n[1] <= 4 * unit);
        for (int32_t j = 0; j < i; ++j)
        {
            const int32_t *q = f.atlas.places + 2 * j;
            const int32_t *m = f.atlas.sides + 2 * j;

            assert_true(
                p[0] >= q[0] + m[0] || q[0] >= p[0] + n[0] ||
                p[1] >= q[1] + m[1] || q[1] >= p[1] + n[1]);
        }
    }
    test_run_destroy(f.run);
}

/* Premultiplied texels of the exemplar, where the UVs say. */
static void
faces_look_up_what_they_did(void **state)
{
    fixture f;
    otx_pyramid levels;
    int32_t opaque = 0;

    (void)state;
    set_up(&f);
    assert_int_equal(otx_paste_atlas_fill(f.run, &f.atlas, &levels), OSDTEX_OK);
    for (int32_t y = 0; y < 16; ++y)
        for (int32_t x = 0; x < 16; ++x)
        {
            const otx_vec2 uv =
                otx_paste_atlas_uv(&f.atlas, &f.list.faces[5], 0);
            const float *made = otx_image_at(
                &levels.levels[0], (int32_t)lround(uv.x * f.atlas.width) + x,
                (int32_t)lround(uv.y * f.atlas.height) + y);
            const float *from =
                otx_image_at(&f.s->exemplar.linear, (8 + x) % 32, y);
            const double away = hypot(x + 0.5 - 8.0, y + 0.5 - 8.0);

            for (int c = 0; c < 3; ++c)
                assert_float_equal(made[c], made[3] * from[c], 1e-6);
            opaque += made[3] == 1.0f;
            if (away < 4.9)
                assert_float_equal(made[3], 1.0, 0);
            if (away > 7.1)
                assert_float_equal(made[3], 0.0, 0);
        }
    assert_true(opaque > 60);
    test_run_destroy(f.run);
}

static void
weights_of_corners_are_in_the_alpha(void **state)
{
    fixture f;
    otx_pyramid levels;

    (void)state;
    set_up(&f);
    assert_int_equal(otx_paste_atlas_fill(f.run, &f.atlas, &levels), OSDTEX_OK);
    for (int32_t x = 2; x < 14; ++x)
    {
        const otx_vec2 uv = otx_paste_atlas_uv(&f.atlas, &f.list.faces[6], 0);
        const float *made = otx_image_at(
            &levels.levels[0], (int32_t)lround(uv.x * f.atlas.width) + x,
            (int32_t)lround(uv.y * f.atlas.height) + 8);

        assert_float_equal(made[3], 1.0 - (x + 0.5) / 16.0, 1e-5);
    }
    test_run_destroy(f.run);
}

static void
rims_are_transparent_down_to_two_texels(void **state)
{
    fixture f;
    otx_pyramid levels;
    int32_t seen = 0;

    (void)state;
    set_up(&f);
    /* A piece that reaches the rim. */
    for (int32_t k = 0; k < OTX_RADIAL_ANGLES; ++k)
        f.s->outline.radius[k] = 60.0f;
    otx_radial_bound(&f.s->outline);
    assert_int_equal(otx_paste_atlas_fill(f.run, &f.atlas, &levels), OSDTEX_OK);
    for (int32_t l = 0; l < levels.count; ++l)
        for (int32_t i = 0; i < f.list.cell_count; ++i)
        {
            const int32_t x = f.atlas.places[2 * i] >> l;
            const int32_t y = f.atlas.places[2 * i + 1] >> l;
            const int32_t w = f.atlas.sides[2 * i] >> l;
            const int32_t h = f.atlas.sides[2 * i + 1] >> l;

            for (int32_t k = 0; k < w * h && (w > 2 || h > 2); ++k)
                if (k % w == 0 || k % w == w - 1 || k / w == 0 ||
                    k / w == h - 1)
                {
                    assert_float_equal(
                        otx_image_at(
                            &levels.levels[l], x + k % w, y + k / w)[3],
                        0.0, 0);
                    ++seen;
                }
        }
    assert_true(seen > 100);
    test_run_destroy(f.run);
}

static void
maps_lie_on_the_same_cells(void **state)
{
    fixture f;
    otx_companions maps;
    otx_companions *from;

    (void)state;
    set_up(&f);
    from = &f.s->exemplar.companions;
    assert_int_equal(
        otx_image_create(f.run, f.run->arena, 64, 64, 1, &from->image),
        OSDTEX_OK);
    for (int32_t i = 0; i < 64 * 64; ++i)
        from->image.pixels[i] = (float)i;
    assert_int_equal(otx_paste_atlas_maps(f.run, &f.atlas, &maps), OSDTEX_OK);
    assert_int_equal(maps.image.width, 2 * f.atlas.width);

    const otx_vec2 uv = otx_paste_atlas_uv(&f.atlas, &f.list.faces[4], 0);

    assert_float_equal(
        *otx_image_at(
            &maps.image, (int32_t)lround(uv.x * maps.image.width) + 5,
            (int32_t)lround(uv.y * maps.image.height) + 3),
        *otx_image_at(&from->image, 16 + 5, 3), 0);
    test_run_destroy(f.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_apart_and_aligned),
        cmocka_unit_test(faces_look_up_what_they_did),
        cmocka_unit_test(weights_of_corners_are_in_the_alpha),
        cmocka_unit_test(rims_are_transparent_down_to_two_texels),
        cmocka_unit_test(maps_lie_on_the_same_cells),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

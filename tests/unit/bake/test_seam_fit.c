/* test_seam_fit.c -- texels moved so that lookups on a rim find what its edge
 * shows, and no others. */
#include "unit/bake/noise.h"

#include "bake/chart_owner.h"
#include "bake/resolve.h"
#include "bake/seam_fit.h"
#include "image/view.h"

enum
{
    N = 2,
    SIDE = 64, /* one block */
    MARGIN = 4
};

/* A texture in one block, its texels to be fitted. */
typedef struct trial
{
    otx_run *run;
    otx_mapping *mapping;
    otx_layout layout;
    otx_bake bake;
    otx_mip mip;
    otx_block block;
    otx_show_view show;
    otx_carry carry;
    float pixels[SIDE * SIDE * 3], fitted[SIDE * SIDE * 3];
    int32_t owners[SIDE * SIDE];
    otx_sharpen_grid grid;
    otx_seam_fit fit;
} trial;

/* The faces right of x = 1 show another place of the exemplar. */
static void
tear(otx_mapping *mapping)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    for (int32_t c = 0; c < leaf->corner_count; ++c)
        if (leaf->face_cage[c / 4] % N == 1)
            mapping->uvs[2 * c] += 0.2f;
}

static trial *
make_trial(otx_run *run, bool torn)
{
    const otx_bake_options color = {.kind = OTX_TEXEL_COLOR};
    trial *t = OTX_ZNEW(run->arena, trial, 1);
    const otx_surface *surface = flat_surface(run, N, 1);

    t->run = run;
    t->mapping = flat_mapping(run, surface, N);
    if (torn)
        tear(t->mapping);
    t->layout = flat_layout(run, t->mapping, OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    assert_int_equal(
        otx_bake_create(
            run, t->mapping, flat_noise(run, 64), &t->layout, &color, &t->bake),
        OSDTEX_OK);
    t->mip = (otx_mip){.layout = &t->layout};
    assert_int_equal(
        otx_mip_find_rims(
            run, run->arena, &t->layout, 0, &t->mip.rims, &t->mip.rim_count),
        OSDTEX_OK);
    assert_int_equal(otx_mip_build(run, run->arena, &t->mip), OSDTEX_OK);
    assert_true(otx_block_draw(
        &t->bake.source, NULL, &t->mip, 0, 0, run->arena, &t->block));
    assert_int_equal(t->block.raster.width, SIDE);
    return t;
}

/* Texels that are far from what they ought to be: all of one colour. */
static void
fit_from(trial *t, float value)
{
    otx_seam_fit_edge edge = {.rim = -1};
    int32_t first;

    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        t->owners[i] = otx_chart_owner(&t->block, i % SIDE, i / SIDE, &first);
    for (int32_t i = 0; i < SIDE * SIDE * t->grid.channels; ++i)
        t->pixels[i] = value;
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
            otx_seam_fit_texel(
                &t->fit, x, y, &edge,
                t->fitted + (y * SIDE + x) * t->grid.channels);
}

static void
set_fit(trial *t, int32_t channels)
{
    t->grid = (otx_sharpen_grid){SIDE, SIDE, channels, t->pixels, t->owners};
    t->fit = (otx_seam_fit){
        .mapping = t->mapping,
        .show = &t->bake.source.show,
        .textures = t->bake.source.textures,
        .mip = &t->mip,
        .raster = &t->block.raster,
        .near_rim = &t->block.near.rim,
        .near_seam = &t->block.near.seam,
        .grid = &t->grid,
        .low = t->bake.source.low,
        .high = t->bake.source.high};
}

static bool
is_near(const trial *t, int32_t texel)
{
    return t->block.near.rim.edges[texel] >= 0 &&
           t->block.near.rim.distance[texel] < 1.0f;
}

static void
other_texels_stay(void **state)
{
    trial *t = make_trial(*state, false);
    int32_t near = 0;

    set_fit(t, 3);
    fit_from(t, 0.4f);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        near += is_near(t, i);
        for (int c = 0; c < 3 && !is_near(t, i); ++c)
            assert_float_equal(t->fitted[3 * i + c], 0.4, 0.0);
    }
    assert_true(near > 100 && near < SIDE * SIDE / 2);
}

/* From the darkest and from the lightest that all channels have. */
static void
no_texel_leaves_the_range(void **state)
{
    trial *t = make_trial(*state, false);
    float ends[2];

    set_fit(t, 3);
    ends[0] = fmaxf(t->fit.low[0], fmaxf(t->fit.low[1], t->fit.low[2]));
    ends[1] = fminf(t->fit.high[0], fminf(t->fit.high[1], t->fit.high[2]));
    for (int end = 0; end < 2; ++end)
    {
        fit_from(t, ends[end]);
        for (int32_t i = 0; i < SIDE * SIDE; ++i)
            for (int c = 0; c < 3; ++c)
                assert_true(
                    t->fitted[3 * i + c] >= t->fit.low[c] &&
                    t->fitted[3 * i + c] <= t->fit.high[c]);
    }
}

/* Lookups on the edge between two faces, from the texture of either, and what
 * the mapping shows there: how far they are apart, and off, in the mean. */
typedef struct gap
{
    double apart, off;
} gap;

static void
look(
    const trial *t, const float *pixels, int32_t face, int32_t k, double at,
    float *out)
{
    const otx_image image = {
        .width = SIDE,
        .height = SIDE,
        .channels = t->grid.channels,
        .pixels = (float *)(uintptr_t)pixels};
    const float *a = t->layout.leaf_uvs + 2 * (4 * face + k);
    const float *b = t->layout.leaf_uvs + 2 * (4 * face + (k + 1) % 4);

    otx_view_value(
        otx_view_of(&image, false, false),
        (otx_vec2){
            SIDE * (a[0] + at * (b[0] - a[0])),
            SIDE * (a[1] + at * (b[1] - a[1]))},
        out);
}

/* What the texels of a texture are to show at the place of an edge: as wide a
 * mean as a texel is. */
static double
shown(const trial *t, int32_t face, int32_t k, double at)
{
    const float *a = t->mapping->uvs + 2 * (4 * face + k);
    const float *b = t->mapping->uvs + 2 * (4 * face + (k + 1) % 4);
    const otx_texture *texture = &t->bake.source.textures[0];
    float color[3];
    const otx_vec2 way = {b[0] - a[0], b[1] - a[1]};
    const double texels =
        SIDE * hypot(
                   t->layout.leaf_uvs[2 * (4 * face + k)] -
                       t->layout.leaf_uvs[2 * (4 * face + (k + 1) % 4)],
                   t->layout.leaf_uvs[2 * (4 * face + k) + 1] -
                       t->layout.leaf_uvs[2 * (4 * face + (k + 1) % 4) + 1]);
    const otx_vec2 step = otx_vec2_scale(1.0 / texels, way);
    const otx_texture_probes probes = otx_texture_measure(
        texture, step, (otx_vec2){-2.0 * step.y, 2.0 * step.x});

    otx_texture_probe(
        texture, &probes, (otx_vec2){a[0] + at * way.x, a[1] + at * way.y},
        color);
    return color[0];
}

/* Over all edges that are cut, the middle of each: ends belong to others as
 * well. */
static gap
measure(const trial *t, const float *pixels)
{
    const otx_level *leaf = otx_surface_leaf(t->layout.surface);
    gap sum = {0.0, 0.0};
    int32_t count = 0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < 4; ++k)
        {
            const int32_t other = otx_layout_across(&t->layout, f, k);
            int32_t back = 0;

            if (!t->layout.rim[4 * f + k] || other < f)
                continue;
            while (otx_level_neighbour(leaf, other, back) != f)
                ++back;
            for (double at = 0.25; at < 0.8; at += 0.05)
            {
                float a[3], b[3];

                look(t, pixels, f, k, at, a);
                look(t, pixels, other, back, 1.0 - at, b);
                sum.apart += fabs((double)a[0] - b[0]);
                sum.off +=
                    fabs(0.5 * ((double)a[0] + b[0]) - shown(t, f, k, at));
                ++count;
            }
        }
    assert_true(count > 20);
    return (gap){sum.apart / count, sum.off / count};
}

/* From texels that know nothing of the picture, lookups on rims come to show
 * it, the same from both sides. */
static void
lookups_on_a_rim_find_what_it_shows(void **state)
{
    trial *t = make_trial(*state, false);
    gap before, after;

    set_fit(t, 3);
    fit_from(t, 0.5f);
    before = measure(t, t->pixels);
    after = measure(t, t->fitted);
    assert_float_equal(before.apart, 0.0, 0.0);
    assert_true(after.off < before.off / 20.0);
    assert_true(after.apart < before.off / 3.0);
}

/* Where the mapping does not go on the step is its own. */
static void
what_is_torn_stays_torn(void **state)
{
    trial *whole = make_trial(*state, false), *t = make_trial(*state, true);
    int32_t more = 0;

    set_fit(whole, 3);
    set_fit(t, 3);
    fit_from(whole, 0.5f);
    fit_from(t, 0.5f);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const int32_t rim = t->block.near.rim.edges[i];
        const otx_mip_rim *r;
        int32_t other;

        if (!is_near(t, i))
            continue;
        r = &t->mip.rims[rim];
        other = otx_layout_across(&t->layout, r->face, r->edge);
        if (other < 0)
            continue;
        if (otx_surface_leaf(t->layout.surface)->face_cage[r->face] % N !=
            otx_surface_leaf(t->layout.surface)->face_cage[other] % N)
        {
            for (int c = 0; c < 3; ++c)
                assert_float_equal(t->fitted[3 * i + c], 0.5, 0.0);
            more += whole->fitted[3 * i] != 0.5f;
        }
    }
    assert_true(more > 20);
}

/* Heights must meet, torn or not, at the corners as well. */
static void
heights_are_welded_wherever_the_surface_goes_on(void **state)
{
    trial *t = make_trial(*state, true);
    int32_t moved = 0;

    set_fit(t, 1);
    t->carry = (otx_carry){
        .surface = t->layout.surface,
        .normal = -1,
        .height = 0,
        .heights = {{1.0, 0.0}}};
    assert_int_equal(
        otx_carry_measure(
            t->run, t->mapping, t->bake.source.exemplars, &t->carry.scale),
        OSDTEX_OK);
    t->show = t->bake.source.show;
    t->show.carry = &t->carry;
    t->fit.show = &t->show;
    t->fit.welds = true;
    fit_from(t, 0.5f);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        moved += t->fitted[i] != 0.5f;
    assert_true(moved > 100);
    assert_true(measure(t, t->fitted).apart < 0.02);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(other_texels_stay),
        test_with_run(no_texel_leaves_the_range),
        test_with_run(lookups_on_a_rim_find_what_it_shows),
        test_with_run(what_is_torn_stays_torn),
        test_with_run(heights_are_welded_wherever_the_surface_goes_on),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_bake.c -- a baked texture shows what the mapping shows: inside, in the
 * margins, at every level, and whatever the number of threads. */
#include "image/view.h"
#include "unit/bake/flat.h"

#include <stdlib.h>

static const otx_bake_options COLOR = {.kind = OTX_TEXEL_COLOR};

/* What a flat layout must show at a texel: the block (cage face) whose cell
 * the texel is in, and the point of the plane that its coordinates stand for,
 * also beyond the block. */
typedef struct expected
{
    int32_t face;
    double x, y;     /* in the plane */
    double beyond;   /* texels outside of the block, 0 in it */
    bool on_surface; /* the plane's point is on the sheet */
} expected;

/* The block that has a texel in its cell, -1 none. */
static expected
expect(const otx_layout *layout, int32_t n, int32_t side, int32_t x, int32_t y)
{
    const double scale = (double)layout->side / side;
    const double u = (x + 0.5) * scale, v = (y + 0.5) * scale;
    expected best = {.face = -1, .beyond = INFINITY};

    for (int32_t f = 0; f < n * n; ++f)
    {
        const float *low = layout->uvs + 8 * f, *high = low + 4;
        const double x0 = (double)low[0] * layout->side;
        const double y0 = (double)low[1] * layout->side;
        const double size = ((double)high[0] - low[0]) * layout->side;
        const double s = (u - x0) / size, t = (v - y0) / size;
        const double dx = fmax(fmax(x0 - u, u - x0 - size), 0.0);
        const double dy = fmax(fmax(y0 - v, v - y0 - size), 0.0);
        const double beyond = hypot(dx, dy) / scale;

        if (beyond < best.beyond)
            best = (expected){f, f % n + s, f / n + t, beyond, false};
    }
    best.on_surface =
        best.x >= 0.0 && best.x <= n && best.y >= 0.0 && best.y <= n;
    return best;
}

/* What a value between 1/2 and 1 may be off by. Texels beside a rim of level 0
 * make up for what half rounds off that across it, half a step at the most;
 * those at a corner for that of two. A texel of these tests is 4 steps. */
static double
rounding_of(int32_t level, double beyond)
{
    const double half_step = 2.5e-4;

    if (level > 0 || !(beyond > 0.0) || beyond >= 1.0)
        return 1e-4;
    return beyond > 0.6 ? 2.0 * half_step : half_step;
}

static void
margins_show_what_is_across_the_edge(void **state)
{
    enum
    {
        N = 3,
        SIDE = 512
    };
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 3);
    const otx_mapping *mapping = flat_mapping(run, surface, N);
    const otx_exemplar *exemplar = flat_ramp(run, 256);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const flat_levels baked =
        flat_bake(run, mapping, exemplar, &layout, &COLOR, 0);
    int64_t in_blocks = 0, in_margins = 0;

    (void)state;
    for (int32_t l = 0; l < 4; ++l)
    {
        const otx_image *image = &baked.levels[l];
        const double gutter = fmax(4.0, 8 >> l);

        for (int32_t y = 0; y < image->height; ++y)
            for (int32_t x = 0; x < image->width; ++x)
            {
                const expected e = expect(&layout, N, image->width, x, y);
                const float *p = otx_image_at(image, x, y);
                const double off = rounding_of(l, e.beyond);

                /* Nearer to the block than to that of any other, in its
                 * margin, and not beyond the sheet. */
                if (!e.on_surface || e.beyond > fmin(gutter, 8 >> l) - 0.8)
                    continue;
                if (fabs(p[0] - (0.25 + 0.5 * e.x / N)) > off ||
                    fabs(p[1] - (0.25 + 0.5 * e.y / N)) > off)
                    fail_msg(
                        "level %d texel %d %d face %d: %g %g, not %g %g", l, x,
                        y, e.face, (double)p[0], (double)p[1],
                        0.25 + 0.5 * e.x / N, 0.25 + 0.5 * e.y / N);
                in_blocks += e.beyond == 0.0;
                in_margins += e.beyond > 0.0;
            }
    }
    assert_true(in_blocks > 100000);
    assert_true(in_margins > 10000);
    test_run_destroy(run);
}

/* Bilinear lookup at a point of a face's block. */
static void
look(
    const otx_layout *layout, const otx_image *image, int32_t face, double s,
    double t, float color[3])
{
    const float *low = layout->uvs + 8 * face, *high = low + 4;
    const otx_vec2 at = {
        (low[0] + s * (high[0] - low[0])) * image->width,
        (low[1] + t * (high[1] - low[1])) * image->height};

    otx_view_value(otx_view_of(image, false, false), at, color);
}

static double
jump(const float *a, const float *b)
{
    double most = 0.0;

    for (int c = 0; c < 3; ++c)
        most = fmax(most, fabs((double)a[c] - b[c]));
    return most;
}

static void
no_level_jumps_more_across_blocks_than_inside(void **state)
{
    enum
    {
        N = 4,
        SIDE = 512
    };
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 2);
    const otx_mapping *mapping = flat_mapping(run, surface, N);
    otx_exemplar *exemplar = flat_exemplar(run, 256, 3);

    (void)state;
    for (int32_t i = 0; i < 256 * 256 * 3; ++i)
        exemplar->linear.pixels[i] = (float)otx_random_unit(7, 0, (uint64_t)i);

    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const flat_levels baked =
        flat_bake(run, mapping, exemplar, &layout, &COLOR, 0);

    for (int32_t l = 0; l < 5; ++l)
    {
        const otx_image *image = &baked.levels[l];
        const double texels =
            (layout.uvs[4] - layout.uvs[0]) * (double)image->width;
        double across = 0.0, inside = 0.0;

        for (int32_t f = 0; f < N * N; ++f)
            for (int32_t i = 0; i <= 64; ++i)
            {
                const double t = i / 64.0;
                float a[3], b[3];

                /* The same point of the sheet from both blocks. */
                if (f % N < N - 1)
                {
                    look(&layout, image, f, 1.0, t, a);
                    look(&layout, image, f + 1, 0.0, t, b);
                    across = fmax(across, jump(a, b));
                }
                if (f / N < N - 1)
                {
                    look(&layout, image, f, t, 1.0, a);
                    look(&layout, image, f + N, t, 0.0, b);
                    across = fmax(across, jump(a, b));
                }
                look(&layout, image, f, 0.5, t, a);
                look(&layout, image, f, 0.5 + 1.0 / texels, t, b);
                inside = fmax(inside, jump(a, b));
            }
        if (!(across <= inside))
            fail_msg("level %d: %g across, %g inside", l, across, inside);
    }
    test_run_destroy(run);
}

/* Shifts what is right of `x` by 0.2 in u, as a patch of its own. */
static void
tear(otx_mapping *mapping, double x)
{
    const otx_surface *surface = mapping->surface;
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t *verts = leaf->face_verts + 4 * f;
        const double middle = 0.5 * (surface->points[3 * verts[0]] +
                                     surface->points[3 * verts[2]]);

        mapping->face_patch[f] = middle > x;
        for (int32_t k = 0; middle > x && k < 4; ++k)
            mapping->uvs[2 * (4 * f + k)] += 0.2f;
    }
}

enum
{
    BLEND_N = 2,
    BLEND_SIDE = 256,
    BLEND = 16
};

/* What sharpening takes off: a twelfth of what the neighbours are apart, of the
 * ramp's bend at its ends, and of the half blend that margins lack where a seam
 * runs into them.
 *
 *   d     texels from the tear
 *   unit  texels to a cage face */
static double
bend_at(const expected *e, double d, double unit)
{
    const double rim = fabs(e->y - round(e->y)) * unit;

    return rim < 1.0                         ? 0.1 / 12
           : fabs(fabs(d) - BLEND / 2) < 1.5 ? 0.2 / BLEND / 12
                                             : 0.0;
}

/* A texel of a bake that was torn at `x` and blended.
 *
 *   margin  texels beside the blocks that are looked at, too */
static void
check_blend(
    const otx_layout *layout, const expected *e, double x, double margin,
    const float *soft, const float *hard)
{
    const double unit = (layout->uvs[4] - layout->uvs[0]) * (double)BLEND_SIDE;
    const double d = (e->x - x) * unit;
    const double t = fmax(0.5 - fabs(d) / BLEND, 0.0);
    const double shown =
        0.25 + 0.5 * e->x / BLEND_N + 0.2 * (d > 0.0 ? 1.0 - t : t);

    /* Margins are blended along their own rim only. */
    if (!e->on_surface || e->beyond > margin || e->y < e->face / BLEND_N ||
        e->y > e->face / BLEND_N + 1)
        return;
    if (fabs(*soft - shown) > 2e-3 + bend_at(e, d, unit))
        fail_msg("torn at %g, %g: %g, not %g", x, d, (double)*soft, shown);
    /* Sharpening looks one texel further. */
    if (fabs(d) > BLEND / 2 + 1)
        assert_true(*soft == *hard);
}

/* Within the blocks, and where blocks meet. */
static void
seams_are_blended_within_their_width(void **state)
{
    const double tears[] = {0.5, 1.0}, margins[] = {0.0, 3.0};

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        otx_run *run = test_run_create();
        const otx_surface *surface = flat_surface(run, BLEND_N, 3);
        otx_mapping *mapping = flat_mapping(run, surface, BLEND_N);
        const otx_exemplar *exemplar = flat_ramp(run, 64);
        const otx_bake_options options = {
            .kind = OTX_TEXEL_COLOR, .seam_blend = BLEND};

        tear(mapping, tears[i]);

        const otx_layout layout =
            flat_layout(run, mapping, OTX_LAYOUT_ATLAS, BLEND_SIDE, 8);
        const flat_levels hard =
            flat_bake(run, mapping, exemplar, &layout, &COLOR, 0);
        const flat_levels soft =
            flat_bake(run, mapping, exemplar, &layout, &options, 0);

        for (int32_t y = 0; y < BLEND_SIDE; ++y)
            for (int32_t x = 0; x < BLEND_SIDE; ++x)
            {
                const expected e = expect(&layout, BLEND_N, BLEND_SIDE, x, y);

                check_blend(
                    &layout, &e, tears[i], margins[i],
                    otx_image_at(&soft.levels[0], x, y),
                    otx_image_at(&hard.levels[0], x, y));
            }
        test_run_destroy(run);
    }
}

/* Two lookups for every face left of x = 1: its own, and one 0.2 further in u
 * that takes over towards x = 1. */
static void
look_up_twice(otx_run *run, otx_mapping *mapping)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    otx_lookups *lookups = OTX_NEW(run->arena, otx_lookups, 1);
    int64_t *first = OTX_ZNEW(run->arena, int64_t, leaf->face_count + 1);
    otx_lookup *items =
        OTX_NEW(run->arena, otx_lookup, 2 * (int64_t)leaf->corner_count);

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t corner = leaf->face_first[f];
        const bool left = leaf->face_cage[f] % 2 == 0;

        first[f + 1] = first[f] + (left ? 8 : 0);
        for (int32_t i = 0; left && i < 8; ++i)
        {
            const int32_t c = corner + i % 4;
            const float x = mapping->surface->points[3 * leaf->face_verts[c]];

            items[first[f] + i] = (otx_lookup){
                {mapping->uvs[2 * c] + (i < 4 ? 0.0f : 0.2f),
                 mapping->uvs[2 * c + 1]},
                i < 4 ? 1.0f - x : x,
                -1};
        }
    }
    *lookups = (otx_lookups){.first = first, .items = items};
    mapping->lookups = lookups;
}

/* The mean of both, and no tear where the second one goes on. */
static void
several_lookups_are_mixed(void **state)
{
    enum
    {
        N = 2,
        SIDE = 256
    };
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 3);
    otx_mapping *mapping = flat_mapping(run, surface, N);
    const otx_exemplar *exemplar = flat_ramp(run, 64);

    (void)state;
    look_up_twice(run, mapping);
    tear(mapping, 1.0);

    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 8);
    const flat_levels baked =
        flat_bake(run, mapping, exemplar, &layout, &COLOR, 0);

    for (int32_t l = 0; l < 3; ++l)
        for (int32_t y = 0; y < baked.levels[l].height; ++y)
            for (int32_t x = 0; x < baked.levels[l].width; ++x)
            {
                const expected e =
                    expect(&layout, N, baked.levels[l].width, x, y);
                const double own = 0.25 + 0.5 * e.x / N;
                const float *p = otx_image_at(&baked.levels[l], x, y);

                if (!e.on_surface || e.beyond > 3.0)
                    continue;
                if (fabs(p[0] - (own + 0.2 * fmin(e.x, 1.0))) > 3e-3 ||
                    fabs(p[1] - (0.25 + 0.5 * e.y / N)) > 3e-3)
                    fail_msg(
                        "level %d texel %d %d: %g, not %g", l, x, y,
                        (double)p[0], own + 0.2 * fmin(e.x, 1.0));
            }
    test_run_destroy(run);
}

static void
a_constant_stays_constant(void **state)
{
    otx_run *run = test_run_create();
    otx_exemplar *exemplar = flat_exemplar(run, 16, 4);
    const otx_cage_input in = mesh_octahedron(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 2);
    const otx_mapping *mapping = flat_mapping(run, &surface, 3.0);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_AUTO, 200, 0);

    (void)state;
    for (int32_t i = 0; i < 16 * 16; ++i)
        memcpy(
            exemplar->linear.pixels + 4 * i,
            (const float[]){0.3f, 0.2f, 0.1f, 0.5f}, 4 * sizeof(float));

    const flat_levels baked =
        flat_bake(run, mapping, exemplar, &layout, &COLOR, 0);

    for (int32_t l = 0; l < baked.count; ++l)
        for (int32_t i = 0; i < baked.levels[l].width * baked.levels[l].height;
             ++i)
            for (int32_t c = 0; c < 4; ++c)
                assert_true(
                    baked.levels[l].pixels[4 * i + c] ==
                    exemplar->linear.pixels[c]);
    test_run_destroy(run);
}

static void
threads_make_no_difference(void **state)
{
    const int32_t threads[] = {1, 2, 8};
    float *first = NULL;
    enum
    {
        SIDE = 256
    };

    (void)state;
    for (int t = 0; t < 3; ++t)
    {
        otx_run *run = test_run_create_with(NULL, threads[t]);
        const otx_surface *surface = flat_surface(run, 3, 2);
        const otx_mapping *mapping = flat_mapping(run, surface, 3.0);
        const otx_exemplar *exemplar = flat_ramp(run, 64);
        const otx_layout layout =
            flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 4);
        const flat_levels baked =
            flat_bake(run, mapping, exemplar, &layout, &COLOR, 0);
        const size_t bytes = SIDE * SIDE * 3 * sizeof(float);

        if (t == 0)
        {
            first = malloc(bytes);
            memcpy(first, baked.levels[0].pixels, bytes);
        }
        assert_memory_equal(first, baked.levels[0].pixels, bytes);
        test_run_destroy(run);
    }
    free(first);
}

static void
numbers_are_those_of_the_mapping(void **state)
{
    enum
    {
        N = 2,
        SIDE = 128
    };
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 2);
    otx_mapping *mapping = flat_mapping(run, surface, N);
    const otx_exemplar *exemplar = flat_ramp(run, 64);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 4);
    const otx_level *leaf = otx_surface_leaf(surface);

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        mapping->face_patch[f] = f;
    for (int32_t kind = 1; kind < OTX_TEXEL_SOURCE; ++kind)
    {
        const otx_bake_options options = {.kind = (otx_texel_kind)kind};
        const flat_levels baked =
            flat_bake(run, mapping, exemplar, &layout, &options, 0);

        for (int32_t y = 0; y < SIDE; ++y)
            for (int32_t x = 0; x < SIDE; ++x)
            {
                const expected e = expect(&layout, N, SIDE, x, y);
                const float *p = otx_image_at(&baked.levels[0], x, y);

                assert_true(p[2] == (e.beyond == 0.0 ? 1.0f : 0.0f));
                if (e.beyond > 0.0)
                    continue;
                if (kind == OTX_TEXEL_PATCH)
                {
                    assert_true(p[1] == (float)e.face);
                    assert_true(
                        p[0] == floorf(p[0]) &&
                        leaf->face_cage[(int32_t)p[0]] == e.face);
                }
                if (kind == OTX_TEXEL_UV)
                    assert_true(
                        fabs(p[0] - (0.25 + 0.5 * e.x / N)) < 1e-5 &&
                        fabs(p[1] - (0.25 + 0.5 * e.y / N)) < 1e-5);
                if (kind == OTX_TEXEL_STRETCH)
                    assert_true(
                        fabsf(p[0] - 1.0f) < 1e-4f &&
                        fabsf(p[1] - 1.0f) < 1e-4f);
            }
    }
    test_run_destroy(run);
}

/* Patches are blocks here, which meet at rims only: the texels beside those
 * are marked, in the block and in its margin, and no others. */
static void
seams_at_rims_are_marked(void **state)
{
    static const otx_bake_options seam = {.kind = OTX_TEXEL_SEAM};
    enum
    {
        N = 2,
        SIDE = 128
    };
    otx_run *run = test_run_create();
    const otx_surface *surface = flat_surface(run, N, 2);
    otx_mapping *mapping = flat_mapping(run, surface, N);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, 4);
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t marked = 0;

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        mapping->face_patch[f] = leaf->face_cage[f];

    const double texel = 1.0 / ((double)(layout.uvs[4] - layout.uvs[0]) * SIDE);
    const flat_levels baked =
        flat_bake(run, mapping, flat_ramp(run, 64), &layout, &seam, 0);

    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const expected e = expect(&layout, N, SIDE, x, y);
            const double dx = fabs(e.x - 1.0), dy = fabs(e.y - 1.0);
            /* Off the corners and the sheet's border, in the gutter. */
            const bool is_plain = fmax(dx, dy) > 2.0 * texel &&
                                  fmax(dx, dy) < 1.0 - 2.0 * texel &&
                                  e.beyond < 2.0;

            if (!is_plain)
                continue;
            if ((fmin(dx, dy) < texel) !=
                (otx_image_at(&baked.levels[0], x, y)[0] == 1.0f))
                fail_msg("texel %d %d of face %d", x, y, e.face);
            marked += fmin(dx, dy) < texel;
        }
    assert_true(marked > 100);
    test_run_destroy(run);
}

static bool
stop_soon(void *user, const char *stage, double fraction)
{
    int32_t *left = user;

    (void)stage;
    (void)fraction;
    return (*left)-- > 0;
}

static void
it_can_be_stopped_anywhere(void **state)
{
    (void)state;
    for (int32_t calls = 0; calls < 12; ++calls)
    {
        otx_run *run = test_run_create();
        const otx_surface *surface = flat_surface(run, 2, 1);
        const otx_mapping *mapping = flat_mapping(run, surface, 2.0);
        const otx_exemplar *exemplar = flat_ramp(run, 16);
        const otx_layout layout =
            flat_layout(run, mapping, OTX_LAYOUT_ATLAS, 128, 4);
        flat_levels out = {otx_pyramid_count(128, 128), {{0}}};
        const otx_bake_sink sink = flat_sink(&out);
        int32_t left = calls;
        otx_bake bake;

        for (int32_t l = 0; l < out.count; ++l)
            otx_image_create(
                run, run->arena, 128 >> l, 128 >> l, 3, &out.levels[l]);
        otx_bake_create(run, mapping, exemplar, &layout, &COLOR, &bake);
        run->progress = stop_soon;
        run->progress_user = &left;
        assert_int_equal(
            otx_bake_tile(run, &bake, 0, &sink), OSDTEX_ERROR_CANCELLED);
        test_run_destroy(run);
    }
}

static otx_status
lay_out_and_bake(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    flat_levels *out)
{
    const otx_layout_options where = {OTX_LAYOUT_ATLAS, 128, 4, 0.0};
    const otx_bake_options options = {
        .kind = OTX_TEXEL_COLOR, .seam_blend = 4.0};
    const otx_bake_sink sink = flat_sink(out);
    otx_layout layout;
    otx_bake bake;

    OTX_TRY(otx_layout_build(run, mapping, &where, &layout));
    OTX_TRY(otx_bake_create(run, mapping, exemplar, &layout, &options, &bake));
    return otx_bake_tile(run, &bake, 0, &sink);
}

static void
failing_any_allocation_leaves_nothing(void **state)
{
    otx_status status = OSDTEX_ERROR_MEMORY;
    int32_t failures = 0;

    (void)state;
    for (int64_t stop = 0; status != OSDTEX_OK; ++stop)
    {
        test_ration f = {INT64_MAX};
        const otx_allocator_hooks hooks = test_ration_hooks(&f);
        otx_run *run = test_run_create_with(&hooks, 1);
        const otx_surface *surface = flat_surface(run, 6, 3);
        otx_mapping *mapping = flat_mapping(run, surface, 6.0);
        const otx_exemplar *exemplar = flat_ramp(run, 64);
        flat_levels out = {otx_pyramid_count(128, 128), {{0}}};

        tear(mapping, 3.0);
        for (int32_t l = 0; l < out.count; ++l)
            otx_image_create(
                run, run->arena, 128 >> l, 128 >> l, 3, &out.levels[l]);
        f.left = stop;
        status = lay_out_and_bake(run, mapping, exemplar, &out);
        f.left = INT64_MAX;
        assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_MEMORY);
        failures += status != OSDTEX_OK;
        test_run_destroy(run);
    }
    assert_true(failures > 3);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_show_what_is_across_the_edge),
        cmocka_unit_test(no_level_jumps_more_across_blocks_than_inside),
        cmocka_unit_test(seams_are_blended_within_their_width),
        cmocka_unit_test(several_lookups_are_mixed),
        cmocka_unit_test(a_constant_stays_constant),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(numbers_are_those_of_the_mapping),
        cmocka_unit_test(seams_at_rims_are_marked),
        cmocka_unit_test(it_can_be_stopped_anywhere),
        cmocka_unit_test(failing_any_allocation_leaves_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_curved.c -- on curved cages, what a renderer sees of both sides of an
 * edge that the texture is cut at: no level jumps more than inside. */
#include "image/view.h"
#include "unit/bake/flat.h"

enum
{
    EXEMPLAR = 512,
    SIDE = 1024,
    MARGIN = 8,
    PLACES = 16 /* along an edge */
};

static const otx_bake_options COLOR = {.kind = OTX_TEXEL_COLOR};

/* The largest difference of a channel, and the mean of the largest. */
typedef struct jumps
{
    double most, sum, count;
} jumps;

typedef struct scene
{
    const otx_layout *layout;
    const otx_image *image; /* of the level */
    jumps across, inside;
} scene;

/* A picture with as much to see at every scale as at any other: noise of all
 * powers of two, each as strong. */
static otx_exemplar *
every_scale(otx_run *run)
{
    otx_exemplar *exemplar = flat_exemplar(run, EXEMPLAR, 3);

    for (int32_t y = 0; y < EXEMPLAR; ++y)
        for (int32_t x = 0; x < EXEMPLAR; ++x)
            for (int32_t c = 0; c < 3; ++c)
            {
                double sum = 0.0;

                for (int32_t s = 0; s < 8; ++s)
                    sum += otx_random_unit(
                        11, (uint64_t)(8 * c + s),
                        (uint64_t)((y >> s) * EXEMPLAR + (x >> s)));
                otx_image_at(&exemplar->linear, x, y)[c] = (float)(sum / 8.0);
            }
    return exemplar;
}

/* Continuous all over the surface: seen from a corner, in the middle of the
 * exemplar. */
static otx_mapping *
projection(otx_run *run, const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_mapping *mapping = OTX_ZNEW(run->arena, otx_mapping, 1);
    double most = 0.0;

    for (int32_t i = 0; i < 3 * leaf->vert_count; ++i)
        most = fmax(most, fabs((double)surface->points[i]));
    mapping->surface = surface;
    mapping->scale = 4.0 * most;
    mapping->patch_count = 1;
    mapping->uvs = OTX_NEW(run->arena, float, 2 * leaf->corner_count);
    mapping->face_patch = OTX_ZNEW(run->arena, int32_t, leaf->face_count);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const float *p = surface->points + 3 * leaf->face_verts[c];
        const double u = p[0] + 0.31 * p[2], v = p[1] + 0.43 * p[2];

        mapping->uvs[2 * c] = (float)(0.5 + 0.3 * u / most);
        mapping->uvs[2 * c + 1] = (float)(0.5 + 0.3 * v / most);
    }
    return mapping;
}

static otx_vec2
corner(const otx_layout *layout, int32_t c)
{
    return (otx_vec2){
        layout->leaf_uvs[2 * (size_t)c], layout->leaf_uvs[2 * (size_t)c + 1]};
}

static void
compare(const scene *s, otx_vec2 a, otx_vec2 b, jumps *to)
{
    const double side = s->image->width;
    double most = 0.0;
    float x[3], y[3];

    otx_view_value(
        otx_view_of(s->image, false, false), otx_vec2_scale(side, a), x);
    otx_view_value(
        otx_view_of(s->image, false, false), otx_vec2_scale(side, b), y);
    for (int c = 0; c < 3; ++c)
        most = fmax(most, fabs((double)x[c] - y[c]));
    to->most = fmax(to->most, most);
    to->sum += most;
    ++to->count;
}

/* The ends of a cut on the texture, seen from the face on either side; false
 * where there is none, and from the other face. */
static bool
find_cut(
    const otx_layout *layout, int32_t face, int32_t k, otx_vec2 here[2],
    otx_vec2 there[2])
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t other = otx_level_neighbour(leaf, face, k);
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const int32_t edge = leaf->face_edges[first + k];

    if (other < face || !layout->rim[first + k] || !layout->covered[face] ||
        !layout->covered[other])
        return false;

    const int32_t start = leaf->face_first[other];
    const int32_t count = otx_level_face_size(leaf, other);
    int32_t j = 0;

    while (leaf->face_edges[start + j] != edge)
        ++j;
    here[0] = corner(layout, first + k);
    here[1] = corner(layout, first + (k + 1) % size);
    there[0] = corner(layout, start + (j + 1) % count);
    there[1] = corner(layout, start + j);
    return true;
}

/* The same points of an edge from the face on either side. */
static void
compare_across(scene *s, int32_t face, int32_t k)
{
    otx_vec2 a[2], b[2];

    if (!find_cut(s->layout, face, k, a, b))
        return;
    for (int32_t i = 0; i <= PLACES; ++i)
    {
        const double t = (double)i / PLACES;

        compare(
            s, otx_vec2_lerp(a[0], a[1], t), otx_vec2_lerp(b[0], b[1], t),
            &s->across);
    }
}

/* Texels along an edge that runs between them; 0 for one that does not. */
static int32_t
texels_along(const otx_vec2 ends[2], double side)
{
    const double x = fabs(ends[1].x - ends[0].x) * side;
    const double y = fabs(ends[1].y - ends[0].y) * side;
    const double from = (x > y ? ends[0].x : ends[0].y) * side;
    const double length = x + y;

    return fmin(x, y) > 1e-3 || fabs(from - floor(from + 0.5)) > 1e-3 ||
                   fabs(length - floor(length + 0.5)) > 1e-3
               ? 0
               : (int32_t)(length + 0.5);
}

/* The same at the middles of the texels along an edge that has as many on
 * either side. */
static void
compare_joined(scene *s, int32_t face, int32_t k)
{
    const double side = s->image->width;
    otx_vec2 a[2], b[2];

    if (!find_cut(s->layout, face, k, a, b))
        return;

    const int32_t count = texels_along(a, side);

    if (count != texels_along(b, side))
        return;
    for (int32_t i = 0; i < count; ++i)
    {
        const double t = (i + 0.5) / count;

        compare(
            s, otx_vec2_lerp(a[0], a[1], t), otx_vec2_lerp(b[0], b[1], t),
            &s->across);
    }
}

/* Points of a chart that are a texel apart, or where it is smaller than that,
 * as far as it goes. */
static void
compare_inside(scene *s, int32_t face, int32_t other)
{
    const otx_layout *layout = s->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);

    if (layout->chart[face] < 0 || layout->chart[face] != layout->chart[other])
        return;

    const otx_vec2 a = corner(layout, leaf->face_first[face]);
    const otx_vec2 way =
        otx_vec2_sub(corner(layout, leaf->face_first[other] + 2), a);
    const double texels = s->image->width * sqrt(otx_vec2_dot(way, way));

    compare(
        s, a, otx_vec2_add(a, otx_vec2_scale(1.0 / fmax(texels, 1.0), way)),
        &s->inside);
}

static void
measure(scene *s)
{
    const otx_level *leaf = otx_surface_leaf(s->layout->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
            compare_across(s, f, k);
        for (int32_t step = 1; step < 64 && f + step < leaf->face_count;
             step *= 2)
        {
            compare_inside(s, f, f + step);
            compare_inside(s, f + step, f);
        }
    }
}

/* No level jumps more, at the most or in the mean, whose texels are at most
 * `widest` texels of level 0; of those that may, the last has one colour. */
static void
check(const char *name, otx_layout_source source, double widest)
{
    otx_run *run = test_run_create();
    char path[96];
    otx_cage cage;

    snprintf(path, sizeof path, "models/cages/%s.obj", name);
    if (mesh_cage_from_file(run, path, &cage) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));

    const otx_surface surface = mesh_refine(run, &cage, 3);
    const otx_mapping *mapping = projection(run, &surface);
    const otx_layout layout = flat_layout(run, mapping, source, SIDE, MARGIN);
    const flat_levels baked =
        flat_bake(run, mapping, every_scale(run), &layout, &COLOR, 0);

    for (int32_t l = 0; l < baked.count; ++l)
    {
        scene s = {.layout = &layout, .image = &baked.levels[l]};

        measure(&s);
        assert_true(s.across.count > 1000 && s.inside.count > 1000);
        if (l + 1 < baked.count && 1 << l > widest)
            continue;
        if (s.across.most > s.inside.most ||
            s.across.sum / s.across.count > s.inside.sum / s.inside.count)
            fail_msg(
                "%s level %d: %g across, mean %g, inside %g, mean %g", name, l,
                s.across.most, s.across.sum / s.across.count, s.inside.most,
                s.inside.sum / s.inside.count);
    }
    test_run_destroy(run);
}

/* Where texels lie alike along a cut both sides show the same, but for a half
 * of what half rounds off: texels of the margin make up for the whole of it. */
static void
both_sides_of_a_cut_show_the_same(void **state)
{
    otx_run *run = test_run_create();
    otx_cage cage;

    (void)state;
    if (mesh_cage_from_file(run, "models/cages/creature.obj", &cage) !=
        OSDTEX_OK)
        fail_msg("%s", test_last_message(run));

    const otx_surface surface = mesh_refine(run, &cage, 3);
    const otx_level *leaf = otx_surface_leaf(&surface);
    const otx_mapping *mapping = projection(run, &surface);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    const flat_levels baked =
        flat_bake(run, mapping, every_scale(run), &layout, &COLOR, 0);
    scene s = {.layout = &layout, .image = &baked.levels[0]};

    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
            compare_joined(&s, f, k);
    assert_true(s.across.count > 1000);
    if (s.across.most > 3e-4)
        fail_msg(
            "%g at the most, mean %g", s.across.most,
            s.across.sum / s.across.count);
    test_run_destroy(run);
}

/* Cells are apart down to texels of two margins. */
static void
no_level_of_an_atlas_jumps_more_across_blocks(void **state)
{
    static const char *const cages[] = {
        "creature", "torus", "sphere", "uv_seams"};

    (void)state;
    for (int32_t i = 0; i < COUNT(cages); ++i)
        check(cages[i], OTX_LAYOUT_ATLAS, 2 * MARGIN);
}

/* Its islands are .06 apart: two texels may lie between them. */
static void
no_level_of_own_uvs_jumps_more_across_seams(void **state)
{
    (void)state;
    check("uv_seams", OTX_LAYOUT_OWN, 0.5 * 0.06 * SIDE);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_sides_of_a_cut_show_the_same),
        cmocka_unit_test(no_level_of_an_atlas_jumps_more_across_blocks),
        cmocka_unit_test(no_level_of_own_uvs_jumps_more_across_seams),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_height.c -- baked heights are the same from both sides of every rim, so
 * that what they displace does not open; and baked normals are theirs. */
#include "image/view.h"
#include "unit/bake/flat.h"

enum
{
    N = 3,
    SIDE = 512,
    MARGIN = 16,
    TEXELS = 64,
    SAMPLES = 33, /* of an edge */
    WAVES = 256   /* texels of a smooth picture */
};

/* Where vertices of a sheet are, so that its faces are of all sizes. */
static const float *
uneven_points(otx_run *run)
{
    static const float places[N + 1] = {0.0f, 0.6f, 1.9f, 3.0f};
    float *points = OTX_NEW(run->arena, float, 3 * (N + 1) * (N + 1));

    for (int32_t v = 0; v < (N + 1) * (N + 1); ++v)
    {
        points[3 * v] = places[v % (N + 1)] + 0.05f * (float)(v / (N + 1));
        points[3 * v + 1] = places[v / (N + 1)];
        points[3 * v + 2] = 0.2f * (float)((v * 7) % 5);
    }
    return points;
}

/* Quads of all sizes. */
static otx_surface *
uneven(otx_run *run)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    otx_cage_input in = mesh_grid(run, N);

    in.points = uneven_points(run);
    options.scheme = OTX_SCHEME_CATMARK;
    *cage = mesh_build(run, &in, &options);
    *surface = mesh_refine(run, cage, 2);
    return surface;
}

/* The sheet of triangles, with every other quad left whole. */
static otx_surface *
triangles(otx_run *run)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    otx_cage_input in = mesh_grid(run, N);
    int32_t *verts = OTX_NEW(run->arena, int32_t, 6 * N * N);
    int32_t *first = OTX_NEW(run->arena, int32_t, 2 * N * N + 1);
    int32_t faces = 0, corners = 0;

    for (int32_t f = 0; f < N * N; ++f)
    {
        const int32_t *q = in.face_verts + 4 * f;
        const int32_t split[6] = {q[0], q[1], q[2], q[0], q[2], q[3]};
        const bool whole = f % 4 == 2;

        memcpy(
            verts + corners, whole ? q : split,
            (whole ? 4 : 6) * sizeof *verts);
        for (int32_t k = 0; k < (whole ? 1 : 2); ++k)
        {
            first[faces++] = corners;
            corners += whole ? 4 : 3;
        }
    }
    first[faces] = corners;
    in.points = uneven_points(run);
    in.face_verts = verts;
    in.face_first = first;
    in.face_count = faces;
    options.scheme = OTX_SCHEME_CATMARK;
    *cage = mesh_build(run, &in, &options);
    *surface = mesh_refine(run, cage, 2);
    return surface;
}

/* Quads on UVs of their own, which are cut between all of them, turned and of
 * other sizes. */
static otx_surface *
own_sheet(otx_run *run)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    otx_cage_input in = mesh_grid(run, N);
    int32_t *own = OTX_NEW(run->arena, int32_t, 4 * N * N);
    float *uvs = OTX_NEW(run->arena, float, 8 * N * N);

    for (int32_t f = 0; f < N * N; ++f)
    {
        const otx_vec2 x = otx_vec2_scale(
            0.1 + 0.1 * otx_random_unit(3, 1, (uint64_t)f),
            otx_vec2_polar(6.0 * otx_random_unit(3, 2, (uint64_t)f)));

        for (int32_t k = 0; k < 4; ++k)
        {
            const otx_vec2 corner = {(k == 1 || k == 2) - 0.5, (k > 1) - 0.5};
            const otx_vec2 at = otx_vec2_mul(x, corner);

            own[4 * f + k] = 4 * f + k;
            uvs[8 * f + 2 * k] = (float)((f % N + 0.5) / N + at.x);
            uvs[8 * f + 2 * k + 1] = (float)((f / N + 0.5) / N + at.y);
        }
    }
    in.uvs = uvs;
    in.uv_count = 4 * N * N;
    in.face_uvs = own;
    options.scheme = OTX_SCHEME_CATMARK;
    *cage = mesh_build(run, &in, &options);
    *surface = mesh_refine(run, cage, 2);
    return surface;
}

/* A patch of its own for each face of the cage, turned and placed anyhow, so
 * that every rim is a seam as well. */
static otx_mapping *
patches(otx_run *run, const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_mapping *mapping = flat_mapping(run, surface, N);
    const int32_t faces = leaf->face_count / (N * N);

    mapping->scale = 2.0;
    mapping->patch_count = N * N;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const uint64_t patch = (uint64_t)(f / faces % (N * N));
        const otx_vec2 x = otx_vec2_polar(6.0 * otx_random_unit(1, 1, patch));
        const double shift = otx_random_unit(1, 2, patch);

        mapping->face_patch[f] = (int32_t)patch;
        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            const float *p = surface->points + 3 * leaf->face_verts[c];

            mapping->uvs[2 * c] =
                (float)(0.5 * (x.x * p[0] + x.y * p[1]) + shift);
            mapping->uvs[2 * c + 1] = (float)(0.5 * (x.x * p[1] - x.y * p[0]));
        }
    }
    return mapping;
}

/* Noise that tiles, and heights of it. */
static otx_exemplar *
noise(otx_run *run)
{
    otx_exemplar *exemplar = flat_ramp(run, TEXELS);
    otx_companions *set = &exemplar->companions;

    exemplar->wrap_x = exemplar->wrap_y = true;
    assert_int_equal(
        otx_image_create(run, run->arena, TEXELS, TEXELS, 1, &set->image),
        OSDTEX_OK);
    for (int32_t i = 0; i < TEXELS * TEXELS; ++i)
        set->image.pixels[i] = (float)otx_random_unit(4, 5, (uint64_t)i);
    set->maps[OTX_COMPANION_HEIGHT].is_there = true;
    set->height_middle = 0.5;
    set->height_range = 1.0;
    return exemplar;
}

/* Waves that tile, four to the picture's width, and their normals. */
static otx_exemplar *
waves(otx_run *run, double width)
{
    otx_exemplar *exemplar = flat_ramp(run, WAVES);
    otx_companions *set = &exemplar->companions;
    const double k = 8.0 * OTX_PI, range = 0.05;

    exemplar->wrap_x = exemplar->wrap_y = true;
    assert_int_equal(
        otx_image_create(run, run->arena, WAVES, WAVES, 4, &set->image),
        OSDTEX_OK);
    for (int32_t y = 0; y < WAVES; ++y)
        for (int32_t x = 0; x < WAVES; ++x)
        {
            float *p = otx_image_at(&set->image, x, y);
            const double u = (x + 0.5) / WAVES, v = (y + 0.5) / WAVES;
            const double c = range * k / width;

            p[0] = (float)(-0.25 * c * cos(k * u));
            p[1] = (float)(0.25 * c * sin(k * v));
            p[2] = 1.0f;
            p[3] = (float)(0.5 + 0.25 * (sin(k * u) + cos(k * v)));
        }
    set->maps[OTX_COMPANION_NORMAL].is_there = true;
    set->maps[OTX_COMPANION_HEIGHT] =
        (otx_companion){.is_there = true, .first = 3};
    set->height_middle = 0.5;
    set->height_range = range;
    return exemplar;
}

static void
take_normals(
    void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    otx_bake_block one = *block;

    one.pixels = block->maps[OTX_COMPANION_NORMAL];
    one.stride = block->map_strides[OTX_COMPANION_NORMAL];
    flat_take(user, slot, lane, &one);
}

static void
take(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    otx_bake_block one = *block;

    one.pixels = block->maps[OTX_COMPANION_HEIGHT];
    one.stride = block->map_strides[OTX_COMPANION_HEIGHT];
    flat_take(user, slot, lane, &one);
}

/* One of the maps, by `take`. */
static flat_levels
bake(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_layout *layout,
    void (*taken)(void *, int32_t, int32_t, const otx_bake_block *),
    int32_t channels)
{
    const otx_bake_options options = {
        .kind = OTX_TEXEL_COLOR, .maps = OTX_MAP_TEXTURES_ALL};
    flat_levels out = {otx_pyramid_count(layout->side, layout->side), {{0}}};
    const otx_bake_sink sink = {
        .take = taken, .put = flat_put, .user = &out, .share = 1.0};
    otx_bake job;

    assert_int_equal(
        otx_bake_create(run, mapping, exemplar, layout, &options, &job),
        OSDTEX_OK);
    for (int32_t l = 0; l < out.count; ++l)
        assert_int_equal(
            otx_image_create(
                run, run->arena, otx_pyramid_side(SIDE, l),
                otx_pyramid_side(SIDE, l), channels, &out.levels[l]),
            OSDTEX_OK);
    assert_int_equal(otx_bake_tile(run, &job, 0, &sink), OSDTEX_OK);
    return out;
}

/* Along edge k of a face. */
static double
look_up(
    const otx_layout *layout, const otx_image *image, int32_t face, int32_t k,
    double t)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const float *a = layout->leaf_uvs + 2 * (first + k);
    const float *b = layout->leaf_uvs + 2 * (first + (k + 1) % size);
    float value = 0.0f;

    otx_view_value(
        otx_view_of(image, false, false),
        (otx_vec2){
            ((1.0 - t) * a[0] + t * b[0]) * image->width,
            ((1.0 - t) * a[1] + t * b[1]) * image->height},
        &value);
    return value;
}

static int32_t
edge_between(const otx_level *leaf, int32_t face, int32_t other)
{
    int32_t k = 0;

    while (otx_level_neighbour(leaf, face, k) != other)
        ++k;
    return k;
}

/* The largest gap over all rims of a level. */
static double
largest_gap(const otx_layout *layout, const otx_image *image, int32_t *rims)
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    double largest = 0.0;

    *rims = 0;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t other = otx_layout_across(layout, f, k);

            if (!layout->rim[leaf->face_first[f] + k] || other < f)
                continue;
            ++*rims;
            for (int32_t s = 0; s < SAMPLES; ++s)
            {
                const double t = (double)s / (SAMPLES - 1);
                const double here = look_up(layout, image, f, k, t);
                const double there = look_up(
                    layout, image, other, edge_between(leaf, other, f),
                    1.0 - t);

                largest = fmax(largest, fabs(here - there));
            }
        }
    return largest;
}

static void
expect_rims_to_meet(otx_run *run, const otx_surface *surface)
{
    const otx_mapping *mapping = patches(run, surface);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    const otx_exemplar *exemplar = noise(run);
    const flat_levels b = bake(run, mapping, exemplar, &layout, take, 1);

    for (int32_t l = 0; MARGIN >> l > 0; ++l)
    {
        int32_t rims;
        const double gap = largest_gap(&layout, &b.levels[l], &rims);

        assert_true(rims > 2 * N * (N - 1));
        if (!(gap <= 1e-4))
            fail_msg("level %d: a gap of %g", l, gap);
    }
}

static void
test_rims_meet(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    expect_rims_to_meet(run, uneven(run));
    expect_rims_to_meet(run, triangles(run));
    test_run_destroy(run);
}

/* What is left of smooth waves where both sides have texels anyhow: told, and
 * held to what it is. */
static void
test_other_rims_are_told(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = own_sheet(run);
    const otx_mapping *mapping = patches(run, surface);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_OWN, SIDE, MARGIN);
    const otx_exemplar *exemplar = waves(run, mapping->scale);
    const flat_levels b = bake(run, mapping, exemplar, &layout, take, 1);

    (void)state;
    for (int32_t l = 0; l < 5; ++l)
    {
        int32_t rims;
        const double gap = largest_gap(&layout, &b.levels[l], &rims);

        print_message(
            "own UVs, level %d: gaps up to %.3f of the range over %d rims\n", l,
            gap / 0.05, rims);
        assert_true(rims > 0);
        assert_true(gap < 0.3 * 0.05);
    }
    test_run_destroy(run);
}

/* The normal of a baked height at a texel of a leaf face, in the frame of the
 * texture, from differences over two texels; false near the face's rim. */
static bool
normal_of(
    const otx_layout *layout, const otx_image *image, int32_t face, int32_t x,
    int32_t y, double n[3])
{
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t first = leaf->face_first[face];
    otx_vec2 q[3];
    otx_vec3 p[3];

    for (int k = 0; k < 3; ++k)
    {
        const int32_t c = first + (k == 2 ? 3 : k);

        q[k] = (otx_vec2){
            (double)layout->leaf_uvs[2 * c] * SIDE,
            (double)layout->leaf_uvs[2 * c + 1] * SIDE};
        p[k] = otx_vec3_load(layout->surface->points, leaf->face_verts[c]);
    }

    const otx_vec2 q1 = otx_vec2_sub(q[1], q[0]), q2 = otx_vec2_sub(q[2], q[0]);
    const otx_vec3 p1 = otx_vec3_sub(p[1], p[0]), p2 = otx_vec3_sub(p[2], p[0]);
    const double area2 = otx_vec2_cross(q1, q2);
    const otx_vec2 at = {x + 0.5 - q[0].x, y + 0.5 - q[0].y};
    const double s = otx_vec2_cross(at, q2) / area2;
    const double t = otx_vec2_cross(q1, at) / area2;
    const double rim = 2.0 / sqrt(fabs(area2));

    if (s < rim || t < rim || s + t > 1.0 - rim)
        return false;

    const otx_vec3 dx = otx_vec3_mix(q2.y / area2, p1, -q1.y / area2, p2);
    const otx_vec3 dy = otx_vec3_mix(-q2.x / area2, p1, q1.x / area2, p2);
    const otx_vec3 along = otx_vec3_unit(dx);
    const double skew = otx_vec3_dot(dy, along);
    const double across =
        otx_vec3_length(otx_vec3_sub(dy, otx_vec3_scale(skew, along)));
    const double h_x = 0.5 * ((double)*otx_image_at(image, x + 1, y) -
                              (double)*otx_image_at(image, x - 1, y));
    const double h_y = 0.5 * ((double)*otx_image_at(image, x, y + 1) -
                              (double)*otx_image_at(image, x, y - 1));
    const double g_x = h_x / otx_vec3_length(dx);
    const double g_y = (h_y - g_x * skew) / across;
    const double length = sqrt(1.0 + g_x * g_x + g_y * g_y);

    n[0] = -g_x / length;
    n[1] = -g_y / length;
    n[2] = 1.0 / length;
    return true;
}

static double
degrees_between(const float *texel, const double n[3])
{
    double dot = 0.0;

    for (int k = 0; k < 3; ++k)
        dot += (2.0 * (double)texel[k] - 1.0) * n[k];
    return acos(fmin(dot, 1.0)) * 180.0 / OTX_PI;
}

/* On patches at all angles, on quads of all shapes. */
static void
test_normals_are_of_the_heights(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = uneven(run);
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_mapping *mapping = patches(run, surface);
    const otx_layout layout =
        flat_layout(run, mapping, OTX_LAYOUT_ATLAS, SIDE, MARGIN);
    const otx_exemplar *exemplar = waves(run, mapping->scale);
    const flat_levels normals =
        bake(run, mapping, exemplar, &layout, take_normals, 3);
    const flat_levels heights = bake(run, mapping, exemplar, &layout, take, 1);
    double sum = 0.0, tilt = 0.0;
    int32_t count = 0, far = 0;

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const float *uv = layout.leaf_uvs + 2 * leaf->face_first[f];
        const int32_t x0 = (int32_t)(uv[0] * SIDE),
                      y0 = (int32_t)(uv[1] * SIDE);

        for (int32_t i = 0; i < 64 * 64; ++i)
        {
            static const double up[3] = {0.0, 0.0, 1.0};
            const int32_t x = x0 - 32 + i % 64, y = y0 - 32 + i / 64;
            double n[3], angle;

            if (x < 1 || y < 1 || x > SIDE - 2 || y > SIDE - 2 ||
                !normal_of(&layout, &heights.levels[0], f, x, y, n))
                continue;
            angle = degrees_between(otx_image_at(&normals.levels[0], x, y), n);
            tilt += degrees_between(otx_image_at(&normals.levels[0], x, y), up);
            sum += angle;
            far += angle > 5.0;
            ++count;
        }
    }
    print_message(
        "%d texels, tilted by %.2f degrees in the mean, off by %.3f\n", count,
        tilt / count, sum / count);
    assert_true(count > 5000);
    assert_true(tilt / count > 5.0);
    assert_true(sum / count < 1.0);
    assert_true(far < count / 100);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rims_meet),
        cmocka_unit_test(test_other_rims_are_told),
        cmocka_unit_test(test_normals_are_of_the_heights),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

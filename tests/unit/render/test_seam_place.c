/* test_seam_place.c -- seams edge by edge, and where they show. */
#include "render/seam_place.h"
#include "scenes.h"

enum
{
    ROWS = 32
};

static void
assert_near(double a, double b, double by)
{
    if (!(fabs(a - b) <= by))
        fail_msg("%.9g is not %.9g", a, b);
}

/* The sphere's UVs jump from u = 1 to 0 at the meridian in front. A picture
 * that grows brighter to the right shows it: 0 beside 0.75. */
static otx_scene
meridian(otx_run *run, otx_scene_texture *texture, float step)
{
    otx_scene scene = scene_sphere(run, ROWS);

    *texture = texture_of(run, 4, false);
    for (int32_t y = 0; y < 4; ++y)
        for (int32_t x = 0; x < 4; ++x)
            for (int32_t k = 0; k < texture->image.channels; ++k)
                otx_image_at(&texture->image, x, y)[k] = step * (float)x;
    scene.texture_count = 1;
    scene.textures = texture;
    return scene;
}

static otx_seam_places
find(otx_run *run, const otx_scene *scene, int32_t most)
{
    otx_seam_places out;

    assert_int_equal(
        otx_seam_places_find(run, run->arena, scene, most, &out), OSDTEX_OK);
    return out;
}

static void
each_edge_is_told_once(void **state)
{
    otx_run *run = test_run_create();
    otx_scene_texture texture;
    const otx_scene scene = meridian(run, &texture, 0.25f);
    const otx_seam_places seams = find(run, &scene, 0);

    (void)state;
    assert_int_equal(seams.edge_count, ROWS);
    assert_int_equal(seams.count, 0);
    for (int32_t i = 0; i < seams.edge_count; ++i)
    {
        const int32_t c = seams.edges[i].corner;
        const int32_t next = c % 4 < 3 ? c + 1 : c - 3;

        assert_true(i == 0 || c > seams.edges[i - 1].corner);
        assert_near(scene.points[3 * scene.face_verts[c]], 0.0, 1e-6);
        assert_near(scene.points[3 * scene.face_verts[next]], 0.0, 1e-6);
        assert_near(seams.edges[i].difference, sqrt(0.75), 1e-3);
    }
    test_run_destroy(run);
}

/* Places lie on the meridian, look outwards, are no neighbours, and none is
 * worse than the one before it; fewer are the first of more. */
static void
the_worst_places_come_first(void **state)
{
    otx_run *run = test_run_create();
    otx_scene_texture texture;
    const otx_scene scene = meridian(run, &texture, 0.25f);
    const otx_seam_places all = find(run, &scene, OTX_SEAM_PLACES_MAX);
    const otx_seam_places two = find(run, &scene, 2);
    double length = 0.0;

    (void)state;
    assert_in_range(all.count, 8, 18);
    assert_int_equal(two.count, 2);
    assert_near(all.cell, 2.0 / 24.0, 0.05);
    for (int32_t i = 0; i < all.count; ++i)
    {
        const otx_seam_place *p = &all.places[i];

        assert_near(p->point.x, 0.0, 1e-6);
        assert_near(otx_vec3_length(p->point), 1.0, 0.02);
        assert_near(otx_vec3_length(p->normal), 1.0, 1e-9);
        assert_true(otx_vec3_dot(p->normal, p->point) > 0.95);
        assert_near(p->difference, sqrt(0.75), 1e-3);
        length += p->length;
        if (i < 2)
            assert_memory_equal(p, &two.places[i], sizeof *p);
        if (i > 0)
            assert_true(
                p->length * p->difference <=
                all.places[i - 1].length * all.places[i - 1].difference);
        for (int32_t k = 0; k < i; ++k)
            assert_true(
                otx_vec3_length(otx_vec3_sub(p->point, all.places[k].point)) >
                all.cell);
    }
    assert_true(length < OTX_PI);
    test_run_destroy(run);
}

static void
what_shows_nothing_is_no_place(void **state)
{
    otx_run *run = test_run_create();
    otx_scene_texture texture;
    otx_scene scene = meridian(run, &texture, 0.0f);
    otx_seam_places seams = find(run, &scene, 9);

    (void)state;
    assert_int_equal(seams.edge_count, ROWS);
    assert_true(seams.edges[0].difference == 0.0f);
    assert_int_equal(seams.count, 0);
    scene.texture_count = 0;
    seams = find(run, &scene, 9);
    assert_int_equal(seams.edge_count, 0);
    scene = scene_quad(&texture);
    seams = find(run, &scene, 9);
    assert_int_equal(seams.edge_count, 0);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_edge_is_told_once),
        cmocka_unit_test(the_worst_places_come_first),
        cmocka_unit_test(what_shows_nothing_is_no_place),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

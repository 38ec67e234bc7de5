/* test_island.c -- edges pair off, UVs are cut where they jump. */
#include "render/island.h"
#include "scenes.h"

static void
every_edge_of_a_closed_model_has_two_sides(void **state)
{
    otx_run *run = test_run_create();
    const otx_scene scene = scene_sphere(run, 8);
    const int32_t *twin;

    (void)state;
    assert_int_equal(
        otx_island_pair(run, run->arena, &scene, &twin), OSDTEX_OK);
    for (int32_t c = 0; c < scene.corner_count; ++c)
    {
        const bool at_pole =
            (c < 4 * 16 && c % 4 == 0) || (c >= 4 * 16 * 7 && c % 4 == 2);

        assert_int_equal(twin[c] < 0, at_pole);
        if (twin[c] >= 0)
            assert_true(twin[twin[c]] == c && twin[c] / 4 != c / 4);
    }
    test_run_destroy(run);
}

static int32_t
count_seams(otx_run *run, const otx_scene *scene, int32_t *islands)
{
    const int32_t *twin, *label;
    const uint8_t *seam;
    int32_t count = 0;

    assert_int_equal(otx_island_pair(run, run->arena, scene, &twin), OSDTEX_OK);
    assert_int_equal(
        otx_island_seams(run, run->arena, scene, twin, &seam), OSDTEX_OK);
    assert_int_equal(
        otx_island_label(run, run->arena, scene, twin, seam, &label),
        OSDTEX_OK);
    *islands = 0;
    for (int32_t c = 0; c < scene->corner_count; ++c)
    {
        count += seam[c];
        assert_true(!seam[c] || seam[twin[c]]);
    }
    for (int32_t f = 0; f < scene->face_count; ++f)
        *islands = label[f] >= *islands ? label[f] + 1 : *islands;
    return count;
}

/* The sphere's UVs jump from u = 1 to 0 at one meridian of 8 edges. */
static void
a_jump_is_a_seam_unless_it_is_a_wrap(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 8);
    otx_scene_texture texture = texture_of(run, 4, false);
    int32_t islands;

    (void)state;
    assert_int_equal(count_seams(run, &scene, &islands), 16);
    assert_int_equal(islands, 1);
    scene.texture_count = 1;
    scene.textures = &texture;
    assert_int_equal(count_seams(run, &scene, &islands), 16);
    texture.wrap_x = true;
    assert_int_equal(count_seams(run, &scene, &islands), 0);
    test_run_destroy(run);
}

static void
patches_and_holes_cut_too(void **state)
{
    otx_run *run = test_run_create();
    otx_scene scene = scene_sphere(run, 8);
    int32_t *patch = OTX_ZNEW(run->arena, int32_t, scene.face_count);
    uint8_t *hole = OTX_ZNEW(run->arena, uint8_t, scene.face_count);
    int32_t islands;

    (void)state;
    /* Two halves meet along the equator of 16 edges. */
    for (int32_t f = 0; f < scene.face_count; ++f)
        patch[f] = f / 64;
    scene.face_patch = patch;
    assert_int_equal(count_seams(run, &scene, &islands), 32);
    assert_int_equal(islands, 2);
    /* A hole has a border, not a seam. */
    hole[60] = 1;
    scene.face_hole = hole;
    assert_int_equal(count_seams(run, &scene, &islands), 30);
    assert_int_equal(islands, 3);
    test_run_destroy(run);
}

static void
three_faces_at_an_edge_pair_in_order(void **state)
{
    static const float points[15] = {0};
    static const int32_t first[] = {0, 3, 6, 9};
    static const int32_t verts[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    otx_run *run = test_run_create();
    const otx_scene scene = {
        .vert_count = 5,
        .face_count = 3,
        .corner_count = 9,
        .points = points,
        .face_first = first,
        .face_verts = verts,
    };
    const int32_t *twin;

    (void)state;
    assert_int_equal(
        otx_island_pair(run, run->arena, &scene, &twin), OSDTEX_OK);
    assert_int_equal(twin[0], 3);
    assert_int_equal(twin[3], 0);
    assert_int_equal(twin[6], -1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_edge_of_a_closed_model_has_two_sides),
        cmocka_unit_test(a_jump_is_a_seam_unless_it_is_a_wrap),
        cmocka_unit_test(patches_and_holes_cut_too),
        cmocka_unit_test(three_faces_at_an_edge_pair_in_order),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

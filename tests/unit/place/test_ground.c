/* test_ground.c -- charts that grow face by face, and are cut back. */
#include "bent.h"

#include "place/ground.h"

/* Every corner of every face is a vertex of the chart, and the slots say so. */
static void
check(const otx_ground *g)
{
    const otx_level *leaf = otx_surface_leaf(g->ask->surface);
    const otx_footprint *c = g->chart;

    for (int32_t i = 0; i < c->face_count; ++i)
    {
        assert_int_equal(g->space->face_slot[c->faces[i]], i);
        for (int32_t k = c->first[i]; k < c->first[i + 1]; ++k)
        {
            const int32_t v = c->corners[k];

            assert_true(v >= 0 && v < c->vert_count);
            assert_int_equal(
                c->verts[v],
                leaf->face_verts
                    [leaf->face_first[c->faces[i]] + k - c->first[i]]);
            assert_int_equal(g->space->vert_slot[c->verts[v]], v);
        }
    }
}

/* Of a picture of 8 faces a side in the middle of a plane: a ring more than
 * those that it touches is within reach of a face. */
static void
test_grows_and_is_trimmed(void **state)
{
    otx_run *run = *state;
    const otx_surface *surface = bent_create(run->arena, 0.0, false);
    const double face = 1.0 / BENT_FACES, width = 8.0 * face;
    const otx_footprint_ask ask = bent_ask(
        surface, (otx_vec3){0.5 + 0.5 * face, 0.5 + 0.5 * face, 0}, width);
    const otx_footprint_space space = bent_space(run->scratch, surface);
    otx_footprint chart;
    otx_ground g = {&ask, &space, run->scratch, &chart, NULL, NULL};
    int32_t all;

    assert_int_equal(otx_ground_begin(&g), OSDTEX_OK);
    assert_int_equal(chart.face_count, 1);
    assert_int_equal(otx_ground_grow(&g, face / width), OSDTEX_OK);
    check(&g);
    all = chart.face_count;
    assert_true(all >= 81 && all <= 144);
    assert_int_equal(otx_ground_trim(&g, -face / width), OSDTEX_OK);
    check(&g);
    assert_true(chart.face_count < all && chart.face_count >= 36);
    assert_int_equal(chart.faces[0], ask.spot.face);
    otx_ground_end(&g);
    assert_int_equal(space.face_slot[ask.spot.face], -1);
}

/* A hole in the surface is gone around, and holes are never taken. */
static void
test_holes_stay_out(void **state)
{
    otx_run *run = *state;
    const otx_surface *surface = bent_create(run->arena, 0.0, false);
    const otx_footprint_ask ask =
        bent_ask(surface, (otx_vec3){0.52, 0.52, 0}, 0.6);
    const otx_footprint_space space = bent_space(run->scratch, surface);
    const int32_t hole = ask.spot.face + 2;
    otx_footprint chart;
    otx_ground g = {&ask, &space, run->scratch, &chart, NULL, NULL};

    ((uint8_t *)(uintptr_t)surface->levels->face_hole)[hole] = 1;
    assert_int_equal(otx_ground_begin(&g), OSDTEX_OK);
    assert_int_equal(otx_ground_grow(&g, 0.0), OSDTEX_OK);
    assert_int_equal(space.face_slot[hole], -1);
    assert_true(space.face_slot[hole + 1] >= 0);
    otx_ground_end(&g);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(test_grows_and_is_trimmed),
        test_with_run(test_holes_stay_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_subset.c -- parts of a surface as surfaces of their own. */
#include "grid.h"
#include "unit/surface/meshes.h"

#include "surface/subset.h"

enum
{
    SIDE = 6
};

/* Columns 1 to 3 of a square. */
static otx_subset
take_columns(otx_run *run, const otx_surface *s)
{
    uint8_t taken[SIDE * SIDE];
    otx_subset part;

    for (int32_t f = 0; f < SIDE * SIDE; ++f)
        taken[f] = f % SIDE >= 1 && f % SIDE <= 3;
    assert_int_equal(otx_subset_take(run, s, taken, &part), OSDTEX_OK);
    return part;
}

static void
what_is_taken_is_where_it_was(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = test_grid_create(run->arena, SIDE, SIDE, 0.5);
    const otx_level *whole = otx_surface_leaf(s);
    const otx_subset part = take_columns(run, s);
    const otx_level *l = otx_surface_leaf(&part.surface);

    (void)state;
    assert_int_equal(l->face_count, 3 * SIDE);
    assert_int_equal(l->vert_count, 4 * (SIDE + 1));
    assert_int_equal(l->corner_count, 4 * l->face_count);
    assert_true(fabs(part.surface.area - 0.25 * l->face_count) < 1e-9);
    assert_true(fabs(part.surface.mean_edge_length - 0.5) < 1e-9);
    for (int32_t f = 0; f < l->face_count; ++f)
        for (int32_t c = l->face_first[f]; c < l->face_first[f + 1]; ++c)
        {
            const int32_t was = part.corners[c];
            const int32_t v = part.verts[l->face_verts[c]];

            assert_true(was >= whole->face_first[part.faces[f]]);
            assert_true(was < whole->face_first[part.faces[f] + 1]);
            assert_int_equal(v, whole->face_verts[was]);
            assert_memory_equal(
                part.surface.points + 3 * l->face_verts[c], s->points + 3 * v,
                3 * sizeof(float));
        }
    test_run_destroy(run);
}

static void
neighbours_are_those_that_are_taken(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *s = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_level *whole = otx_surface_leaf(s);
    const otx_subset part = take_columns(run, s);
    const otx_level *l = otx_surface_leaf(&part.surface);
    int32_t open = 0;

    (void)state;
    for (int32_t f = 0; f < l->face_count; ++f)
        for (int32_t k = 0; k < 4; ++k)
        {
            const int32_t other = otx_level_neighbour(l, f, k);
            const int32_t was = otx_level_neighbour(whole, part.faces[f], k);

            open += other < 0;
            if (other >= 0)
                assert_int_equal(part.faces[other], was);
            else
                assert_true(was < 0 || was % SIDE < 1 || was % SIDE > 3);
        }
    assert_int_equal(open, 2 * SIDE + 6);
    test_run_destroy(run);
}

static void
widening_goes_along_the_surface_and_not_over_holes(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *grid = test_grid_create(run->arena, SIDE, 1, 1.0);
    otx_level level = *otx_surface_leaf(grid);
    otx_surface s = *grid;
    uint8_t *hole = OTX_ZNEW(run->arena, uint8_t, SIDE);
    uint8_t marked[SIDE] = {1};

    (void)state;
    assert_int_equal(otx_subset_widen(run, &s, 2.5, 7, marked), OSDTEX_OK);
    assert_memory_equal(marked, ((uint8_t[SIDE]){1, 7, 7}), SIDE);
    hole[2] = 1;
    level.face_hole = hole;
    s.levels = &level;
    memset(marked + 1, 0, SIDE - 1);
    assert_int_equal(otx_subset_widen(run, &s, 9.0, 7, marked), OSDTEX_OK);
    assert_memory_equal(marked, ((uint8_t[SIDE]){1, 7}), SIDE);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_taken_is_where_it_was),
        cmocka_unit_test(neighbours_are_those_that_are_taken),
        cmocka_unit_test(widening_goes_along_the_surface_and_not_over_holes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

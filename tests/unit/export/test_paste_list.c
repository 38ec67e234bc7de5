/* test_paste_list.c -- pastes as layers of faces. */
#include "export/paste_list.h"
#include "strip_pastes.h"

static otx_paste_list
make(strip_pastes *s)
{
    otx_paste_list list;

    assert_int_equal(
        otx_paste_list_make(s->run, &s->mapping, &s->exemplar, &list),
        OSDTEX_OK);
    return list;
}

static void
faces_are_in_the_layers_of_their_lookups(void **state)
{
    otx_run *run = test_run_create();
    const otx_paste_list list = make(strip_pastes_create(run));
    const int32_t faces[] = {0, 1, 2, 3, 1, 2, 3, 3};
    const int32_t first[] = {0, 4, 7, 8};

    (void)state;
    assert_int_equal(list.layer_count, 3);
    assert_memory_equal(list.layer_first, first, sizeof first);
    for (int32_t i = 0; i < 8; ++i)
    {
        assert_int_equal(list.faces[i].face, faces[i]);
        assert_int_equal(list.faces[i].cell >= 0, i >= 4);
    }
    assert_null(list.faces[0].lookup);
    assert_int_equal(list.corner_count, 32);
    test_run_destroy(run);
}

/* One outline at places that look alike is one picture; what fades is one by
 * itself. */
static void
what_looks_alike_shares_a_cell(void **state)
{
    otx_run *run = test_run_create();
    strip_pastes *s = strip_pastes_create(run);
    otx_paste_list list = make(s);

    (void)state;
    assert_int_equal(list.cell_count, 2);
    assert_int_equal(list.faces[4].cell, list.faces[5].cell);
    assert_int_equal(list.faces[4].cell, list.faces[7].cell);
    assert_int_not_equal(list.faces[4].cell, list.faces[6].cell);
    assert_true(list.cells[list.faces[6].cell].fades);
    assert_false(list.cells[list.faces[4].cell].fades);
    s->exemplar.wrap_x = false;
    list = make(s);
    assert_int_equal(list.cell_count, 3);
    test_run_destroy(run);
}

static void
cells_hold_what_is_looked_up(void **state)
{
    otx_run *run = test_run_create();
    const otx_paste_list list = make(strip_pastes_create(run));

    (void)state;
    for (int32_t i = 4; i < 8; ++i)
        for (int32_t k = 0; k < 4; ++k)
        {
            const otx_paste_face *face = &list.faces[i];
            const otx_paste_cell *cell = &list.cells[face->cell];
            const otx_vec2 at = otx_paste_list_at(&list, face, k);
            const double u = (double)face->lookup[k].uv[0] * STRIP_SIDE;
            const double away = cell->x + at.x - u;

            assert_true(at.x >= 2 && at.x <= cell->width - 2);
            assert_true(at.y >= 2 && at.y <= cell->height - 2);
            /* The same texel, or one that repeats it. */
            assert_true(
                fabs(away / STRIP_SIDE - round(away / STRIP_SIDE)) < 1e-6);
        }
    test_run_destroy(run);
}

static void
other_lookups_are_refused(void **state)
{
    otx_run *run = test_run_create();
    strip_pastes *s = strip_pastes_create(run);
    otx_paste_list list;

    (void)state;
    s->items[4].fragment = -1;
    assert_int_equal(
        otx_paste_list_make(run, &s->mapping, &s->exemplar, &list),
        OSDTEX_ERROR_SUPPORT);
    test_run_destroy(run);
}

static void
pieces_too_large_are_refused(void **state)
{
    otx_run *run = test_run_create();
    strip_pastes *s = strip_pastes_create(run);
    otx_paste_list list;

    (void)state;
    s->items[4].uv[0] = -1e6f;
    assert_int_equal(
        otx_paste_list_make(run, &s->mapping, &s->exemplar, &list),
        OSDTEX_ERROR_LIMIT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_in_the_layers_of_their_lookups),
        cmocka_unit_test(what_looks_alike_shares_a_cell),
        cmocka_unit_test(cells_hold_what_is_looked_up),
        cmocka_unit_test(other_lookups_are_refused),
        cmocka_unit_test(pieces_too_large_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

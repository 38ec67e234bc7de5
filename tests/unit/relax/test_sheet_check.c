/* test_sheet_check.c -- sheets as they are made are sound, and each way of
 * spoiling one is found. */
#include "grid.h"

#include "relax/sheet_check.h"

typedef struct fixture
{
    otx_run *run;
    const otx_surface *surface;
    otx_sheet sheet;
} fixture;

/* A grid of two patches side by side. */
static fixture
make(void)
{
    fixture f = {.run = test_run_create()};
    int32_t patch[12];
    otx_vec2 *uvs = OTX_ZNEW(f.run->arena, otx_vec2, 48);

    f.surface = test_grid_create(f.run->arena, 4, 3, 1.0);
    for (int32_t i = 0; i < 12; ++i)
        patch[i] = i % 4 < 2 ? 0 : 1;
    assert_int_equal(
        otx_sheet_build(f.run, f.surface, 8.0, patch, NULL, uvs, &f.sheet),
        OSDTEX_OK);
    return f;
}

static void
assert_found(fixture *f, const char *words)
{
    const char *wrong = otx_sheet_check(&f->sheet, f->surface);

    assert_non_null(wrong);
    assert_non_null(strstr(wrong, words));
    test_run_destroy(f->run);
}

static void
what_is_made_is_sound(void **state)
{
    fixture f = make();

    (void)state;
    assert_null(otx_sheet_check(&f.sheet, f.surface));
    test_run_destroy(f.run);
}

static void
what_is_spoilt_is_found(void **state)
{
    fixture a = make(), b = make(), c = make(), d = make();

    (void)state;
    a.sheet.corners[5] = -1;
    assert_found(&a, "no variable");
    b.sheet.at[2].y = INFINITY;
    assert_found(&b, "not finite");
    c.sheet.seams[0].b[0] = c.sheet.seams[0].b[1];
    assert_found(&c, "same edge");
    d.sheet.patches[d.sheet.corners[0]] = 7;
    assert_found(&d, "two patches");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_made_is_sound),
        cmocka_unit_test(what_is_spoilt_is_found),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

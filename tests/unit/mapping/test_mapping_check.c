/* test_mapping_check.c -- a sound mapping passes; each way of being rubbish
 * that is known is refused. */
#include "grid.h"

#include "mapping/mapping_check.h"

typedef struct fixture
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplar;
    otx_mapping *mapping;
    uint8_t *hole; /* [face_count] of the surface */
} fixture;

/* A flat grid that is laid on part of a picture, inside of it. */
static fixture
make(bool wrap)
{
    fixture f = {.run = test_run_create()};

    f.surface = test_grid_create(f.run->arena, 6, 5, 1.0);
    f.exemplar = test_exemplar_create(f.run->arena, 64, 32, wrap, 1);
    f.mapping =
        test_mapping_create(f.run->arena, f.surface, f.exemplar, 4.0, 2.0);
    f.hole = OTX_ZNEW(f.run->arena, uint8_t, 30);
    memcpy(
        (void *)(uintptr_t)&f.surface->levels[0].face_hole, &f.hole,
        sizeof f.hole);
    return f;
}

static otx_status
check(const fixture *f)
{
    return otx_mapping_check(
        f->run, f->mapping, f->surface, f->exemplar, 1, "trial");
}

/* What is wrong is said, and ends the test. */
static void
assert_refused(fixture *f, const char *words)
{
    assert_int_equal(check(f), OSDTEX_ERROR_INTERNAL);
    if (!strstr(test_last_message(f->run), words))
        fail_msg("%s", test_last_message(f->run));
    test_run_destroy(f->run);
}

static void
what_is_sound_passes_without_a_word(void **state)
{
    for (int wrap = 0; wrap < 2; ++wrap)
    {
        fixture f = make(wrap);

        (void)state;
        f.hole[7] = 1;
        f.mapping->face_patch[7] = -1;
        assert_int_equal(check(&f), OSDTEX_OK);
        assert_int_equal(otx_diagnostics_count(f.run->diagnostics), 0);
        test_run_destroy(f.run);
    }
}

static void
arrays_that_are_missing_are_refused(void **state)
{
    fixture f = make(true), g = make(true), h = make(true), k = make(true);

    (void)state;
    f.mapping->uvs = NULL;
    assert_refused(&f, "no UVs");
    g.mapping->surface = NULL;
    assert_refused(&g, "another surface");
    h.mapping->surface = test_grid_create(h.run->arena, 5, 5, 1.0);
    assert_refused(&h, "another surface");
    k.mapping->scale = NAN;
    assert_refused(&k, "scale");
}

static void
patches_out_of_range_are_refused(void **state)
{
    static const int32_t wrong[] = {1000000, 1, -2};

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        fixture f = make(true);

        f.mapping->face_patch[7] = wrong[i];
        assert_refused(&f, "patch that does not exist");
    }
}

static void
faces_without_a_patch_are_refused(void **state)
{
    fixture f = make(true), g = make(true);

    (void)state;
    for (int32_t i = 0; i < 20; ++i)
        f.mapping->face_patch[i] = -1;
    assert_refused(&f, "not covered");
    g.hole[7] = 1;
    assert_refused(&g, "hole has a patch");
}

static void
uvs_that_are_no_numbers_are_refused(void **state)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY};

    (void)state;
    for (int i = 0; i < 3; ++i)
    {
        fixture f = make(true);

        f.mapping->uvs[15] = wrong[i];
        assert_refused(&f, "not finite");
    }
}

/* A face beyond the border is no fault of one that tiles. */
static void
what_leaves_a_picture_that_ends_is_refused(void **state)
{
    for (int wrap = 0; wrap < 2; ++wrap)
    {
        fixture f = make(wrap);

        (void)state;
        for (int32_t c = 0; c < 120; ++c)
            f.mapping->uvs[2 * c] -= 3.0f / 64.0f;
        if (wrap)
        {
            assert_int_equal(check(&f), OSDTEX_OK);
            test_run_destroy(f.run);
        }
        else
            assert_refused(&f, "outside");
    }
}

static void
mirror(fixture *f, int32_t faces)
{
    for (int32_t c = 0; c < 4 * faces; ++c)
        f->mapping->uvs[2 * c] = 1.0f - f->mapping->uvs[2 * c];
}

static void
a_mirrored_picture_is_refused_and_a_fold_is_said(void **state)
{
    fixture f = make(true), g = make(true);

    (void)state;
    mirror(&f, 2);
    assert_int_equal(check(&f), OSDTEX_OK);
    assert_non_null(strstr(test_last_message(f.run), "2 faces"));
    test_run_destroy(f.run);
    mirror(&g, 30);
    assert_refused(&g, "reversed");
}

/* One corner is pulled over the others: the face has area, but is torn. */
static void
a_corner_that_is_reversed_is_said(void **state)
{
    fixture f = make(true);
    float *uv = f.mapping->uvs + 8 * 7;

    (void)state;
    uv[4] = uv[0] + 0.25f * (uv[4] - uv[0]);
    uv[5] = uv[1] + 0.25f * (uv[5] - uv[1]);
    assert_int_equal(check(&f), OSDTEX_OK);
    assert_int_equal(otx_diagnostics_count(f.run->diagnostics), 1);
    assert_non_null(strstr(test_last_message(f.run), "1 faces are folded"));
    test_run_destroy(f.run);
}

static void
sources_that_are_not_given_are_refused(void **state)
{
    static const uint8_t second = 1;
    fixture f = make(true), g = make(true);

    (void)state;
    f.mapping->patch_exemplar = &second;
    f.mapping->exemplar_count = 2;
    assert_refused(&f, "more exemplars");
    g.mapping->patch_exemplar = &second;
    g.mapping->exemplar_count = 1;
    assert_refused(&g, "not given");
}

/* Two lookups on face 0, of weights `a` and `b`. */
static void
mix(fixture *f, float a, float b)
{
    int64_t *first = OTX_NEW(f->run->arena, int64_t, 31);
    otx_lookup *items = OTX_ZNEW(f->run->arena, otx_lookup, 8);
    otx_lookups *lookups = OTX_NEW(f->run->arena, otx_lookups, 1);

    first[0] = 0;
    for (int32_t i = 1; i < 31; ++i)
        first[i] = 8;
    for (int32_t i = 0; i < 8; ++i)
        items[i].weight = i < 4 ? a : b;
    *lookups = (otx_lookups){.first = first, .items = items};
    f->mapping->lookups = lookups;
}

static void
lookups_are_weighed_to_one(void **state)
{
    fixture f = make(true), g = make(true);

    (void)state;
    mix(&f, 0.25f, 0.75f);
    assert_int_equal(check(&f), OSDTEX_OK);
    test_run_destroy(f.run);
    mix(&g, 0.25f, 0.5f);
    assert_refused(&g, "weights");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_sound_passes_without_a_word),
        cmocka_unit_test(arrays_that_are_missing_are_refused),
        cmocka_unit_test(patches_out_of_range_are_refused),
        cmocka_unit_test(faces_without_a_patch_are_refused),
        cmocka_unit_test(uvs_that_are_no_numbers_are_refused),
        cmocka_unit_test(what_leaves_a_picture_that_ends_is_refused),
        cmocka_unit_test(a_mirrored_picture_is_refused_and_a_fold_is_said),
        cmocka_unit_test(a_corner_that_is_reversed_is_said),
        cmocka_unit_test(sources_that_are_not_given_are_refused),
        cmocka_unit_test(lookups_are_weighed_to_one),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_seams_api.c -- where seams of a mapping show, and how far its faces are
 * stretched, for a host. */
#include "meter.h"

#include <math.h>

static osdtex_mapping *
map_sphere(osdtex_context *context)
{
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_exemplar *exemplar = NULL;
    osdtex_cage *cage = NULL;
    osdtex_mapping *mapping = NULL;

    map.level = 2;
    map.scale = 1.0;
    if (osdtex_cage_read(context, "models/cages/sphere.obj", NULL, &cage) !=
            OSDTEX_OK ||
        osdtex_exemplar_read(
            context, "models/exemplars/gravel_tile.png", NULL, &exemplar) !=
            OSDTEX_OK ||
        osdtex_map(context, cage, exemplar, &map, &mapping) != OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(context)->message);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    return mapping;
}

static osdtex_context *
open_context(int32_t threads)
{
    osdtex_context_options how = osdtex_context_options_default();
    osdtex_context *context;

    how.threads = threads;
    assert_int_equal(osdtex_context_create(&how, &context), OSDTEX_OK);
    return context;
}

/* The face of a corner. */
static osdtex_index
face_of(const osdtex_surface_info *s, osdtex_index corner)
{
    osdtex_index f = 0;

    while (s->face_first[f + 1] <= corner)
        ++f;
    return f;
}

/* Seams lie between patches, in order, and each once; places near them. */
static void
seams_are_where_patches_meet(void **state)
{
    osdtex_context *context = open_context(2);
    osdtex_mapping *mapping = map_sphere(context);
    const osdtex_surface_info *s =
        osdtex_surface_describe(osdtex_mapping_surface(mapping));
    const int32_t *patch = osdtex_mapping_describe(mapping)->face_patch;
    osdtex_seams *seams;
    const osdtex_seams_info *info;
    int32_t showing = 0;

    (void)state;
    assert_int_equal(
        osdtex_seams_create(context, mapping, 5, &seams), OSDTEX_OK);
    info = osdtex_seams_describe(seams);
    assert_true(info->seam_count > 50);
    assert_int_equal(info->place_count, 5);
    for (int32_t i = 0; i < info->seam_count; ++i)
    {
        const osdtex_seam *seam = &info->seams[i];
        const osdtex_index face = face_of(s, seam->corner);
        const osdtex_index first = s->face_first[face];
        const osdtex_index size = s->face_first[face + 1] - first;
        const osdtex_index a = s->face_verts[seam->corner];
        const osdtex_index b =
            s->face_verts[first + (seam->corner - first + 1) % size];
        int others = 0;

        assert_true(i == 0 || seam->corner > info->seams[i - 1].corner);
        assert_true(seam->difference >= 0.0f && seam->difference <= 1.0f);
        showing += seam->difference > 0.0f;
        for (osdtex_index f = 0; f < s->face_count; ++f)
            for (osdtex_index c = s->face_first[f]; c < s->face_first[f + 1];
                 ++c)
            {
                const osdtex_index d =
                    c + 1 < s->face_first[f + 1] ? c + 1 : s->face_first[f];

                if (s->face_verts[c] == b && s->face_verts[d] == a)
                    others += patch[f] != patch[face];
            }
        assert_int_equal(others, 1);
    }
    assert_true(showing > 50);
    for (int32_t i = 0; i < info->place_count; ++i)
    {
        const osdtex_seam_place *p = &info->places[i];
        const double *n = p->normal;

        assert_true(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-9);
        assert_true(p->length > 0.0);
        assert_true(p->difference > 0.0 && p->difference <= 1.0);
    }
    osdtex_mapping_destroy(mapping);
    assert_true(info->places[0].length > 0.0); /* what is lent stays */
    osdtex_seams_destroy(seams);
    osdtex_context_destroy(context);
}

static void
threads_make_no_difference(void **state)
{
    osdtex_seams *seams[2];
    const osdtex_seams_info *a, *b;

    (void)state;
    for (int k = 0; k < 2; ++k)
    {
        osdtex_context *context = open_context(1 + 2 * k);
        osdtex_mapping *mapping = map_sphere(context);

        assert_int_equal(
            osdtex_seams_create(
                context, mapping, OSDTEX_SEAM_PLACES_MAX, &seams[k]),
            OSDTEX_OK);
        osdtex_mapping_destroy(mapping);
        osdtex_context_destroy(context);
    }
    a = osdtex_seams_describe(seams[0]);
    b = osdtex_seams_describe(seams[1]);
    assert_int_equal(a->seam_count, b->seam_count);
    assert_int_equal(a->place_count, b->place_count);
    assert_memory_equal(
        a->seams, b->seams, (size_t)a->seam_count * sizeof *a->seams);
    assert_memory_equal(
        a->places, b->places, (size_t)a->place_count * sizeof *a->places);
    osdtex_seams_destroy(seams[0]);
    osdtex_seams_destroy(seams[1]);
}

/* Most faces are about as large as asked, and the mean is near 1. */
static void
faces_are_as_large_as_asked(void **state)
{
    osdtex_context *context = open_context(2);
    osdtex_mapping *mapping = map_sphere(context);
    const int32_t count = osdtex_mapping_describe(mapping)->face_count;
    float *stretch = malloc((size_t)count * sizeof *stretch);
    int32_t close = 0;

    (void)state;
    assert_int_equal(
        osdtex_mapping_stretch(context, mapping, stretch), OSDTEX_OK);
    for (int32_t f = 0; f < count; ++f)
    {
        assert_true(stretch[f] > 0.0f && isfinite(stretch[f]));
        close += stretch[f] > 0.8f && stretch[f] < 1.25f;
    }
    assert_true(close > 9 * count / 10);
    free(stretch);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
}

static void
what_cannot_be_looked_at_is_refused(void **state)
{
    const osdtex_status wrong = OSDTEX_ERROR_ARGUMENT;
    osdtex_context *context = open_context(1);
    osdtex_mapping *mapping = map_sphere(context);
    osdtex_seams *seams = (osdtex_seams *)1;
    float stretch;

    (void)state;
    assert_int_equal(osdtex_seams_create(NULL, mapping, 1, &seams), wrong);
    assert_null(seams);
    assert_int_equal(osdtex_seams_create(context, NULL, 1, &seams), wrong);
    assert_int_equal(osdtex_seams_create(context, mapping, -1, &seams), wrong);
    assert_int_equal(osdtex_seams_create(context, mapping, 100, &seams), wrong);
    assert_int_equal(osdtex_seams_create(context, mapping, 1, NULL), wrong);
    assert_int_equal(osdtex_mapping_stretch(context, mapping, NULL), wrong);
    assert_int_equal(osdtex_mapping_stretch(context, NULL, &stretch), wrong);
    assert_int_equal(osdtex_mapping_stretch(NULL, mapping, &stretch), wrong);
    assert_null(osdtex_seams_describe(NULL));
    osdtex_seams_destroy(NULL);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
}

static osdtex_mapping *kept;

static osdtex_status
look(osdtex_context *context)
{
    osdtex_seams *seams = NULL;
    const osdtex_status status = osdtex_seams_create(context, kept, 9, &seams);

    assert_true((status == OSDTEX_OK) == (seams != NULL));
    osdtex_seams_destroy(seams);
    return status;
}

static void
failures_leak_nothing(void **state)
{
    const moments at = {20, 20};
    osdtex_context *context = open_context(1);

    (void)state;
    kept = map_sphere(context);
    fail_at_moments(&at, look);
    cancel_at_moments(&at, look);
    osdtex_mapping_destroy(kept);
    osdtex_context_destroy(context);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seams_are_where_patches_meet),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(faces_are_as_large_as_asked),
        cmocka_unit_test(what_cannot_be_looked_at_is_refused),
        cmocka_unit_test(failures_leak_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

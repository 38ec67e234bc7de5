/* test_pasting.c -- rounds of pieces: the same by any number of threads, whole,
 * and nowhere turned over. */
#include "unit/method/trial.h"

#include "surface/facet.h"

static void
check_threads(const char *mode)
{
    trial *one = paste("models/cages/torus.obj", 1, 6.0, mode, 1);
    const otx_lookups *a = one->mapping.lookups;
    const size_t faces = (size_t)otx_surface_leaf(&one->surface)->face_count;
    const size_t corners =
        (size_t)otx_surface_leaf(&one->surface)->corner_count;
    static const int32_t threads[] = {2, 8};

    for (int i = 0; i < 2; ++i)
    {
        trial *t = paste("models/cages/torus.obj", 1, 6.0, mode, threads[i]);
        const otx_lookups *b = t->mapping.lookups;

        assert_int_equal(t->mapping.patch_count, one->mapping.patch_count);
        assert_memory_equal(
            t->mapping.uvs, one->mapping.uvs,
            2 * corners * sizeof *t->mapping.uvs);
        assert_memory_equal(a->first, b->first, (faces + 1) * sizeof *a->first);
        assert_memory_equal(
            a->items, b->items, (size_t)a->first[faces] * sizeof *a->items);
        for (int32_t f = 0; f < a->fragment_count; ++f)
            if (a->fragments[f].outline)
                assert_memory_equal(
                    a->fragments[f].outline, b->fragments[f].outline,
                    sizeof(otx_radial));
        test_run_destroy(t->run);
    }
    test_run_destroy(one->run);
}

static void
threads_do_not_show(void **state)
{
    (void)state;
    check_threads("splotch");
    check_threads("packing");
}

static double
area_of(const otx_lookup *corners, int32_t a, int32_t b, int32_t c)
{
    const double ux = (double)(corners[b].uv[0] - corners[a].uv[0]);
    const double uy = (double)(corners[b].uv[1] - corners[a].uv[1]);
    const double vx = (double)(corners[c].uv[0] - corners[a].uv[0]);
    const double vy = (double)(corners[c].uv[1] - corners[a].uv[1]);

    return ux * vy - uy * vx;
}

static void
no_piece_turns_over(void **state)
{
    trial *t = paste("models/cages/creature.obj", 1, 12.0, "splotch", 2);
    const otx_level *leaf = otx_surface_leaf(&t->surface);
    const otx_lookups *l = t->mapping.lookups;

    (void)state;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t size = otx_level_face_size(leaf, f);

        for (int64_t i = l->first[f]; i < l->first[f + 1]; i += size)
            for (int32_t k = 0; k < otx_facet_count(leaf, f); ++k)
            {
                const otx_facet facet = otx_facet_at(leaf, f, k);
                const int32_t first = leaf->face_first[f];

                assert_true(
                    area_of(
                        l->items + i, facet.corners[0] - first,
                        facet.corners[1] - first,
                        facet.corners[2] - first) > 0.0);
            }
    }
    test_run_destroy(t->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_show),
        cmocka_unit_test(no_piece_turns_over),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

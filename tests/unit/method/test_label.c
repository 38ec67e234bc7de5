/* test_label.c -- patches of one material are wholes. */
#include "materials.h"

/* Area of the kept faces that hang together with `seed`; marks them open. */
static double
take_region(const otx_surface *surface, int32_t seed, uint8_t *open)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t *stack = calloc((size_t)leaf->face_count, sizeof *stack);
    int32_t depth = 1;
    double area = 0.0;

    assert_non_null(stack);
    stack[0] = seed;
    open[seed] = 1;
    while (depth > 0)
    {
        const int32_t face = stack[--depth];
        otx_vec3 unused;

        area +=
            0.5 * otx_vec3_length(otx_dual_leaf_area(surface, face, &unused));
        for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, face, k);

            if (other < 0 || open[other])
                continue;
            open[other] = 1;
            stack[depth++] = other;
        }
    }
    free(stack);
    return area;
}

/* What is left of the lattice between patches is wider than two cells. */
static void
no_scraps_of_the_lattice_are_left(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const int32_t faces = otx_surface_leaf(&s->surface)->face_count;

    (void)state;
    for (double scale = 1.0; scale < 6.0; scale *= 1.5)
    {
        const double cell = 0.25 * scale;
        otx_figures figures;
        otx_mapping m;

        assert_int_equal(
            map_with(run, &s->surface, &e, scale, &m, &figures), OSDTEX_OK);
        check(&m, &e);

        uint8_t *open = OTX_NEW(run->arena, uint8_t, faces);

        memcpy(open, m.lattice->open, (size_t)faces);
        for (int32_t f = 0; f < faces; ++f)
            if (!open[f])
                assert_true(
                    take_region(&s->surface, f, open) > 1.5 * cell * cell);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_scraps_of_the_lattice_are_left),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_bond.c -- a strip continues its neighbour: on a plane nothing breaks. */
#include "materials.h"

static void
a_plane_is_laid_without_a_seam(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_bricks(run);
    const otx_cage_input in = mesh_grid(run, 4);
    const field_surface *s = field_from_input(run, &in, 3);
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    otx_figures figures;
    otx_mapping m;

    (void)state;
    if (map_courses(run, &s->surface, &e, 2.0, &m, &figures) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    check(&m, &e);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t i = 0; i < 4; ++i)
        {
            const int32_t other = otx_level_neighbour(leaf, f, i);
            const int32_t c = 4 * f + i;

            if (other < 0)
                continue;
            /* The corner of the neighbour at the same vertex shows the same,
             * but for whole pictures. */
            for (int32_t j = 4 * other; j < 4 * other + 4; ++j)
                for (int k = 0; k < 2; ++k)
                {
                    const double d =
                        (double)m.uvs[2 * j + k] - (double)m.uvs[2 * c + k];

                    if (leaf->face_verts[j] == leaf->face_verts[c])
                        assert_near(d, round(d), 1e-3);
                }
        }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_is_laid_without_a_seam),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

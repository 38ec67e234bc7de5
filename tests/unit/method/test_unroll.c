/* test_unroll.c -- strips are as long as what they show. */
#include "materials.h"

/* Radii differ by a factor of two between the outside of a torus and its
 * inside, bricks by a quarter at most: courses run round the hole, each of its
 * own length, and close. */
static void
courses_keep_their_size(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_bricks(run);
    const otx_cage_input in = field_torus(run, 16, 8);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    const double scale = 2.5;
    otx_figures figures;
    otx_mapping m;

    (void)state;
    if (map_courses(run, &s->surface, &e, scale, &m, &figures) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    check(&m, &e);
    assert_true(lattice(&figures, "singular_faces") == 0.0);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t first = leaf->face_first[f];
        otx_vec3 p[3];
        otx_vec2 q[3];
        double stretch[2];

        for (int j = 0; j < 3; ++j)
        {
            p[j] =
                otx_vec3_load(s->surface.points, leaf->face_verts[first + j]);
            q[j] = (otx_vec2){
                scale * (double)m.uvs[2 * (first + j)],
                scale * (double)m.uvs[2 * (first + j) + 1]};
        }
        otx_stretch_singular(p, q, stretch);
        assert_true(stretch[0] < 1.25 && stretch[1] > 1.0 / 1.25);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(courses_keep_their_size),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_blend.c -- what is blended, and what is left alone. */
#include "materials.h"

/* Something that has the exemplar's lattice and symmetry, from -2 to 2. */
static double
repeating(double u, double v)
{
    return -cos(8.0 * OTX_PI * u) - cos(8.0 * OTX_PI * v);
}

/* What a face shows on the way from its corner k to the next one. */
static double
shown(const otx_mapping *m, int32_t face, int32_t k, double t, bool blended)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);
    const int32_t size = otx_level_face_size(leaf, face);
    const int32_t next = (k + 1) % size;
    const otx_lookups *l = m->lookups;
    double sum = 0.0;

    if (!blended || l->first[face + 1] == l->first[face])
    {
        const float *a = m->uvs + 2 * (leaf->face_first[face] + k);
        const float *b = m->uvs + 2 * (leaf->face_first[face] + next);

        return repeating(
            (1.0 - t) * a[0] + t * b[0], (1.0 - t) * a[1] + t * b[1]);
    }
    for (int64_t i = l->first[face]; i < l->first[face + 1]; i += size)
    {
        const otx_lookup *a = l->items + i + k, *b = l->items + i + next;

        sum += ((1.0 - t) * a->weight + t * b->weight) *
               repeating(
                   (1.0 - t) * a->uv[0] + t * b->uv[0],
                   (1.0 - t) * a->uv[1] + t * b->uv[1]);
    }
    return sum;
}

/* The largest difference between both sides of the edges of faces that have
 * several lookups. */
static double
largest_jump(const otx_mapping *m, bool blended)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);
    double most = 0.0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f) &&
                            m->lookups->first[f + 1] > m->lookups->first[f];
             ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            const int32_t edge = leaf->face_edges[leaf->face_first[f] + k];
            int32_t there = 0;

            while (leaf->face_edges[leaf->face_first[other] + there] != edge)
                ++there;
            for (double t = 0.0; t <= 1.0; t += 0.125)
                most = fmax(
                    most, fabs(
                              shown(m, f, k, t, blended) -
                              shown(m, other, there, 1.0 - t, blended)));
        }
    return most;
}

/* Floats of UVs are off by 1e-7, by 25 times that in what is looked up. */
static void
singular_faces_do_not_tear(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = mesh_cube(run);

    (void)state;
    for (int32_t level = 3; level < 6; ++level)
    {
        const field_surface *s = field_from_input(run, &in, level);
        const otx_level *leaf = otx_surface_leaf(&s->surface);
        otx_figures figures;
        otx_mapping m;

        if (map_lattice(run, &s->surface, &e, "blend", 1.5, &m, &figures) !=
            OSDTEX_OK)
            fail_msg("%s", test_last_message(run));
        check(&m, &e);
        assert_non_null(m.lookups);
        assert_true(
            lattice(&figures, "blended_faces") >=
            lattice(&figures, "singular_faces"));
        assert_true(
            lattice(&figures, "blended_area_share") > 0.0 &&
            lattice(&figures, "blended_area_share") < 0.8);
        assert_true(lattice(&figures, "filled_area_share") == 0.0);
        for (int32_t f = 0; f < leaf->face_count; ++f)
        {
            const int32_t size = otx_level_face_size(leaf, f);
            const otx_lookup *items = m.lookups->items + m.lookups->first[f];
            const int64_t count = m.lookups->first[f + 1] - m.lookups->first[f];

            assert_true(count == 0 || count == 4 * (int64_t)size);
            for (int32_t c = 0; c < size && count > 0; ++c)
            {
                double sum = 0.0;

                for (int64_t i = c; i < count; i += size)
                    sum += items[i].weight;
                assert_true(fabs(sum - 1.0) < 1e-6);
            }
        }
        if (!(largest_jump(&m, true) < 1e-4 && largest_jump(&m, false) > 0.5))
            fail_msg(
                "level %d: %g, torn %g", level, largest_jump(&m, true),
                largest_jump(&m, false));
    }
    test_run_destroy(run);
}

/* Without dislocations there is nothing to mix. */
static void
whole_lattices_are_not_blended(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = field_torus(run, 12, 8);
    const field_surface *s = field_from_input(run, &in, 4);
    otx_figures figures;
    otx_mapping m[2];

    (void)state;
    for (int i = 0; i < 2; ++i)
        assert_int_equal(
            map_lattice(
                run, &s->surface, &e, i == 0 ? "on" : "blend", 4.0, &m[i],
                &figures),
            OSDTEX_OK);
    assert_true(lattice(&figures, "singular_rings") == 0.0);
    assert_true(lattice(&figures, "blended_faces") == 0.0);
    assert_null(m[1].lookups);
    assert_same_uvs(&m[0], &m[1]);
    test_run_destroy(run);
}

static otx_status
blend(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    otx_mapping *out)
{
    otx_figures figures;

    return map_lattice(run, surface, exemplar, "blend", 1.5, out, &figures);
}

static void
what_does_not_tile_is_not_blended(void **state)
{
    (void)state;
    assert_unsupported(blend, "tiles");
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singular_faces_do_not_tear),
        cmocka_unit_test(whole_lattices_are_not_blended),
        cmocka_unit_test(what_does_not_tile_is_not_blended),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

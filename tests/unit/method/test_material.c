/* test_material.c -- whole mappings: covered, unfolded, the same for any
 * number of threads, refused where there is no lattice. */
#include "materials.h"

static void
covers_without_folds(void **state)
{
    (void)state;
    for (int wrap = 0; wrap < 2; ++wrap)
    {
        otx_run *run = test_run_create();
        const otx_exemplar e = make_exemplar(run, true, wrap == 1);
        const otx_cage_input inputs[] = {
            mesh_cube(run), field_torus(run, 12, 8)};

        for (int i = 0; i < 2; ++i)
        {
            const field_surface *s = field_from_input(run, &inputs[i], 4);
            otx_mapping m;

            if (map(run, &s->surface, &e, i == 0 ? 1.5 : 4.0, &m) != OSDTEX_OK)
                fail_msg("%s", test_last_message(run));
            check(&m, &e);
        }
        test_run_destroy(run);
    }
}

static void
the_same_for_any_number_of_threads(void **state)
{
    otx_run *runs[2];
    otx_mapping m[2];

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        runs[i] = test_run_create_with(NULL, i == 0 ? 1 : 3);

        otx_exemplar *e = OTX_NEW(runs[i]->arena, otx_exemplar, 1);
        const otx_cage_input in = mesh_cube(runs[i]);
        const field_surface *s = field_from_input(runs[i], &in, 4);

        *e = make_exemplar(runs[i], true, true);
        assert_int_equal(map(runs[i], &s->surface, e, 1.5, &m[i]), OSDTEX_OK);
    }
    assert_int_equal(m[0].patch_count, m[1].patch_count);
    assert_memory_equal(
        m[0].uvs, m[1].uvs,
        2 * sizeof(float) *
            (size_t)otx_surface_leaf(m[0].surface)->corner_count);
    test_run_destroy(runs[0]);
    test_run_destroy(runs[1]);
}

/* The report's figures, and cells that pictures can be made of. */
static void
what_was_done_is_told(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    int32_t open = 0;
    otx_figures figures;
    otx_mapping m;

    (void)state;
    assert_int_equal(
        map_with(run, &s->surface, &e, 1.5, &m, &figures), OSDTEX_OK);
    assert_true(lattice(&figures, "faces") > 0);
    assert_true(
        lattice(&figures, "clean_area_share") > 0.0 &&
        lattice(&figures, "clean_area_share") <= 1.0);
    assert_true(
        lattice(&figures, "gradient_error") > 0.0 &&
        lattice(&figures, "gradient_error") < 0.5);
    assert_non_null(m.lattice);
    assert_true(m.lattice->defect_count == lattice(&figures, "singular_faces"));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        open += m.lattice->open[f];
    assert_int_equal(open > 0, lattice(&figures, "filled_area_share") > 0.0);
    test_run_destroy(run);
}

/* A mesh as it is has a lattice as well as one that is subdivided. */
static void
plain_meshes_have_lattices(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = field_torus(run, 72, 36);
    otx_cage_options options = otx_cage_options_default();
    otx_surface surface;
    otx_cage cage;
    otx_figures figures;
    otx_mapping m;

    (void)state;
    options.scheme = OTX_SCHEME_NONE;
    cage = mesh_build(run, &in, &options);
    surface = mesh_refine(run, &cage, 0);
    assert_int_equal(surface.level_count, 1);
    if (map_with(run, &surface, &e, 4.0, &m, &figures) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    check(&m, &e);
    assert_true(lattice(&figures, "singular_faces") == 0.0);
    assert_true(lattice(&figures, "clean_area_share") == 1.0);
    test_run_destroy(run);
}

/* Noise that tiles: the whole picture is the cell. */
static void
what_tiles_is_its_own_cell(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, false, true);
    const otx_cage_input in = field_torus(run, 24, 12);
    const field_surface *s = field_from_input(run, &in, 1);
    otx_figures figures;
    otx_mapping m;

    (void)state;
    assert_int_equal(
        map_with(run, &s->surface, &e, 1.5, &m, &figures), OSDTEX_OK);
    check(&m, &e);
    assert_true(lattice(&figures, "clean_area_share") > 0.5);
    test_run_destroy(run);
}

static void
what_has_no_lattice_is_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, false, false);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 2);
    otx_mapping m;

    (void)state;
    assert_int_equal(map(run, &s->surface, &e, 1.5, &m), OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), "lattice"));
    test_run_destroy(run);
}

static void
the_method_follows_the_exemplar(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar lattice_of_cells = make_exemplar(run, true, true);
    const otx_exemplar noise = make_exemplar(run, false, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 2);
    otx_map_request request = {.scale = 1.0, .first_face = -1};
    otx_job job = {
        run, &s->surface, &lattice_of_cells, 1, &request, NULL, NULL};
    const otx_method *method;

    (void)state;
    assert_int_equal(otx_method_choose(&job, &method), OSDTEX_OK);
    assert_string_equal(method->name, "material");
    assert_non_null(strstr(test_last_message(run), "limbs"));
    job.exemplars = &noise;
    assert_int_equal(otx_method_choose(&job, &method), OSDTEX_OK);
    assert_string_equal(method->name, "hierarchical");
    request.scale = 50.0;
    job.exemplars = &lattice_of_cells;
    assert_int_equal(otx_method_choose(&job, &method), OSDTEX_OK);
    assert_string_equal(method->name, "hierarchical");
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_without_folds),
        cmocka_unit_test(the_same_for_any_number_of_threads),
        cmocka_unit_test(what_was_done_is_told),
        cmocka_unit_test(plain_meshes_have_lattices),
        cmocka_unit_test(what_tiles_is_its_own_cell),
        cmocka_unit_test(what_has_no_lattice_is_refused),
        cmocka_unit_test(the_method_follows_the_exemplar),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

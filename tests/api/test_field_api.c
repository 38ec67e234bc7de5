/* test_field_api.c -- fields as a host sees them: constraints, edits, tables,
 * and what is refused. */
#include "field_scene.h"

#include <unistd.h>

/* On a closed surface of genus 0 the indices sum to 2, whatever is asked. */
static void
every_kind_of_following_obeys_poincare_hopf(void **state)
{
    static const char *const kinds[] = {
        NULL, "smooth", "up", "edges", "curvature", "1,2,-0.5"};

    (void)state;
    for (int k = 0; k < 6; ++k)
        for (int32_t symmetry = 1; symmetry <= 4; symmetry *= 2)
        {
            scene s;
            osdtex_field *field;
            const osdtex_field_info *info;
            double sum = 0.0;

            assert_int_equal(
                open_scene(&s, "models/cages/creature.obj", 1, NULL),
                OSDTEX_OK);
            field = make_field(&s, kinds[k], symmetry);
            info = osdtex_field_describe(field);
            assert_int_equal(info->symmetry, symmetry);
            for (int32_t i = 0; i < info->singularity_count; ++i)
                sum += info->singularities[i].index;
            assert_true(fabs(sum - 2.0) < 1e-9);
            assert_directions_everywhere(info);
            osdtex_field_destroy(field);
            close_scene(&s);
        }
}

/* V - E + F of a closed surface: each edge has two faces. */
static int32_t
euler_of(const scene *s)
{
    const osdtex_surface_info *leaf = osdtex_surface_describe(s->surface);
    const int32_t corners = leaf->face_first[leaf->face_count];

    return leaf->vert_count - corners / 2 + leaf->face_count;
}

/* Both schemes and none, components, handles. */
static void
indices_sum_to_the_euler_characteristic(void **state)
{
    static const struct
    {
        const char *name;
        osdtex_scheme scheme;
        int32_t level;
        int32_t euler;
    } cases[] = {
        {"loop_closed", OSDTEX_SCHEME_LOOP, 2, 2},
        {"loop_closed", OSDTEX_SCHEME_NONE, 0, 2},
        {"torus", OSDTEX_SCHEME_CATMARK, 1, 0},
        {"torus", OSDTEX_SCHEME_NONE, 0, 0},
        {"double_torus", OSDTEX_SCHEME_CATMARK, 1, -2},
        {"double_torus", OSDTEX_SCHEME_NONE, 0, -2},
        {"creature", OSDTEX_SCHEME_BILINEAR, 1, 2},
    };
    osdtex_cage_options how = osdtex_cage_options_default();
    scene s;

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
        for (int32_t symmetry = 1; symmetry <= 4; symmetry *= 2)
        {
            const osdtex_field_info *info;
            osdtex_field *field;
            double sum = 0.0;
            char path[64];

            snprintf(path, sizeof path, "models/cages/%s.obj", cases[i].name);
            how.scheme = cases[i].scheme;
            assert_int_equal(
                open_scheme(&s, path, cases[i].level, &how, NULL), OSDTEX_OK);
            assert_int_equal(euler_of(&s), cases[i].euler);
            field = make_field(&s, NULL, symmetry);
            info = osdtex_field_describe(field);
            for (int32_t k = 0; k < info->singularity_count; ++k)
                sum += info->singularities[k].index;
            assert_true(fabs(sum - cases[i].euler) < 1e-9);
            osdtex_field_destroy(field);
            close_scene(&s);
        }
}

static void
open_and_several_components_have_directions_everywhere(void **state)
{
    static const struct
    {
        const char *name;
        osdtex_scheme scheme;
    } cases[] = {
        {"several_components", OSDTEX_SCHEME_CATMARK},
        {"open_boundary", OSDTEX_SCHEME_CATMARK},
        {"loop_open", OSDTEX_SCHEME_LOOP},
        {"open_boundary", OSDTEX_SCHEME_NONE},
        {"several_components", OSDTEX_SCHEME_NONE},
    };
    osdtex_cage_options how = osdtex_cage_options_default();
    scene s;

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
    {
        const osdtex_field_info *info;
        osdtex_field *field;
        char path[64];

        snprintf(path, sizeof path, "models/cages/%s.obj", cases[i].name);
        how.scheme = cases[i].scheme;
        assert_int_equal(
            open_scheme(
                &s, path, how.scheme == OSDTEX_SCHEME_NONE ? 0 : 2, &how, NULL),
            OSDTEX_OK);
        field = make_field(&s, "1,2,3", 2);
        info = osdtex_field_describe(field);
        assert_directions_everywhere(info);
        osdtex_field_destroy(field);
        close_scene(&s);
    }
}

static osdtex_status
make_from_lines(const char *cage, const char *lines, char message[400])
{
    osdtex_field_options options = osdtex_field_options_default();
    osdtex_field *field = NULL;
    osdtex_status status;
    char path[64];
    FILE *file;
    scene s;

    snprintf(path, sizeof path, "/tmp/osdtex-lines-%d.csv", (int)getpid());
    file = fopen(path, "w");
    assert_non_null(file);
    fputs(lines, file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(open_scene(&s, cage, 1, NULL), OSDTEX_OK);
    options.constraints = path;
    status = osdtex_field_create(s.context, s.surface, &options, &field);
    snprintf(message, 400, "%s", last_message(&s));
    remove(path);
    osdtex_field_destroy(field);
    close_scene(&s);
    return status;
}

static void
contradictions_and_holes_get_a_sentence(void **state)
{
    char message[400];

    (void)state;
    assert_int_equal(
        make_from_lines(
            "models/cages/plane.obj", "0,1,0,0\n3,1,0,0\n0,0,1,0\n", message),
        OSDTEX_OK);
    assert_non_null(strstr(
        message, "constraint 3 contradicts constraint 1; the later one holds"));
    assert_int_equal(
        make_from_lines(
            "models/cages/plane.obj", "0,1,0,0\n0,-1,0,0\n", message),
        OSDTEX_OK);
    assert_null(strstr(message, "contradicts"));
    assert_int_equal(
        make_from_lines("models/cages/hole.obj", "10,1,0,0\n", message),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(message, "constraint 1 lies on a hole"));
}

static void
crosses_follow_the_edges_of_quads(void **state)
{
    const osdtex_field_info *info;
    const osdtex_surface_info *surface;
    osdtex_field *field;
    double off = 0.0;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/torus.obj", 2, NULL), OSDTEX_OK);
    field = make_field(&s, "edges", 4);
    info = osdtex_field_describe(field);
    surface = osdtex_surface_describe(s.surface);
    assert_int_equal(info->singularity_count, 0);
    for (int32_t f = 0; f < info->face_count; ++f)
    {
        const osdtex_index *v = surface->face_verts + surface->face_first[f];
        const float *a = surface->points + 3 * (size_t)v[0];
        const float *b = surface->points + 3 * (size_t)v[1];
        const float *d = info->directions + 3 * (size_t)f;
        double dot = 0.0, length_sq = 0.0, cosine;

        for (int i = 0; i < 3; ++i)
        {
            dot += (b[i] - a[i]) * d[i];
            length_sq += (b[i] - a[i]) * (b[i] - a[i]);
        }
        cosine = fabs(dot) / sqrt(length_sq);
        off += fmin(cosine, 1.0 - cosine);
    }
    assert_true(off / info->face_count < 0.05);
    osdtex_field_destroy(field);
    close_scene(&s);
}

static void
an_edit_changes_its_area_only(void **state)
{
    osdtex_constraint c = osdtex_constraint_none();
    const osdtex_field_info *before, *after;
    osdtex_field *field, *edited;
    int32_t turned = 0, sized = 0;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 3, NULL), OSDTEX_OK);
    field = make_field(&s, "1,0,0", 2);
    before = osdtex_field_describe(field);
    c.face = 0;
    c.direction[0] = c.direction[2] = 1.0;
    c.scale = 2.0;
    c.has_material = 1;
    c.material = 0.75;
    if (osdtex_field_edit(
            s.context, field, &c, 0.3 * osdtex_cage_describe(s.cage)->diagonal,
            &edited) != OSDTEX_OK)
        fail_msg("%s", last_message(&s));
    after = osdtex_field_describe(edited);
    for (int32_t f = 0; f < before->face_count; ++f)
        turned +=
            memcmp(
                before->directions + 3 * (size_t)f,
                after->directions + 3 * (size_t)f, 3 * sizeof(float)) != 0;
    for (int32_t v = 0; v < before->vert_count; ++v)
        sized += before->scales[v] != after->scales[v];
    assert_true(turned > 64 && turned < before->face_count / 2);
    assert_true(sized > 64 && sized < before->vert_count / 2);
    assert_true(fabs(after->scale_max - 2.0) < 1e-6);
    assert_true(fabs(after->scales[0] - 2.0) < 1e-6);
    assert_true(fabs(after->materials[0] - 0.75) < 1e-6);
    /* A second edit keeps the first; the old fields may go before. */
    osdtex_field_destroy(field);
    field = edited;
    c = osdtex_constraint_none();
    c.face = 1;
    c.scale = 0.5;
    assert_int_equal(
        osdtex_field_edit(s.context, field, &c, INFINITY, &edited), OSDTEX_OK);
    osdtex_field_destroy(field);
    after = osdtex_field_describe(edited);
    assert_true(fabs(after->scale_min - 0.5) < 1e-6);
    assert_true(after->scale_max > 1.9);
    osdtex_field_destroy(edited);
    close_scene(&s);
}

static void
what_cannot_be_held_is_refused_in_a_sentence(void **state)
{
    static const struct
    {
        osdtex_constraint constraint;
        const char *says;
    } cases[] = {
#define AT(face_) .size = sizeof(osdtex_constraint), .face = (face_)
        {{AT(0)}, "asks for nothing"},
        {{AT(999999), .direction = {1, 0, 0}}, "the cage lacks"},
        {{AT(0), .direction = {NAN, 0, 0}}, "not finite"},
        {{AT(0), .direction = {0, 0, 1}}, "upright"},
        {{AT(0), .scale = 17}, "1/16"},
        {{AT(0), .scale = NAN}, "1/16"},
        {{AT(0), .has_material = 1, .material = -1}, "material"},
        {{AT(-1), .point = {NAN, 0, 0}, .direction = {1, 0, 0}},
         "finite point"},
#undef AT
    };
    osdtex_field *field, *edited;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 1, NULL), OSDTEX_OK);
    field = make_field(&s, NULL, 2);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
    {
        assert_int_equal(osdtex_diagnostic_clear(s.context), OSDTEX_OK);
        assert_int_equal(
            osdtex_field_edit(
                s.context, field, &cases[i].constraint, 1.0, &edited),
            OSDTEX_ERROR_ARGUMENT);
        assert_null(edited);
        if (!strstr(last_message(&s), cases[i].says))
            fail_msg("%s: %s", cases[i].says, last_message(&s));
    }
    assert_int_equal(
        osdtex_field_edit(s.context, field, &cases[0].constraint, NAN, &edited),
        OSDTEX_ERROR_ARGUMENT);
    osdtex_field_destroy(field);
    close_scene(&s);
}

static void
a_table_is_taken_back_as_constraints(void **state)
{
    osdtex_field_options options = osdtex_field_options_default();
    const osdtex_field_info *a, *b;
    osdtex_field *field, *again;
    double off = 0.0;
    char path[64];
    scene s;

    (void)state;
    snprintf(path, sizeof path, "/tmp/osdtex-field-%d.csv", (int)getpid());
    assert_int_equal(
        open_scene(&s, "models/cages/torus.obj", 1, NULL), OSDTEX_OK);
    field = make_field(&s, "curvature", 2);
    assert_int_equal(osdtex_field_write(s.context, field, 0, path), OSDTEX_OK);
    assert_int_equal(
        osdtex_field_write(s.context, field, 2, path), OSDTEX_ERROR_ARGUMENT);
    options.constraints = path;
    options.symmetry = 2;
    assert_int_equal(
        osdtex_field_create(s.context, s.surface, &options, &again), OSDTEX_OK);
    remove(path);
    a = osdtex_field_describe(field);
    b = osdtex_field_describe(again);
    for (int32_t f = 0; f < a->face_count; ++f)
    {
        double dot = 0.0;

        for (int i = 0; i < 3; ++i)
            dot += a->directions[3 * f + i] * b->directions[3 * f + i];
        off += 1.0 - fabs(dot);
    }
    assert_true(off / a->face_count < 0.02);
    osdtex_field_destroy(again);
    osdtex_field_destroy(field);
    close_scene(&s);
}

/* Pictures of a model with and without its field differ. */
static void
expect_drawn(osdtex_context *context, osdtex_model *model, const char *show)
{
    osdtex_render_options options = osdtex_render_options_default();
    osdtex_image *image[2];
    size_t bytes;

    options.width = options.height = 64;
    options.samples = 1;
    for (int i = 0; i < 2; ++i)
    {
        options.show = i == 0 ? show : "texture";
        assert_int_equal(
            osdtex_render(context, model, &options, &image[i]), OSDTEX_OK);
    }
    bytes = sizeof(float) * 64 * 64 *
            (size_t)osdtex_image_describe(image[0])->channels;
    assert_memory_not_equal(
        osdtex_image_describe(image[0])->pixels,
        osdtex_image_describe(image[1])->pixels, bytes);
    osdtex_image_destroy(image[0]);
    osdtex_image_destroy(image[1]);
}

/* A table that has a line for each face of a plain mesh is its field, and is
 * shown on that mesh as a model; a table of other faces is refused. */
static void
a_table_is_shown_on_a_written_model(void **state)
{
    static const char sphere[] = "models/cages/sphere.obj";
    osdtex_cage_options plain = osdtex_cage_options_default();
    osdtex_field_options options = osdtex_field_options_default();
    const osdtex_field_info *a, *b;
    osdtex_field *field, *again;
    osdtex_model *model, *bare, *none;
    char path[64];
    scene s, coarse;

    (void)state;
    snprintf(path, sizeof path, "/tmp/osdtex-shown-%d.csv", (int)getpid());
    plain.scheme = OSDTEX_SCHEME_NONE;
    assert_int_equal(open_scheme(&s, sphere, 0, &plain, NULL), OSDTEX_OK);
    field = make_field(&s, "0,1,0.5", 2);
    a = osdtex_field_describe(field);
    assert_int_equal(osdtex_field_write(s.context, field, 0, path), OSDTEX_OK);
    options.constraints = path;
    options.whole_table = 1;
    assert_int_equal(
        osdtex_field_create(s.context, s.surface, &options, &again), OSDTEX_OK);
    b = osdtex_field_describe(again);
    assert_int_equal(a->singularity_count, b->singularity_count);
    for (int32_t i = 0; i < a->singularity_count; ++i)
        assert_int_equal(
            a->singularities[i].vertex, b->singularities[i].vertex);
    for (int32_t i = 0; i < 3 * a->face_count; ++i)
        assert_true(fabs(a->directions[i] - b->directions[i]) < 1e-5);
    assert_int_equal(osdtex_model_read(s.context, sphere, &bare), OSDTEX_OK);
    assert_int_equal(
        osdtex_model_join_field(s.context, bare, again, &model), OSDTEX_OK);
    osdtex_model_destroy(bare);
    osdtex_field_destroy(again);
    expect_drawn(s.context, model, "field");
    expect_drawn(s.context, model, "singularities");

    /* Neither the field nor the table of the mesh fits another one. */
    assert_int_equal(open_scene(&coarse, sphere, 1, NULL), OSDTEX_OK);
    osdtex_field_destroy(field);
    field = make_field(&coarse, NULL, 2);
    assert_int_equal(
        osdtex_model_join_field(s.context, model, field, &none),
        OSDTEX_ERROR_ARGUMENT);
    assert_null(none);
    assert_non_null(strstr(last_message(&s), "but the model has"));
    assert_int_equal(
        osdtex_field_write(coarse.context, field, 1, path), OSDTEX_OK);
    osdtex_model_destroy(model);
    assert_int_equal(
        osdtex_field_create(s.context, s.surface, &options, &again),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(last_message(&s), "each needs one"));
    remove(path);
    osdtex_field_destroy(field);
    close_scene(&coarse);
    close_scene(&s);
}

static osdtex_status
make_and_edit(scene *s)
{
    osdtex_field_options options = osdtex_field_options_default();
    osdtex_constraint c = osdtex_constraint_none();
    osdtex_field *field = NULL, *edited = NULL;
    osdtex_status status;

    options.octaves = 0.5;
    options.follow = "edges";
    c.face = 2;
    c.direction[0] = c.direction[1] = c.direction[2] = 1.0;
    c.scale = 2.0;
    status = osdtex_field_create(s->context, s->surface, &options, &field);
    if (status == OSDTEX_OK)
        status = osdtex_field_edit(s->context, field, &c, 1.0, &edited);
    osdtex_field_destroy(edited);
    osdtex_field_destroy(field);
    return status;
}

static void
failing_allocations_leak_nothing(void **state)
{
    (void)state;
    for (long k = 0;; k += 1 + k / 16)
    {
        meter m = {.fail_at = k, .cancel_at = -1};
        const osdtex_context_options options = metered(&m);
        osdtex_status status;
        scene s;

        status = open_scene(&s, "models/cages/sphere.obj", 1, &options);
        if (status == OSDTEX_OK)
            status = make_and_edit(&s);
        close_scene(&s);
        assert_int_equal(m.blocks, 0);
        assert_true(status == OSDTEX_ERROR_MEMORY || status == OSDTEX_OK);
        if (m.calls <= k)
            return;
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_following_obeys_poincare_hopf),
        cmocka_unit_test(indices_sum_to_the_euler_characteristic),
        cmocka_unit_test(
            open_and_several_components_have_directions_everywhere),
        cmocka_unit_test(contradictions_and_holes_get_a_sentence),
        cmocka_unit_test(crosses_follow_the_edges_of_quads),
        cmocka_unit_test(an_edit_changes_its_area_only),
        cmocka_unit_test(what_cannot_be_held_is_refused_in_a_sentence),
        cmocka_unit_test(a_table_is_taken_back_as_constraints),
        cmocka_unit_test(a_table_is_shown_on_a_written_model),
        cmocka_unit_test(failing_allocations_leak_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_api.c -- the library as a host sees it: arguments, ownership, failing
 * allocations, cancelling at every moment. */
#include "meter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char cage_path[] = "models/cages/plane.obj";
static const char exemplar_path[] = "models/exemplars/gravel_tile.png";

static const float cube_points[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                    -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
static const osdtex_index cube_sizes[] = {4, 4, 4, 4, 4, 4};
static const osdtex_index cube_verts[] = {
    0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

static osdtex_cage_arrays
cube(void)
{
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();

    arrays.vert_count = 8;
    arrays.face_count = 6;
    arrays.points = cube_points;
    arrays.face_sizes = cube_sizes;
    arrays.face_verts = cube_verts;
    return arrays;
}

typedef struct pipe
{
    osdtex_cage *cage;
    osdtex_surface *surface;
    osdtex_exemplar *exemplar;
    osdtex_mapping *mapping;
    osdtex_model *model;
    osdtex_image *image;
} pipe;

static void
pipe_destroy(pipe *p)
{
    osdtex_image_destroy(p->image);
    osdtex_model_destroy(p->model);
    osdtex_mapping_destroy(p->mapping);
    osdtex_exemplar_destroy(p->exemplar);
    osdtex_surface_destroy(p->surface);
    osdtex_cage_destroy(p->cage);
}

/* Everything up to the picture, small. */
static osdtex_status
pipe_run(osdtex_context *context, pipe *p)
{
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_render_options render = osdtex_render_options_default();
    osdtex_status status;

    refine.level = 1;
    map.scale = 4.0;
    render.width = render.height = 16;
    render.samples = 1;
    *p = (pipe){0};
    status = osdtex_cage_read(context, cage_path, NULL, &p->cage);
    if (status == OSDTEX_OK)
        status = osdtex_surface_refine(context, p->cage, &refine, &p->surface);
    if (status == OSDTEX_OK)
        status =
            osdtex_exemplar_read(context, exemplar_path, NULL, &p->exemplar);
    map.surface = p->surface;
    if (status == OSDTEX_OK)
        status = osdtex_map(context, p->cage, p->exemplar, &map, &p->mapping);
    if (status == OSDTEX_OK)
        status = osdtex_model_create(context, p->mapping, &p->model);
    if (status == OSDTEX_OK)
        status = osdtex_render(context, p->model, &render, &p->image);
    return status;
}

/* --------------------------------------------------------------------- */

static int
set_up(void **state)
{
    osdtex_context *context;

    if (osdtex_context_create(NULL, &context) != OSDTEX_OK)
        return 1;
    *state = context;
    return 0;
}

static int
tear_down(void **state)
{
    osdtex_context_destroy(*state);
    return 0;
}

static void
names_and_versions(void **state)
{
    char hash[OSDTEX_HASH_BYTES];

    (void)state;
    assert_string_equal(osdtex_version(), "0.2.0");
    assert_string_equal(osdtex_status_name(OSDTEX_OK), "OK");
    assert_string_equal(osdtex_status_name(OSDTEX_ERROR_COLOUR), "COLOUR");
    assert_string_equal(osdtex_status_name(1), "UNKNOWN");
    assert_string_equal(osdtex_status_name(OSDTEX_ERROR_INTERNAL), "INTERNAL");
    assert_string_equal(osdtex_status_name(-12), "UNKNOWN");
    osdtex_hash("", 0, hash);
    assert_int_equal(strlen(hash), OSDTEX_HASH_BYTES - 1);
}

static void
null_is_an_argument_or_nothing(void **state)
{
    osdtex_context *context = *state;
    osdtex_cage *cage = (osdtex_cage *)1;
    osdtex_surface *surface = (osdtex_surface *)1;
    osdtex_exemplar *exemplar = (osdtex_exemplar *)1;
    osdtex_mapping *mapping = (osdtex_mapping *)1;
    osdtex_model *model = (osdtex_model *)1;
    osdtex_image *image = (osdtex_image *)1;
    const osdtex_status wrong = OSDTEX_ERROR_ARGUMENT;

    assert_int_equal(osdtex_context_create(NULL, NULL), wrong);
    assert_int_equal(osdtex_cage_read(NULL, "x", NULL, &cage), wrong);
    assert_null(cage);
    assert_int_equal(osdtex_cage_read(context, NULL, NULL, &cage), wrong);
    assert_int_equal(osdtex_cage_read(context, "x", NULL, NULL), wrong);
    assert_int_equal(osdtex_cage_create(context, NULL, NULL, &cage), wrong);
    assert_int_equal(
        osdtex_surface_refine(context, NULL, NULL, &surface), wrong);
    assert_null(surface);
    assert_int_equal(
        osdtex_exemplar_read(context, NULL, NULL, &exemplar), wrong);
    assert_null(exemplar);
    assert_int_equal(
        osdtex_exemplar_create(context, NULL, NULL, &exemplar), wrong);
    assert_int_equal(osdtex_map(context, NULL, NULL, NULL, &mapping), wrong);
    assert_null(mapping);
    assert_int_equal(osdtex_mapping_write(context, NULL, "x", NULL), wrong);
    assert_int_equal(osdtex_report_write(context, NULL, "x"), wrong);
    assert_int_equal(osdtex_model_read(context, NULL, &model), wrong);
    assert_null(model);
    assert_int_equal(osdtex_model_create(context, NULL, &model), wrong);
    assert_int_equal(osdtex_render(context, NULL, NULL, &image), wrong);
    assert_null(image);
    assert_int_equal(
        osdtex_image_create(context, 1, 1, 3, NULL, &image), wrong);
    assert_int_equal(osdtex_image_write(context, NULL, "x.png"), wrong);
    assert_int_equal(osdtex_image_read(context, NULL, &image), wrong);
    assert_null(osdtex_cage_describe(NULL));
    assert_null(osdtex_surface_describe(NULL));
    assert_null(osdtex_exemplar_describe(NULL));
    assert_null(osdtex_mapping_describe(NULL));
    assert_null(osdtex_image_describe(NULL));
    osdtex_cage_destroy(NULL);
    osdtex_surface_destroy(NULL);
    osdtex_exemplar_destroy(NULL);
    osdtex_mapping_destroy(NULL);
    osdtex_model_destroy(NULL);
    osdtex_image_destroy(NULL);
    osdtex_context_destroy(NULL);
}

/* Whoever is destroyed first, what others are made of stays. */
static void
handles_are_destroyed_in_any_order(void **state)
{
    meter m = {.fail_at = -1, .cancel_at = -1};
    const osdtex_context_options options = metered(&m);
    osdtex_render_options render = osdtex_render_options_default();
    osdtex_context *context;
    osdtex_image *again;
    pipe p;

    (void)state;
    render.width = render.height = 16;
    render.samples = 1;
    assert_int_equal(osdtex_context_create(&options, &context), OSDTEX_OK);
    assert_int_equal(pipe_run(context, &p), OSDTEX_OK);
    osdtex_cage_destroy(p.cage);
    osdtex_surface_destroy(p.surface);
    osdtex_exemplar_destroy(p.exemplar);
    osdtex_mapping_destroy(p.mapping);
    assert_int_equal(
        osdtex_render(context, p.model, &render, &again), OSDTEX_OK);
    osdtex_context_destroy(context);
    assert_memory_equal(
        osdtex_image_describe(p.image)->pixels,
        osdtex_image_describe(again)->pixels, 16 * 16 * 4 * sizeof(float));
    osdtex_model_destroy(p.model);
    osdtex_image_destroy(p.image);
    osdtex_image_destroy(again);
    assert_int_equal(m.blocks, 0);
}

static void
the_last_call_says_why_it_failed(void **state)
{
    osdtex_context *context = *state;
    osdtex_cage *cage;

    assert_int_equal(osdtex_context_error(NULL)->status, OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(osdtex_context_error(context)->status, OSDTEX_OK);
    assert_int_equal(
        osdtex_cage_read(context, "no/such.obj", NULL, &cage), OSDTEX_ERROR_IO);
    assert_int_equal(osdtex_context_error(context)->status, OSDTEX_ERROR_IO);
    assert_string_equal(osdtex_context_error(context)->file, "no/such.obj");
    assert_string_not_equal(osdtex_context_error(context)->message, "");
    assert_int_equal(
        osdtex_cage_read(context, cage_path, NULL, &cage), OSDTEX_OK);
    assert_int_equal(osdtex_context_error(context)->status, OSDTEX_OK);
    osdtex_cage_destroy(cage);
}

/* One call from cage and exemplar to a mapping, and none needs options. */
static void
defaults_are_enough(void **state)
{
    osdtex_context *context = *state;
    osdtex_surface *surface;
    osdtex_mapping *mapping;
    osdtex_exemplar *exemplar;
    osdtex_cage *cage;

    assert_int_equal(
        osdtex_cage_read(context, cage_path, NULL, &cage), OSDTEX_OK);
    assert_int_equal(
        osdtex_exemplar_read(context, exemplar_path, NULL, &exemplar),
        OSDTEX_OK);
    assert_int_equal(
        osdtex_surface_refine(context, cage, NULL, &surface), OSDTEX_OK);
    assert_true(osdtex_surface_describe(surface)->level > 0);
    osdtex_surface_destroy(surface);
    assert_int_equal(
        osdtex_map(context, cage, exemplar, NULL, &mapping), OSDTEX_OK);
    osdtex_cage_destroy(cage);
    osdtex_exemplar_destroy(exemplar);
    assert_int_equal(
        osdtex_surface_describe(osdtex_mapping_surface(mapping))->face_count,
        osdtex_mapping_describe(mapping)->face_count);
    osdtex_mapping_destroy(mapping);
    assert_null(osdtex_mapping_surface(NULL));
}

/* A surface is of one cage, and only that cage is mapped with it. */
static void
a_surface_of_another_cage_is_refused(void **state)
{
    osdtex_map_options options = osdtex_map_options_default();
    osdtex_cage_arrays arrays = cube();
    osdtex_mapping *mapping;
    osdtex_cage *other;
    pipe p;

    assert_int_equal(pipe_run(*state, &p), OSDTEX_OK);
    assert_int_equal(
        osdtex_cage_create(*state, &arrays, NULL, &other), OSDTEX_OK);
    options.surface = p.surface;
    assert_int_equal(
        osdtex_map(*state, other, p.exemplar, &options, &mapping),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(
        strstr(osdtex_context_error(*state)->message, "of another one"));
    osdtex_cage_destroy(other);
    pipe_destroy(&p);
}

/* Bindings get the defaults from the library, at whatever length they know. */
static void
exported_defaults_are_those_of_the_header(void **state)
{
    const osdtex_map_options wanted = osdtex_map_options_default();
    osdtex_map_options got;
    size_t shorter = offsetof(osdtex_map_options, first_u);

    (void)state;
    memset(&got, 0xff, sizeof got);
    osdtex_map_options_init(&got, sizeof got);
    assert_memory_equal(&got, &wanted, sizeof got);
    memset(&got, 0xff, sizeof got);
    osdtex_map_options_init(&got, shorter);
    assert_int_equal(got.size, shorter);
    assert_int_equal(got.first_face, -1);
    assert_true(isnan(got.first_u)); /* beyond: untouched */
}

static void
options_without_a_size_are_refused(void **state)
{
    osdtex_cage_options options = {0};
    osdtex_context_options context_options = {0};
    osdtex_cage_arrays arrays = cube();
    osdtex_context *context;
    osdtex_cage *cage;

    assert_int_equal(
        osdtex_cage_create(*state, &arrays, &options, &cage),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        osdtex_context_create(&context_options, &context),
        OSDTEX_ERROR_ARGUMENT);
}

/* A caller that was built against a shorter struct gets the defaults for what
 * it does not know. */
static void
shorter_options_are_completed(void **state)
{
    osdtex_cage_options options = osdtex_cage_options_default();
    osdtex_cage_arrays arrays = cube();
    osdtex_cage *cage;

    options.size = offsetof(osdtex_cage_options, boundary);
    options.scheme = OSDTEX_SCHEME_BILINEAR;
    options.boundary = 99; /* beyond the size: not looked at */
    assert_int_equal(
        osdtex_cage_create(*state, &arrays, &options, &cage), OSDTEX_OK);
    assert_int_equal(
        osdtex_cage_describe(cage)->scheme, OSDTEX_SCHEME_BILINEAR);
    assert_int_equal(
        osdtex_cage_describe(cage)->boundary, OSDTEX_BOUNDARY_EDGE_AND_CORNER);
    osdtex_cage_destroy(cage);
}

static void
a_cube_from_arrays(void **state)
{
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_cage_arrays arrays = cube();
    osdtex_surface *surface;
    const osdtex_surface_info *leaves;
    const osdtex_cage_info *info;
    osdtex_cage *cage;

    assert_int_equal(
        osdtex_cage_create(*state, &arrays, NULL, &cage), OSDTEX_OK);
    info = osdtex_cage_describe(cage);
    assert_int_equal(info->edge_count, 12);
    assert_int_equal(info->quad_count, 6);
    assert_int_equal(info->component_count, 1);
    assert_int_equal(info->boundary_edge_count, 0);
    assert_true(fabs(info->diagonal - 2.0 * sqrt(3.0)) < 1e-6);
    assert_true(fabs(info->default_scale - 0.2 * info->diagonal) < 1e-12);
    assert_null(info->path);
    assert_null(info->hash);
    refine.level = 2;
    assert_int_equal(
        osdtex_surface_refine(*state, cage, &refine, &surface), OSDTEX_OK);
    leaves = osdtex_surface_describe(surface);
    assert_int_equal(leaves->face_count, 6 * 16);
    assert_int_equal(leaves->corner_count, 4 * leaves->face_count);
    for (osdtex_index f = 0; f < leaves->face_count; ++f)
        assert_int_equal(leaves->face_cage[f], f / 16);
    osdtex_surface_destroy(surface);
    osdtex_cage_destroy(cage);
}

static void
bad_arrays_are_refused_with_a_face(void **state)
{
    osdtex_index verts[24];
    osdtex_cage_arrays arrays = cube();
    osdtex_diagnostic d;
    osdtex_cage *cage;

    memcpy(verts, cube_verts, sizeof verts);
    verts[9] = 8;
    arrays.face_verts = verts;
    assert_int_equal(
        osdtex_cage_create(*state, &arrays, NULL, &cage), OSDTEX_ERROR_FORMAT);
    assert_null(cage);
    assert_int_equal(
        osdtex_diagnostic_get(*state, osdtex_diagnostic_count(*state) - 1, &d),
        OSDTEX_OK);
    assert_int_equal(d.severity, OSDTEX_SEVERITY_ERROR);
    assert_int_equal(d.face, 2);
    arrays.points = NULL;
    assert_int_equal(
        osdtex_cage_create(*state, &arrays, NULL, &cage),
        OSDTEX_ERROR_ARGUMENT);
}

static void
findings_are_cleared(void **state)
{
    osdtex_cage *cage;
    osdtex_diagnostic d;

    osdtex_cage_read(*state, "nowhere.obj", NULL, &cage);
    osdtex_cage_read(*state, "nowhere.obj", NULL, &cage);
    assert_int_equal(osdtex_diagnostic_count(*state), 1);
    assert_int_equal(osdtex_diagnostic_get(*state, 0, &d), OSDTEX_OK);
    assert_int_equal(d.count, 2);
    assert_string_equal(d.file, "nowhere.obj");
    assert_int_equal(osdtex_diagnostic_clear(*state), OSDTEX_OK);
    assert_int_equal(osdtex_diagnostic_count(*state), 0);
    assert_int_equal(
        osdtex_diagnostic_get(*state, 0, &d), OSDTEX_ERROR_ARGUMENT);
}

/* The option table and what `osdtex_option_get` says of it agree: the default
 * of every setting can be set, and what is out of range cannot. */
static void
every_setting_takes_its_own_default(void **state)
{
    osdtex_method_info method;
    osdtex_option_info option;

    (void)state;
    assert_true(osdtex_method_count() > 0);
    for (int32_t m = 0; m < osdtex_method_count(); ++m)
    {
        assert_int_equal(osdtex_method_get(m, &method), OSDTEX_OK);
        for (int32_t i = 0; i < method.option_count; ++i)
        {
            assert_int_equal(osdtex_option_get(m, i, &option), OSDTEX_OK);
            assert_true(strlen(option.name) > 0 && strlen(option.help) > 0);
            assert_true(strlen(option.fallback) > 0);
            assert_int_equal(
                option.choices != NULL, option.kind == OSDTEX_OPTION_CHOICE);
        }
        assert_int_equal(
            osdtex_option_get(m, method.option_count, &option),
            OSDTEX_ERROR_ARGUMENT);
    }
    assert_int_equal(osdtex_method_get(-1, &method), OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        osdtex_method_get(osdtex_method_count(), &method),
        OSDTEX_ERROR_ARGUMENT);
}

static void
the_whole_pipe(void **state)
{
    const osdtex_mapping_info *mapping;
    const osdtex_image_info *image;
    pipe p;

    assert_int_equal(pipe_run(*state, &p), OSDTEX_OK);
    mapping = osdtex_mapping_describe(p.mapping);
    for (osdtex_index c = 0; c < 2 * mapping->corner_count; ++c)
        assert_true(isfinite(mapping->uvs[c]));
    for (osdtex_index f = 0; f < mapping->face_count; ++f)
        assert_in_range(mapping->face_patch[f], 0, mapping->patch_count - 1);
    image = osdtex_image_describe(p.image);
    assert_int_equal(image->width, 16);
    assert_int_equal(image->channels, 4);
    pipe_destroy(&p);
}

/* An exemplar from memory maps as one from a file does. */
static void
an_exemplar_from_pixels(void **state)
{
    float pixels[32 * 32 * 3];
    osdtex_image *image;
    osdtex_exemplar *exemplar;

    for (int i = 0; i < 32 * 32 * 3; ++i)
        pixels[i] = (float)((i * 7919) % 101) / 101.0f;
    assert_int_equal(
        osdtex_image_create(*state, 32, 32, 3, pixels, &image), OSDTEX_OK);
    assert_int_equal(
        osdtex_exemplar_create(*state, image, NULL, &exemplar), OSDTEX_OK);
    osdtex_image_destroy(image); /* it was copied */
    assert_memory_equal(
        osdtex_exemplar_describe(exemplar)->pixels, pixels, sizeof pixels);
    osdtex_exemplar_destroy(exemplar);
}

/* Waves of 24 texels that the picture cuts off, with a step along one axis and
 * with none along the other, are cropped to whole ones; a scale goes on meaning
 * the picture that was given. */
static void
a_lattice_is_cropped_to_tile(void **state)
{
    enum
    {
        SIDE = 108
    };
    static float pixels[SIDE * SIDE * 3];
    osdtex_exemplar_options options = osdtex_exemplar_options_default();
    const osdtex_exemplar_info *info;
    osdtex_image *image;
    osdtex_exemplar *exemplar;

    options.tileable = OSDTEX_TILEABLE_AUTO;
    for (int i = 0; i < SIDE * SIDE * 3; ++i)
        pixels[i] =
            (float)(0.3 + 0.1 * cos(i / 3 % SIDE * 0.26179939) + 0.1 * sin(i / 3 / SIDE * 0.26179939));
    assert_int_equal(
        osdtex_image_create(*state, SIDE, SIDE, 3, pixels, &image), OSDTEX_OK);
    assert_int_equal(
        osdtex_exemplar_create(*state, image, &options, &exemplar), OSDTEX_OK);
    info = osdtex_exemplar_describe(exemplar);
    assert_int_equal(info->width, 96);
    assert_int_equal(info->height, 96);
    assert_int_equal(info->source_width, SIDE);
    assert_true(info->wrap_x && info->wrap_y && info->made_tileable);
    osdtex_exemplar_destroy(exemplar);
    osdtex_image_destroy(image);
}

/* Halves come back as they were written, and PNG as integers over 255. */
static void
an_image_is_read_back(void **state)
{
    static const float pixels[] = {0.0f, 0.25f, 4.0f,  1.0f, 0.5f, 0.125f,
                                   2.0f, 0.75f, 0.25f, 0.5f, 0.5f, 0.5f};
    const char *const paths[] = {"test_api_image.exr", "test_api_image.png"};
    osdtex_image *image;

    assert_int_equal(
        osdtex_image_create(*state, 2, 2, 3, pixels, &image), OSDTEX_OK);
    for (int i = 0; i < 2; ++i)
    {
        const osdtex_image_info *back;
        osdtex_image *again;

        assert_int_equal(
            osdtex_image_write(*state, image, paths[i]), OSDTEX_OK);
        assert_int_equal(
            osdtex_image_read(*state, paths[i], &again), OSDTEX_OK);
        remove(paths[i]);
        back = osdtex_image_describe(again);
        assert_int_equal(back->width, 2);
        assert_int_equal(back->channels, 3);
        if (i == 0)
            assert_memory_equal(back->pixels, pixels, sizeof pixels);
        else
            assert_true(
                back->pixels[9] * 255.0f == roundf(back->pixels[9] * 255.0f));
        osdtex_image_destroy(again);
    }
    osdtex_image_destroy(image);
    assert_int_equal(
        osdtex_image_read(*state, paths[0], &image), OSDTEX_ERROR_IO);
    assert_null(image);
}

static const moments MOMENTS = {40, 4};

/* A host's whole job. */
static osdtex_status
run_once(osdtex_context *context)
{
    pipe p;
    const osdtex_status status = pipe_run(context, &p);

    pipe_destroy(&p);
    return status;
}

static void
failing_allocations_leak_nothing(void **state)
{
    (void)state;
    fail_at_moments(&MOMENTS, run_once);
}

static void
cancelling_leaks_nothing(void **state)
{
    (void)state;
    cancel_at_moments(&MOMENTS, run_once);
}

#define WITH_CONTEXT(test)                                                     \
    cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_and_versions),
        WITH_CONTEXT(null_is_an_argument_or_nothing),
        cmocka_unit_test(handles_are_destroyed_in_any_order),
        WITH_CONTEXT(the_last_call_says_why_it_failed),
        WITH_CONTEXT(defaults_are_enough),
        WITH_CONTEXT(a_surface_of_another_cage_is_refused),
        cmocka_unit_test(exported_defaults_are_those_of_the_header),
        WITH_CONTEXT(options_without_a_size_are_refused),
        WITH_CONTEXT(shorter_options_are_completed),
        WITH_CONTEXT(a_cube_from_arrays),
        WITH_CONTEXT(bad_arrays_are_refused_with_a_face),
        WITH_CONTEXT(findings_are_cleared),
        cmocka_unit_test(every_setting_takes_its_own_default),
        WITH_CONTEXT(the_whole_pipe),
        WITH_CONTEXT(an_exemplar_from_pixels),
        WITH_CONTEXT(a_lattice_is_cropped_to_tile),
        WITH_CONTEXT(an_image_is_read_back),
        cmocka_unit_test(failing_allocations_leak_nothing),
        cmocka_unit_test(cancelling_leaks_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_several_api.c -- several exemplars as a host gives them: what is said of
 * the result, what is refused, and heaps and patience that end. */
#include "meter.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum
{
    SIDE = 40,
    MASK = 512,
    FACES = 16 /* of the cage */
};

static const char cage_path[] = "models/cages/plane.obj";

typedef struct pipe
{
    osdtex_cage *cage;
    osdtex_surface *surface;
    osdtex_exemplar *exemplars[2];
    osdtex_mapping *mapping;
    osdtex_model *model;
    uint8_t faces[FACES];
    osdtex_also also[4];
    osdtex_map_options options;
} pipe;

static void
pipe_destroy(pipe *p)
{
    osdtex_model_destroy(p->model);
    osdtex_mapping_destroy(p->mapping);
    for (int k = 0; k < 2; ++k)
        osdtex_exemplar_destroy(p->exemplars[k]);
    osdtex_surface_destroy(p->surface);
    osdtex_cage_destroy(p->cage);
}

static osdtex_status
make_exemplar(
    osdtex_context *context, int kind, const osdtex_exemplar_options *options,
    osdtex_exemplar **out)
{
    static float pixels[SIDE * SIDE * 3];
    osdtex_image *image;
    osdtex_status status;

    for (int i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c)
            pixels[3 * i + c] =
                (float)(0.5 + 0.4 * sin(0.3 * (c + 1) * (i % SIDE) + kind) * cos(0.2 * (kind + 1) * (double)(i / SIDE)));
    status = osdtex_image_create(context, SIDE, SIDE, 3, pixels, &image);
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_create(context, image, options, out);
    osdtex_image_destroy(image);
    return status;
}

/* The left half of the cage's faces in one exemplar, the rest in the other, at
 * a scale of its own. */
static osdtex_status
pipe_begin(
    osdtex_context *context, pipe *p, const osdtex_exemplar_options *second)
{
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_status status;

    *p = (pipe){.options = osdtex_map_options_default()};
    refine.level = 1;
    for (int f = 0; f < FACES; ++f)
        p->faces[f] = f % 4 > 1;
    status = osdtex_cage_read(context, cage_path, NULL, &p->cage);
    if (status == OSDTEX_OK)
        status = osdtex_surface_refine(context, p->cage, &refine, &p->surface);
    for (int k = 0; k < 2 && status == OSDTEX_OK; ++k)
        status =
            make_exemplar(context, k, k == 1 ? second : NULL, &p->exemplars[k]);
    for (int k = 0; k < 4; ++k)
        p->also[k] = (osdtex_also){p->exemplars[1], NULL, 2.5};
    p->options.scale = 2.0;
    p->options.also = p->also;
    p->options.also_count = 1;
    p->options.face_exemplars = p->faces;
    return status;
}

static osdtex_status
pipe_map(osdtex_context *context, pipe *p)
{
    p->options.surface = p->surface;
    return osdtex_map(
        context, p->cage, p->exemplars[0], &p->options, &p->mapping);
}

static osdtex_status
pipe_run(osdtex_context *context, pipe *p)
{
    osdtex_status status = pipe_begin(context, p, NULL);

    if (status == OSDTEX_OK)
        status = pipe_map(context, p);
    if (status == OSDTEX_OK)
        status = osdtex_model_create(context, p->mapping, &p->model);
    return status;
}

/* Maps with no transition: each face shows what is asked for. */
static void
expect_halves(osdtex_context *context, const char *mask)
{
    const osdtex_mapping_info *info;
    const osdtex_surface_info *surface;
    osdtex_setting exact = {"transition", "0"};
    pipe p;

    assert_int_equal(pipe_begin(context, &p, NULL), OSDTEX_OK);
    p.options.settings = &exact;
    p.options.setting_count = 1;
    if (mask)
    {
        /* As large as it is: resizing would leave room for the mask. */
        p.also[0].scale = 0.0;
        p.options.face_exemplars = NULL;
    }
    p.options.mask = mask;
    assert_int_equal(pipe_map(context, &p), OSDTEX_OK);
    info = osdtex_mapping_describe(p.mapping);
    surface = osdtex_surface_describe(p.surface);
    assert_int_equal(info->exemplar_count, 2);
    assert_non_null(info->patch_exemplar);
    for (osdtex_index f = 0; f < info->face_count; ++f)
        assert_int_equal(
            info->patch_exemplar[info->face_patch[f]],
            p.faces[surface->face_cage[f]]);
    pipe_destroy(&p);
}

static void
patches_say_which_they_are_from(void **state)
{
    expect_halves(*state, NULL);
}

/* Red on the right half, as one picture and as that of a tile. The heap spoils
 * what it takes back. */
static void
a_mask_says_where_they_go(void **state)
{
    static float pixels[MASK * MASK * 3];
    meter m = {.fail_at = -1, .cancel_at = -1};
    const osdtex_context_options options = metered(&m);
    osdtex_context *context;
    osdtex_image *image;
    char folder[] = "/tmp/osdtex-mask-XXXXXX", path[64], tiles[64];

    (void)state;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/mask.1001.exr", folder);
    snprintf(tiles, sizeof tiles, "%s/mask.<UDIM>.exr", folder);
    for (int i = 0; i < MASK * MASK; ++i)
        pixels[3 * i] = i % MASK >= MASK / 2 ? 1.0f : 0.0f;
    assert_int_equal(osdtex_context_create(&options, &context), OSDTEX_OK);
    assert_int_equal(
        osdtex_image_create(context, MASK, MASK, 3, pixels, &image), OSDTEX_OK);
    assert_int_equal(osdtex_image_write(context, image, path), OSDTEX_OK);
    osdtex_image_destroy(image);
    expect_halves(context, path);
    expect_halves(context, tiles);
    osdtex_context_destroy(context);
    remove(path);
    remove(folder);
    assert_int_equal(m.blocks, 0);
}

/* The same questions, asked from memory: by a mask and by constraints. */
static void
memory_says_where_they_go(void **state)
{
    static float pixels[MASK * MASK * 3];
    osdtex_constraint at[FACES];
    osdtex_setting exact = {"transition", "0"};
    osdtex_image *image;

    for (int i = 0; i < MASK * MASK; ++i)
        pixels[3 * i] = i % MASK >= MASK / 2 ? 1.0f : 0.0f;
    assert_int_equal(
        osdtex_image_create(*state, MASK, MASK, 3, pixels, &image), OSDTEX_OK);
    for (int way = 0; way < 2; ++way)
    {
        const osdtex_mapping_info *info;
        const osdtex_surface_info *surface;
        pipe p;

        assert_int_equal(pipe_begin(*state, &p, NULL), OSDTEX_OK);
        p.options.settings = &exact;
        p.options.setting_count = 1;
        p.options.face_exemplars = NULL;
        for (int f = 0; f < FACES; ++f)
        {
            at[f] = osdtex_constraint_none();
            at[f].face = f;
            at[f].exemplar = 1 + p.faces[f];
        }
        if (way == 0)
            p.options.mask_image = image;
        else
        {
            p.options.constraint_items = at;
            p.options.constraint_count = FACES;
        }
        assert_int_equal(pipe_map(*state, &p), OSDTEX_OK);
        info = osdtex_mapping_describe(p.mapping);
        surface = osdtex_surface_describe(osdtex_mapping_surface(p.mapping));
        for (osdtex_index f = 0; f < info->face_count; ++f)
            assert_int_equal(
                info->patch_exemplar[info->face_patch[f]],
                p.faces[surface->face_cage[f]]);
        pipe_destroy(&p);
    }
    osdtex_image_destroy(image);
}

static void
one_exemplar_is_said_to_be_one(void **state)
{
    const osdtex_mapping_info *info;
    pipe p;

    assert_int_equal(pipe_begin(*state, &p, NULL), OSDTEX_OK);
    p.options.also_count = 0;
    p.options.face_exemplars = NULL;
    assert_int_equal(pipe_map(*state, &p), OSDTEX_OK);
    info = osdtex_mapping_describe(p.mapping);
    assert_int_equal(info->exemplar_count, 1);
    assert_null(info->patch_exemplar);
    pipe_destroy(&p);
}

static void
expect_refused(
    osdtex_context *context, pipe *p, osdtex_status wanted, const char *words)
{
    osdtex_diagnostic d;

    osdtex_diagnostic_clear(context);
    assert_int_equal(pipe_map(context, p), wanted);
    assert_null(p->mapping);
    assert_int_equal(osdtex_diagnostic_count(context), 1);
    osdtex_diagnostic_get(context, 0, &d);
    if (!strstr(d.message, words))
        fail_msg("'%s' is not in: %s", words, d.message);
}

static void
what_cannot_be_is_refused(void **state)
{
    pipe p;

    assert_int_equal(pipe_begin(*state, &p, NULL), OSDTEX_OK);
    p.options.also_count = 4;
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "takes up to 4");
    p.options.also_count = -1;
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "none are given");
    p.options.also_count = 1;
    p.also[0].scale = NAN;
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "exemplar 2");
    p.also[0].scale = 1e9;
    expect_refused(*state, &p, OSDTEX_ERROR_LIMIT, "texels");
    p.also[0].scale = 1e-3;
    expect_refused(*state, &p, OSDTEX_ERROR_LIMIT, "too few");
    p.also[0].scale = 0.0;
    p.faces[7] = 2;
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "face 7");
    p.faces[7] = 0;
    p.options.face_exemplars = NULL;
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "nothing says where");
    p.also[0].exemplar = NULL;
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "missing");
    pipe_destroy(&p);
}

static void
exemplars_of_two_spaces_are_refused(void **state)
{
    osdtex_exemplar_options options = osdtex_exemplar_options_default();
    pipe p;

    options.embedding = OSDTEX_EMBEDDING_LAB;
    assert_int_equal(pipe_begin(*state, &p, &options), OSDTEX_OK);
    expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "cannot be compared");
    pipe_destroy(&p);
    options = osdtex_exemplar_options_default();
    options.to = "ACEScg";
    assert_int_equal(pipe_begin(*state, &p, &options), OSDTEX_OK);
    if (strcmp(
            osdtex_exemplar_describe(p.exemplars[0])->linear_space,
            osdtex_exemplar_describe(p.exemplars[1])->linear_space) != 0)
        expect_refused(*state, &p, OSDTEX_ERROR_ARGUMENT, "two spaces");
    pipe_destroy(&p);
}

static const moments MOMENTS = {20, 3};

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

#define WITH_CONTEXT(test)                                                     \
    cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int
main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_CONTEXT(patches_say_which_they_are_from),
        cmocka_unit_test(a_mask_says_where_they_go),
        WITH_CONTEXT(memory_says_where_they_go),
        WITH_CONTEXT(one_exemplar_is_said_to_be_one),
        WITH_CONTEXT(what_cannot_be_is_refused),
        WITH_CONTEXT(exemplars_of_two_spaces_are_refused),
        cmocka_unit_test(failing_allocations_leak_nothing),
        cmocka_unit_test(cancelling_leaks_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

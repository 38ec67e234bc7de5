/* test_edit_api.c -- mappings made from others outlive them, with what was
 * placed over those. */
#include "meter.h"

#include <stdio.h>
#include <unistd.h>

enum
{
    SIDE = 48
};

/* A host whose memory is wiped when it is given back. */
typedef struct scene
{
    meter heap;
    osdtex_context *context;
    osdtex_cage *cage;
    osdtex_exemplar *exemplar;
    osdtex_mapping *mapping; /* with a picture over it */
    char place[40];
} scene;

static int
set_up(void **state)
{
    scene *s = calloc(1, sizeof *s);
    osdtex_map_options map = osdtex_map_options_default();
    char picture[4096];
    FILE *file;

    assert_non_null(s);
    s->heap = (meter){.fail_at = -1, .cancel_at = -1};
    strcpy(s->place, "/tmp/osdtex_placeXXXXXX");
    file = fdopen(mkstemp(s->place), "w");
    assert_non_null(file);
    assert_non_null(realpath("models/exemplars/bricks_tile.png", picture));
    fprintf(
        file,
        "{\"placed\": [{\"picture\": \"%s\", \"point\": [0, 0, 0], "
        "\"width\": 2}]}",
        picture);
    fclose(file);

    const osdtex_context_options how = metered(&s->heap);

    assert_int_equal(osdtex_context_create(&how, &s->context), OSDTEX_OK);
    assert_int_equal(
        osdtex_cage_read(s->context, "models/cages/plane.obj", NULL, &s->cage),
        OSDTEX_OK);
    assert_int_equal(
        osdtex_exemplar_read(
            s->context, "models/exemplars/gravel_tile.png", NULL, &s->exemplar),
        OSDTEX_OK);
    map.level = 1;
    map.place = s->place;
    if (osdtex_map(s->context, s->cage, s->exemplar, &map, &s->mapping) !=
        OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(s->context)->message);
    *state = s;
    return 0;
}

static int
tear_down(void **state)
{
    scene *s = *state;

    osdtex_mapping_destroy(s->mapping);
    osdtex_exemplar_destroy(s->exemplar);
    osdtex_cage_destroy(s->cage);
    osdtex_context_destroy(s->context);
    assert_int_equal(s->heap.blocks, 0);
    unlink(s->place);
    free(s);
    return 0;
}

/* What a mapping looks like, 3 floats a pixel, to be freed. */
static float *
picture_of(osdtex_context *context, const osdtex_mapping *mapping)
{
    const size_t bytes = SIDE * SIDE * 4 * sizeof(float);
    osdtex_render_options options = osdtex_render_options_default();
    osdtex_model *model;
    osdtex_image *image;
    float *pixels = malloc(bytes);

    assert_non_null(pixels);
    options.width = options.height = SIDE;
    options.samples = 1;
    options.unlit = 1;
    options.view = "front";
    assert_int_equal(osdtex_model_create(context, mapping, &model), OSDTEX_OK);
    assert_int_equal(
        osdtex_render(context, model, &options, &image), OSDTEX_OK);
    assert_int_equal(osdtex_image_describe(image)->channels, 4);
    memcpy(pixels, osdtex_image_describe(image)->pixels, bytes);
    osdtex_image_destroy(image);
    osdtex_model_destroy(model);
    return pixels;
}

/* Looks the same when the mapping that it was made from has gone. */
static void
check_outlives(scene *s, osdtex_mapping *made)
{
    const size_t bytes = SIDE * SIDE * 4 * sizeof(float);
    float *before = picture_of(s->context, made), *after;

    osdtex_mapping_destroy(s->mapping);
    s->mapping = NULL;
    after = picture_of(s->context, made);
    assert_memory_equal(before, after, bytes);
    free(before);
    free(after);
    osdtex_mapping_destroy(made);
}

static void
a_kept_mapping_outlives_the_first(void **state)
{
    scene *s = *state;
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_mapping *kept;

    map.keep = s->mapping;
    assert_int_equal(
        osdtex_map(s->context, s->cage, s->exemplar, &map, &kept), OSDTEX_OK);
    check_outlives(s, kept);
}

static void
an_edited_mapping_outlives_the_first(void **state)
{
    scene *s = *state;
    osdtex_edit_options options = osdtex_edit_options_default();
    osdtex_constraint redo = osdtex_constraint_none();
    osdtex_mapping *one, *two;

    redo.face = 1;
    redo.redo = 1;
    redo.reach = 0.5;
    options.constraint_items = &redo;
    options.constraint_count = 1;
    assert_int_equal(
        osdtex_mapping_edit(s->context, s->mapping, &options, &one), OSDTEX_OK);
    assert_int_equal(
        osdtex_mapping_edit(s->context, one, &options, &two), OSDTEX_OK);
    osdtex_mapping_destroy(one);
    check_outlives(s, two);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(
            a_kept_mapping_outlives_the_first, set_up, tear_down),
        cmocka_unit_test_setup_teardown(
            an_edited_mapping_outlives_the_first, set_up, tear_down),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

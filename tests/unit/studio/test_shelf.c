/* test_shelf.c -- which mapping a recipe is found by, and is an edit of. */
#include "support.h"

#include "studio/shelf.h"

#include <osdtex/osdtex.h>

/* A mapping of a quad, for things to be kept. */
typedef struct scene
{
    osdtex_context *context;
    osdtex_cage *cage;
    osdtex_exemplar *exemplar;
    otx_outcome *outcome;
    otx_shelf shelf;
} scene;

static int
set_up(void **state)
{
    static const float points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const osdtex_index sizes[] = {4}, verts[] = {0, 1, 2, 3};
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();
    osdtex_map_options options = osdtex_map_options_default();
    float pixels[64 * 64 * 3];
    osdtex_image *image;
    osdtex_mapping *mapping;
    scene *s = calloc(1, sizeof *s);

    assert_non_null(s);
    arrays.vert_count = 4;
    arrays.face_count = 1;
    arrays.points = points;
    arrays.face_sizes = sizes;
    arrays.face_verts = verts;
    for (int i = 0; i < 64 * 64 * 3; ++i)
        pixels[i] = (float)(i * 37 % 101) / 101.0f;
    options.level = 1;
    assert_int_equal(osdtex_context_create(NULL, &s->context), OSDTEX_OK);
    assert_int_equal(
        osdtex_cage_create(s->context, &arrays, NULL, &s->cage), OSDTEX_OK);
    assert_int_equal(
        osdtex_image_create(s->context, 64, 64, 3, pixels, &image), OSDTEX_OK);
    assert_int_equal(
        osdtex_exemplar_create(s->context, image, NULL, &s->exemplar),
        OSDTEX_OK);
    osdtex_image_destroy(image);
    assert_int_equal(
        osdtex_map(s->context, s->cage, s->exemplar, &options, &mapping),
        OSDTEX_OK);
    assert_int_equal(
        otx_outcome_make(s->context, mapping, NULL, &s->outcome), OSDTEX_OK);
    *state = s;
    return 0;
}

static int
tear_down(void **state)
{
    scene *s = *state;

    otx_shelf_free(&s->shelf);
    otx_outcome_release(s->outcome);
    osdtex_exemplar_destroy(s->exemplar);
    osdtex_cage_destroy(s->cage);
    osdtex_context_destroy(s->context);
    free(s);
    return 0;
}

static json_t *
recipe_of(int seed, const char *list)
{
    json_t *recipe = json_pack(
        "{s:i, s:{s:o}}", "seed", seed, "constraints", "constraints",
        json_loads(list, 0, NULL));

    assert_non_null(recipe);
    return recipe;
}

static void
put(scene *s, int seed, const char *list)
{
    json_t *recipe = recipe_of(seed, list);

    otx_shelf_put(&s->shelf, recipe, s->outcome);
    json_decref(recipe);
}

/* How many constraints are an edit of something kept; 0 none. */
static int
rest_of(scene *s, int seed, const char *list)
{
    json_t *recipe = recipe_of(seed, list), *rest = NULL;
    otx_outcome *base = otx_shelf_base(&s->shelf, recipe, &rest);
    const int count = (int)json_array_size(rest);

    assert_int_equal(base != NULL, rest != NULL);
    json_decref(recipe);
    json_decref(rest);
    return count;
}

static bool
is_found(scene *s, int seed, const char *list)
{
    json_t *recipe = recipe_of(seed, list);
    const bool is_there = otx_shelf_find(&s->shelf, recipe) != NULL;

    json_decref(recipe);
    return is_there;
}

static void
test_finds(void **state)
{
    scene *s = *state;

    put(s, 1, "[]");
    put(s, 1, "[{\"face\": 0, \"scale\": 2}]");
    assert_true(is_found(s, 1, "[]"));
    assert_true(is_found(s, 1, "[{\"face\": 0, \"scale\": 2}]"));
    assert_false(is_found(s, 2, "[]"));
    for (int i = 0; i < 2 * OTX_SHELF_MOST; ++i)
        put(s, 10 + i, "[]");
    assert_int_equal(s->shelf.count, OTX_SHELF_MOST);
    assert_false(is_found(s, 1, "[]"));
    assert_true(is_found(s, 9 + 2 * OTX_SHELF_MOST, "[]"));
}

static void
test_edits(void **state)
{
    scene *s = *state;

    put(s, 1, "[]");
    assert_int_equal(rest_of(s, 1, "[]"), 0);
    assert_int_equal(rest_of(s, 1, "[{\"face\": 0}]"), 0);
    assert_int_equal(rest_of(s, 2, "[{\"edit\": 1}]"), 0);
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 1}]"), 1);
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 1}, {\"edit\": 1}]"), 2);
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 1}, {\"edit\": 2}]"), 0);
    put(s, 1, "[{\"edit\": 1}]");
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 1}, {\"edit\": 2}]"), 1);
    /* What has a smaller number comes before what is there. */
    put(s, 1, "[{\"edit\": 3}]");
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 3}, {\"edit\": 2}]"), 0);
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 3}, {\"edit\": 4}]"), 1);
    assert_int_equal(rest_of(s, 1, "[{\"edit\": 3}, {\"edit\": 5}]"), 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_finds, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_edits, set_up, tear_down)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_recipe.c -- what a recipe says, and the past of them. */
#include "support.h"

#include "studio/past.h"
#include "studio/recipe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char GOOD[] =
    "{\"exemplar\": 1, \"seed\": 7, \"scale\": 2.5, "
    "\"first-patch\": [3, 0.25, 0.5, 90], \"exemplar-class\": \"lattice\", "
    "\"constraints\": {}}";

static json_t *
parse(const char *text)
{
    char error[OTX_STUDIO_ERROR_BYTES] = "";
    json_t *recipe = otx_recipe_parse(text, strlen(text), 2, error);

    assert_true(recipe || strlen(error) > 10);
    return recipe;
}

static void
test_options(void **state)
{
    osdtex_map_options options = osdtex_map_options_default();
    json_t *recipe = parse(GOOD);

    (void)state;
    assert_non_null(recipe);
    otx_recipe_apply(recipe, &options);
    assert_int_equal(otx_recipe_exemplar(recipe), 1);
    assert_int_equal(options.seed, 7);
    assert_true(options.scale == 2.5);
    assert_int_equal(options.first_face, 3);
    assert_true(options.first_v == 0.5);
    assert_true(fabs(options.first_angle - 1.5707963) < 1e-6);
    assert_string_equal(options.exemplar_class, "lattice");
    json_decref(recipe);
}

/* What the options say, said as a recipe, says the same. */
static void
test_first(void **state)
{
    osdtex_map_options options = osdtex_map_options_default();
    osdtex_map_options again = osdtex_map_options_default();
    json_t *recipe;
    char *text;

    (void)state;
    options.seed = 5;
    options.first_face = 2;
    options.first_angle = 0.5;
    recipe = otx_recipe_first(&options);
    text = json_dumps(recipe, 0);
    json_decref(recipe);
    recipe = parse(text);
    assert_non_null(recipe);
    otx_recipe_apply(recipe, &again);
    assert_int_equal(again.seed, 5);
    assert_int_equal(again.first_face, 2);
    assert_true(fabs(again.first_angle - 0.5) < 1e-12);
    json_decref(recipe);
    free(text);
}

/* Every prefix is refused, and so is every byte that is another one, or what it
 * gives is a recipe. */
static void
test_prefixes(void **state)
{
    char text[sizeof GOOD];

    (void)state;
    for (size_t n = 0; n + 1 < sizeof GOOD; ++n)
    {
        memcpy(text, GOOD, n);
        text[n] = '\0';
        assert_null(parse(text));
    }
    for (size_t i = 0; i + 1 < sizeof GOOD; ++i)
    {
        memcpy(text, GOOD, sizeof GOOD);
        text[i] = '9';
        json_decref(parse(text));
    }
}

static void
test_history(void **state)
{
    otx_past h = {0};

    (void)state;
    assert_null(otx_past_now(&h));
    for (int i = 0; i < 2 * OTX_PAST_MOST; ++i)
        otx_past_push(&h, json_integer(i));
    assert_int_equal(h.count, OTX_PAST_MOST);
    assert_false(otx_past_step(&h, 1));
    assert_true(otx_past_step(&h, -1));
    assert_int_equal(
        json_integer_value(otx_past_now(&h)), 2 * OTX_PAST_MOST - 2);
    assert_true(otx_past_has(&h, 1));
    otx_past_push(&h, json_integer(-1));
    assert_false(otx_past_has(&h, 1));
    assert_int_equal(h.revision, 2 * OTX_PAST_MOST + 2);
    while (otx_past_step(&h, -1))
        ;
    assert_int_equal(json_integer_value(otx_past_now(&h)), OTX_PAST_MOST);
    otx_past_free(&h);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options), cmocka_unit_test(test_first),
        cmocka_unit_test(test_prefixes), cmocka_unit_test(test_history)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

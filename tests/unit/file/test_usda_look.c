/* test_usda_look.c -- whatever maps there are, everything that is connected is
 * there, and names survive. */
#include "folder.h"

#include "file/usda_look.h"

static const char *const NAMES[] = {"wood", "old wood", "3"};
static const int32_t FACES[] = {0, 1, 2};

/* The look of a model called "m"; bit i of `maps` says whether map i is there.
 */
static otx_usda
look_with(uint32_t maps)
{
    return (otx_usda){
        .texture = "c.exr",
        .interop_id = maps & 64 ? "srgb_rec709_scene" : "lin_ap1_scene",
        .materialx = maps & 32 ? "m.mtlx" : NULL,
        .materials = {3, NAMES, maps & 128 ? FACES : NULL},
        .maps = {
            .normal = maps & 1 ? "n.exr" : NULL,
            .roughness = maps & 2 ? "r.exr" : NULL,
            .metalness = maps & 4 ? "me.exr" : NULL,
            .height = maps & 8 ? "h.exr" : NULL,
            .occlusion = maps & 16 ? "o.exr" : NULL}};
}

static char *
written(test_file *f, const otx_usda *usda)
{
    otx_text_out *out;

    assert_int_equal(
        otx_text_out_open(f->run, "test", f->path, NULL, &out), OSDTEX_OK);
    assert_true(otx_usda_look_write(f->run, out, usda, "m"));
    assert_int_equal(otx_text_out_close(f->run, out), OSDTEX_OK);
    return test_read_text(f->run, f->path);
}

static int32_t
count_of(const char *text, const char *part)
{
    int32_t count = 0;

    for (const char *at = strstr(text, part); at; at = strstr(at + 1, part))
        ++count;
    return count;
}

/* The block of a prim: from its name to the brace that ends it. */
static const char *
block_of(const char *text, const char *head, size_t *length)
{
    const char *at = strstr(text, head);
    int depth = 0;

    *length = 0;
    assert_non_null(at);
    for (const char *c = strchr(at, '{'); c && *c; ++c)
    {
        depth += *c == '{' ? 1 : *c == '}' ? -1 : 0;
        if (depth == 0)
        {
            *length = (size_t)(c - at);
            return at;
        }
    }
    fail_msg("%s does not end", head);
    return NULL;
}

/* </m/Look/PRIM.outputs:NAME> is an output of such a shader. */
static void
check_connection(const char *text, const char *target)
{
    char prim[64], output[64], head[80], line[96];
    size_t length;
    const char *block, *found;

    if (sscanf(target, "</m/Look/%63[^.].outputs:%63[^>]>", prim, output) != 2)
        fail_msg("%.60s leads nowhere", target);
    snprintf(head, sizeof head, "def Shader \"%s\"", prim);
    snprintf(line, sizeof line, " outputs:%s\n", output);
    block = block_of(text, head, &length);
    found = strstr(block, line);
    if (!found || found > block + length)
        fail_msg("%s has no output %s", prim, output);
}

static void
what_is_connected_is_there(void **state)
{
    test_file *f = *state;

    for (uint32_t maps = 0; maps < 256; ++maps)
    {
        const otx_usda usda = look_with(maps);
        const char *text = written(f, &usda);

        assert_int_equal(count_of(text, "{"), count_of(text, "}"));
        assert_int_equal(count_of(text, "("), count_of(text, ")"));
        for (const char *at = strstr(text, ".connect = "); at;
             at = strstr(at + 1, ".connect = "))
            check_connection(text, strchr(at, '<'));
        assert_int_equal(
            count_of(text, "        token outputs:displacement.connect = "),
            (maps & 8) != 0);
        /* Each texture once, and each looked up by the one reader. */
        assert_int_equal(
            count_of(text, "\"UsdUVTexture\""),
            1 + __builtin_popcount(maps & 31));
        assert_int_equal(
            count_of(text, "</m/Look/Reader.outputs:result>"),
            1 + __builtin_popcount(maps & 31));
    }
}

static void
numbers_are_not_taken_for_colours(void **state)
{
    test_file *f = *state;
    const otx_usda linear = look_with(31), encoded = look_with(31 | 64);
    const char *text = written(f, &linear);

    assert_int_equal(count_of(text, "sourceColorSpace = \"raw\""), 6);
    assert_int_equal(count_of(text, "colorSpace = \"lin_ap1_scene\""), 1);
    text = written(f, &encoded);
    assert_int_equal(count_of(text, "sourceColorSpace = \"raw\""), 5);
    assert_int_equal(count_of(text, "sourceColorSpace = \"sRGB\""), 1);
    /* Only normals are made vectors of. */
    assert_int_equal(count_of(text, "inputs:bias = (-1, -1, -1, 0)"), 1);
}

static void
what_has_no_map_has_a_value(void **state)
{
    test_file *f = *state;
    const otx_usda without = look_with(0), with = look_with(2);

    assert_int_equal(
        count_of(written(f, &without), "float inputs:roughness = 0.5"), 1);
    assert_int_equal(count_of(written(f, &with), "inputs:roughness = 0.5"), 0);
}

static void
names_of_files_survive(void **state)
{
    test_file *f = *state;
    otx_usda usda = look_with(0);

    usda.texture = "a@b.exr";
    assert_int_equal(count_of(written(f, &usda), "= @@@a@b.exr@@@"), 1);
    usda.texture = "a@@@b.exr";
    assert_int_equal(count_of(written(f, &usda), "= @@@a\\@@@b.exr@@@"), 1);
    usda.texture = "a.<UDIM>.exr";
    assert_int_equal(count_of(written(f, &usda), "= @a.<UDIM>.exr@"), 1);
}

/* Materials of the cage are identifiers, no two alike, and have the look. */
static void
materials_have_all_of_the_look(void **state)
{
    test_file *f = *state;
    const otx_usda usda = look_with(128);
    const char *text = written(f, &usda);

    assert_int_equal(count_of(text, "prepend inherits = </m/Look>"), 3);
    for (int32_t i = 0; i < 3; ++i)
    {
        const char *name =
            otx_usda_look_material(f->run->arena, &usda.materials, i);
        char head[128];

        snprintf(head, sizeof head, "def Material \"%s\"", name);
        assert_int_equal(count_of(text, head), 1);
        assert_int_equal(
            strspn(
                name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                      "0123456789_"),
            strlen(name));
    }
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_file_setup, test_file_teardown)
    const struct CMUnitTest tests[] = {
        TEST(what_is_connected_is_there),
        TEST(numbers_are_not_taken_for_colours),
        TEST(what_has_no_map_has_a_value),
        TEST(names_of_files_survive),
        TEST(materials_have_all_of_the_look),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

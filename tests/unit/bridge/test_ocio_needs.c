/* test_ocio_needs.c -- all that a configuration depends on is named: its text,
 * variables, and tables, also those that others refer to. */
#include "folder.h"

#include "bridge/ocio.h"

enum
{
    NEEDS_MAX = 64,
    TEXT_BYTES = 512
};

/* What was visited, in its order; long texts are cut off. */
typedef struct needs
{
    int32_t count;
    otx_ocio_need kinds[NEEDS_MAX];
    char texts[NEEDS_MAX][TEXT_BYTES];
} needs;

static void
note(void *user, otx_ocio_need need, const char *text)
{
    needs *n = user;

    assert_true(n->count < NEEDS_MAX);
    n->kinds[n->count] = need;
    snprintf(n->texts[n->count++], TEXT_BYTES, "%s", text);
}

/* Tables in a transform of a space, in a group, and in a look. */
static const char CONFIG[] =
    "ocio_profile_version: 2\n"
    "search_path: .\n"
    "roles:\n"
    "  default: a\n"
    "  scene_linear: a\n"
    "displays:\n"
    "  d:\n"
    "    - !<View> {name: v, colorspace: a}\n"
    "active_displays: []\n"
    "active_views: []\n"
    "looks:\n"
    "  - !<Look>\n"
    "    name: warm\n"
    "    process_space: a\n"
    "    transform: !<FileTransform> {src: look.spi1d}\n"
    "colorspaces:\n"
    "  - !<ColorSpace>\n"
    "    name: a\n"
    "  - !<ColorSpace>\n"
    "    name: b\n"
    "    to_scene_reference: !<FileTransform> {src: \"${SHOT}.ctf\"}\n"
    "  - !<ColorSpace>\n"
    "    name: c\n"
    "    from_scene_reference: !<GroupTransform>\n"
    "      children:\n"
    "        - !<MatrixTransform> {offset: [1, 0, 0, 0]}\n"
    "        - !<FileTransform> {src: none.spi1d}\n";

static const char TABLE[] =
    "<?xml version=\"1.0\"?>\n"
    "<ProcessList id=\"x\" version=\"2.0\">\n"
    "<Reference path=\"a&amp;b.ctf\" inBitDepth=\"32f\"/>\n"
    "</ProcessList>\n";

static void
put(const test_folder *folder, const char *name, const char *text)
{
    test_write_bytes(
        test_path(folder, name), (const uint8_t *)text, strlen(text));
}

/* Visits a configuration beside which some of its tables are. */
static void
visit(const test_folder *folder, needs *out)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio;

    put(folder, "config.ocio", CONFIG);
    put(folder, "s1.ctf", TABLE);
    put(folder, "a&b.ctf", "<ProcessList/>");
    put(folder, "look.spi1d", "Version 1\n");
    setenv("SHOT", "s1", 1);
    if (otx_ocio_open(test_path(folder, "config.ocio"), &ocio, message) !=
        OSDTEX_OK)
        fail_msg("%s", message);
    out->count = 0;
    assert_int_equal(otx_ocio_visit_needs(ocio, note, out, message), OSDTEX_OK);
    assert_string_equal(message, "");
    otx_ocio_close(ocio);
}

static int32_t
count_of(const needs *n, otx_ocio_need kind, const char *text)
{
    int32_t count = 0;

    for (int32_t i = 0; i < n->count; ++i)
        count +=
            n->kinds[i] == kind && (!text || strcmp(n->texts[i], text) == 0);
    return count;
}

static void
all_that_it_depends_on_is_named(void **state)
{
    const test_folder folder = test_folder_create();
    static needs n;

    (void)state;
    visit(&folder, &n);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_TEXT, NULL), 2);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_VARIABLE, "SHOT=s1"), 1);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_NAME, "${SHOT}.ctf"), 1);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_NAME, "look.spi1d"), 1);
    /* Named, and not there. */
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_NAME, "none.spi1d"), 1);
    /* Of another table, whose name is escaped there. */
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_NAME, "a&b.ctf"), 1);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_NAME, NULL), 4);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_FILE, NULL), 3);
    for (int32_t i = 0; i < n.count; ++i)
        if (n.kinds[i] == OTX_OCIO_NEED_FILE)
            assert_int_equal(access(n.texts[i], R_OK), 0);
    test_folder_remove(&folder);
}

/* Jobs are compared by hashes of this. */
static void
the_order_is_always_the_same(void **state)
{
    const test_folder folder = test_folder_create();
    static needs a, b;

    (void)state;
    visit(&folder, &a);
    visit(&folder, &b);
    assert_int_equal(a.count, b.count);
    for (int32_t i = 0; i < a.count; ++i)
    {
        assert_int_equal(a.kinds[i], b.kinds[i]);
        assert_string_equal(a.texts[i], b.texts[i]);
    }
    test_folder_remove(&folder);
}

static void
the_one_built_in_needs_no_files(void **state)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio *ocio;
    static needs n;

    (void)state;
    n.count = 0;
    assert_int_equal(otx_ocio_open_builtin(&ocio, message), OSDTEX_OK);
    assert_int_equal(otx_ocio_visit_needs(ocio, note, &n, message), OSDTEX_OK);
    assert_int_equal(count_of(&n, OTX_OCIO_NEED_TEXT, NULL), 2);
    assert_int_equal(n.count, 2);
    otx_ocio_close(ocio);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_that_it_depends_on_is_named),
        cmocka_unit_test(the_order_is_always_the_same),
        cmocka_unit_test(the_one_built_in_needs_no_files),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

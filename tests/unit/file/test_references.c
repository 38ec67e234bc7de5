/* test_references.c -- an OBJ names libraries, and these name maps. */
#include "folder.h"

#include "file/references.h"

typedef struct visited
{
    int32_t count;
    char names[16][64]; /* without the folder */
} visited;

static void
visit(void *user, const char *path)
{
    visited *v = user;

    assert_in_range(v->count, 0, 15);
    snprintf(v->names[v->count++], 64, "%s", strrchr(path, '/') + 1);
}

static void
put(const test_folder *folder, const char *name, const char *text)
{
    test_write_bytes(
        test_path(folder, name), (const uint8_t *)text, strlen(text));
}

static bool
has(const visited *v, const char *name)
{
    for (int32_t i = 0; i < v->count; ++i)
        if (strcmp(v->names[i], name) == 0)
            return true;
    return false;
}

static visited
look(const test_folder *folder, const char *name)
{
    visited v = {0};

    assert_int_equal(
        otx_references_visit(test_path(folder, name), visit, &v), OSDTEX_OK);
    return v;
}

static void
libraries_and_their_maps_are_visited(void **state)
{
    const test_folder folder = test_folder_create();
    visited v;

    (void)state;
    put(&folder, "a.obj", "v 0 0 0\nmtllib a.mtl not_there.mtl\nf 1 1 1\n");
    put(&folder, "a.mtl",
        "newmtl m\nmap_Kd -s 1 1 1 wood.png\nmap_Bump two words.png\n"
        "map_Ks not_there.png\n");
    put(&folder, "wood.png", "");
    put(&folder, "two words.png", "");
    put(&folder, "other.png", "");
    v = look(&folder, "a.obj");
    assert_true(has(&v, "a.obj") && has(&v, "a.mtl"));
    assert_true(has(&v, "wood.png") && has(&v, "two words.png"));
    assert_false(has(&v, "other.png") || has(&v, "not_there.png"));
    assert_false(has(&v, "not_there.mtl"));
    v = look(&folder, "a.mtl");
    assert_true(has(&v, "wood.png"));
    assert_false(has(&v, "a.obj"));
    test_folder_remove(&folder);
}

static void
a_pattern_stands_for_its_tiles(void **state)
{
    const test_folder folder = test_folder_create();
    visited v;

    (void)state;
    put(&folder, "a.mtl", "newmtl m\nmap_Kd wood.<UDIM>.png\n");
    put(&folder, "wood.1001.png", "");
    put(&folder, "wood.1012.png", "");
    put(&folder, "wool.1001.png", "");
    v = look(&folder, "a.mtl");
    assert_true(has(&v, "wood.1001.png") && has(&v, "wood.1012.png"));
    assert_false(has(&v, "wool.1001.png"));
    test_folder_remove(&folder);
}

static void
what_is_not_there_names_nothing(void **state)
{
    const test_folder folder = test_folder_create();

    (void)state;
    assert_int_equal(look(&folder, "a.obj").count, 0);
    test_folder_remove(&folder);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(libraries_and_their_maps_are_visited),
        cmocka_unit_test(a_pattern_stands_for_its_tiles),
        cmocka_unit_test(what_is_not_there_names_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_door.c -- who is let in. */
#include "support.h"

#include "studio/door.h"

#include <string.h>

static otx_door
door_at(uint16_t port)
{
    otx_door door = {.port = port};

    assert_true(otx_door_make(&door));
    return door;
}

static void
test_tokens_differ(void **state)
{
    const otx_door a = door_at(1), b = door_at(1);

    (void)state;
    assert_int_equal(strlen(a.token), OTX_DOOR_TOKEN_BYTES - 1);
    assert_int_equal(
        strspn(a.token, "0123456789abcdef"), OTX_DOOR_TOKEN_BYTES - 1);
    assert_string_not_equal(a.token, b.token);
}

static void
test_paths(void **state)
{
    const otx_door door = door_at(1);
    char url[128];

    (void)state;
    snprintf(url, sizeof url, "/%s/main.js", door.token);
    assert_string_equal(otx_door_path(&door, url), "main.js");
    snprintf(url, sizeof url, "/%s/", door.token);
    assert_string_equal(otx_door_path(&door, url), "");
    snprintf(url, sizeof url, "/%s", door.token);
    assert_null(otx_door_path(&door, url));
    snprintf(url, sizeof url, "//%s/", door.token);
    assert_null(otx_door_path(&door, url));
    for (size_t i = 1; i < OTX_DOOR_TOKEN_BYTES; ++i)
    {
        snprintf(url, sizeof url, "/%s/", door.token);
        url[i] = 'x';
        assert_null(otx_door_path(&door, url));
    }
    assert_null(otx_door_path(&door, ""));
    assert_null(otx_door_path(&door, "/"));
}

static void
test_names(void **state)
{
    static const otx_door_names OURS[] = {
        {"127.0.0.1:8080", NULL, NULL},
        {"localhost:8080", "http://localhost:8080", "same-origin"},
        {"127.0.0.1:8080", NULL, "none"}};
    static const otx_door_names OTHERS[] = {
        {NULL, NULL, NULL},
        {"127.0.0.1", NULL, NULL},
        {"127.0.0.1:80800", NULL, NULL},
        {"evil:8080", NULL, NULL},
        {"127.0.0.1:8080", "http://evil", NULL},
        {"127.0.0.1:8080", "", NULL},
        {"127.0.0.1:8080", NULL, "cross-site"}};
    const otx_door door = door_at(8080);

    (void)state;
    for (size_t i = 0; i < sizeof OURS / sizeof *OURS; ++i)
        assert_true(otx_door_is_ours(&door, &OURS[i]));
    for (size_t i = 0; i < sizeof OTHERS / sizeof *OTHERS; ++i)
        assert_false(otx_door_is_ours(&door, &OTHERS[i]));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tokens_differ), cmocka_unit_test(test_paths),
        cmocka_unit_test(test_names)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}

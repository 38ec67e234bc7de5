/* test_hash.c -- known hashes, and files like memory. */
#include "support.h"

#include "base/hash.h"

#include <stdlib.h>
#include <unistd.h>

static void
empty_and_known(void **state)
{
    char text[OTX_HASH_TEXT_BYTES];

    (void)state;
    /* From the test vectors of xxHash. */
    otx_hash_text("", 0, text);
    assert_string_equal(text, "99aa06d3014798d86001c324468d497f");
}

static void
a_file_hashes_like_its_bytes(void **state)
{
    enum
    {
        BYTES = 100000
    };
    char path[] = "/tmp/osdtex_hash_XXXXXX";
    char of_file[OTX_HASH_TEXT_BYTES], of_memory[OTX_HASH_TEXT_BYTES];
    char *bytes = malloc(BYTES);
    const int descriptor = mkstemp(path);

    (void)state;
    for (int i = 0; i < BYTES; ++i)
        bytes[i] = (char)(i * 7 + i / 300);
    assert_int_equal(write(descriptor, bytes, BYTES), BYTES);
    close(descriptor);
    otx_hash_text(bytes, BYTES, of_memory);
    assert_true(otx_hash_file(path, of_file));
    assert_string_equal(of_file, of_memory);
    unlink(path);
    free(bytes);
}

static void
what_is_no_file_has_none(void **state)
{
    char text[OTX_HASH_TEXT_BYTES];

    (void)state;
    assert_false(otx_hash_file("/tmp", text));
    assert_string_equal(text, "");
    assert_false(otx_hash_file("/nonexistent/file", text));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_and_known),
        cmocka_unit_test(a_file_hashes_like_its_bytes),
        cmocka_unit_test(what_is_no_file_has_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

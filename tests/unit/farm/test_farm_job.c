/* test_farm_job.c -- jobs that are read, and the sentences for those that are
 * not.
 */
#include "support.h"

#include "farm/farm_job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char WHOLE[] =
    "{\"name\": \"shirts\", \"threads\": 4, \"tasks\": [\n"
    " {\"name\": \"red\", \"command\": \"bake\","
    " \"arguments\": \"  a.obj b.exr   -o c.obj \"},\n"
    " {\"name\": \"blue\", \"command\": \"map\","
    " \"arguments\": [\"a.obj\", \"dark blue.exr\"]}]}\n";

/* Reads a file with the first `length` bytes of `text`. */
static bool
read_bytes(const char *text, size_t length, otx_farm_job *job, char *error)
{
    char path[] = "/tmp/osdtex-test-job-XXXXXX";
    const int file = mkstemp(path);
    bool done;

    assert_true(file >= 0);
    assert_int_equal(write(file, text, length), (ssize_t)length);
    close(file);
    done = otx_farm_job_read(path, job, error);
    unlink(path);
    return done;
}

static void
words_are_split_at_blanks_or_given(void **state)
{
    static const char *const red[] = {"a.obj", "b.exr", "-o", "c.obj"};
    char error[OTX_FARM_JOB_ERROR_BYTES];
    otx_farm_job job;
    json_t *words;

    (void)state;
    assert_true(read_bytes(WHOLE, strlen(WHOLE), &job, error));
    assert_string_equal(job.name, "shirts");
    assert_int_equal(job.threads, 4);
    assert_int_equal(job.task_count, 2);
    assert_string_equal(job.folder, "/tmp");
    assert_string_equal(otx_farm_job_command(&job, 1), "map");
    assert_string_equal(otx_farm_job_task_name(&job, 0), "red");

    words = otx_farm_job_words(&job, 0);
    assert_int_equal(json_array_size(words), sizeof red / sizeof red[0]);
    for (size_t i = 0; i < sizeof red / sizeof red[0]; ++i)
        assert_string_equal(
            json_string_value(json_array_get(words, i)), red[i]);
    json_decref(words);

    words = otx_farm_job_words(&job, 1);
    assert_string_equal(
        json_string_value(json_array_get(words, 1)), "dark blue.exr");
    json_decref(words);
    otx_farm_job_free(&job);
}

/* A job that was cut off says where, and leaves nothing behind. */
static void
no_prefix_of_a_job_is_one(void **state)
{
    (void)state;
    for (size_t length = 0; length + 2 < sizeof WHOLE; ++length)
    {
        char error[OTX_FARM_JOB_ERROR_BYTES] = "";
        otx_farm_job job;

        assert_false(read_bytes(WHOLE, length, &job, error));
        assert_true(strlen(error) > 10);
        assert_non_null(strchr(error, ':'));
        assert_null(job.root);
    }
}

/* Whatever byte is turned into whatever: read or refused with a sentence. */
static void
no_broken_byte_does_harm(void **state)
{
    static const char bytes[] = {'\0', '"', '{', ']', '\\', '\xff', '9', ' '};
    char text[sizeof WHOLE];

    (void)state;
    for (size_t at = 0; at + 1 < sizeof WHOLE; ++at)
        for (size_t i = 0; i < sizeof bytes; ++i)
        {
            char error[OTX_FARM_JOB_ERROR_BYTES] = "";
            otx_farm_job job;

            memcpy(text, WHOLE, sizeof WHOLE);
            text[at] = bytes[i];
            if (!read_bytes(text, sizeof WHOLE - 1, &job, error))
            {
                assert_true(strlen(error) > 10);
                continue;
            }
            assert_true(job.task_count >= 1 && job.threads >= 0);
            for (int t = 0; t < job.task_count; ++t)
            {
                json_t *words = otx_farm_job_words(&job, t);

                assert_true(json_array_size(words) > 0);
                json_decref(words);
            }
            otx_farm_job_free(&job);
        }
}

static void
names_that_engines_would_take_amiss_are_refused(void **state)
{
    static const char *const names[] = {
        "", "-x", "a/b", "a;b", "$x", "a\\\"b", "\\u00e4", "a\\nb"};

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
    {
        char text[256], error[OTX_FARM_JOB_ERROR_BYTES];
        otx_farm_job job;

        snprintf(
            text, sizeof text,
            "{\"name\": \"%s\", \"tasks\": [{\"name\": \"a\", "
            "\"command\": \"map\", \"arguments\": \"a b\"}]}",
            names[i]);
        assert_false(read_bytes(text, strlen(text), &job, error));
        assert_non_null(strstr(error, "\"name\""));
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_split_at_blanks_or_given),
        cmocka_unit_test(no_prefix_of_a_job_is_one),
        cmocka_unit_test(no_broken_byte_does_harm),
        cmocka_unit_test(names_that_engines_would_take_amiss_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

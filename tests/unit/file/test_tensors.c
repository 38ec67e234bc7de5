/* test_tensors.c -- what is written is read again; no prefix of it crashes. */
#include "folder.h"

#include "file/tensors.h"

static const double DOUBLES[] = {0.5, -1e300, 3.0};
static const int32_t NUMBERS[] = {1, -2, 3, 4, 5, INT32_MIN};
static const uint8_t BYTES[] = {7, 0, 255};

static uint8_t *
write_some(otx_run *run, const char *path, size_t *bytes)
{
    otx_tensors *out = OTX_ZNEW(run->arena, otx_tensors, 1);

    out->about = "{\"what\":\"a test\"}";
    otx_tensors_add(out, "doubles", OTX_TENSOR_F64, 3, 0, DOUBLES);
    otx_tensors_add(out, "numbers", OTX_TENSOR_I32, 3, 2, NUMBERS);
    otx_tensors_add(out, "none", OTX_TENSOR_I32, 0, 2, NUMBERS);
    otx_tensors_add(out, "bytes", OTX_TENSOR_U8, 3, 0, BYTES);
    assert_int_equal(otx_tensors_write(run, out, path, path), OSDTEX_OK);
    return test_read_bytes(run, path, bytes);
}

static void
what_is_written_is_read(void **state)
{
    const test_file *f = *state;
    otx_tensors *in = OTX_ZNEW(f->run->arena, otx_tensors, 1);
    const otx_tensor *t;
    size_t bytes;

    write_some(f->run, f->path, &bytes);
    assert_int_equal(otx_tensors_read(f->run, f->path, in), OSDTEX_OK);
    assert_int_equal(in->count, 4);
    assert_string_equal(in->about, "{\"what\":\"a test\"}");
    t = otx_tensors_find(in, "doubles", OTX_TENSOR_F64, 3, 0);
    assert_memory_equal(t->data, DOUBLES, sizeof DOUBLES);
    t = otx_tensors_find(in, "numbers", OTX_TENSOR_I32, -1, -1);
    assert_memory_equal(t->data, NUMBERS, sizeof NUMBERS);
    t = otx_tensors_find(in, "bytes", OTX_TENSOR_U8, 3, 0);
    assert_memory_equal(t->data, BYTES, sizeof BYTES);
    assert_non_null(otx_tensors_find(in, "none", OTX_TENSOR_I32, 0, 2));
    assert_null(otx_tensors_find(in, "numbers", OTX_TENSOR_F32, 3, 2));
    assert_null(otx_tensors_find(in, "numbers", OTX_TENSOR_I32, 2, 3));
    assert_null(otx_tensors_find(in, "other", OTX_TENSOR_I32, -1, -1));
}

static void
the_same_arrays_give_the_same_bytes(void **state)
{
    const test_file *f = *state;
    size_t one, two;
    const uint8_t *a = write_some(f->run, f->path, &one);
    const uint8_t *b = write_some(f->run, f->path, &two);

    assert_int_equal(one, two);
    assert_memory_equal(a, b, one);
}

static void
no_prefix_is_taken_for_a_file(void **state)
{
    const test_file *f = *state;
    otx_tensors *in = OTX_ZNEW(f->run->arena, otx_tensors, 1);
    size_t bytes;
    const uint8_t *all = write_some(f->run, f->path, &bytes);

    for (size_t n = 0; n < bytes; ++n)
    {
        test_write_bytes(f->path, all, n);
        assert_int_equal(
            otx_tensors_read(f->run, f->path, in), OSDTEX_ERROR_FORMAT);
    }
}

/* A byte of the header changed makes another file or none, never a crash. */
static void
damaged_headers_are_survived(void **state)
{
    const test_file *f = *state;
    otx_tensors *in = OTX_ZNEW(f->run->arena, otx_tensors, 1);
    size_t bytes;
    uint8_t *all = write_some(f->run, f->path, &bytes);

    for (size_t i = 0; i + sizeof BYTES < bytes; i += 3)
    {
        const uint8_t kept = all[i];

        all[i] = kept ^ 0x15;
        test_write_bytes(f->path, all, bytes);
        if (otx_tensors_read(f->run, f->path, in) == OSDTEX_OK)
            assert_in_range(in->count, 0, 4);
        all[i] = kept;
    }
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_file_setup, test_file_teardown)
    const struct CMUnitTest tests[] = {
        TEST(what_is_written_is_read),
        TEST(the_same_arrays_give_the_same_bytes),
        TEST(no_prefix_is_taken_for_a_file),
        TEST(damaged_headers_are_survived),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

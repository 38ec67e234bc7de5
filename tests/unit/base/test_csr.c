/* test_csr.c -- lists in one array, against lists of their own. */
#include "support.h"

#include "base/csr.h"
#include "base/random.h"

enum
{
    LISTS = 37,
    ITEMS = 500
};

static int32_t
list_of(int32_t item)
{
    /* Some lists stay empty, the first and the last among them. */
    return 1 +
           3 * (int32_t)(otx_random_bits(7, 0, (uint64_t)item) % ((LISTS - 2) / 3));
}

static void
lists_hold_their_items_in_order(void **state)
{
    int32_t first[LISTS + 2] = {0}, items[ITEMS];
    int32_t total = 0;

    (void)state;
    for (int32_t i = 0; i < ITEMS; ++i)
        otx_csr_count(first, list_of(i), 1);
    otx_csr_sum(first, LISTS);
    assert_int_equal(first[LISTS + 1], ITEMS);
    for (int32_t i = 0; i < ITEMS; ++i)
        items[otx_csr_place(first, list_of(i))] = i;
    assert_int_equal(first[0], 0);
    assert_int_equal(first[LISTS], ITEMS);
    for (int32_t k = 0; k < LISTS; ++k)
        for (int32_t at = first[k]; at < first[k + 1]; ++at, ++total)
        {
            assert_int_equal(list_of(items[at]), k);
            assert_true(at == first[k] || items[at - 1] < items[at]);
        }
    assert_int_equal(total, ITEMS);
}

static void
wide_offsets_are_the_same(void **state)
{
    int32_t first[LISTS + 2] = {0};
    int64_t wide[LISTS + 2] = {0};

    (void)state;
    for (int32_t i = 0; i < ITEMS; ++i)
    {
        otx_csr_count(first, list_of(i), 2);
        otx_csr_wide_count(wide, list_of(i), 2);
    }
    otx_csr_sum(first, LISTS);
    otx_csr_wide_sum(wide, LISTS);
    for (int32_t i = 0; i < 2 * ITEMS; ++i)
        assert_int_equal(
            otx_csr_place(first, list_of(i / 2)),
            otx_csr_wide_place(wide, list_of(i / 2)));
    for (int32_t k = 0; k < LISTS + 2; ++k)
        assert_int_equal(first[k], wide[k]);
}

static void
no_lists_are_fine(void **state)
{
    int32_t first[2] = {0};

    (void)state;
    otx_csr_sum(first, 0);
    assert_int_equal(first[0], 0);
    assert_int_equal(first[1], 0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_hold_their_items_in_order),
        cmocka_unit_test(wide_offsets_are_the_same),
        cmocka_unit_test(no_lists_are_fine),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

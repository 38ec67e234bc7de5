/* test_pqueue.c -- out comes what is least, equal keys in the order of items.
 */
#include "support.h"

#include "base/pqueue.h"
#include "base/random.h"

#include <math.h>

static void
entries_come_out_sorted(void **state)
{
    otx_run *run = test_run_create();
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    otx_pqueue_entry last = {-1.0, -1}, entry;
    int32_t count = 0;

    (void)state;
    for (int32_t i = 0; i < 5000; ++i)
        otx_pqueue_push(
            &queue, floor(20.0 * otx_random_unit(1, 0, (uint64_t)i)), i);
    while (otx_pqueue_pop(&queue, &entry))
    {
        assert_true(
            entry.key > last.key ||
            (entry.key == last.key && entry.item > last.item));
        last = entry;
        ++count;
    }
    assert_int_equal(count, 5000);
    assert_false(otx_pqueue_pop(&queue, &entry));
    test_run_destroy(run);
}

static void
keys_may_be_infinite(void **state)
{
    otx_run *run = test_run_create();
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    otx_pqueue_entry entry;

    (void)state;
    otx_pqueue_push(&queue, INFINITY, 1);
    otx_pqueue_push(&queue, 0.0, 2);
    otx_pqueue_push(&queue, -INFINITY, 3);
    for (int32_t item = 3; item > 0; --item)
    {
        assert_true(otx_pqueue_pop(&queue, &entry));
        assert_int_equal(entry.item, item);
    }
    test_run_destroy(run);
}

static void
running_out_of_memory_is_said(void **state)
{
    const otx_allocator_hooks hooks = {.limit_bytes = 1 << 20};
    otx_run *run = test_run_create_with(&hooks, 1);
    otx_pqueue queue = otx_pqueue_make(run->scratch);
    int32_t i = 0;

    (void)state;
    for (; i < 1 << 20 && !otx_arena_failed(run->scratch); ++i)
        otx_pqueue_push(&queue, i, i);
    assert_in_range(i, 1, (1 << 20) - 1);
    assert_int_equal(queue.count, i - 1);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_come_out_sorted),
        cmocka_unit_test(keys_may_be_infinite),
        cmocka_unit_test(running_out_of_memory_is_said),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

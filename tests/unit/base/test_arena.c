/* test_arena.c -- alignment, overflow, limits, release order. */
#include "support.h"

static void
allocations_are_aligned_and_distinct(void **state)
{
    otx_run *run = *state;
    char *a = OTX_NEW(run->arena, char, 1);
    char *b = OTX_NEW(run->arena, char, 0);
    char *c = OTX_NEW(run->arena, char, 1 << 20);

    assert_non_null(a);
    assert_true(b != a && c != b);
    assert_int_equal((uintptr_t)a % 64, 0);
    assert_int_equal((uintptr_t)c % 64, 0);
    memset(c, 1, 1 << 20);
}

static void
a_product_that_overflows_is_refused(void **state)
{
    otx_run *run = *state;

    assert_null(otx_arena_alloc(run->arena, SIZE_MAX / 2, 3));
    assert_null(otx_arena_alloc(run->arena, SIZE_MAX, 1));
}

/* One question after a group of allocations: the first, the second or both may
 * have failed. Releasing the mark before them forgets it. */
static void
a_failure_is_remembered_until_its_mark(void **state)
{
    otx_run *run = test_run_create();

    (void)state;
    for (int which = 0; which < 4; ++which)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const otx_arena_mark kept = otx_arena_here(run->arena);

        assert_int_equal(otx_run_ok(run), OSDTEX_OK);
        (void)otx_arena_alloc(run->scratch, which & 1 ? SIZE_MAX : 1, 2);
        (void)otx_arena_alloc(run->arena, which & 2 ? SIZE_MAX : 1, 2);
        (void)otx_arena_alloc(run->scratch, 1, 2);
        assert_int_equal(
            otx_run_ok(run), which ? OSDTEX_ERROR_MEMORY : OSDTEX_OK);
        otx_arena_release(run->scratch, mark);
        otx_arena_release(run->arena, kept);
        assert_int_equal(otx_run_ok(run), OSDTEX_OK);
    }
    test_run_destroy(run);
}

static void
note_call(void *object)
{
    int *calls = object;

    ++*calls;
}

static void
release_runs_what_was_deferred_since_the_mark(void **state)
{
    otx_run *run = *state;
    int before = 0, after = 0;
    const size_t used = otx_allocator_used(run->allocator);
    otx_arena *arena = otx_arena_create(run->allocator);
    otx_arena_mark mark;

    assert_true(otx_arena_defer(arena, note_call, &before));
    mark = otx_arena_here(arena);
    assert_true(otx_arena_defer(arena, note_call, &after));
    assert_non_null(OTX_NEW(arena, char, 1 << 22));
    otx_arena_release(arena, mark);
    assert_int_equal(before, 0);
    assert_int_equal(after, 1);
    otx_arena_destroy(arena);
    assert_int_equal(before, 1);
    assert_int_equal(otx_allocator_used(run->allocator), used);
}

static void
a_limit_is_kept(void **state)
{
    const otx_allocator_hooks hooks = {.limit_bytes = 1 << 20};
    otx_allocator *allocator = otx_allocator_create(&hooks);
    otx_arena *arena = otx_arena_create(allocator);

    (void)state;
    assert_null(OTX_NEW(arena, char, 2 << 20));
    assert_non_null(OTX_NEW(arena, char, 1 << 19));
    assert_null(OTX_NEW(arena, char, 1 << 19));
    otx_arena_destroy(arena);
    assert_int_equal(otx_allocator_used(allocator), 0);
    assert_true(otx_allocator_peak(allocator) <= 1 << 20);
    otx_allocator_destroy(allocator);
}

static void
what_is_held_outlives_its_owner(void **state)
{
    otx_allocator *allocator = otx_allocator_create(NULL);
    otx_arena *held = otx_arena_create(allocator);
    otx_arena *holder = otx_arena_create(allocator);
    int calls = 0;

    (void)state;
    assert_true(otx_arena_defer(held, note_call, &calls));
    assert_true(otx_arena_hold(holder, held));
    /* Both owners leave before the holder does. */
    otx_allocator_destroy(allocator);
    otx_arena_destroy(held);
    assert_int_equal(calls, 0);
    otx_arena_destroy(holder);
    assert_int_equal(calls, 1);
}

static int
setup(void **state)
{
    *state = test_run_create();
    return 0;
}

static int
teardown(void **state)
{
    test_run_destroy(*state);
    return 0;
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allocations_are_aligned_and_distinct),
        cmocka_unit_test(a_product_that_overflows_is_refused),
        cmocka_unit_test(a_failure_is_remembered_until_its_mark),
        cmocka_unit_test(release_runs_what_was_deferred_since_the_mark),
        cmocka_unit_test(a_limit_is_kept),
        cmocka_unit_test(what_is_held_outlives_its_owner),
    };

    return cmocka_run_group_tests(tests, setup, teardown);
}

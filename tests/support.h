/* support.h -- what every unit test needs: cmocka and a run to pass around. */
#ifndef OTX_TESTS_SUPPORT_H
#define OTX_TESTS_SUPPORT_H

/* cmocka.h needs these first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Folder with real cages and photographs, beside the project where it is
 * there. Tests that need it skip with a message where it is absent. */
#define SHARED_DATA "../shared/data"

/* Ends a test as skipped. tests/run_test.py gathers the sentences. */
#define test_skip(sentence)                                                    \
    do                                                                         \
    {                                                                          \
        print_message("skipped: %s\n", sentence);                              \
        skip();                                                                \
    } while (0)

/* A heap that fails once `left` allocations have succeeded. */
typedef struct test_ration
{
    int64_t left;
} test_ration;

static inline void *
test_ration_alloc(void *user, size_t bytes)
{
    test_ration *ration = user;

    return ration->left-- > 0 ? malloc(bytes) : NULL;
}

static inline void
test_ration_release(void *user, void *block, size_t bytes)
{
    (void)user;
    (void)bytes;
    free(block);
}

static inline otx_allocator_hooks
test_ration_hooks(test_ration *ration)
{
    return (otx_allocator_hooks){
        test_ration_alloc, test_ration_release, ration, 0};
}

/* A run with its own heap, arenas, diagnostics and pool. */
static inline otx_run *
test_run_create_with(const otx_allocator_hooks *hooks, int32_t threads)
{
    otx_allocator *allocator = otx_allocator_create(hooks);
    otx_arena *arena = otx_arena_create(allocator);
    otx_run *run = OTX_ZNEW(arena, otx_run, 1);

    run->allocator = allocator;
    run->arena = arena;
    run->scratch = otx_arena_create(allocator);
    run->pool = otx_pool_create(allocator, threads);
    run->diagnostics = otx_diagnostics_create(allocator);
    run->seed = 1;
    return run;
}

static inline otx_run *
test_run_create(void)
{
    return test_run_create_with(NULL, 2);
}

static inline void
test_run_destroy(otx_run *run)
{
    otx_allocator *allocator = run->allocator;
    otx_arena *arena = run->arena;

    otx_pool_destroy(run->pool);
    otx_arena_destroy(run->scratch);
    otx_diagnostics_destroy(run->diagnostics);
    otx_arena_destroy(arena);
    assert_int_equal(otx_allocator_used(allocator), 0);
    otx_allocator_destroy(allocator);
}

/* The same as the state of a test, for cmocka_unit_test_setup_teardown. */
static inline int
test_run_setup(void **state)
{
    *state = test_run_create();
    return 0;
}

static inline int
test_run_teardown(void **state)
{
    test_run_destroy(*state);
    return 0;
}

/* A test that is handed a run of its own. */
#define test_with_run(name)                                                    \
    cmocka_unit_test_setup_teardown(name, test_run_setup, test_run_teardown)

/* The last finding's sentence, "" when there is none. */
static inline const char *
test_last_message(const otx_run *run)
{
    osdtex_diagnostic d;
    const int32_t count = otx_diagnostics_count(run->diagnostics);

    if (count == 0)
        return "";
    otx_diagnostics_get(run->diagnostics, count - 1, &d);
    return d.message;
}

#endif

/* test_union_find.c -- sets are the components of the joins, whatever their
 * order, and known by their smallest element. */
#include "support.h"

#include "base/random.h"
#include "base/union_find.h"

enum
{
    COUNT = 200,
    JOINS = 120
};

static int32_t
end_of(int32_t join, uint64_t which)
{
    return (int32_t)(otx_random_bits(3, which, (uint64_t)join) % COUNT);
}

/* Labels spread along the joins until nothing changes. */
static void
label_slowly(int32_t label[COUNT])
{
    bool changed = true;

    for (int32_t i = 0; i < COUNT; ++i)
        label[i] = i;
    while (changed)
    {
        changed = false;
        for (int32_t j = 0; j < JOINS; ++j)
        {
            int32_t *a = &label[end_of(j, 0)], *b = &label[end_of(j, 1)];

            changed = changed || *a != *b;
            *a = *b = *a < *b ? *a : *b;
        }
    }
}

static void
sets_are_components(void **state)
{
    int32_t label[COUNT], parent[COUNT];

    (void)state;
    label_slowly(label);
    for (int32_t turn = 0; turn < 3; ++turn)
    {
        for (int32_t i = 0; i < COUNT; ++i)
            parent[i] = i;
        for (int32_t k = 0; k < JOINS; ++k)
        {
            /* 7 and 120 share no factor: each join once, in another order. */
            const int32_t j = turn == 0 ? k : (7 * k + turn) % JOINS;

            otx_union_find_join(parent, end_of(j, 0), end_of(j, 1));
        }
        for (int32_t i = 0; i < COUNT; ++i)
            assert_int_equal(otx_union_find_root(parent, i), label[i]);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sets_are_components),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

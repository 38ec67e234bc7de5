/* test_dissect.c -- halves are eliminated before what separates them. */
#include "support.h"

#include "math/dissect.h"

enum
{
    SIDE = 48,
    COUNT = SIDE * SIDE
};

/* Neighbours in a square grid, CSR. */
static void
grid(int32_t *first, int32_t *neighbour, otx_vec3 *points)
{
    int32_t n = 0;

    for (int32_t i = 0; i < COUNT; ++i)
    {
        const int32_t x = i % SIDE, y = i / SIDE;

        first[i] = n;
        points[i] = (otx_vec3){x, y, 0};
        if (x > 0)
            neighbour[n++] = i - 1;
        if (x + 1 < SIDE)
            neighbour[n++] = i + 1;
        if (y > 0)
            neighbour[n++] = i - SIDE;
        if (y + 1 < SIDE)
            neighbour[n++] = i + SIDE;
    }
    first[COUNT] = n;
}

static void
the_last_group_separates(void **state)
{
    otx_run *run = test_run_create();
    int32_t *first = OTX_NEW(run->arena, int32_t, COUNT + 1);
    int32_t *neighbour = OTX_NEW(run->arena, int32_t, 4 * COUNT);
    otx_vec3 *points = OTX_NEW(run->arena, otx_vec3, COUNT);
    int32_t *group = OTX_NEW(run->arena, int32_t, COUNT);
    int32_t *queue = OTX_NEW(run->arena, int32_t, COUNT);
    uint8_t *seen = OTX_ZNEW(run->arena, uint8_t, COUNT);
    int32_t last = 0, cut = 0, head = 0, tail = 0;

    (void)state;
    grid(first, neighbour, points);
    assert_true(
        otx_dissect(run->scratch, COUNT, points, first, neighbour, group));
    for (int32_t i = 0; i < COUNT; ++i)
        last = group[i] > last ? group[i] : last;
    for (int32_t i = 0; i < COUNT; ++i)
        cut += seen[i] = group[i] == last;
    assert_int_equal(cut, SIDE);
    /* What is reached from one corner around it is a half. */
    assert_false(seen[0]);
    queue[tail++] = 0;
    seen[0] = 1;
    while (head < tail)
    {
        const int32_t i = queue[head++];

        for (int32_t k = first[i]; k < first[i + 1]; ++k)
            if (!seen[neighbour[k]])
            {
                seen[neighbour[k]] = 1;
                queue[tail++] = neighbour[k];
            }
    }
    assert_int_equal(tail, COUNT / 2 - SIDE);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_group_separates),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_peaks.c -- the scan lists exactly the local minima, best first. */
#include "support.h"

#include "base/random.h"
#include "match/peaks.h"

enum
{
    WIDTH = 23,
    HEIGHT = 17,
    STRIDE = 24
};

/* By the definition, with no shortcut. */
static bool
is_local_minimum(const otx_peaks_map *map, int x, int y)
{
    const int w = map->x_end - map->x_begin, h = map->y_end - map->y_begin;
    const float value = map->values[y * STRIDE + x];

    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
        {
            int i = x + dx - map->x_begin, j = y + dy - map->y_begin;

            if (map->wrap_x)
                i = (i + 2 * w) % w;
            if (map->wrap_y)
                j = (j + 2 * h) % h;
            if (i < 0 || i >= w || j < 0 || j >= h)
                continue;
            i += map->x_begin;
            j += map->y_begin;

            const float other = map->values[j * STRIDE + i];
            const bool first = j < y || (j == y && i < x);

            if (other < value || (other == value && first))
                return false;
        }
    return true;
}

static void
check_map(uint64_t seed, int steps, bool wrap, int margin)
{
    float values[HEIGHT * STRIDE];
    const otx_peaks_map map = {
        .values = values,
        .stride = STRIDE,
        .x_begin = margin,
        .x_end = WIDTH - margin,
        .y_begin = margin,
        .y_end = HEIGHT - margin,
        .wrap_x = wrap,
        .wrap_y = wrap};
    otx_peaks found = {.capacity = 5};
    otx_peaks wanted = {.capacity = 5};

    /* Few steps make many ties. */
    for (uint64_t i = 0; i < HEIGHT * STRIDE; ++i)
        values[i] = (float)(int)(otx_random_unit(seed, 0, i) * steps) - 3.0f;
    for (int angle = 0; angle < 2; ++angle)
    {
        otx_peaks_scan(&map, angle, 7.0, 0.5, &found);
        for (int y = map.y_begin; y < map.y_end; ++y)
            for (int x = map.x_begin; x < map.x_end; ++x)
                if (is_local_minimum(&map, x, y))
                    otx_peaks_insert(
                        &wanted, &(otx_peak){
                                     7.0 + 0.5 * (double)values[y * STRIDE + x],
                                     angle, y, x});
    }
    assert_int_equal(found.count, wanted.count);
    for (int i = 0; i < found.count; ++i)
    {
        assert_true(found.list[i].value == wanted.list[i].value);
        assert_int_equal(found.list[i].angle, wanted.list[i].angle);
        assert_int_equal(found.list[i].x, wanted.list[i].x);
        assert_int_equal(found.list[i].y, wanted.list[i].y);
    }
}

static void
the_scan_lists_the_local_minima(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed < 50; ++seed)
    {
        check_map(seed, 1000000, true, 0);
        check_map(seed, 1000000, false, 0);
        check_map(seed, 1000000, false, 4);
        check_map(seed, 4, true, 0);
        check_map(seed, 1, true, 0);
        check_map(seed, 2, false, 7);
    }
}

static void
the_order_of_insertion_does_not_matter(void **state)
{
    const otx_peak peaks[5] = {
        {1.0, 1, 2, 3},
        {1.0, 1, 2, 2},
        {0.5, 3, 0, 0},
        {1.0, 0, 9, 9},
        {2.0, 0, 0, 0}};
    const int wanted[4] = {2, 3, 1, 0};

    (void)state;
    for (int first = 0; first < 5; ++first)
    {
        otx_peaks list = {.capacity = 4};

        for (int i = 0; i < 5; ++i)
            otx_peaks_insert(&list, &peaks[(first + 2 * i) % 5]);
        assert_int_equal(list.count, 4);
        for (int i = 0; i < 4; ++i)
            assert_memory_equal(
                &list.list[i], &peaks[wanted[i]], sizeof *peaks);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scan_lists_the_local_minima),
        cmocka_unit_test(the_order_of_insertion_does_not_matter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

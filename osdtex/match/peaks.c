/* peaks.c -- one pass with a falling threshold.
 *
 * The result is a property of the map alone, not of the order of the pass:
 * local minima are defined by their neighbourhood, so that suppression cannot
 * depend on who was seen first. */
#include "match/peaks.h"

enum
{
    RADIUS = 2
};

static bool
comes_before(const otx_peak *a, const otx_peak *b)
{
    if (a->value != b->value)
        return a->value < b->value;
    if (a->angle != b->angle)
        return a->angle < b->angle;
    return a->y != b->y ? a->y < b->y : a->x < b->x;
}

void
otx_peaks_insert(otx_peaks *peaks, const otx_peak *peak)
{
    int32_t at = peaks->count;

    if (at == peaks->capacity)
    {
        if (at == 0 || !comes_before(peak, &peaks->list[at - 1]))
            return;
        --at;
    }
    else
        ++peaks->count;
    for (; at > 0 && comes_before(peak, &peaks->list[at - 1]); --at)
        peaks->list[at] = peaks->list[at - 1];
    peaks->list[at] = *peak;
}

/* Coordinates of the neighbours along one axis, and its own; how many. */
static int32_t
list_neighbours(
    int32_t at, int32_t begin, int32_t end, bool wrap,
    int32_t list[2 * RADIUS + 1])
{
    const int32_t period = end - begin;
    int32_t count = 0;

    for (int32_t i = at - RADIUS; i <= at + RADIUS; ++i)
        if (i >= begin && i < end)
            list[count++] = i;
        else if (wrap)
            list[count++] = begin + ((i - begin) % period + period) % period;
    return count;
}

static bool
is_minimum(const otx_peaks_map *map, int32_t x, int32_t y)
{
    const float value = map->values[(size_t)y * map->stride + (size_t)x];
    int32_t columns[2 * RADIUS + 1], rows[2 * RADIUS + 1];
    const int32_t column_count =
        list_neighbours(x, map->x_begin, map->x_end, map->wrap_x, columns);
    const int32_t row_count =
        list_neighbours(y, map->y_begin, map->y_end, map->wrap_y, rows);

    for (int32_t j = 0; j < row_count; ++j)
    {
        const float *row = map->values + (size_t)rows[j] * map->stride;

        for (int32_t i = 0; i < column_count; ++i)
        {
            const float other = row[columns[i]];
            const bool first = rows[j] != y ? rows[j] < y : columns[i] < x;

            if (other < value || (other == value && first))
                return false;
        }
    }
    return true;
}

/* A neighbour in the row undercuts: most pixels end here. */
static inline bool
is_undercut(const float *row, int32_t x)
{
    return row[x - 1] < row[x] || row[x + 1] < row[x];
}

/* The first x in [x, end) of a value that is at most `limit`. */
static int32_t
skip_above(const float *row, int32_t x, int32_t end, float limit)
{
    for (; x + 4 <= end; x += 4)
        if ((row[x] <= limit) | (row[x + 1] <= limit) | (row[x + 2] <= limit) |
            (row[x + 3] <= limit))
            break;
    while (x < end && !(row[x] <= limit))
        ++x;
    return x;
}

/* Map value up to which a pixel could enter the list. Rounded upwards: the
 * insertion decides exactly. */
static float
entry_limit(const otx_peaks *peaks, double offset, double scale)
{
    if (peaks->count < peaks->capacity)
        return INFINITY;
    return nextafterf(
        (float)((peaks->list[peaks->count - 1].value - offset) / scale),
        INFINITY);
}

void
otx_peaks_scan(
    const otx_peaks_map *map, int32_t angle, double offset, double scale,
    otx_peaks *peaks)
{
    float limit = entry_limit(peaks, offset, scale);

    for (int32_t y = map->y_begin; y < map->y_end; ++y)
    {
        const float *row = map->values + (size_t)y * map->stride;

        for (int32_t x = map->x_begin;
             (x = skip_above(row, x, map->x_end, limit)) < map->x_end; ++x)
        {
            const bool inside = x > map->x_begin && x + 1 < map->x_end;

            if ((inside && is_undercut(row, x)) || !is_minimum(map, x, y))
                continue;
            otx_peaks_insert(
                peaks, &(otx_peak){
                           .value = offset + scale * (double)row[x],
                           .angle = angle,
                           .y = y,
                           .x = x});
            limit = entry_limit(peaks, offset, scale);
        }
    }
}

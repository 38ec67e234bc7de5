/* dissect.c -- in which order to eliminate the unknowns of a surface. */
#include "math/dissect.h"

enum
{
    LEAF = 256 /* unknowns that are not halved any more */
};

typedef struct dissection
{
    const otx_vec3 *points;
    const int32_t *first, *neighbour;
    int32_t *group;
    int32_t *items; /* unknowns, those of a part contiguous */
    int32_t *spare;
    int32_t *part; /* of each unknown: a stamp of its half */
    int32_t stamp;
    int32_t groups;
} dissection;

static double
along(otx_vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static int
longest_axis(const dissection *d, const int32_t *items, int32_t count)
{
    double extent[3];
    int best = 0;

    for (int axis = 0; axis < 3; ++axis)
    {
        double low = INFINITY, high = -INFINITY;

        for (int32_t i = 0; i < count; ++i)
        {
            const double x = along(d->points[items[i]], axis);

            low = fmin(low, x);
            high = fmax(high, x);
        }
        extent[axis] = high - low;
        if (extent[axis] > extent[best])
            best = axis;
    }
    return best;
}

static bool
before(const dissection *d, int axis, int32_t a, int32_t b)
{
    const double x = along(d->points[a], axis), y = along(d->points[b], axis);

    return x < y || (x == y && a < b);
}

/* Puts the `half` lowest items in front [Hoare61]. */
static void
halve(
    const dissection *d, int axis, int32_t *items, int32_t count, int32_t half)
{
    int32_t low = 0, high = count - 1;

    while (low < high)
    {
        const int32_t pivot = items[low + (high - low) / 2];
        int32_t i = low, j = high;

        while (i <= j)
        {
            while (before(d, axis, items[i], pivot))
                ++i;
            while (before(d, axis, pivot, items[j]))
                --j;
            if (i <= j)
            {
                const int32_t swap = items[i];

                items[i++] = items[j];
                items[j--] = swap;
            }
        }
        if (half <= j)
            high = j;
        else if (half >= i)
            low = i;
        else
            return;
    }
}

static bool
touches(const dissection *d, int32_t item, int32_t part)
{
    for (int32_t k = d->first[item]; k < d->first[item + 1]; ++k)
        if (d->part[d->neighbour[k]] == part)
            return true;
    return false;
}

/* Orders items as first half, second half, what separates them; the numbers of
 * the two halves. */
static void
separate(dissection *d, int32_t *items, int32_t count, int32_t sizes[2])
{
    const int32_t half = count / 2;
    const int32_t other = ++d->stamp;
    int32_t kept = 0, cut = 0;

    halve(d, longest_axis(d, items, count), items, count, half);
    for (int32_t i = half; i < count; ++i)
        d->part[items[i]] = other;
    for (int32_t i = 0; i < half; ++i)
        if (touches(d, items[i], other))
            d->spare[cut++] = items[i];
        else
            items[kept++] = items[i];
    for (int32_t i = half; i < count; ++i)
        items[kept + i - half] = items[i];
    for (int32_t i = 0; i < cut; ++i)
        items[count - cut + i] = d->spare[i];
    sizes[0] = kept;
    sizes[1] = count - half;
}

static void
finish(dissection *d, const int32_t *items, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        d->group[items[i]] = d->groups;
    d->groups += count > 0;
}

/* As deep as the logarithm of the count. */
static void
dissect(dissection *d, int32_t *items, int32_t count)
{
    int32_t sizes[2];

    if (count <= LEAF)
    {
        finish(d, items, count);
        return;
    }
    separate(d, items, count, sizes);
    dissect(d, items, sizes[0]);
    dissect(d, items + sizes[0], sizes[1]);
    finish(d, items + sizes[0] + sizes[1], count - sizes[0] - sizes[1]);
}

bool
otx_dissect(
    otx_arena *scratch, int32_t count, const otx_vec3 *points,
    const int32_t *first, const int32_t *neighbour, int32_t *group)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    dissection d = {
        .points = points,
        .first = first,
        .neighbour = neighbour,
        .group = group,
        .items = OTX_NEW(scratch, int32_t, count),
        .spare = OTX_NEW(scratch, int32_t, count),
        .part = OTX_ZNEW(scratch, int32_t, count)};

    if (!d.items || !d.spare || !d.part)
        return false;
    for (int32_t i = 0; i < count; ++i)
        d.items[i] = i;
    dissect(&d, d.items, count);
    otx_arena_release(scratch, mark);
    return true;
}

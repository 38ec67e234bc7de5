/* patterns.c -- blobs, pebbles, and whatever the user brings. */
#include "bench/patterns.h"

#include "base/random.h"
#include "file/picture_read.h"

/* Smooth noise of one cell size that repeats after n pixels, in [0, 1). */
static double
blob(int32_t n, int32_t x, int32_t y, int32_t cell, uint32_t channel)
{
    const int32_t cells = n / cell, i = x / cell, j = y / cell;
    const double u = (double)(x % cell) / cell;
    const double v = (double)(y % cell) / cell;
    double corner[2][2];

    for (int32_t k = 0; k < 4; ++k)
        corner[k / 2][k % 2] = otx_random_unit(
            (uint64_t)cell, channel,
            (uint64_t)((j + k / 2) % cells * n + (i + k % 2) % cells));
    return (1 - v) * ((1 - u) * corner[0][0] + u * corner[0][1]) +
           v * ((1 - u) * corner[1][0] + u * corner[1][1]);
}

otx_status
bench_patterns_blobs(otx_run *run, int32_t n, otx_image *out)
{
    OTX_TRY(otx_image_create(run, run->arena, n, n, 3, out));
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
            for (uint32_t c = 0; c < 3; ++c)
                otx_image_at(out, x, y)[c] =
                    (float)((blob(n, x, y, 4, c) + blob(n, x, y, 8, c) + blob(n, x, y, 16, c)) / 3.0);
    return OSDTEX_OK;
}

enum
{
    PEBBLE = 16 /* pixels, of the grid that each pebble has a cell of */
};

/* Distances to the nearest and second nearest of one jittered point a cell,
 * and the number of the nearest [Worley96]. */
static uint64_t
nearest_pebble(int32_t n, int32_t x, int32_t y, double distance[2])
{
    const int32_t cells = n / PEBBLE;
    uint64_t nearest = 0;

    distance[0] = distance[1] = INFINITY;
    for (int32_t k = 0; k < 25; ++k)
    {
        const int32_t i = x / PEBBLE + k % 5 - 2, j = y / PEBBLE + k / 5 - 2;
        const uint64_t cell =
            (uint64_t)((j + cells) % cells * cells + (i + cells) % cells);
        const double px = (i + otx_random_unit(3, 1, cell)) * PEBBLE;
        const double py = (j + otx_random_unit(3, 2, cell)) * PEBBLE;
        const double d = hypot(x - px, y - py);

        if (d < distance[0])
        {
            distance[1] = distance[0];
            distance[0] = d;
            nearest = cell;
        }
        else if (d < distance[1])
            distance[1] = d;
    }
    return nearest;
}

otx_status
bench_patterns_pebbles(otx_run *run, int32_t n, otx_image *out)
{
    OTX_TRY(otx_image_create(run, run->arena, n, n, 3, out));
    for (int32_t y = 0; y < n; ++y)
        for (int32_t x = 0; x < n; ++x)
        {
            double distance[2];
            const uint64_t pebble = nearest_pebble(n, x, y, distance);
            const double edge = (distance[1] - distance[0]) / PEBBLE;
            const double light = fmin(1.0, 0.15 + 1.5 * edge);

            for (uint32_t c = 0; c < 3; ++c)
                otx_image_at(out, x, y)[c] =
                    (float)(light * (0.35 + 0.4 * otx_random_unit(4, c, pebble) + 0.25 * blob(n, x, y, 4, 3)));
        }
    return OSDTEX_OK;
}

static otx_status
build(
    otx_run *run, const otx_image *pixels, const char *path, bool is_float,
    otx_exemplar *out)
{
    const otx_exemplar_input input = {
        .pixels = *pixels, .source = {.path = path, .is_float = is_float}};
    otx_colour colour;

    OTX_TRY(otx_colour_open(run, NULL, NULL, &colour));
    return otx_exemplar_build(run, &colour, &input, out);
}

otx_status
bench_patterns_exemplar(
    otx_run *run, const otx_image *pixels, otx_exemplar *out)
{
    return build(run, pixels, "pattern", false, out);
}

otx_status
bench_patterns_read(otx_run *run, const char *path, otx_exemplar *out)
{
    otx_picture picture;

    OTX_TRY(otx_picture_read(run, path, &picture));
    return build(run, &picture.image, path, picture.is_float, out);
}

/* sharpen.c -- a twelfth of the second difference taken off, along x and y. */
#include "bake/sharpen.h"

static const float SHARE = 1.0f / 12.0f;

/* fminf() and fmaxf() are calls, for the sake of NaN. */
static inline float
smaller(float a, float b)
{
    return a < b ? a : b;
}

static inline float
larger(float a, float b)
{
    return a > b ? a : b;
}

/* Whether two texels show the same surface: of one chart, or one of them what
 * goes on beside it. */
static bool
hang_together(int32_t a, int32_t b)
{
    return a == b || a < 0 || b < 0;
}

/* Steps (in texels) to the pairs of neighbours that a texel is compared with.
 * Returns how many. */
static int32_t
find_pairs(
    const otx_sharpen_grid *grid, int32_t x, int32_t y, ptrdiff_t steps[2])
{
    const int32_t *owner = grid->owners + (ptrdiff_t)y * grid->width + x;
    const ptrdiff_t ways[2] = {1, grid->width};
    const bool is_inside[2] = {
        x > 0 && x + 1 < grid->width, y > 0 && y + 1 < grid->height};
    int32_t count = 0;

    for (int i = 0; i < 2; ++i)
        if (is_inside[i] && hang_together(owner[0], owner[ways[i]]) &&
            hang_together(owner[0], owner[-ways[i]]))
            steps[count++] = ways[i];
    return count;
}

void
otx_sharpen_texels(
    const otx_sharpen_grid *grid, int32_t left, int32_t below, int32_t width,
    int32_t height, float *out)
{
    const int32_t channels = grid->channels;

    for (int32_t y = below; y < below + height; ++y)
        for (int32_t x = left; x < left + width; ++x)
        {
            const float *in =
                grid->pixels + ((ptrdiff_t)y * grid->width + x) * channels;
            ptrdiff_t steps[2];
            const int32_t count = find_pairs(grid, x, y, steps);

            for (int32_t c = 0; c < channels; ++c, ++in)
            {
                float low = *in, high = *in, difference = 0.0f;

                for (int32_t i = 0; i < count; ++i)
                {
                    const float a = in[-steps[i] * channels];
                    const float b = in[steps[i] * channels];

                    low = smaller(low, smaller(a, b));
                    high = larger(high, larger(a, b));
                    difference += (a - *in) + (b - *in);
                }
                *out++ = smaller(larger(*in - SHARE * difference, low), high);
            }
        }
}

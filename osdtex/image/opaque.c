/* opaque.c -- where a picture can be taken from.
 *
 * The largest rectangle is found row by row: over each column stands a bar of
 * opaque texels that ends in the row, and a stack of bars of rising height
 * gives the widest rectangle below each of them, in time linear in texels. */
#include "image/opaque.h"

typedef struct bar
{
    int32_t start, height;
} bar;

static bool
is_transparent(const otx_image *image, int32_t x, int32_t y)
{
    return !(otx_image_at(image, x, y)[3] > 0.0f);
}

/* Takes the rectangle [start, end) of `height` rows that ends in row y when it
 * is larger than what there is. */
static void
offer(otx_opaque *out, bar b, int32_t end, int32_t y)
{
    const int64_t width = end - b.start;

    if (width * b.height <= (int64_t)out->width * out->height)
        return;
    out->x = b.start;
    out->y = y + 1 - b.height;
    out->width = (int32_t)width;
    out->height = b.height;
}

/*   heights  [width] of the bars that end in row y
 *   stack    [width + 1] */
static void
scan_row(
    const int32_t *heights, int32_t width, int32_t y, bar *stack,
    otx_opaque *out)
{
    int32_t used = 0;

    for (int32_t x = 0; x <= width; ++x)
    {
        const int32_t height = x < width ? heights[x] : 0;
        int32_t start = x;

        while (used > 0 && stack[used - 1].height >= height)
        {
            const bar b = stack[--used];

            offer(out, b, x, y);
            start = b.start;
        }
        stack[used++] = (bar){start, height};
    }
}

bool
otx_opaque_find(otx_arena *arena, const otx_image *image, otx_opaque *out)
{
    int32_t *heights = OTX_ZNEW(arena, int32_t, image->width);
    bar *stack = OTX_NEW(arena, bar, (size_t)image->width + 1);
    int64_t count = 0;

    *out = (otx_opaque){0.0, 0, 0, image->width, image->height};
    if (!heights || !stack)
        return false;
    if (image->channels < 4)
        return true;
    out->width = out->height = 0;
    for (int32_t y = 0; y < image->height; ++y)
    {
        for (int32_t x = 0; x < image->width; ++x)
        {
            const bool hole = is_transparent(image, x, y);

            heights[x] = hole ? 0 : heights[x] + 1;
            count += hole;
        }
        scan_row(heights, image->width, y, stack, out);
    }
    out->transparent =
        (double)count / ((double)image->width * (double)image->height);
    return true;
}

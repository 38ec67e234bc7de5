/* html.c -- escapes, base64, SVG. */
#include "regress/html.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

void
otx_html_put_text(FILE *out, const char *text)
{
    for (; text && *text; ++text)
    {
        switch (*text)
        {
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '&':
            fputs("&amp;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(*text, out);
        }
    }
}

/* Three bytes to four letters; [count] of them are there. */
static void
put_triple(FILE *out, const uint8_t *b, size_t count)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "abcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint32_t bits = (uint32_t)b[0] << 16 |
                          (count > 1 ? (uint32_t)b[1] << 8 : 0) |
                          (count > 2 ? b[2] : 0);

    fputc(letters[bits >> 18], out);
    fputc(letters[bits >> 12 & 63], out);
    fputc(count > 1 ? letters[bits >> 6 & 63] : '=', out);
    fputc(count > 2 ? letters[bits & 63] : '=', out);
}

bool
otx_html_put_png(FILE *out, const char *path)
{
    FILE *in = path ? fopen(path, "rb") : NULL;
    uint8_t bytes[3];
    size_t count;

    if (!in)
        return false;
    fputs("url(data:image/png;base64,", out);
    while ((count = fread(bytes, 1, 3, in)) > 0)
        put_triple(out, bytes, count);
    fputc(')', out);
    fclose(in);
    return true;
}

bool
otx_html_png_size(const char *path, int size[2])
{
    FILE *in = path ? fopen(path, "rb") : NULL;
    uint8_t head[24]; /* signature, then IHDR: width and height at 16 and 20 */
    const bool whole = in && fread(head, 1, 24, in) == 24;

    if (in)
        fclose(in);
    if (!whole || memcmp(head, "\x89PNG", 4) != 0)
        return false;
    for (int i = 0; i < 2; ++i)
        size[i] = head[18 + 4 * i] << 8 | head[19 + 4 * i];
    return true;
}

/* ---------------------------------------------------------------------- */

enum
{
    CURVE_WIDTH = 120,
    CURVE_HEIGHT = 24,
    CURVE_MARGIN = 3
};

typedef struct curve
{
    size_t count;
    double low, high;
} curve;

static void
cover(curve *c, const json_t *number)
{
    if (!json_is_number(number))
        return;
    c->low = fmin(c->low, json_number_value(number));
    c->high = fmax(c->high, json_number_value(number));
}

static double
x_of(const curve *c, size_t i)
{
    return CURVE_MARGIN + (CURVE_WIDTH - 2.0 * CURVE_MARGIN) * (double)(i + 1) /
                              (double)(c->count);
}

/* Ever the same is a line through the middle. */
static double
y_of(const curve *c, const json_t *number)
{
    /* Halves, since the span itself may be beyond the largest number. */
    const double span = c->high / 2.0 - c->low / 2.0;
    const double share =
        span > 0.0 ? (json_number_value(number) / 2.0 - c->low / 2.0) / span
                   : 0.5;

    return CURVE_HEIGHT - CURVE_MARGIN -
           share * (CURVE_HEIGHT - 2.0 * CURVE_MARGIN);
}

void
otx_html_put_sparkline(
    FILE *out, const json_t *numbers, const json_t *reference)
{
    curve c = {json_array_size(numbers), INFINITY, -INFINITY};
    json_t *number;
    size_t i;

    if (c.count == 0)
        return;
    json_array_foreach(numbers, i, number)
    {
        cover(&c, number);
    }
    cover(&c, reference);
    fprintf(
        out,
        "<svg class=\"trend\" viewBox=\"0 0 %d %d\" role=\"img\" "
        "aria-label=\"%zu runs, from %.6g to %.6g\">",
        CURVE_WIDTH, CURVE_HEIGHT, c.count, c.low, c.high);
    if (json_is_number(reference))
        fprintf(
            out,
            "<line class=\"was\" x1=\"0\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/>",
            CURVE_WIDTH, y_of(&c, reference), y_of(&c, reference));
    fputs("<polyline points=\"", out);
    json_array_foreach(numbers, i, number)
    {
        fprintf(out, "%.1f,%.1f ", x_of(&c, i), y_of(&c, number));
    }
    number = json_array_get(numbers, c.count - 1);
    fprintf(
        out, "\"/><circle cx=\"%.1f\" cy=\"%.1f\" r=\"2\"/></svg>",
        x_of(&c, c.count - 1), y_of(&c, number));
}

/* compare.c -- hashes of content, differences of pictures. */
#include "regress/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool
otx_compare_hash_text(const char *path, char text[OSDTEX_HASH_BYTES])
{
    FILE *in = fopen(path, "rb");
    char *kept = NULL, *line = NULL;
    size_t bytes = 0, room = 0;
    FILE *out = in ? open_memstream(&kept, &bytes) : NULL;
    ssize_t length;
    bool whole = out != NULL;

    while (whole && (length = getline(&line, &room, in)) > 0)
        if (line[0] != '#' && strncmp(line, "<!--", 4) != 0)
            fwrite(line, 1, (size_t)length, out);
    if (in)
        whole = whole && !ferror(in);
    if (out && fclose(out) != 0)
        whole = false;
    if (in)
        fclose(in);
    if (whole)
        osdtex_hash(kept, bytes, text);
    free(kept);
    free(line);
    return whole;
}

static size_t
value_count(const osdtex_image_info *image)
{
    return (size_t)image->width * (size_t)image->height *
           (size_t)image->channels;
}

bool
otx_compare_hash_pixels(
    osdtex_context *context, const char *path, char text[OSDTEX_HASH_BYTES])
{
    char both[16 + 2 * OSDTEX_HASH_BYTES];
    const osdtex_image_info *info;
    osdtex_image *image;

    if (osdtex_image_read(context, path, &image) != OSDTEX_OK)
        return false;
    info = osdtex_image_describe(image);
    osdtex_hash(info->pixels, value_count(info) * sizeof(float), text);
    snprintf(
        both, sizeof both, "%d %d %d %s", info->width, info->height,
        info->channels, text);
    osdtex_hash(both, strlen(both), text);
    osdtex_image_destroy(image);
    return true;
}

static void
compare(
    const osdtex_image_info *a, const osdtex_image_info *b,
    otx_compare_difference *out)
{
    out->has_pixels = true;
    out->pixels = (int64_t)a->width * a->height;
    for (int64_t i = 0; i < out->pixels; ++i)
    {
        double most = 0.0;

        for (int32_t k = 0; k < a->channels; ++k)
            most = fmax(
                most, fabs(
                          (double)a->pixels[i * a->channels + k] -
                          (double)b->pixels[i * a->channels + k]));
        out->differing += most > 0.0;
        out->over += most > OTX_COMPARE_FAIL;
        if (most <= out->worst)
            continue;
        out->worst = most;
        out->x = (int32_t)(i % a->width);
        out->y = a->height - 1 - (int32_t)(i / a->width);
    }
    out->passes =
        (double)out->over <= OTX_COMPARE_SHARE * (double)out->pixels &&
        out->worst <= OTX_COMPARE_HARD;
}

void
otx_compare_pictures(
    osdtex_context *context, const char *path, const char *reference,
    otx_compare_difference *out)
{
    const osdtex_image_info *a, *b;
    osdtex_image *first = NULL, *second = NULL;

    *out = (otx_compare_difference){0};
    if (osdtex_image_read(context, path, &first) == OSDTEX_OK &&
        osdtex_image_read(context, reference, &second) == OSDTEX_OK)
    {
        a = osdtex_image_describe(first);
        b = osdtex_image_describe(second);
        if (a->width == b->width && a->height == b->height &&
            a->channels == b->channels)
            compare(a, b, out);
    }
    osdtex_image_destroy(first);
    osdtex_image_destroy(second);
}

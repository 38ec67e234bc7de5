/* derived.c -- exemplars that are made from others: cut out, put together anew,
 * or compared at another size. */
#include "exemplar/exemplar.h"

#include "exemplar/statistics.h"
#include "exemplar/tileable.h"
#include "image/texture.h"

#include <string.h>

static otx_status
crop(
    otx_run *run, const otx_image *from, int32_t x, int32_t y, int32_t width,
    int32_t height, otx_image *out)
{
    const size_t row = (size_t)width * (size_t)from->channels;

    *out = (otx_image){width, height, from->channels, NULL};
    if (!from->pixels)
        return OSDTEX_OK;
    OTX_TRY(
        otx_image_create(run, run->arena, width, height, from->channels, out));
    for (int32_t j = 0; j < height; ++j)
        memcpy(
            otx_image_at(out, 0, j), otx_image_at(from, x, y + j),
            row * sizeof *out->pixels);
    return OSDTEX_OK;
}

otx_status
otx_exemplar_crop(
    otx_run *run, const otx_exemplar *from, int32_t x, int32_t y, int32_t width,
    int32_t height, otx_exemplar *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_exemplar made = *from;
    otx_tileable test;

    OTX_TRY(crop(run, &from->linear, x, y, width, height, &made.linear));
    OTX_TRY(crop(run, &from->match, x, y, width, height, &made.match));
    OTX_TRY(crop(run, &from->lab, x, y, width, height, &made.lab));
    OTX_TRY(otx_companions_crop(
        run, &from->companions, from->linear.width,
        (const int32_t[]){x, y, width, height}, &made.companions));
    OTX_TRY(otx_exemplar_measure(run, &made));
    if (width < from->lab.width && made.lab.pixels)
    {
        OTX_TRY(otx_tileable_test(run, &made.lab, 0, &test));
        made.wrap_x = test.tiles;
    }
    if (height < from->lab.height && made.lab.pixels)
    {
        OTX_TRY(otx_tileable_test(run, &made.lab, 1, &test));
        made.wrap_y = test.tiles;
    }
    *out = made;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static otx_status
rearrange(
    otx_run *run, const otx_image *from, const int32_t *texels, otx_image *out)
{
    const size_t count = (size_t)from->width * (size_t)from->height;
    const size_t channels = (size_t)from->channels;

    *out = *from;
    if (!from->pixels)
        return OSDTEX_OK;
    OTX_TRY(otx_image_create(
        run, run->arena, from->width, from->height, from->channels, out));
    for (size_t i = 0; i < count; ++i)
        memcpy(
            out->pixels + i * channels,
            from->pixels + (size_t)texels[i] * channels,
            channels * sizeof *out->pixels);
    return OSDTEX_OK;
}

otx_status
otx_exemplar_rearrange(
    otx_run *run, const otx_exemplar *from, const int32_t *texels,
    otx_exemplar *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_exemplar made = *from;

    OTX_TRY(rearrange(run, &from->linear, texels, &made.linear));
    OTX_TRY(rearrange(run, &from->match, texels, &made.match));
    OTX_TRY(rearrange(run, &from->lab, texels, &made.lab));
    OTX_TRY(otx_companions_rearrange(
        run, &from->companions, from->linear.width, from->linear.height, texels,
        &made.companions));
    OTX_TRY(otx_exemplar_measure(run, &made));
    made.wrap_x = made.wrap_y = true;
    *out = made;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* One picture at another size. */
typedef struct resizing
{
    const otx_texture *from;
    otx_image *to;
    otx_texture_probes probes; /* of a texel of it */
} resizing;

static otx_status
resize_row(void *context, int64_t y, otx_worker *worker)
{
    const resizing *r = context;
    const otx_vec2 step = {1.0 / r->to->width, 1.0 / r->to->height};

    (void)worker;
    for (int32_t x = 0; x < r->to->width; ++x)
    {
        float values[OTX_IMAGE_MAX_CHANNELS];

        otx_texture_probe(
            r->from, &r->probes,
            (otx_vec2){(x + 0.5) * step.x, ((double)y + 0.5) * step.y}, values);
        memcpy(
            otx_image_at(r->to, x, (int32_t)y), values,
            (size_t)r->to->channels * sizeof *values);
    }
    return OSDTEX_OK;
}

static otx_status
resize(
    otx_run *run, const otx_exemplar *e, const otx_image *from, int32_t width,
    int32_t height, otx_image *out)
{
    otx_texture texture;
    resizing r = {.from = &texture, .to = out};

    *out = (otx_image){width, height, from->channels, NULL};
    if (!from->pixels)
        return OSDTEX_OK;
    OTX_TRY(otx_texture_create(
        run, run->scratch, from, e->wrap_x, e->wrap_y, &texture));
    OTX_TRY(
        otx_image_create(run, run->arena, width, height, from->channels, out));
    r.probes = otx_texture_measure(
        &texture, (otx_vec2){1.0 / width, 0.0}, (otx_vec2){0.0, 1.0 / height});
    return otx_pool_for(run->pool, height, resize_row, &r);
}

otx_status
otx_exemplar_resize(
    otx_run *run, const otx_exemplar *from, int32_t width, int32_t height,
    otx_exemplar *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_exemplar made = *from;

    if (width < OTX_EXEMPLAR_MIN_SIDE || height < OTX_EXEMPLAR_MIN_SIDE)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, "colour",
            (otx_where){from->source_path, 0, -1, -1},
            "at its scale the picture has %d x %d texels of the first "
            "exemplar's size, too few to texture with",
            (int)width, (int)height);
    OTX_TRY(resize(run, from, &from->match, width, height, &made.match));
    OTX_TRY(resize(run, from, &from->lab, width, height, &made.lab));
    OTX_TRY(otx_exemplar_measure(run, &made));
    *out = made;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_exemplar_rescale(
    otx_run *run, const otx_exemplar *from, int32_t width, int32_t height,
    otx_exemplar *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_exemplar made;

    OTX_TRY(otx_exemplar_resize(run, from, width, height, &made));
    OTX_TRY(resize(run, from, &from->linear, width, height, &made.linear));
    OTX_TRY(resize(
        run, from, &from->companions.image, width, height,
        &made.companions.image));
    *out = made;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

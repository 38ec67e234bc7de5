/* wire.c -- arrays as the page reads them, in one block of bytes. */
#include "studio/wire.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* How far from what was asked is shown. */
static const float OCTAVES = 16.0f;

/* -- a block -------------------------------------------------------------- */

static size_t
padded(size_t bytes)
{
    return (bytes + 3) & ~(size_t)3;
}

/* Room for a head and so many bytes. */
static otx_wire
begin(const int32_t head[OTX_WIRE_HEAD], size_t bytes)
{
    otx_wire w = {NULL, OTX_WIRE_HEAD * sizeof *head};

    w.bytes = calloc(1, w.count + bytes);
    if (w.bytes)
        memcpy(w.bytes, head, w.count);
    return w;
}

/* The place of the next array. */
static void *
next(otx_wire *w, size_t bytes)
{
    void *at = (char *)w->bytes + w->count;

    w->count += padded(bytes);
    return at;
}

static void
add(otx_wire *w, const void *array, size_t bytes)
{
    void *at = next(w, bytes);

    if (array)
        memcpy(at, array, bytes);
}

otx_wire
otx_wire_surface(const otx_snapshot *s)
{
    const osdtex_surface_info *i =
        osdtex_surface_describe(osdtex_mapping_surface(s->outcome->mapping));
    const size_t verts = (size_t)i->vert_count, faces = (size_t)i->face_count,
                 corners = (size_t)i->corner_count;
    const int32_t head[OTX_WIRE_HEAD] = {
        OTX_WIRE_MAGIC,  (int32_t)s->outcome->surface_serial,
        i->vert_count,   i->face_count,
        i->corner_count, i->level};
    otx_wire w = begin(
        head, sizeof i->origin + 4 * (6 * verts + 2 * faces + 1 + corners));

    if (!w.bytes)
        return w;
    add(&w, i->origin, sizeof i->origin);
    add(&w, i->points, verts * 3 * sizeof(float));
    add(&w, i->normals, verts * 3 * sizeof(float));
    add(&w, i->face_first, (faces + 1) * sizeof(int32_t));
    add(&w, i->face_verts, corners * sizeof(int32_t));
    add(&w, i->face_cage, faces * sizeof(int32_t));
    return w;
}

/* Octaves by which faces show the texture larger than asked, or smaller; what
 * is turned over is as large as can be, and holes are not looked at. */
static void
put_stretch(const otx_snapshot *s, float *out)
{
    const osdtex_mapping_info *m = osdtex_mapping_describe(s->outcome->mapping);

    for (osdtex_index f = 0; f < m->face_count; ++f)
    {
        const float stretch = s->outcome->stretch[f];

        out[f] = isnan(stretch)
                     ? 0.0f
                     : fminf(OCTAVES, fmaxf(-OCTAVES, log2f(stretch)));
    }
}

otx_wire
otx_wire_mapping(const otx_snapshot *s)
{
    const osdtex_mapping_info *m = osdtex_mapping_describe(s->outcome->mapping);
    const osdtex_field_info *d =
        s->outcome->field ? osdtex_field_describe(s->outcome->field) : NULL;
    const size_t faces = (size_t)m->face_count,
                 corners = (size_t)m->corner_count,
                 verts = d ? (size_t)d->vert_count : 0;
    const int32_t head[OTX_WIRE_HEAD] = {OTX_WIRE_MAGIC,
                                         (int32_t)s->serial,
                                         (int32_t)s->outcome->surface_serial,
                                         m->face_count,
                                         m->corner_count,
                                         m->patch_count,
                                         m->exemplar_count,
                                         d ? d->symmetry : 0,
                                         (int32_t)verts};
    otx_wire w =
        begin(head, 4 * (2 * corners + 5 * faces + verts) + padded(faces));
    uint8_t *exemplars;

    if (!w.bytes)
        return w;
    add(&w, m->uvs, corners * 2 * sizeof(float));
    add(&w, m->face_patch, faces * sizeof(int32_t));
    put_stretch(s, next(&w, faces * sizeof(float)));
    add(&w, d ? d->directions : NULL, faces * 3 * sizeof(float));
    add(&w, d ? d->scales : NULL, verts * sizeof(float));
    exemplars = next(&w, faces);
    for (size_t f = 0; m->patch_exemplar && f < faces; ++f)
        if (m->face_patch[f] >= 0)
            exemplars[f] = m->patch_exemplar[m->face_patch[f]];
    return w;
}

otx_wire
otx_wire_seams(const otx_snapshot *s)
{
    const osdtex_seams_info *i = osdtex_seams_describe(s->outcome->seams);
    int32_t head[OTX_WIRE_HEAD] = {OTX_WIRE_MAGIC, (int32_t)s->serial};
    otx_wire w;

    for (int32_t k = 0; k < i->seam_count; ++k)
        head[2] += i->seams[k].difference > 0.0f;
    w = begin(head, (size_t)head[2] * sizeof *i->seams);
    for (int32_t k = 0; w.bytes && k < i->seam_count; ++k)
        if (i->seams[k].difference > 0.0f)
            add(&w, &i->seams[k], sizeof *i->seams);
    return w;
}

/* -- textures ------------------------------------------------------------- */

static uint8_t
srgb(double linear)
{
    const double v = linear <= 0.0031308
                         ? 12.92 * linear
                         : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;

    return (uint8_t)lround(255.0 * fmin(1.0, fmax(0.0, v)));
}

/* Mean of a square of texels. */
static void
put_texel(
    const osdtex_exemplar_info *e, int32_t x, int32_t y, int32_t step,
    uint8_t out[4])
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};

    for (int32_t i = 0; i < step * step; ++i)
    {
        const size_t at = (size_t)(y * step + i / step) * (size_t)e->width +
                          (size_t)(x * step + i % step);

        for (int32_t k = 0; k < e->channels; ++k)
            sum[k] += (double)e->pixels[at * (size_t)e->channels + (size_t)k];
    }
    for (int32_t k = 0; k < 3; ++k)
        out[k] = srgb(sum[k] / (step * step));
    out[3] = 255;
}

otx_wire
otx_wire_texture(const osdtex_exemplar *exemplar, int32_t most)
{
    const osdtex_exemplar_info *e = osdtex_exemplar_describe(exemplar);
    int32_t step = 1;

    while (e->width / step > most || e->height / step > most)
        step *= 2;

    const int32_t width = e->width / step, height = e->height / step;
    const int32_t head[OTX_WIRE_HEAD] = {
        OTX_WIRE_MAGIC, width, height, e->wrap_x, e->wrap_y};
    const size_t bytes = 4 * (size_t)width * (size_t)height;
    otx_wire w = begin(head, bytes);
    uint8_t *texels;

    if (!w.bytes)
        return w;
    texels = next(&w, bytes);
    for (int32_t y = 0; y < height; ++y)
        for (int32_t x = 0; x < width; ++x)
            put_texel(
                e, x, y, step,
                texels + 4 * ((size_t)y * (size_t)width + (size_t)x));
    return w;
}

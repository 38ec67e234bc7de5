/* paste_atlas.c -- the pictures of pastes side by side, cut out by alpha. */
#include "export/paste_atlas.h"

#include "image/view.h"
#include "surface/facet.h"

#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "export";

enum
{
    TEXELS_MOST = 1 << 27
};

/* Beyond the sides of a triangle that filters reach, texels. */
static const double BEYOND = 1.5;

/* ---- room ---- */

/* A power of two of which n is 3 or 4, rounded up. */
static int32_t
unit_of(int32_t n)
{
    int32_t unit = 1;

    while (4 * unit < n)
        unit *= 2;
    return unit;
}

static int32_t
round_up(int32_t n, int32_t unit)
{
    return (n + unit - 1) / unit * unit;
}

typedef struct cell_size
{
    int32_t unit, width, height, index;
} cell_size;

/* Large units first, so that what follows stays at multiples of its own. */
static int
compare_sizes(const void *a, const void *b)
{
    const cell_size *p = a, *q = b;

    if (p->unit != q->unit)
        return p->unit > q->unit ? -1 : 1;
    if (p->height != q->height)
        return p->height > q->height ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

/* Puts cells into rows; the height that they take. */
static int64_t
put_rows(const cell_size *sizes, int32_t count, int32_t width, int32_t *places)
{
    int64_t y = 0;
    int32_t x = 0, height = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        if (x + sizes[i].width > width)
        {
            y += height;
            x = height = 0;
        }
        places[2 * sizes[i].index] = x;
        places[2 * sizes[i].index + 1] = y < INT32_MAX ? (int32_t)y : 0;
        x += sizes[i].width;
        height = height > sizes[i].height ? height : sizes[i].height;
    }
    return y + height;
}

static otx_status
check_room(otx_run *run, int64_t width, int64_t height)
{
    if (width <= OTX_IMAGE_MAX_SIDE && height <= OTX_IMAGE_MAX_SIDE &&
        width * height <= TEXELS_MOST)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
        "the pictures of the pastes take %lld x %lld texels, which is more "
        "than a bake would; write one, or raise {scale}",
        (long long)width, (long long)height);
}

otx_status
otx_paste_atlas_pack(
    otx_run *run, const otx_paste_list *list, otx_paste_atlas *out)
{
    const int32_t count = list->cell_count;
    cell_size *sizes = OTX_NEW(run->scratch, cell_size, count);
    int32_t widest = 4;
    double area = 0.0;
    int64_t height;

    *out = (otx_paste_atlas){
        .list = list,
        .places = OTX_ZNEW(run->scratch, int32_t, 2 * (size_t)count),
        .sides = OTX_NEW(run->scratch, int32_t, 2 * (size_t)count),
        .units = OTX_NEW(run->scratch, int32_t, count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_paste_cell *c = &list->cells[i];
        const int32_t unit =
            unit_of(c->width > c->height ? c->width : c->height);

        out->units[i] = unit;
        out->sides[2 * i] = round_up(c->width, unit);
        out->sides[2 * i + 1] = round_up(c->height, unit);
        sizes[i] =
            (cell_size){unit, out->sides[2 * i], out->sides[2 * i + 1], i};
        widest = widest > sizes[i].width ? widest : sizes[i].width;
        area += (double)sizes[i].width * sizes[i].height;
    }
    if (count > 1)
        qsort(sizes, (size_t)count, sizeof *sizes, compare_sizes);
    OTX_TRY(check_room(run, (int64_t)fmin(sqrt(area), 1e9), 1));
    out->width = round_up(
        widest > sqrt(area) ? widest : (int32_t)sqrt(area),
        count > 0 ? sizes[0].unit : 1);
    height = put_rows(sizes, count, out->width, out->places);
    height = (height > 4 ? height : 4) + (count > 0 ? sizes[0].unit : 1) - 1;
    height -= height % (count > 0 ? sizes[0].unit : 1);
    OTX_TRY(check_room(run, out->width, height));
    out->height = (int32_t)height;
    return OSDTEX_OK;
}

/* ---- weights ---- */

/* A triangle of a face in the atlas, with its weights. */
typedef struct facet
{
    otx_vec2 at[3];
    double weights[3];
} facet;

/* Barycentric coordinates; false where there is no area. */
static bool
coordinates(const facet *t, otx_vec2 at, double out[3])
{
    const otx_vec2 a = otx_vec2_sub(t->at[1], t->at[0]);
    const otx_vec2 b = otx_vec2_sub(t->at[2], t->at[0]);
    const otx_vec2 d = otx_vec2_sub(at, t->at[0]);
    const double area = otx_vec2_cross(a, b);

    out[1] = otx_vec2_cross(d, b) / area;
    out[2] = otx_vec2_cross(a, d) / area;
    out[0] = 1.0 - out[1] - out[2];
    return fabs(area) > 1e-9;
}

/* How far outside of the triangle a place is, texels. */
static double
beyond(const facet *t, const double w[3])
{
    const double area = fabs(otx_vec2_cross(
        otx_vec2_sub(t->at[1], t->at[0]), otx_vec2_sub(t->at[2], t->at[0])));
    double most = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        const double side = otx_vec2_length(
            otx_vec2_sub(t->at[(k + 1) % 3], t->at[(k + 2) % 3]));

        most = fmax(most, -w[k] * area / fmax(side, 1e-9));
    }
    return most;
}

/* What is inside of a triangle has its weights, what is next to it too where no
 * other has it. */
static void
draw_facet(const facet *t, bool inside, otx_image *weights)
{
    const double reach = inside ? 0.0 : BEYOND;
    double w[3];

    for (int32_t y = (int32_t)fmax(
             floor(fmin(fmin(t->at[0].y, t->at[1].y), t->at[2].y) - 2.0), 0.0);
         y < weights->height &&
         y < fmax(fmax(t->at[0].y, t->at[1].y), t->at[2].y) + 2.0;
         ++y)
        for (int32_t x = (int32_t)fmax(
                 floor(fmin(fmin(t->at[0].x, t->at[1].x), t->at[2].x) - 2.0),
                 0.0);
             x < weights->width &&
             x < fmax(fmax(t->at[0].x, t->at[1].x), t->at[2].x) + 2.0;
             ++x)
        {
            float *to = otx_image_at(weights, x, y);
            double sum = 0.0;

            if (!coordinates(t, (otx_vec2){x + 0.5, y + 0.5}, w) ||
                beyond(t, w) > reach || (!inside && *to >= 0.0f))
                continue;
            for (int k = 0; k < 3; ++k)
                sum += w[k] * t->weights[k];
            *to = (float)fmin(fmax(sum, 0.0), 1.0);
        }
}

static void
draw_face(
    const otx_paste_atlas *atlas, const otx_paste_face *face, bool inside,
    otx_image *weights)
{
    const otx_level *leaf = otx_surface_leaf(atlas->list->mapping->surface);
    const int32_t *place = atlas->places + 2 * (size_t)face->cell;
    const int32_t first = leaf->face_first[face->face];

    for (int32_t i = 0; i < otx_facet_count(leaf, face->face); ++i)
    {
        const otx_facet corners = otx_facet_at(leaf, face->face, i);
        facet t;

        for (int k = 0; k < 3; ++k)
        {
            const int32_t local = corners.corners[k] - first;

            t.at[k] = otx_vec2_add(
                otx_paste_list_at(atlas->list, face, local),
                (otx_vec2){place[0], place[1]});
            t.weights[k] = (double)face->lookup[local].weight;
        }
        draw_facet(&t, inside, weights);
    }
}

/* The weights of faces as a picture; negative where no face is. */
static otx_status
draw_weights(otx_run *run, const otx_paste_atlas *atlas, otx_image *out)
{
    const otx_paste_list *list = atlas->list;
    const size_t count = (size_t)atlas->width * (size_t)atlas->height;

    OTX_TRY(otx_image_create(
        run, run->scratch, atlas->width, atlas->height, 1, out));
    for (size_t i = 0; i < count; ++i)
        out->pixels[i] = -1.0f;
    for (int pass = 0; pass < 2; ++pass)
        for (int32_t i = list->layer_first[1];
             i < list->layer_first[list->layer_count]; ++i)
        {
            if (list->cells[list->faces[i].cell].fades)
                draw_face(atlas, &list->faces[i], pass == 0, out);
            if (i % 4096 == 0)
                OTX_TRY(otx_progress(run, "write", 0.2));
        }
    return OSDTEX_OK;
}

/* ---- texels ---- */

typedef struct filling
{
    const otx_paste_atlas *atlas;
    const otx_image *weights;
    otx_image *image;
} filling;

/* What the fragment of a cell leaves of a texel of the exemplar. */
static double
alpha_at(
    const otx_paste_list *list, const otx_paste_cell *cell, int32_t x,
    int32_t y)
{
    const otx_exemplar *e = list->exemplar;
    const otx_fragment *f = &list->mapping->lookups->fragments[cell->fragment];
    const double u = (x + 0.5) / e->linear.width - (double)f->frame[0];
    const double v = (y + 0.5) / e->linear.height - (double)f->frame[1];
    const double width = 1.0 / (e->linear.width * (double)f->frame[2]);

    return f->outline
               ? otx_radial_alpha(
                     f->outline,
                     (otx_vec2){
                         u / (double)f->frame[2], v / (double)f->frame[3]},
                     width)
               : 1.0;
}

/* Texel (i, j) of a cell of which less is there by `alpha`. */
static void
put_texel(const otx_exemplar *e, int32_t x, int32_t y, double alpha, float *to)
{
    const otx_image *from = &e->linear;
    const float *texel = otx_image_at(
        from, otx_view_fold(x, from->width, e->wrap_x),
        otx_view_fold(y, from->height, e->wrap_y));
    const bool has_alpha = from->channels == 2 || from->channels == 4;

    for (int c = 0; c < 3; ++c)
        to[c] = (float)alpha * texel[from->channels < 3 ? 0 : c];
    to[3] = (float)alpha * (has_alpha ? texel[from->channels - 1] : 1.0f);
}

static otx_status
fill_cell(void *context, int64_t index, otx_worker *worker)
{
    const filling *f = context;
    const otx_paste_list *list = f->atlas->list;
    const otx_paste_cell *cell = &list->cells[index];
    const int32_t *place = f->atlas->places + 2 * index;

    (void)worker;
    for (int32_t j = 1; j + 1 < cell->height; ++j)
        for (int32_t i = 1; i + 1 < cell->width; ++i)
        {
            const int32_t x = place[0] + i, y = place[1] + j;
            double alpha = alpha_at(list, cell, cell->x + i, cell->y + j);

            if (cell->fades && *otx_image_at(f->weights, x, y) >= 0.0f)
                alpha *= (double)*otx_image_at(f->weights, x, y);
            if (alpha > 0.0)
                put_texel(
                    list->exemplar, cell->x + i, cell->y + j, alpha,
                    otx_image_at(f->image, x, y));
        }
    return OSDTEX_OK;
}

/* The rims of cells at a mip level. */
static void
clear_rims(const otx_paste_atlas *atlas, int32_t level, otx_image *image)
{
    for (int32_t i = 0; i < atlas->list->cell_count; ++i)
    {
        const int32_t x = atlas->places[2 * i] >> level;
        const int32_t y = atlas->places[2 * i + 1] >> level;
        const int32_t w = atlas->sides[2 * i] >> level;
        const int32_t h = atlas->sides[2 * i + 1] >> level;
        const size_t texel = 4 * sizeof(float);

        if (1 << level > atlas->units[i] || (w <= 2 && h <= 2))
            continue;
        memset(otx_image_at(image, x, y), 0, (size_t)w * texel);
        memset(otx_image_at(image, x, y + h - 1), 0, (size_t)w * texel);
        for (int32_t j = 0; j < h; ++j)
        {
            memset(otx_image_at(image, x, y + j), 0, texel);
            memset(otx_image_at(image, x + w - 1, y + j), 0, texel);
        }
    }
}

otx_status
otx_paste_atlas_fill(
    otx_run *run, const otx_paste_atlas *atlas, otx_pyramid *out)
{
    const size_t texels = (size_t)atlas->width * (size_t)atlas->height;
    otx_image weights = {0};
    filling f = {atlas, &weights, &out->levels[0]};
    bool fades = false;

    for (int32_t i = 0; i < atlas->list->cell_count; ++i)
        fades = fades || atlas->list->cells[i].fades;
    if (fades)
        OTX_TRY(draw_weights(run, atlas, &weights));
    OTX_TRY(otx_image_create(
        run, run->scratch, atlas->width, atlas->height, 4, &out->levels[0]));
    memset(out->levels[0].pixels, 0, 4 * texels * sizeof(float));
    OTX_TRY(otx_loop_result(
        run, STAGE,
        otx_pool_for(run->pool, atlas->list->cell_count, fill_cell, &f)));
    out->count = otx_pyramid_count(atlas->width, atlas->height);
    for (int32_t l = 1; l < out->count; ++l)
    {
        OTX_TRY(otx_pyramid_reduce(
            run, run->scratch, &out->levels[l - 1], &out->levels[l]));
        clear_rims(atlas, l, &out->levels[l]);
    }
    return OSDTEX_OK;
}

/* ---- maps ---- */

typedef struct map_filling
{
    const otx_paste_atlas *atlas;
    const otx_image *from;
    otx_image *to;
    int32_t factor; /* texels of the maps to one of the colour's side */
} map_filling;

static otx_status
fill_maps(void *context, int64_t index, otx_worker *worker)
{
    const map_filling *f = context;
    const otx_exemplar *e = f->atlas->list->exemplar;
    const otx_paste_cell *cell = &f->atlas->list->cells[index];
    const int32_t *place = f->atlas->places + 2 * index;
    const size_t bytes = (size_t)f->from->channels * sizeof(float);

    (void)worker;
    for (int32_t j = 0; j < cell->height * f->factor; ++j)
        for (int32_t i = 0; i < cell->width * f->factor; ++i)
            memcpy(
                otx_image_at(
                    f->to, place[0] * f->factor + i, place[1] * f->factor + j),
                otx_image_at(
                    f->from,
                    otx_view_fold(
                        cell->x * f->factor + i, f->from->width, e->wrap_x),
                    otx_view_fold(
                        cell->y * f->factor + j, f->from->height, e->wrap_y)),
                bytes);
    return OSDTEX_OK;
}

otx_status
otx_paste_atlas_maps(
    otx_run *run, const otx_paste_atlas *atlas, otx_companions *out)
{
    const otx_companions *from = &atlas->list->exemplar->companions;
    map_filling f = {
        atlas, &from->image, &out->image,
        from->image.width / atlas->list->exemplar->linear.width};

    *out = *from;
    OTX_TRY(otx_image_create(
        run, run->scratch, atlas->width * f.factor, atlas->height * f.factor,
        from->image.channels, &out->image));
    /* Outside of the cells it says what the first texel does. */
    for (size_t i = 0; i < (size_t)out->image.width * (size_t)out->image.height;
         ++i)
        memcpy(
            out->image.pixels + i * (size_t)from->image.channels,
            from->image.pixels, (size_t)from->image.channels * sizeof(float));
    return otx_loop_result(
        run, STAGE,
        otx_pool_for(run->pool, atlas->list->cell_count, fill_maps, &f));
}

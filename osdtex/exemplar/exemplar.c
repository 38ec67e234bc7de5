/* exemplar.c -- from a decoded file to the picture that is copied from and the
 * one that is compared.
 *
 * Passes run row by row over the pool and write only their own row; what is
 * summed over the picture is summed from rows in their order, so the bytes do
 * not depend on the number of threads. */
#include "exemplar/exemplar.h"

#include "colour/colour_known.h"
#include "colour/decoder.h"
#include "exemplar/statistics.h"
#include "exemplar/tileable.h"

#include <math.h>
#include <string.h>

static const char stage[] = "colour";

/* Below this A a colour is not divided by it: noise would become light. */
static const float alpha_min = 1.0F / 65536.0F;

/* What a pass has found in a row. */
typedef struct row_result
{
    int32_t bad_x; /* first texel that is not finite, -1 none */
    float low, high;
} row_result;

typedef struct build
{
    otx_run *run;
    const otx_colour *colour;
    const otx_exemplar_input *input;
    otx_exemplar *out;
    const char *source_space;
    const otx_decoder *decoder; /* of the file's numbers to it; NULL none */
    const char *linear_space;
    otx_texture_type type;
    const char *pixel_space; /* what `linear` is in, where --to is data */
    const char *work_space;  /* what `work` is in; not a matter of --to */
    const char *match_space; /* NULL: the work picture with the sRGB curve */
    bool match_is_linear;
    bool is_data;
    row_result *rows;
    otx_image work;  /* what is compared is made from; may be `linear` */
    float low, high; /* over R, G, B of `work` */
} build;

/* One picture of linear light being made from the file's pixels. */
typedef struct bringing
{
    const build *b;
    const char *space;
    const otx_image *to;
    bool divide_alpha;   /* colour is unassociated for the conversion */
    bool multiply_alpha; /* and associated again afterwards */
} bringing;

/* ---- the linear picture ---- */

static void
scale_colour(float *texel, float factor)
{
    for (int k = 0; k < 3; ++k)
        texel[k] *= factor;
}

/* Grey becomes R = G = B; premultiplied colour is unassociated. */
static otx_status
load_row(void *context, int64_t y, otx_worker *worker)
{
    const bringing *g = context;
    const otx_image *from = &g->b->input->pixels;
    const otx_image *to = g->to;
    const int32_t step = from->channels >= 3 ? 1 : 0;
    (void)worker;

    for (int32_t x = 0; x < to->width; ++x)
    {
        const float *in = otx_image_at(from, x, (int32_t)y);
        float *out = otx_image_at(to, x, (int32_t)y);

        for (int k = 0; k < 3; ++k)
            out[k] = in[k * step];
        if (to->channels == 4)
            out[3] = in[from->channels - 1];
        if (g->divide_alpha && out[3] > alpha_min)
            scale_colour(out, 1.0F / out[3]);
    }
    return OSDTEX_OK;
}

/* Associates colour with A again, and looks for what is not finite. */
static otx_status
finish_row(void *context, int64_t y, otx_worker *worker)
{
    const bringing *g = context;
    const otx_image *image = g->to;
    row_result r = {.bad_x = -1, .low = INFINITY, .high = -INFINITY};
    (void)worker;

    for (int32_t x = 0; x < image->width; ++x)
    {
        float *texel = otx_image_at(image, x, (int32_t)y);
        bool finite = true;

        if (g->multiply_alpha && !(g->divide_alpha && texel[3] <= alpha_min))
            scale_colour(texel, texel[3]);
        for (int k = 0; k < image->channels; ++k)
            finite = finite && isfinite(texel[k]);
        if (!finite && r.bad_x < 0)
            r.bad_x = x;
        for (int k = 0; k < 3; ++k)
        {
            /* fminf() is a call. */
            r.low = texel[k] < r.low ? texel[k] : r.low;
            r.high = texel[k] > r.high ? texel[k] : r.high;
        }
    }
    g->b->rows[y] = r;
    return OSDTEX_OK;
}

/* Rows from the top, as people count them. */
static otx_status
check_finite(build *b, const bringing *g)
{
    const int32_t height = g->to->height;
    otx_where where = OTX_NOWHERE;

    where.file = b->input->source.path;
    b->low = INFINITY;
    b->high = -INFINITY;
    for (int32_t y = height - 1; y >= 0; --y)
    {
        if (b->rows[y].bad_x >= 0)
            return otx_fail(
                b->run, OSDTEX_ERROR_NUMERIC, stage, where,
                "the pixel in column %d of row %d from the top is not finite "
                "in '%s'; repair the picture or check the colour spaces",
                b->rows[y].bad_x, height - 1 - y, g->space);
        b->low = fminf(b->low, b->rows[y].low);
        b->high = fmaxf(b->high, b->rows[y].high);
    }
    return OSDTEX_OK;
}

/* The file's pixels in `space`, in `arena`, or where arena is NULL in their
 * place; their range goes into b->low and b->high. */
static otx_status
bring(build *b, otx_arena *arena, const char *space, otx_image *out)
{
    const otx_image *pixels = &b->input->pixels;
    const bool premultiplied = b->input->alpha_is_premultiplied;
    const bool has_alpha = pixels->channels == 2 || pixels->channels == 4;
    const bool converts = b->decoder || strcmp(b->source_space, space) != 0;
    bringing g = {.b = b, .space = space, .to = out};

    *out = *pixels;
    if (arena)
        OTX_TRY(otx_image_create(
            b->run, arena, pixels->width, pixels->height, has_alpha ? 4 : 3,
            out));
    /* Without a conversion premultiplied pixels pass bit by bit. */
    g.divide_alpha = has_alpha && premultiplied && converts;
    g.multiply_alpha =
        has_alpha && !b->is_data && (g.divide_alpha || !premultiplied);
    OTX_TRY(otx_pool_for(b->run->pool, out->height, load_row, &g));
    if (b->decoder)
        OTX_TRY(otx_decoder_apply(b->run, b->decoder, out));
    if (converts)
        OTX_TRY(
            otx_colour_convert(b->run, b->colour, b->source_space, space, out));
    OTX_TRY(otx_pool_for(b->run->pool, out->height, finish_row, &g));
    return check_finite(b, &g);
}

/* What is copied, in the space that was asked for, and what is compared, which
 * is the same picture unless another space than usual was asked for: so that
 * the mapping is the same whatever space its texture is written in. */
static otx_status
build_linear(build *b)
{
    const otx_exemplar_input *input = b->input;
    const bool takes =
        input->may_take && input->linear_only && input->pixels.channels >= 3;

    OTX_TRY(bring(
        b, takes ? NULL : b->run->arena, b->linear_space, &b->out->linear));
    b->work = b->out->linear;
    if (b->input->linear_only || strcmp(b->pixel_space, b->work_space) == 0)
        return OSDTEX_OK;
    return bring(b, b->run->scratch, b->work_space, &b->work);
}

/* ---- the pictures that are compared ---- */

/* One picture being made from the linear one. */
typedef struct view
{
    const build *b;
    const otx_image *image;
    otx_image *display;
    otx_embedding embedding;
    bool encode;
} view;

/* Scene-linear colours below the peak; data scaled into [0, 1] together. */
static otx_status
shape_row(void *context, int64_t y, otx_worker *worker)
{
    const view *v = context;
    const build *b = v->b;
    const float low = fminf(b->low, 0.0F);
    const float range = fmaxf(b->high, 1.0F) - low;
    (void)worker;

    for (int32_t x = 0; x < v->display->width; ++x)
    {
        const float *in = otx_image_at(&b->work, x, (int32_t)y);
        float *out = otx_image_at(v->display, x, (int32_t)y);

        if (!b->is_data)
            otx_embedding_shape(b->high, in, out);
        else
            for (int k = 0; k < 3; ++k)
                out[k] = (in[k] - low) / range;
        if (v->encode)
            for (int k = 0; k < 3; ++k)
                out[k] = otx_embedding_encode(out[k]);
    }
    return OSDTEX_OK;
}

static otx_status
encode_row(void *context, int64_t y, otx_worker *worker)
{
    const view *v = context;
    float *row = otx_image_at(v->display, 0, (int32_t)y);
    (void)worker;

    for (int32_t i = 0; i < 3 * v->display->width; ++i)
        row[i] = otx_embedding_encode(row[i]);
    return OSDTEX_OK;
}

static otx_status
embed_row(void *context, int64_t y, otx_worker *worker)
{
    const view *v = context;
    (void)worker;

    for (int32_t x = 0; x < v->display->width; ++x)
        otx_embedding_map(
            v->embedding, otx_image_at(v->display, x, (int32_t)y),
            otx_image_at(v->image, x, (int32_t)y));
    return OSDTEX_OK;
}

/* The display-like picture in `space`, or with the sRGB curve on the work
 * picture where there is no space. */
static otx_status
build_display(
    const build *b, const char *space, bool is_linear, otx_image *display)
{
    otx_run *run = b->run;
    view v = {.b = b, .display = display};

    v.encode = !b->is_data && !space;
    OTX_TRY(otx_pool_for(run->pool, display->height, shape_row, &v));
    if (b->is_data || !space)
        return OSDTEX_OK;
    OTX_TRY(otx_colour_convert(run, b->colour, b->work_space, space, display));
    if (is_linear)
        return otx_pool_for(run->pool, display->height, encode_row, &v);
    return OSDTEX_OK;
}

static otx_status
embed(
    const build *b, otx_image *display, otx_embedding embedding, otx_image *out)
{
    view v = {.b = b, .display = display, .embedding = embedding, .image = out};

    OTX_TRY(otx_image_create(
        b->run, b->run->arena, display->width, display->height, 3, out));
    return otx_pool_for(b->run->pool, display->height, embed_row, &v);
}

/* Lab is measured in sRGB, whatever space matching is done in. */
static otx_status
build_views(build *b)
{
    const char *srgb = otx_colour_srgb(b->colour);
    const char *match = b->match_space;
    const bool same = !srgb || (match && strcmp(srgb, match) == 0);
    otx_exemplar *out = b->out;
    otx_image display;

    OTX_TRY(otx_image_create(
        b->run, b->run->scratch, out->linear.width, out->linear.height, 3,
        &display));
    OTX_TRY(build_display(b, match, b->match_is_linear, &display));
    OTX_TRY(embed(b, &display, b->input->embedding, &out->match));
    if (!same && !b->is_data)
        OTX_TRY(build_display(b, srgb, false, &display));
    return embed(b, &display, OTX_EMBEDDING_LAB, &out->lab);
}

/* ---- decisions ---- */

static otx_status
check_input(otx_run *run, const otx_exemplar_input *input)
{
    const otx_image *pixels = &input->pixels;
    otx_where where = OTX_NOWHERE;

    where.file = input->source.path;
    if (pixels->channels < 1 || pixels->channels > 4 || !pixels->pixels ||
        (unsigned)input->embedding >= OTX_EMBEDDING_COUNT)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, stage, where,
            "an exemplar has 1 to 4 channels (grey or RGB, with or without "
            "alpha), not %d",
            pixels->channels);
    if (pixels->width < OTX_EXEMPLAR_MIN_SIDE ||
        pixels->height < OTX_EXEMPLAR_MIN_SIDE)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, stage, where,
            "the picture is %d x %d texels, too small to texture with; give "
            "one of at least %d x %d",
            pixels->width, pixels->height, OTX_EXEMPLAR_MIN_SIDE,
            OTX_EXEMPLAR_MIN_SIDE);
    return OSDTEX_OK;
}

static otx_status
resolve_spaces(build *b)
{
    const otx_exemplar_input *input = b->input;
    const otx_ocio *config = b->colour->config;

    OTX_TRY(otx_colour_resolve(
        b->run, b->colour, &input->source, &b->source_space, &b->decoder));
    b->is_data = otx_ocio_is_data(config, b->source_space);
    if (b->is_data)
    {
        b->linear_space = b->pixel_space = b->source_space;
        b->work_space = b->match_space = b->source_space;
        b->type =
            input->type == OTX_TEXTURE_ANY ? OTX_TEXTURE_EXR : input->type;
        otx_note(
            b->run, OSDTEX_SEVERITY_INFO, stage, OTX_NOWHERE,
            "'%s' holds data: the pixels pass unchanged and are compared as "
            "they are",
            b->source_space);
        return OSDTEX_OK;
    }
    otx_receiver_choice choice;

    OTX_TRY(otx_receiver_resolve(
        b->run, b->colour, input->receiver, input->to, input->type, &choice));
    b->linear_space = choice.space;
    b->type = choice.type;
    /* To data nothing is converted: the pixels stay in the input space. */
    b->pixel_space = otx_ocio_is_data(config, b->linear_space)
                         ? b->source_space
                         : b->linear_space;
    b->work_space = otx_colour_scene_linear(b->colour);
    if (!b->work_space)
        b->work_space = b->pixel_space;
    return otx_colour_resolve_match(
        b->run, b->colour, input->match_space, &b->match_space,
        &b->match_is_linear);
}

static otx_status
resolve_wrap(build *b)
{
    static const char *const words[] = {"no axis", "x", "y", "x and y"};
    otx_exemplar *out = b->out;
    otx_tileable x;
    otx_tileable y;
    otx_where where = OTX_NOWHERE;

    where.file = b->input->source.path;
    out->wrap_x = out->wrap_y = b->input->wrap == OTX_EXEMPLAR_WRAP_YES;
    if (b->input->wrap != OTX_EXEMPLAR_WRAP_AUTO)
    {
        otx_note(
            b->run, OSDTEX_SEVERITY_INFO, stage, where,
            "the picture is taken to tile in %s (asked for)",
            words[out->wrap_x ? 3 : 0]);
        return OSDTEX_OK;
    }
    OTX_TRY(otx_tileable_test(b->run, &out->lab, 0, &x));
    OTX_TRY(otx_tileable_test(b->run, &out->lab, 1, &y));
    out->wrap_x = x.tiles;
    out->wrap_y = y.tiles;
    otx_note(
        b->run, OSDTEX_SEVERITY_INFO, stage, where,
        "the picture tiles in %s (step across the border, and inside: x %.1f, "
        "%.1f; y %.1f, %.1f in Lab)",
        words[(x.tiles ? 1 : 0) + (y.tiles ? 2 : 0)], x.border, x.inner,
        y.border, y.inner);
    return OSDTEX_OK;
}

/* A copy, so that the exemplar may outlive file and configuration. */
static bool
keep(build *b, const char *text, const char **out)
{
    *out = text ? otx_arena_strdup(b->run->arena, text) : NULL;
    return *out || !text;
}

static otx_status
record(build *b)
{
    otx_exemplar *out = b->out;
    const char *match = b->match_space ? b->match_space : b->work_space;
    const char *source =
        b->decoder ? otx_decoder_name(b->decoder) : b->source_space;

    out->embedding = b->input->embedding;
    out->receiver = b->input->receiver;
    out->type = b->type;
    out->is_data = b->is_data;
    out->has_chromaticities = otx_colour_chromaticities(
        b->colour, b->linear_space, out->chromaticities);
    if (keep(b, b->input->source.path, &out->source_path) &&
        keep(b, b->input->hash, &out->source_hash) &&
        keep(b, source, &out->source_space) &&
        keep(b, b->linear_space, &out->linear_space) &&
        keep(b, match, &out->match_space) &&
        keep(
            b, otx_colour_interop_id(b->colour, b->linear_space),
            &out->interop_id))
        return OSDTEX_OK;
    return otx_fail_memory(b->run, stage);
}

/* What is compared, and what is found out by comparing. */
static otx_status
build_compared(build *b)
{
    otx_exemplar *out = b->out;

    if (b->input->linear_only)
    {
        out->match = out->lab =
            (otx_image){out->linear.width, out->linear.height, 3, NULL};
        out->wrap_x = out->wrap_y = b->input->wrap == OTX_EXEMPLAR_WRAP_YES;
        return OSDTEX_OK;
    }
    OTX_TRY(build_views(b));
    OTX_TRY(otx_progress(b->run, stage, 0.8));
    OTX_TRY(otx_exemplar_measure(b->run, out));
    return resolve_wrap(b);
}

static otx_status
build_all(build *b)
{
    OTX_TRY(resolve_spaces(b));
    b->rows = OTX_ZNEW(b->run->scratch, row_result, b->input->pixels.height);
    OTX_TRY(otx_run_ok(b->run));
    OTX_TRY(build_linear(b));
    OTX_TRY(otx_progress(b->run, stage, 0.4));
    OTX_TRY(build_compared(b));
    OTX_TRY(record(b));
    return otx_progress(b->run, stage, 1.0);
}

otx_status
otx_exemplar_build(
    otx_run *run, const otx_colour *colour, const otx_exemplar_input *input,
    otx_exemplar *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    build b = {.run = run, .colour = colour, .input = input, .out = out};

    *out = (otx_exemplar){0};
    OTX_TRY(check_input(run, input));

    const otx_status status = build_all(&b);

    otx_arena_release(run->scratch, mark);
    if (status != OSDTEX_OK)
        *out = (otx_exemplar){0};
    return status;
}

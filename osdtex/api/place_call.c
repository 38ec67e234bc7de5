/* place_call.c -- a mapping with pictures placed over it. */
#include "api/place_call.h"

#include "api/picture_source.h"
#include "base/hash.h"
#include "file/picture_read.h"
#include "file/place_file.h"
#include "place/place.h"

#include <string.h>

static const char STAGE[] = "place";

static const double DEGREES = OTX_PI / 180.0;

/* ---- pictures ---- */

static otx_status
read_picture(
    otx_call *call, const otx_place_picture *picture, const otx_exemplar *like,
    bool linear_only, otx_exemplar *out)
{
    otx_run *run = &call->run;
    otx_exemplar_input input = {
        .to = like->linear_space,
        .receiver = like->receiver,
        .type = OTX_TEXTURE_EXR,
        .match_space = like->match_space,
        .embedding = like->embedding,
        .wrap = OTX_EXEMPLAR_WRAP_NO,
        .linear_only = linear_only};
    char hash[OTX_HASH_TEXT_BYTES];
    const otx_colour *colour;
    otx_picture read;
    otx_run aside;

    OTX_TRY(otx_call_colour(call, &colour));
    OTX_TRY(otx_call_aside(call, &aside));
    OTX_TRY(otx_picture_read(&aside, picture->path, &read));
    otx_picture_source_fill(&read, &input.source);
    input.source.path = picture->path;
    input.source.from = picture->from;
    input.pixels = read.image;
    input.alpha_is_premultiplied = read.alpha_is_premultiplied;
    if (otx_hash_file(picture->path, hash))
        input.hash = hash;
    OTX_TRY(otx_exemplar_build(run, colour, &input, out));
    if (out->linear.channels < 4)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, STAGE, otx_where_file(picture->path),
            "the picture has no alpha: all of its rectangle is placed");
    return OSDTEX_OK;
}

otx_status
otx_place_call_pictures(
    otx_call *call, const otx_place_picture *list, int32_t count,
    const otx_exemplar *like, bool linear_only, otx_decals *out)
{
    otx_exemplar *pictures = OTX_ZNEW(call->run.arena, otx_exemplar, count);
    otx_texture *textures = OTX_ZNEW(call->run.arena, otx_texture, count);

    OTX_TRY(otx_run_ok(&call->run));
    for (int32_t k = 0; k < count; ++k)
    {
        OTX_TRY(read_picture(call, &list[k], like, linear_only, &pictures[k]));
        OTX_TRY(otx_texture_create(
            &call->run, call->run.arena, &pictures[k].linear, false, false,
            &textures[k]));
    }
    out->picture_count = count;
    out->pictures = pictures;
    out->textures = textures;
    return OSDTEX_OK;
}

/* ---- items ---- */

static bool
same_picture(const otx_place_picture *a, const otx_place_line *b)
{
    return strcmp(a->path, b->picture) == 0 &&
           (a->from && b->from ? strcmp(a->from, b->from) == 0
                               : a->from == b->from);
}

static otx_vec3
vector(const double v[3])
{
    return (otx_vec3){v[0], v[1], v[2]};
}

static otx_place_item
item_of(const otx_place_line *line, int32_t picture)
{
    return (otx_place_item){
        .picture = picture,
        .number = line->number,
        .face = line->face,
        .point = vector(line->point),
        .scatter = line->scatter,
        .width = line->width,
        .height = line->height,
        .has_up = line->has_up,
        .up = vector(line->up),
        .turn = line->turn * DEGREES,
        .mirror = line->mirror,
        .opacity = line->opacity,
        .anchor = {line->anchor[0], line->anchor[1]}};
}

/* Points are relative to the cage's origin inside. */
static otx_status
list_items(
    otx_call *call, const otx_place_file *file, const osdtex_mapping *handle,
    otx_place_list *out, otx_decals *decals)
{
    otx_run *run = &call->run;
    const double *origin = handle->surface->surface.cage->origin;
    otx_place_item *items = OTX_NEW(run->arena, otx_place_item, file->count);
    otx_place_picture *pictures =
        OTX_NEW(run->scratch, otx_place_picture, file->count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < file->count; ++i)
    {
        const otx_place_line *line = &file->lines[i];
        int32_t k = 0;

        while (k < count && !same_picture(&pictures[k], line))
            ++k;
        if (k == OSDTEX_PLACE_PICTURES_MAX)
            return otx_fail(
                run, OSDTEX_ERROR_LIMIT, STAGE, otx_where_file(file->path),
                "the file names more than %d pictures; put some of them into "
                "one",
                OSDTEX_PLACE_PICTURES_MAX);
        if (k == count)
            pictures[count++] = (otx_place_picture){line->picture, line->from};
        items[i] = item_of(line, k);
        items[i].point = otx_vec3_sub(items[i].point, vector(origin));
    }
    out->path = file->path;
    out->count = file->count;
    out->items = items;
    return otx_place_call_pictures(
        call, pictures, count, &handle->exemplars[0], false, decals);
}

static void
put_figures(otx_figures *figures, const otx_place_figures *placed)
{
    otx_figures_count(figures, "placed.decals", "decals", placed->count);
    otx_figures_count(figures, "placed.faces", "faces", placed->faces);
    otx_figures_real(figures, "placed.stretch_mean", "", placed->stretch_mean);
    otx_figures_real(figures, "placed.stretch_p95", "", placed->stretch_p95);
    otx_figures_real(figures, "placed.offset", "texels", placed->offset);
}

otx_status
otx_place_call(otx_call *call, const char *path, osdtex_mapping *handle)
{
    const otx_arena_mark mark = otx_arena_here(call->run.scratch);
    otx_place_figures placed;
    otx_place_list list = {0};
    otx_place_file file;
    otx_decals *decals;

    if (!path)
        return OSDTEX_OK;
    decals = OTX_ZNEW(call->run.arena, otx_decals, 1);
    OTX_TRY(otx_run_ok(&call->run));
    otx_figures_stage(&handle->figures, "place");
    OTX_TRY(otx_place_file_read(&call->run, path, &file));
    OTX_TRY(list_items(call, &file, handle, &list, decals));
    list.pictures = decals->pictures;
    OTX_TRY(otx_place_all(
        &call->run, &handle->surface->surface, &list, &decals->lookups,
        &placed));
    handle->mapping.decals = placed.count > 0 ? decals : NULL;
    otx_figures_stage(&handle->figures, NULL);
    put_figures(&handle->figures, &placed);
    otx_arena_release(call->run.scratch, mark);
    return OSDTEX_OK;
}

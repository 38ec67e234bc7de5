/* companion_pictures.c -- the other maps of a material, from their files or the
 * host's pixels. */
#include "api/companion_pictures.h"

#include "api/handle.h"
#include "api/picture_source.h"
#include "base/hash.h"
#include "exemplar/match_maps.h"
#include "file/exr_data.h"
#include "file/picture_read.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char STAGE[] = "material";

/* Files that are read, each once however many maps it holds. */
typedef struct pictures
{
    otx_run aside;
    otx_picture list[OTX_COMPANION_COUNT];
    char hashes[OTX_COMPANION_COUNT][OTX_HASH_TEXT_BYTES];
} pictures;

/* Their products are finite in 32 bits. */
static const double HEIGHT_MAX = 1e15;

static otx_status
check(otx_run *run, const osdtex_exemplar_options *options)
{
    if (options->map_count < 0 || options->map_count > OSDTEX_MAP_KINDS ||
        (options->map_count > 0 && !options->maps))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a material has up to %d maps besides its colour, one of a kind",
            OSDTEX_MAP_KINDS);
    if (!(options->height_range >= 0.0 && options->height_range <= HEIGHT_MAX))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "heights reach over a positive number of scene units up to %g, not "
            "%g",
            HEIGHT_MAX, options->height_range);
    if (!(fabs(options->height_middle) <= HEIGHT_MAX))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the surface stays where heights are a value up to %g, not %g",
            HEIGHT_MAX, options->height_middle);
    for (int32_t i = 0; i < options->map_count; ++i)
    {
        const osdtex_companion *map = &options->maps[i];

        if ((!map->path && !map->image) || map->kind < 0 ||
            map->kind >= OSDTEX_MAP_KINDS || map->channel < 0 ||
            map->channel > 3 ||
            (map->kind == OSDTEX_MAP_NORMAL && map->channel != 0))
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "a map of the material has neither a path nor an image, or is "
                "of "
                "no kind or channel that there is");
    }
    return OSDTEX_OK;
}

/* As NULL is to itself. */
static bool
same_text(const char *a, const char *b)
{
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static bool
same_source(const osdtex_companion *a, const osdtex_companion *b)
{
    return a->image == b->image &&
           (a->image ||
            (same_text(a->path, b->path) && same_text(a->layer, b->layer)));
}

/* Pixels of the host, as if from a file of floats. */
static otx_picture
picture_of(const osdtex_image *image)
{
    return (otx_picture){
        .image = image->image,
        .is_float = true,
        .bits = 32,
        .is_gray = image->image.channels < 3};
}

/* The only layer of an EXR, whatever its one channel is called; else NULL. */
static otx_status
only_layer(otx_run *run, const char *path, const char **out)
{
    otx_exr_data_list list;

    *out = NULL;
    if (!otx_exr_data_is_there(path))
        return OSDTEX_OK;
    OTX_TRY(otx_exr_data_list_read(run, path, &list));
    *out = list.count == 1 ? list.names[0] : NULL;
    return OSDTEX_OK;
}

/* The file of map i, or what an earlier map has of it. */
static otx_status
read_file(pictures *p, const osdtex_companion *maps, int32_t i)
{
    const char *layer = maps[i].layer;

    if (maps[i].image)
    {
        p->list[i] = picture_of(maps[i].image);
        return OSDTEX_OK;
    }
    for (int32_t k = 0; k < i; ++k)
        if (same_source(&maps[k], &maps[i]))
        {
            p->list[i] = p->list[k];
            memcpy(p->hashes[i], p->hashes[k], sizeof p->hashes[i]);
            return OSDTEX_OK;
        }
    if (!layer)
        OTX_TRY(only_layer(&p->aside, maps[i].path, &layer));
    OTX_TRY(
        otx_picture_read_layer(&p->aside, maps[i].path, layer, &p->list[i]));
    if (!otx_hash_file(maps[i].path, p->hashes[i]))
        p->hashes[i][0] = '\0';
    return OSDTEX_OK;
}

static otx_status
describe(
    otx_run *run, const pictures *p, const osdtex_companion *maps, int32_t i,
    otx_companion_input *out)
{
    const otx_picture *picture = &p->list[i];

    if (maps[i].channel >= picture->image.channels ||
        (picture->is_gray && maps[i].channel > 0))
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(maps[i].path),
            "the %s map is to be channel %d, and the picture has %d",
            otx_companion_name((otx_companion_kind)maps[i].kind),
            maps[i].channel + 1,
            picture->is_gray ? 1 : picture->image.channels);
    *out = (otx_companion_input){
        .kind = (otx_companion_kind)maps[i].kind,
        .pixels = picture->image,
        .is_gray = picture->is_gray,
        .is_float = picture->is_float,
        .bits = picture->bits,
        .channel = maps[i].channel,
        .y_down = maps[i].y_down != 0,
        .is_inverted = maps[i].inverted != 0,
        .path = maps[i].image ? NULL : maps[i].path,
        .layer = maps[i].image ? NULL : maps[i].layer,
        .hash = p->hashes[i][0] ? p->hashes[i] : NULL,
        .type = otx_picture_source_type(picture),
    };
    return OSDTEX_OK;
}

/* One map, for the eye. */
static void
print_map(const otx_companion_input *in, char *text, size_t bytes)
{
    static const char *const channels[] = {"red", "green", "blue", "alpha"};
    const bool is_normal = in->kind == OTX_COMPANION_NORMAL;
    const size_t used = strlen(text);

    snprintf(
        text + used, bytes - used, "%s%s map, %d x %d, %s, data%s%s%s%s%s%s",
        used > 0 ? "; " : "", otx_companion_name(in->kind), in->pixels.width,
        in->pixels.height, in->type, in->layer ? ", layer " : "",
        in->layer ? in->layer : "",
        is_normal ? in->y_down ? ", y down (DirectX)" : ", y up (OpenGL)" : "",
        !is_normal && !in->is_gray ? ", from " : "",
        !is_normal && !in->is_gray ? channels[in->channel] : "",
        in->is_inverted ? ", 1 less what it says (gloss)" : "");
}

static bool
same_file(const otx_companion_input *a, const otx_companion_input *b)
{
    return a == b || (a->path && b->path && strcmp(a->path, b->path) == 0);
}

/* What was found, a file at a time. */
static void
say(otx_run *run, const otx_companion_input *inputs, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
    {
        char text[1024] = "";
        bool said = false;

        for (int32_t k = 0; k < i; ++k)
            said = said || same_file(&inputs[k], &inputs[i]);
        for (int32_t k = i; k < count && !said; ++k)
            if (same_file(&inputs[k], &inputs[i]))
                print_map(&inputs[k], text, sizeof text);
        if (!said)
            otx_note(
                run, OSDTEX_SEVERITY_INFO, STAGE,
                otx_where_file(inputs[i].path), "%s", text);
    }
}

otx_status
otx_companion_pictures_take(
    otx_call *call, const osdtex_exemplar_options *options,
    const otx_exemplar *exemplar, otx_companions *out)
{
    otx_run *run = &call->run;
    const otx_image *color = &exemplar->linear;
    otx_companion_input inputs[OTX_COMPANION_COUNT];
    pictures *p;

    OTX_TRY(check(run, options));
    if (options->map_count == 0)
        return OSDTEX_OK;
    p = OTX_ZNEW(run->scratch, pictures, 1);
    if (!p)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(otx_call_aside(call, &p->aside));
    for (int32_t i = 0; i < options->map_count; ++i)
    {
        OTX_TRY(read_file(p, options->maps, i));
        OTX_TRY(describe(run, p, options->maps, i, &inputs[i]));
    }
    say(run, inputs, options->map_count);
    OTX_TRY(otx_companions_build(
        run, inputs, options->map_count, color->width, color->height,
        exemplar->wrap_x, exemplar->wrap_y, out));
    out->height_range = options->height_range;
    out->height_middle = options->height_middle;
    out->written_y_down = options->normals_y_down != 0;
    if (out->written_y_down && out->maps[OTX_COMPANION_NORMAL].is_there)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
            "normals are written with y down, and an MTL cannot say so: who "
            "reads one takes y to be up; the .usda and the .mtlx say it");
    return OSDTEX_OK;
}

otx_match_weights
otx_companion_pictures_weights(const osdtex_exemplar_options *options)
{
    otx_match_weights weights = {.color = options->match_color};

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        weights.maps[k] = options->match_maps[k];
    return weights;
}

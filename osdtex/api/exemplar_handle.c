/* exemplar_handle.c -- a picture from file or memory, its colours resolved. */
#include "api/exemplar_handle.h"

#include "analysis/exemplar_analysis.h"
#include "api/call.h"
#include "api/companion_pictures.h"
#include "api/exemplar_slices.h"
#include "api/picture_source.h"
#include "base/hash.h"
#include "export/companion_files.h"
#include "export/texture_file.h"
#include "file/exr_slices.h"
#include "file/picture_read.h"
#include "image/opaque.h"
#include "quilt/period.h"
#include "quilt/toroid.h"

#include <math.h>
#include <string.h>

static uint32_t
maps_of(const otx_companions *companions)
{
    uint32_t maps = 0;

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
        maps |= companions->maps[k].is_there ? 1u << k : 0u;
    return maps;
}

static osdtex_exemplar_info
info_of(const otx_exemplar *exemplar, const char *type)
{
    return (osdtex_exemplar_info){
        .path = exemplar->source_path,
        .hash = exemplar->source_hash,
        .type = type,
        .source_space = exemplar->source_space,
        .linear_space = exemplar->linear_space,
        .match_space = exemplar->match_space,
        .embedding = otx_embedding_name(exemplar->embedding),
        .width = exemplar->linear.width,
        .height = exemplar->linear.height,
        .channels = exemplar->linear.channels,
        .wrap_x = exemplar->wrap_x,
        .wrap_y = exemplar->wrap_y,
        .pixels = exemplar->linear.pixels,
        .source_width = exemplar->linear.width,
        .maps = maps_of(&exemplar->companions),
    };
}

static otx_status
check_options(
    otx_run *run, const osdtex_exemplar_options *theirs,
    osdtex_exemplar_options *ours)
{
    *ours = osdtex_exemplar_options_default();
    OTX_TRY(otx_call_options(run, ours, sizeof *ours, theirs));
    if (ours->embedding < 0 || ours->embedding >= OTX_EMBEDDING_COUNT ||
        ours->wrap < OSDTEX_WRAP_AUTO || ours->wrap > OSDTEX_WRAP_YES ||
        ours->tileable < OSDTEX_TILEABLE_AUTO ||
        ours->tileable > OSDTEX_TILEABLE_MAKE ||
        ours->receiver < OSDTEX_RECEIVER_ANY ||
        ours->receiver >= OTX_RECEIVER_COUNT ||
        ours->texture_type < OSDTEX_TEXTURE_ANY ||
        ours->texture_type >= OTX_TEXTURE_COUNT)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "colour", OTX_NOWHERE,
            "embedding, wrap, tileable, receiver or type of the textures is "
            "none of the values of osdtex.h");
    return OSDTEX_OK;
}

/* Up to which cuts are taken not to show; see docs/notes/toroid.md for the
 * pictures that it was set on. */
static const double oddness_max = 1.15;

/* Crops a lattice that does not tile to whole periods. False in `*whole` where
 * there are none along its sides. */
static otx_status
crop_to_periods(
    otx_run *run, otx_where where, otx_exemplar *exemplar,
    otx_exemplar_cuts *cuts, bool *whole)
{
    otx_analysis a;
    otx_period p;

    *whole = true;
    OTX_TRY(otx_exemplar_analysis(run, exemplar, &a));
    if (a.kind != OTX_ANALYSIS_LATTICE)
        return OSDTEX_OK;
    *whole = otx_period_find(exemplar, a.generators, &p);
    if (!*whole ||
        (p.width == exemplar->lab.width && p.height == exemplar->lab.height))
        return OSDTEX_OK;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, "exemplar", where,
        "whole periods of the picture's lattice are %d x %d texels at (%d, %d)",
        p.width, p.height, p.x, p.y);
    cuts->x += p.x;
    cuts->y += p.y;
    cuts->width = p.width;
    cuts->height = p.height;
    return otx_exemplar_crop(
        run, exemplar, p.x, p.y, p.width, p.height, exemplar);
}

static void
say(otx_run *run, otx_where where, bool good, bool kept, double oddness)
{
    otx_note(
        run, OSDTEX_SEVERITY_INFO, "exemplar", where,
        "%s (oddness of what is across its cuts %.2f, good up to %.2f)",
        good   ? "the picture is made to tile"
        : kept ? "the picture is kept as it is: made to tile, its cuts would "
                 "show"
               : "the picture is made to tile, as asked for, though its cuts "
                 "show",
        oddness, oddness_max);
}

/* Makes a picture tile that does not, where it is asked for or good. */
static otx_status
make_tileable(otx_run *run, osdtex_tileable how, osdtex_exemplar *handle)
{
    const bool may_keep = how == OSDTEX_TILEABLE_AUTO;
    otx_exemplar source = handle->exemplar;
    const otx_where where = {source.source_path, 0, -1, -1};
    otx_exemplar_cuts cuts = handle->cuts;
    otx_toroid toroid = {0};
    bool whole, good;

    if (how == OSDTEX_TILEABLE_KEEP)
        return OSDTEX_OK;
    if (may_keep && (source.lab.width < OTX_TOROID_MIN_SIDE ||
                     source.lab.height < OTX_TOROID_MIN_SIDE))
        return OSDTEX_OK;
    OTX_TRY(crop_to_periods(run, where, &source, &cuts, &whole));
    if (handle->exemplar.wrap_x && handle->exemplar.wrap_y &&
        source.lab.width == handle->exemplar.lab.width &&
        source.lab.height == handle->exemplar.lab.height)
        return OSDTEX_OK;
    if (!whole && may_keep)
    {
        otx_note(
            run, OSDTEX_SEVERITY_INFO, "exemplar", where,
            "the picture is kept as it is: no whole periods of its lattice lie "
            "along its sides");
        return OSDTEX_OK;
    }
    if (!source.wrap_x || !source.wrap_y)
        OTX_TRY(otx_toroid_make(run, &source, &toroid));
    good = toroid.oddness <= oddness_max;
    say(run, where, good, may_keep, toroid.oddness);
    if (!good && may_keep)
        return OSDTEX_OK;
    handle->info.made_tileable = 1;
    handle->cuts = cuts;
    handle->cuts.texels = toroid.map.texels;
    if (!toroid.map.texels)
    {
        handle->exemplar = source;
        return OSDTEX_OK;
    }
    return otx_exemplar_rearrange(
        run, &source, toroid.map.texels, &handle->exemplar);
}

/* A picture is cut to its part without transparent texels where that part is
 * at least this share of it. */
static const double opaque_share_min = 0.25;

/* Transparent texels are no source. Where they are what the picture is about,
 * as in lace, or the user says that it tiles as it is, they stay, and are told.
 */
static otx_status
avoid_transparent(otx_run *run, osdtex_wrap wrap, osdtex_exemplar *handle)
{
    otx_exemplar *exemplar = &handle->exemplar;
    const otx_where where = {exemplar->source_path, 0, -1, -1};
    const double texels =
        (double)exemplar->linear.width * exemplar->linear.height;
    otx_opaque o;

    if (!otx_opaque_find(run->scratch, &exemplar->linear, &o))
        return otx_fail_memory(run, "exemplar");
    if (o.transparent == 0.0)
        return OSDTEX_OK;
    if (wrap != OSDTEX_WRAP_YES &&
        (double)o.width * o.height >= opaque_share_min * texels &&
        o.width >= OTX_EXEMPLAR_MIN_SIDE && o.height >= OTX_EXEMPLAR_MIN_SIDE)
    {
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "exemplar", where,
            "%.1f %% of the picture are transparent; only its %d x %d texels "
            "from (%d, %d), counted from the lower left, are used, where there "
            "are none",
            100.0 * o.transparent, o.width, o.height, o.x, o.y);
        handle->cuts.x = o.x;
        handle->cuts.y = o.y;
        handle->cuts.width = o.width;
        handle->cuts.height = o.height;
        return otx_exemplar_crop(
            run, exemplar, o.x, o.y, o.width, o.height, exemplar);
    }
    otx_note(
        run, OSDTEX_SEVERITY_WARNING, "exemplar", where,
        "%.1f %% of the picture are transparent, and no part without that is "
        "large enough to be used alone; the texture will have holes",
        100.0 * o.transparent);
    return OSDTEX_OK;
}

static otx_status
keep_texels(otx_run *run, otx_exemplar_cuts *cuts)
{
    const size_t count = (size_t)cuts->width * (size_t)cuts->height;
    int32_t *copy = OTX_NEW(run->arena, int32_t, count);

    OTX_TRY(otx_run_ok(run));
    memcpy(copy, cuts->texels, count * sizeof *copy);
    cuts->texels = copy;
    return OSDTEX_OK;
}

/* Does to a picture what was done to another one of its size. */
static otx_status
cut_alike(otx_run *run, const otx_exemplar_cuts *cuts, osdtex_exemplar *handle)
{
    otx_exemplar *e = &handle->exemplar;
    const bool whole =
        cuts->width == cuts->file_width && cuts->height == cuts->file_height;

    if (e->linear.width != cuts->file_width ||
        e->linear.height != cuts->file_height)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "mapping",
            otx_where_file(e->source_path),
            "the picture has %d x %d texels, and the mapping was made for one "
            "of %d x %d; scale it to that size",
            e->linear.width, e->linear.height, cuts->file_width,
            cuts->file_height);
    handle->cuts = *cuts;
    if (cuts->texels)
        OTX_TRY(keep_texels(run, &handle->cuts));
    handle->info.made_tileable = !whole || cuts->texels != NULL;
    if (!whole)
        OTX_TRY(otx_exemplar_crop(
            run, e, cuts->x, cuts->y, cuts->width, cuts->height, e));
    return cuts->texels ? otx_exemplar_rearrange(run, e, cuts->texels, e)
                        : OSDTEX_OK;
}

/* Builds the handle. `input` holds what is known of the pixels.
 *
 *   cuts  that are made instead of looked for; NULL none */
static otx_status
build(
    otx_call *call, otx_exemplar_input *input,
    const osdtex_exemplar_options *options, const otx_exemplar_cuts *cuts,
    const char *type, bool is_tiles, osdtex_exemplar **out)
{
    otx_run *run = &call->run;
    osdtex_exemplar *handle = OTX_ZNEW(run->arena, osdtex_exemplar, 1);
    const otx_colour *colour;
    otx_match_weights weights;
    int32_t made, width, height;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_call_colour(call, &colour));
    input->to = options->to;
    input->receiver = (otx_receiver)options->receiver;
    input->type = (otx_texture_type)options->texture_type;
    input->match_space = options->match_space;
    input->embedding = (otx_embedding)options->embedding;
    input->wrap = (otx_exemplar_wrap)options->wrap;
    handle->arena = run->arena;
    OTX_TRY(otx_exemplar_build(run, colour, input, &handle->exemplar));
    OTX_TRY(otx_companion_pictures_take(
        call, options, &handle->exemplar, &handle->exemplar.companions));
    weights = otx_companion_pictures_weights(options);
    OTX_TRY(otx_match_maps_mix(run, &weights, &handle->exemplar));
    width = handle->exemplar.linear.width;
    height = handle->exemplar.linear.height;
    handle->cuts = (otx_exemplar_cuts){
        .wrap = options->wrap,
        .layer = options->layer ? otx_arena_strdup(run->arena, options->layer)
                                : NULL,
        .file_width = width,
        .file_height = height,
        .width = width,
        .height = height};
    if (!is_tiles && !cuts)
        OTX_TRY(avoid_transparent(run, options->wrap, handle));
    if (cuts)
        OTX_TRY(cut_alike(run, cuts, handle));
    /* Who says that it does not tile wants it so. */
    else if (
        options->wrap != OSDTEX_WRAP_NO ||
        options->tileable == OSDTEX_TILEABLE_MAKE)
        OTX_TRY(make_tileable(run, options->tileable, handle));
    made = handle->info.made_tileable;
    handle->info = info_of(&handle->exemplar, type);
    handle->info.made_tileable = made;
    handle->info.source_width = width;
    *out = handle;
    return OSDTEX_OK;
}

/* `hash` of the file at `path`, copied to where the handle lives. */
static otx_status
keep_source(otx_run *run, const char *path, otx_exemplar_input *input)
{
    char hash[OTX_HASH_TEXT_BYTES];

    input->source.path = otx_arena_strdup(run->arena, path);
    OTX_TRY(otx_run_ok(run));
    if (!otx_hash_file(path, hash))
        return OSDTEX_OK;
    input->hash = otx_arena_strdup(run->arena, hash);
    return otx_run_ok(run);
}

/* Takes over how a tiled texture is divided. */
static otx_status
keep_tiles(
    otx_run *run, const char *path, const char *text, osdtex_exemplar *handle)
{
    otx_exemplar *exemplar = &handle->exemplar;

    OTX_TRY(otx_tile_layout_parse(
        run, path, text, exemplar->linear.width, exemplar->linear.height,
        &exemplar->tiles));
    handle->info.tile_size = exemplar->tiles.cell;
    handle->info.source_width = exemplar->tiles.source_width;
    return OSDTEX_OK;
}

/* The slices of a stack, of which the handle holds the one in the middle. */
static otx_status
keep_slices(
    otx_call *call, const char *path, int32_t count,
    const otx_exemplar_input *input, const osdtex_exemplar_options *options,
    osdtex_exemplar *handle)
{
    OTX_TRY(otx_exemplar_slices_read(
        call, path, count, input, options, &handle->exemplar,
        &handle->exemplar.slices));
    handle->info.slices = count;
    otx_note(
        &call->run, OSDTEX_SEVERITY_INFO, "exemplar", otx_where_file(path),
        "the file is a stack of %d slices; what is matched is the one in the "
        "middle",
        count);
    return OSDTEX_OK;
}

static otx_status
read_exemplar(
    otx_call *call, const char *path, const osdtex_exemplar_options *options,
    const otx_exemplar_cuts *cuts, bool linear_only, osdtex_exemplar **out)
{
    otx_exemplar_input input = {.linear_only = linear_only};
    char middle[OTX_EXR_SLICE_NAME_BYTES];
    osdtex_exemplar_options ours;
    otx_slice_maps maps;
    otx_picture picture;
    int32_t slices;
    otx_run aside;

    if (!path)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "exemplar", OTX_NOWHERE,
            "no path of an exemplar is given");
    OTX_TRY(check_options(&call->run, options, &ours));
    OTX_TRY(otx_call_aside(call, &aside));
    slices = ours.layer ? 0 : otx_exr_slice_count(path);
    otx_exr_slice_name(slices / 2, middle);
    input.may_take = linear_only && !slices;
    OTX_TRY(otx_picture_read_layer(
        input.may_take ? &call->run : &aside, path,
        slices ? middle : ours.layer, &picture));
    OTX_TRY(keep_source(&call->run, path, &input));
    input.pixels = picture.image;
    input.alpha_is_premultiplied = picture.alpha_is_premultiplied;
    otx_picture_source_fill(&picture, &input.source);
    input.source.from = ours.from;
    if (picture.tiles)
    {
        ours.wrap = OSDTEX_WRAP_NO;
        ours.tileable = OSDTEX_TILEABLE_KEEP;
    }
    if (slices)
    {
        ours.wrap = OSDTEX_WRAP_YES;
        ours.tileable = OSDTEX_TILEABLE_KEEP;
        otx_exemplar_slices_maps(path, slices / 2, &maps);
        if (ours.map_count == 0)
        {
            ours.maps = maps.list;
            ours.map_count = maps.count;
        }
    }
    OTX_TRY(build(
        call, &input, &ours, cuts, otx_picture_source_type(&picture),
        picture.tiles || slices, out));
    if (slices)
        OTX_TRY(keep_slices(call, path, slices, &input, &ours, *out));
    return picture.tiles ? keep_tiles(&call->run, path, picture.tiles, *out)
                         : OSDTEX_OK;
}

osdtex_status
osdtex_exemplar_read(
    osdtex_context *context, const char *path,
    const osdtex_exemplar_options *options, osdtex_exemplar **out)
{
    return otx_exemplar_handle_read(context, path, options, NULL, false, out);
}

osdtex_status
otx_exemplar_handle_read(
    osdtex_context *context, const char *path,
    const osdtex_exemplar_options *options, const otx_exemplar_cuts *cuts,
    bool linear_only, osdtex_exemplar **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "exemplar", &call));
    return otx_call_end(
        &call, read_exemplar(&call, path, options, cuts, linear_only, out),
        out);
}

static otx_status
create_exemplar(
    otx_call *call, const osdtex_image *image,
    const osdtex_exemplar_options *options, osdtex_exemplar **out)
{
    otx_exemplar_input input = {0};
    osdtex_exemplar_options ours;

    if (!image)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "exemplar", OTX_NOWHERE,
            "no image is given");
    OTX_TRY(check_options(&call->run, options, &ours));
    input.pixels = image->image;
    input.alpha_is_premultiplied = true;
    input.source.from = ours.from;
    input.source.is_float = true;
    return build(call, &input, &ours, NULL, NULL, false, out);
}

osdtex_status
osdtex_exemplar_create(
    osdtex_context *context, const osdtex_image *image,
    const osdtex_exemplar_options *options, osdtex_exemplar **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "exemplar", &call));
    return otx_call_end(
        &call, create_exemplar(&call, image, options, out), out);
}

const osdtex_exemplar_info *
osdtex_exemplar_describe(const osdtex_exemplar *exemplar)
{
    return exemplar ? &exemplar->info : NULL;
}

double
osdtex_exemplar_leaf_edge(const osdtex_exemplar *exemplar, double scale)
{
    if (!exemplar)
        return 0.0;

    const osdtex_exemplar_info *info = &exemplar->info;
    const double side = fmin(info->width, info->height);
    const double texels = fmin(fmax(14.0, side / 128.0), side / 48.0);

    return scale / info->source_width * texels;
}

void
osdtex_exemplar_destroy(osdtex_exemplar *exemplar)
{
    if (exemplar)
        otx_arena_destroy(exemplar->arena);
}

static otx_status
analyse(
    otx_run *run, const osdtex_exemplar *exemplar,
    osdtex_exemplar_structure *out)
{
    const otx_exemplar *e = &exemplar->exemplar;
    otx_analysis a;

    OTX_TRY(otx_exemplar_analysis(run, e, &a));
    *out = (osdtex_exemplar_structure){
        .name = otx_analysis_name(a.kind),
        .symmetry = a.symmetry,
        .angle = a.angle,
        .generators =
            {a.generators[0].x, a.generators[0].y, a.generators[1].x,
             a.generators[1].y},
        .coherence = a.coherence,
        .regularity = a.regularity,
    };
    return OSDTEX_OK;
}

osdtex_status
osdtex_exemplar_analyse(
    osdtex_context *context, const osdtex_exemplar *exemplar,
    osdtex_exemplar_structure *out)
{
    otx_call call;

    if (!out || !exemplar)
        return OSDTEX_ERROR_ARGUMENT;
    *out = (osdtex_exemplar_structure){0};
    OTX_TRY(otx_call_begin(context, "exemplar", &call));
    return otx_call_drop(&call, analyse(&call.run, exemplar, out));
}

const char *
osdtex_texture_extension(osdtex_texture_type type, int32_t map)
{
    if (type < OSDTEX_TEXTURE_ANY || type >= OTX_TEXTURE_COUNT || map < -1 ||
        map >= OTX_COMPANION_COUNT)
        return NULL;
    return map < 0 ? otx_texture_file_type_extension((otx_texture_type)type)
                   : otx_companion_files_extension(
                         (otx_texture_type)type, (otx_companion_kind)map);
}

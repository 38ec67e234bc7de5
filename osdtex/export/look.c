/* look.c -- textures tile by tile, then the texts that name them. */
#include "export/look.h"

#include "export/corner_normals.h"

#include "export/cage_model.h"
#include "export/companion_files.h"
#include "export/names.h"
#include "export/texture_file.h"
#include "export/texture_stream.h"
#include "file/mark.h"
#include "file/mtl.h"
#include "file/mtlx.h"
#include "file/obj_write.h"
#include "file/png_file.h"
#include "file/usda.h"
#include "mapping/source.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char STAGE[] = "export";

enum
{
    SUFFIX_BYTES = 64,
    PREVIEW_SIDE = 1024 /* texels at most */
};

typedef struct writer
{
    otx_run *run;
    const otx_mapping *mapping;
    const otx_exemplar *exemplars; /* all in one linear space */
    const otx_layout *layout;
    const otx_look_options *options;
    otx_atomic_file_set *set;
    otx_names names;
} writer;

/* ---- names ----------------------------------------------------------------
 */

/* FOLDER/NAMEsuffix in run->arena; NULL when memory is out. */
static const char *
path_of(const writer *w, const char *suffix)
{
    const size_t base = strlen(w->names.mtl) - strlen(".mtl");
    const size_t bytes = strlen(suffix) + 1;
    char *path = OTX_NEW(w->run->arena, char, base + bytes);

    if (!path)
        return NULL;
    memcpy(path, w->names.mtl, base);
    memcpy(path + base, suffix, bytes);
    return path;
}

/* The same without the folder, as the other files refer to it. */
static const char *
name_of(const writer *w, const char *suffix)
{
    const char *path = path_of(w, suffix);
    const char *slash = path ? strrchr(path, '/') : NULL;

    return slash ? slash + 1 : path;
}

/* "_patch.1001.exr"; nothing stands for the colour. */
static void
tile_suffix(
    otx_texel_kind kind, int32_t tile, const char *extension,
    char suffix[SUFFIX_BYTES])
{
    const bool is_color = kind == OTX_TEXEL_COLOR;

    snprintf(
        suffix, SUFFIX_BYTES, "%s%s.%" PRId32 "%s", is_color ? "" : "_",
        is_color ? "" : otx_bake_kind_name(kind), tile, extension);
}

/* "_normal.1001.exr" */
static void
map_suffix(
    const writer *w, otx_companion_kind kind, int32_t tile,
    char suffix[SUFFIX_BYTES])
{
    snprintf(
        suffix, SUFFIX_BYTES, "_%s.%" PRId32 "%s", otx_companion_name(kind),
        tile, otx_companion_files_extension(w->exemplars->type, kind));
}

/* How texts name the textures: the number where there is one tile only, since
 * not all readers know the token. */
static const char *
texture_name(const writer *w, const char *extension)
{
    char suffix[SUFFIX_BYTES];

    if (w->layout->tile_count == 1)
        tile_suffix(OTX_TEXEL_COLOR, w->layout->tiles[0], extension, suffix);
    else
        snprintf(suffix, sizeof suffix, ".<UDIM>%s", extension);
    return name_of(w, suffix);
}

/* The same of a map; NULL where no exemplar has it. */
static const char *
map_name(const writer *w, otx_companion_kind kind)
{
    const int32_t count = otx_source_count(w->mapping);
    char suffix[SUFFIX_BYTES];
    bool is_there = false;

    for (int32_t k = 0; k < count; ++k)
        is_there |= w->exemplars[k].companions.maps[kind].is_there;
    if (w->layout->tile_count == 1)
        map_suffix(w, kind, w->layout->tiles[0], suffix);
    else
        snprintf(
            suffix, sizeof suffix, "_%s.<UDIM>%s", otx_companion_name(kind),
            otx_companion_files_extension(w->exemplars->type, kind));
    return is_there ? name_of(w, suffix) : NULL;
}

/* Those of all maps; run->arena tells when memory is out. */
static otx_data_maps
map_names(const writer *w)
{
    return (otx_data_maps){
        .normal = map_name(w, OTX_COMPANION_NORMAL),
        .normal_y_down = w->exemplars->companions.written_y_down,
        .roughness = map_name(w, OTX_COMPANION_ROUGHNESS),
        .metalness = map_name(w, OTX_COMPANION_METALNESS),
        .height = map_name(w, OTX_COMPANION_HEIGHT),
        .occlusion = map_name(w, OTX_COMPANION_OCCLUSION),
    };
}

static const char *
color_name(const writer *w)
{
    return texture_name(w, otx_texture_file_extension(w->exemplars));
}

/* ---- textures --------------------------------------------------------------
 */

/* Where blocks go: into the texture, those of one level into the preview, and
 * their maps into files of their own. */
typedef struct target
{
    otx_texture_stream color;
    int32_t preview_level; /* -1 none */
    otx_image preview;
    otx_texture_stream maps[OTX_COMPANION_COUNT];
} target;

static void
take(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    target *t = user;

    if (block->level == t->preview_level)
        otx_bake_copy(block, &t->preview);
    otx_texture_stream_take(&t->color, slot, lane, block);
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
        otx_texture_stream_take(&t->maps[k], slot, lane, block);
}

static otx_status
put(void *user, int32_t slot, int32_t level, int32_t x, int32_t y)
{
    target *t = user;

    OTX_TRY(otx_texture_stream_put(&t->color, slot, level, x, y));
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
        OTX_TRY(otx_texture_stream_put(&t->maps[k], slot, level, x, y));
    return OSDTEX_OK;
}

/* Into a target, and which part of all that is baked a tile of a kind is. */
static otx_bake_sink
sink_of(const writer *w, otx_texel_kind kind, int32_t tile, target *t)
{
    const int32_t tiles = w->options->udim != 0 ? 1 : w->layout->tile_count;
    const int32_t at = w->options->udim != 0 ? 0 : tile;
    int32_t before = 0, kinds = 0;
    double share;

    for (int32_t k = 0; k < OTX_TEXEL_KIND_COUNT; ++k)
        if (k == OTX_TEXEL_COLOR || w->options->extras[k])
        {
            before += k < (int32_t)kind;
            ++kinds;
        }
    share = 1.0 / ((double)kinds * tiles);
    return (otx_bake_sink){
        .take = take,
        .put = put,
        .user = t,
        .begin = share * ((double)before * tiles + at),
        .share = share};
}

static otx_exr_options
exr_options(const writer *w, otx_texel_kind kind)
{
    const otx_exemplar *exemplar = w->exemplars;
    otx_exr_options options = otx_exr_options_default();

    options.full_float = kind != OTX_TEXEL_COLOR;
    if (kind != OTX_TEXEL_COLOR)
        return options;
    options.has_chromaticities = exemplar->has_chromaticities;
    memcpy(
        options.chromaticities, exemplar->chromaticities,
        sizeof options.chromaticities);
    options.color_space = exemplar->linear_space;
    options.interop_id = exemplar->interop_id;
    return options;
}

/* A PNG holds colour that is not multiplied by alpha. */
static void
unassociate(otx_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;

    for (size_t i = 0; image->channels == 4 && i < count; ++i)
    {
        float *p = image->pixels + 4 * i;

        for (int32_t k = 0; k < 3; ++k)
            p[k] = p[3] > 0.0f ? p[k] / p[3] : 0.0f;
    }
}

static otx_status
write_preview(const writer *w, int32_t tile, otx_image *image)
{
    const otx_colour *colour = w->options->colour;
    const char *display = otx_colour_srgb(colour);
    char suffix[SUFFIX_BYTES];
    const char *path;

    tile_suffix(OTX_TEXEL_COLOR, tile, ".png", suffix);
    path = path_of(w, suffix);
    OTX_TRY(otx_run_ok(w->run));
    unassociate(image);
    if (display)
        OTX_TRY(otx_colour_convert(
            w->run, colour, w->exemplars->linear_space, display, image));
    else
        otx_note(
            w->run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
            "the colour configuration has no sRGB space, so the previews show "
            "linear values");
    return otx_png_file_write(w->run, w->set, path, image, 8);
}

/* Begins the file `path` of a tile, an EXR by `options`; NULL: by the type of
 * the exemplar. */
static otx_status
begin_stream(
    const writer *w, const otx_bake *bake, const char *path, int32_t channels,
    int32_t map, otx_exr_options *options, otx_texture_stream *s)
{
    const otx_exr_attribute comment = {
        .name = "comments",
        .kind = OTX_EXR_TEXT,
        .text = w->options->texture_comment};

    if (options)
    {
        options->attributes = &comment;
        options->attribute_count = comment.text != NULL;
    }
    return otx_texture_stream_begin(
        w->run, w->set, path, bake, channels, map, options, s);
}

/* The files of the maps that are baked with the colour. */
static otx_status
begin_maps(const writer *w, const otx_bake *bake, int32_t tile, target *t)
{
    for (int32_t k = 0;
         bake->maps.texels.channels > 0 && k < OTX_COMPANION_COUNT; ++k)
    {
        const otx_companion_kind kind = (otx_companion_kind)k;
        otx_exr_options exr = otx_companion_files_options(kind);
        const bool is_exr =
            otx_companion_files_is_exr(w->exemplars->type, kind);
        char suffix[SUFFIX_BYTES];

        if (bake->maps.first[k] < 0)
            continue;
        map_suffix(w, kind, w->layout->tiles[tile], suffix);
        OTX_TRY(begin_stream(
            w, bake, path_of(w, suffix), otx_companion_channels(kind), k,
            is_exr ? &exr : NULL, &t->maps[k]));
    }
    return OSDTEX_OK;
}

static otx_status
end_streams(const writer *w, target *t)
{
    OTX_TRY(otx_texture_stream_end(w->run, w->set, w->exemplars, &t->color));
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
        OTX_TRY(
            otx_texture_stream_end(w->run, w->set, w->exemplars, &t->maps[k]));
    return OSDTEX_OK;
}

/* Only an EXR has levels below the first. */
static bool
needs_levels(const target *t)
{
    bool needed = t->color.exr || t->preview_level > 0;

    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
        needed |= t->maps[k].exr != NULL;
    return needed;
}

static otx_status
begin_preview(const writer *w, const otx_bake *bake, target *t)
{
    const int32_t side = w->layout->side;

    for (t->preview_level = 0; side >> t->preview_level > PREVIEW_SIDE;)
        ++t->preview_level;
    return otx_image_create(
        w->run, w->run->scratch, side >> t->preview_level,
        side >> t->preview_level, bake->source.channels, &t->preview);
}

/* Bakes one kind of one tile into its file, with the colour its maps. */
static otx_status
write_tile(
    const writer *w, const otx_bake *bake, int32_t tile, bool preview,
    target *t)
{
    const otx_texel_kind kind = bake->source.kind;
    const bool is_exr =
        kind != OTX_TEXEL_COLOR || w->exemplars->type <= OTX_TEXTURE_EXR;
    otx_bake_sink sink = sink_of(w, kind, tile, t);
    otx_exr_options exr = exr_options(w, kind);
    char suffix[SUFFIX_BYTES];

    tile_suffix(
        kind, w->layout->tiles[tile],
        is_exr ? ".exr" : otx_texture_file_extension(w->exemplars), suffix);
    if (preview)
        OTX_TRY(begin_preview(w, bake, t));
    OTX_TRY(begin_stream(
        w, bake, path_of(w, suffix), bake->source.channels, -1,
        is_exr ? &exr : NULL, &t->color));
    OTX_TRY(begin_maps(w, bake, tile, t));
    sink.level_count = needs_levels(t) ? 0 : 1;
    OTX_TRY(otx_bake_tile(w->run, bake, tile, &sink));
    OTX_TRY(end_streams(w, t));
    return preview ? write_preview(w, w->layout->tiles[tile], &t->preview)
                   : OSDTEX_OK;
}

static otx_status
write_kind(const writer *w, otx_texel_kind kind)
{
    /* A PNG is its own preview. */
    const bool preview = kind == OTX_TEXEL_COLOR && w->options->colour &&
                         w->exemplars->type != OTX_TEXTURE_PNG;
    const otx_bake_options options = {
        kind, w->options->seam_blend, OTX_MAP_TEXTURES_ALL, false,
        w->exemplars->companions.written_y_down};
    otx_bake bake;

    OTX_TRY(otx_bake_create(
        w->run, w->mapping, w->exemplars, w->layout, &options, &bake));
    for (int32_t tile = 0; tile < w->layout->tile_count; ++tile)
    {
        const otx_arena_mark mark = otx_arena_here(w->run->scratch);
        target *t = OTX_ZNEW(w->run->scratch, target, 1);
        otx_status status;

        if (!t)
            return otx_fail_memory(w->run, STAGE);
        t->preview_level = -1;
        if (w->options->udim != 0 && w->layout->tiles[tile] != w->options->udim)
            continue;
        status = write_tile(w, &bake, tile, preview, t);
        otx_arena_release(w->run->scratch, mark);
        OTX_TRY(status);
    }
    return OSDTEX_OK;
}

/* ---- texts -----------------------------------------------------------------
 */

static otx_status
write_mtl(
    const writer *w, const char *suffix, const char *texture,
    const otx_obj_names *materials)
{
    const char *path = path_of(w, suffix);
    otx_mtl_material *list =
        OTX_NEW(w->run->scratch, otx_mtl_material, materials->count);
    const otx_mtl mtl = {path, materials->count, list};
    const otx_data_maps maps = map_names(w);
    const char *temporary;

    OTX_TRY(otx_run_ok(w->run));
    for (int32_t i = 0; i < materials->count; ++i)
        list[i] = (otx_mtl_material){
            .name = materials->text[i],
            .diffuse = {1.0f, 1.0f, 1.0f},
            .map_kd = texture,
            .maps = maps,
        };
    OTX_TRY(otx_atomic_file_add(w->run, w->set, path, &temporary));
    return otx_mtl_write(w->run, &mtl, temporary, path);
}

/* "UDIM tiles 1001 1002 ..." */
static char *
tiles_comment(const writer *w)
{
    const otx_layout *layout = w->layout;
    const size_t number = strlen(" 1001");
    const size_t lead = strlen("UDIM tiles");
    char *text = OTX_NEW(
        w->run->scratch, char, lead + number * (size_t)layout->tile_count + 1);

    if (!text)
        return NULL;
    memcpy(text, "UDIM tiles", lead);
    for (int32_t i = 0; i < layout->tile_count; ++i)
        snprintf(
            text + lead + number * (size_t)i, number + 1, " %" PRId32,
            layout->tiles[i]);
    return text;
}

/* The comments of the caller, the rule of interpolation, and the tiles. */
static otx_status
list_comments(
    const writer *w, const char *const **comments, int32_t *comment_count)
{
    const int32_t count = w->options->comment_count;
    const char **list = OTX_NEW(w->run->scratch, const char *, count + 2);
    const size_t bytes = 192;
    char *rule = OTX_NEW(w->run->scratch, char, bytes);
    char *tiles = tiles_comment(w);

    OTX_TRY(otx_run_ok(w->run));
    for (int32_t i = 0; i < count; ++i)
        list[i] = w->options->comments[i];
    snprintf(
        rule, bytes, "UVs %s: subdivide with face-varying interpolation \"%s\"",
        w->layout->is_atlas ? "of an atlas" : "of the cage",
        otx_cage_model_fvar_name(otx_cage_model_fvar(w->layout)));
    list[count] = rule;
    list[count + 1] = tiles;
    *comments = list;
    *comment_count = count + 2;
    return OSDTEX_OK;
}

static otx_status
write_cage(const writer *w)
{
    const char *path = path_of(w, "_cage.obj");
    const char *library = name_of(w, "_cage.mtl");
    otx_obj_write_options how = {.name = path, .tags = true};
    const char *temporary;
    otx_obj obj;

    OTX_TRY(otx_run_ok(w->run));
    OTX_TRY(list_comments(w, &how.comments, &how.comment_count));
    OTX_TRY(otx_cage_model_obj(
        w->run, w->layout, path, library, w->names.stem, &obj));
    if (w->options->normals)
    {
        otx_corner_normals normals;

        OTX_TRY(
            otx_corner_normals_of_cage(w->run, w->layout->surface, &normals));
        obj.normal_count = normals.count;
        obj.normals = normals.normals;
        obj.face_normals = normals.indices;
    }
    OTX_TRY(write_mtl(w, "_cage.mtl", color_name(w), &obj.materials));
    if (w->options->colour)
        OTX_TRY(write_mtl(
            w, "_preview.mtl", texture_name(w, ".png"), &obj.materials));
    OTX_TRY(otx_atomic_file_add(w->run, w->set, path, &temporary));
    return otx_obj_write(w->run, &obj, temporary, &how);
}

/* Of a stack, where along its axis the corners of the cage are; vertices keep
 * their numbers from level to level. NULL: there is no axis. */
static const float *
corner_slices(const writer *w)
{
    const otx_level *cage = &w->layout->surface->levels[0];
    const float *along = w->mapping->along;
    float *slices;

    if (!along)
        return NULL;
    slices = OTX_NEW(w->run->scratch, float, cage->corner_count);
    for (int32_t c = 0; slices && c < cage->corner_count; ++c)
        slices[c] = along[cage->face_verts[c]];
    return slices;
}

static otx_status
write_usda(const writer *w)
{
    const char *path = path_of(w, ".usda");
    otx_obj listed = {0};
    const char *temporary;
    otx_usda usda;

    OTX_TRY(otx_run_ok(w->run));
    otx_cage_model_usda(w->layout, w->names.stem, &usda);
    OTX_TRY(otx_cage_model_materials(
        w->run, w->layout->surface->cage, NULL,
        w->layout->surface->cage->face_count, w->names.stem, &listed));
    if (listed.materials.count > 1)
        usda.materials = (otx_usda_subsets){
            listed.materials.count, listed.materials.text,
            listed.face_material};
    usda.rest = w->options->rest;
    usda.texture = color_name(w);
    usda.materialx = name_of(w, ".mtlx");
    usda.maps = map_names(w);
    usda.interop_id = otx_texture_file_interop_id(w->exemplars);
    /* A subdivided mesh has those of its limit in USD. */
    if (w->options->normals &&
        w->layout->surface->cage->scheme == OTX_SCHEME_NONE)
    {
        otx_corner_normals normals;

        OTX_TRY(
            otx_corner_normals_of_cage(w->run, w->layout->surface, &normals));
        usda.normals = normals.normals;
        usda.face_normals = normals.indices;
    }
    usda.slices = corner_slices(w);
    usda.z_up = w->options->z_up;
    usda.meters_per_unit = w->options->meters_per_unit > 0.0
                               ? w->options->meters_per_unit
                               : otx_cage_model_meters(w->exemplars->receiver);
    OTX_TRY(otx_run_ok(w->run));
    OTX_TRY(list_comments(w, &usda.comments, &usda.comment_count));
    OTX_TRY(otx_atomic_file_add(w->run, w->set, path, &temporary));
    return otx_usda_write(w->run, &usda, temporary, path);
}

static otx_status
write_mtlx(const writer *w)
{
    const char *path = path_of(w, ".mtlx");
    const otx_mtlx mtlx = {
        .name = w->names.stem,
        .texture = color_name(w),
        .maps = map_names(w),
        .interop_id = otx_texture_file_interop_id(w->exemplars)};
    const char *temporary;

    OTX_TRY(otx_run_ok(w->run));
    OTX_TRY(otx_atomic_file_add(w->run, w->set, path, &temporary));
    return otx_mtlx_write(w->run, &mtlx, temporary, path);
}

static otx_status
write_mesh(const writer *w)
{
    otx_model_options options;
    otx_model_files files;

    if (!w->options->mesh)
        return OSDTEX_OK;
    options = *w->options->mesh;
    options.path = w->options->path;
    options.set = w->set;
    return otx_model_write(w->run, w->mapping, w->exemplars, &options, &files);
}

/* Readers that show a texture of several tiles wrongly unless they are told. */
static void
say_tiles(const writer *w)
{
    const otx_receiver receiver = w->exemplars->receiver;

    if (w->layout->tile_count < 2)
        return;
    if (receiver == OTX_RECEIVER_BLENDER)
        otx_note(
            w->run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
            "Blender's OBJ importer knows no UDIM tiles: load the cage with "
            "osdtex_import.py, which makes them one tiled image");
    if (receiver == OTX_RECEIVER_WEB)
        otx_note(
            w->run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
            "the bake has %" PRId32
            " UDIM tiles, and web viewers show one: leave out "
            "{texels-per-unit}, or lower it",
            w->layout->tile_count);
}

/* One tile does not make the whole: then the texts, which are those of all
 * tiles, must not say that they are of this job. */
static otx_status
write_texts(const writer *w)
{
    otx_run run = *w->run;
    otx_mark mark = {0};
    writer texts = *w;

    if (run.mark && w->options->udim != 0)
    {
        mark = *run.mark;
        mark.job[0] = '\0';
        run.mark = &mark;
        texts.run = &run;
    }
    OTX_TRY(write_mtlx(&texts));
    OTX_TRY(write_usda(&texts));
    /* Last into place, so that whoever waits for it finds the others. */
    return write_cage(&texts);
}

static otx_status
write_files(const writer *w)
{
    int32_t tile;

    if (w->options->udim != 0)
        OTX_TRY(
            otx_layout_find_tile(w->run, w->layout, w->options->udim, &tile));
    say_tiles(w);
    otx_companion_files_say_gaps(
        w->run, w->layout->is_atlas && !w->layout->is_charts,
        &w->layout->surface->levels[0], map_name(w, OTX_COMPANION_HEIGHT));
    OTX_TRY(write_kind(w, OTX_TEXEL_COLOR));
    for (int32_t kind = 1; kind < OTX_TEXEL_KIND_COUNT; ++kind)
        if (w->options->extras[kind])
            OTX_TRY(write_kind(w, (otx_texel_kind)kind));
    OTX_TRY(write_mesh(w));
    OTX_TRY(write_texts(w));
    return otx_atomic_file_commit(w->run, w->set, true);
}

otx_status
otx_look_write(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, const otx_look_options *options)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    writer w = {
        .run = run,
        .mapping = mapping,
        .exemplars = exemplars,
        .layout = layout,
        .options = options,
    };
    otx_status status =
        otx_names_derive(run, run->arena, options->path, &w.names);

    /* Not in the scratch arena, which is released after every tile. */
    if (status == OSDTEX_OK)
        status = otx_atomic_file_begin(run, run->arena, &w.set);
    if (status == OSDTEX_OK)
        status = write_files(&w);
    otx_arena_release(run->scratch, mark);
    return status;
}

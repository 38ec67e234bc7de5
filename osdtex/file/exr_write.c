/* exr_write.c -- EXR through OpenEXR's C core, chunk by chunk in file order.
 *
 * The core writes headers, offsets and chunks; what is in a chunk is made by
 * exr_chunk.c, on all threads. So the core's encoder is not used, which clips
 * the tiles of every mip level to the size of level 0 and then writes files
 * that no reader accepts. */
#include "file/exr.h"

#include "base/build.h"
#include "file/exr_core.h"
#include "file/mark.h"
#include "image/pyramid.h"

#include <errno.h>
#include <openexr.h>
#include <osdtex/version.h>
#include <stdio.h>
#include <string.h>

enum
{
    SHORT_NAME_BYTES = 31 /* longer names need a flag in the file */
};

struct otx_exr_writer
{
    otx_run *run;
    const char *path;
    exr_context_t file;
    int part; /* of the file, which header or chunks go to */
    otx_exr_size size;
    bool tiled;
    bool full_float;
    int32_t level_count;
    int32_t level, x, y;     /* of the chunk to come */
    int64_t clamped_count;   /* values beyond the half range */
    otx_exr_packer *packers; /* [packer_count] one for each thread */
    int32_t packer_count;
};

/* The place of a chunk in its level, in texels, y from the top. */
typedef struct place
{
    int32_t x, y, width, height;
} place;

/* Whether the system says that there is no room. The core gives no reason, but
 * its last call was the write that failed. */
static bool
is_full(int error)
{
    return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

static otx_status
check(const otx_exr_writer *w, exr_result_t code)
{
    const int error = errno;

    if (code == EXR_ERR_SUCCESS)
        return OSDTEX_OK;
    if (code == EXR_ERR_OUT_OF_MEMORY)
        return otx_fail_memory(w->run, "picture");
    if (is_full(error))
        return otx_fail(
            w->run, OSDTEX_ERROR_IO, "picture", otx_where_file(w->path),
            "the disk is full (%s); make room or choose another folder",
            strerror(error));
    return otx_fail(
        w->run, OSDTEX_ERROR_IO, "picture", otx_where_file(w->path),
        "the EXR cannot be written (%s)", exr_get_default_error_message(code));
}

static void
writer_close(void *object)
{
    otx_exr_writer *w = object;

    if (w->file)
        exr_finish(&w->file);
    for (int32_t i = 0; i < w->packer_count; ++i)
        otx_exr_packer_close(&w->packers[i]);
}

static int32_t
smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* ---- header ------------------------------------------------------------- */

static exr_pixel_type_t
pixel_type(const otx_exr_writer *w)
{
    return w->full_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
}

static exr_result_t
write_layout(otx_exr_writer *w, const char *name)
{
    static const char *const names[4] = {"A", "B", "G", "R"};
    const bool is_gray = w->size.channels == 1;
    exr_result_t code;

    code = exr_add_part(
        w->file, name, w->tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE,
        &w->part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(
            w->file, w->part, w->size.width, w->size.height,
            EXR_COMPRESSION_ZIP);
    if (code == EXR_ERR_SUCCESS && w->tiled)
        code = exr_set_tile_descriptor(
            w->file, w->part, OTX_EXR_TILE, OTX_EXR_TILE,
            EXR_TILE_MIPMAP_LEVELS, EXR_TILE_ROUND_DOWN);
    for (int32_t i = 4 - w->size.channels; i < 4; ++i)
        if (code == EXR_ERR_SUCCESS)
            code = exr_add_channel(
                w->file, w->part, is_gray ? "Y" : names[i], pixel_type(w),
                EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return code;
}

static exr_result_t
write_text(otx_exr_writer *w, const char *name, const char *text)
{
    return text ? exr_attr_set_string(w->file, w->part, name, text)
                : EXR_ERR_SUCCESS;
}

static exr_result_t
write_color(otx_exr_writer *w, const otx_exr_options *options)
{
    const float *c = options->chromaticities;
    const exr_attr_chromaticities_t chromaticities = {
        .red_x = c[0],
        .red_y = c[1],
        .green_x = c[2],
        .green_y = c[3],
        .blue_x = c[4],
        .blue_y = c[5],
        .white_x = c[6],
        .white_y = c[7]};
    exr_result_t code = EXR_ERR_SUCCESS;

    if (options->has_chromaticities)
        code = exr_attr_set_chromaticities(
            w->file, w->part, "chromaticities", &chromaticities);
    if (code == EXR_ERR_SUCCESS)
        code = write_text(w, "oiio:ColorSpace", options->color_space);
    if (code == EXR_ERR_SUCCESS)
        code = write_text(w, "colorInteropID", options->interop_id);
    return code;
}

/* What tells a renderer that this is a texture made for it. */
static exr_result_t
write_texture(otx_exr_writer *w, const otx_exr_options *options)
{
    char modes[32];
    exr_result_t code;

    snprintf(
        modes, sizeof modes, "%s,%s", options->wrap_x ? "periodic" : "clamp",
        options->wrap_y ? "periodic" : "clamp");
    code = write_text(w, "wrapmodes", modes);
    if (code == EXR_ERR_SUCCESS)
        code = write_text(w, "textureformat", "Plain Texture");
    return code;
}

static exr_result_t
write_attribute(otx_exr_writer *w, const otx_exr_attribute *a)
{
    switch (a->kind)
    {
    case OTX_EXR_TEXT:
        return write_text(w, a->name, a->text ? a->text : "");
    case OTX_EXR_INTEGER:
        return exr_attr_set_int(w->file, w->part, a->name, a->integer);
    default:
        return exr_attr_set_float(w->file, w->part, a->name, a->real);
    }
}

/* In the attribute that readers show, unless the caller has taken it. */
static otx_status
write_mark(otx_exr_writer *w, const otx_exr_options *options)
{
    const char *name = "comments";
    char text[OTX_MARK_BYTES];

    otx_mark_print(w->run->mark, text);
    for (int32_t i = 0; i < options->attribute_count; ++i)
        if (strcmp(options->attributes[i].name, name) == 0)
            name = "osdtex:mark";
    return text[0] ? check(w, write_text(w, name, text)) : OSDTEX_OK;
}

static otx_status
write_attributes(otx_exr_writer *w, const otx_exr_options *options)
{
    char software[256];

    snprintf(
        software, sizeof software, "osdtex %d.%d.%d (build %s)",
        OSDTEX_VERSION_MAJOR, OSDTEX_VERSION_MINOR, OSDTEX_VERSION_PATCH,
        otx_build());
    OTX_TRY(check(w, write_text(w, "Software", software)));
    OTX_TRY(check(w, write_color(w, options)));
    if (w->tiled)
        OTX_TRY(check(w, write_texture(w, options)));
    for (int32_t i = 0; i < options->attribute_count; ++i)
        if (write_attribute(w, &options->attributes[i]) != EXR_ERR_SUCCESS)
            return otx_fail(
                w->run, OSDTEX_ERROR_ARGUMENT, "picture",
                otx_where_file(w->path),
                "attribute \"%s\" cannot be set in the EXR; is its name there "
                "twice, empty or too long?",
                options->attributes[i].name);
    return write_mark(w, options);
}

static bool
has_long_name(const otx_exr_options *options)
{
    for (int32_t i = 0; i < options->attribute_count; ++i)
        if (strlen(options->attributes[i].name) > SHORT_NAME_BYTES)
            return true;
    return false;
}

static void
turn_to(otx_exr_writer *w, const otx_exr_part *part)
{
    w->size = part->size;
    w->tiled = part->options->tiled;
    w->full_float = part->options->full_float;
    w->level_count =
        w->tiled ? otx_pyramid_count(w->size.width, w->size.height) : 1;
    w->level = w->x = w->y = 0;
}

static otx_status
write_header(otx_exr_writer *w, const otx_exr_part *parts, int32_t count)
{
    bool long_names = false;

    for (int32_t i = 0; i < count; ++i)
        long_names = long_names || has_long_name(parts[i].options);
    if (long_names)
        OTX_TRY(check(w, exr_set_longname_support(w->file, 1)));
    for (int32_t i = 0; i < count; ++i)
    {
        turn_to(w, &parts[i]);
        OTX_TRY(check(w, write_layout(w, parts[i].name)));
        OTX_TRY(write_attributes(w, parts[i].options));
    }
    return check(w, exr_write_header(w->file));
}

/* ---- chunks ------------------------------------------------------------- */

static int32_t
level_width(const otx_exr_writer *w, int32_t level)
{
    return otx_pyramid_side(w->size.width, level);
}

static int32_t
level_height(const otx_exr_writer *w, int32_t level)
{
    return otx_pyramid_side(w->size.height, level);
}

static int32_t
chunk_width(const otx_exr_writer *w)
{
    return w->tiled ? OTX_EXR_TILE : w->size.width;
}

static int32_t
chunk_height(const otx_exr_writer *w)
{
    return w->tiled ? OTX_EXR_TILE : OTX_EXR_ROWS;
}

/* A chunk, clipped to its level. */
static place
place_of(const otx_exr_writer *w, int32_t level, int32_t x, int32_t y)
{
    const int32_t left = x * chunk_width(w), top = y * chunk_height(w);

    return (place){
        left, top, smaller(chunk_width(w), level_width(w, level) - left),
        smaller(chunk_height(w), level_height(w, level) - top)};
}

/* Counts on to the next chunk in file order. */
static void
advance(otx_exr_writer *w)
{
    if (++w->x * chunk_width(w) < level_width(w, w->level))
        return;
    w->x = 0;
    if (++w->y * chunk_height(w) < level_height(w, w->level))
        return;
    w->y = 0;
    ++w->level;
}

size_t
otx_exr_packed_bytes(const otx_exr_writer *w)
{
    return otx_exr_chunk_bytes(
        (size_t)chunk_width(w) * (size_t)chunk_height(w), w->size.channels,
        w->full_float);
}

void
otx_exr_pack(
    const otx_exr_writer *w, int32_t lane, int32_t level, int32_t x, int32_t y,
    const float *pixels, ptrdiff_t stride, otx_exr_chunk *chunk)
{
    const place p = place_of(w, level, x, y);
    const otx_exr_texels texels = {
        pixels, stride, p.width, p.height, w->size.channels};

    otx_exr_chunk_pack(&w->packers[lane], &texels, w->full_float, chunk);
}

static otx_status
check_chunk(const otx_exr_writer *w, const otx_exr_chunk *chunk)
{
    if (chunk->status == OSDTEX_ERROR_NUMERIC)
        return otx_fail(
            w->run, OSDTEX_ERROR_NUMERIC, "picture", otx_where_file(w->path),
            "the picture to write holds a value that is not finite; please "
            "report how it was made");
    return chunk->status == OSDTEX_OK ? OSDTEX_OK
                                      : otx_fail_memory(w->run, "picture");
}

otx_status
otx_exr_put(
    otx_exr_writer *w, int32_t level, int32_t x, int32_t y,
    const otx_exr_chunk *chunk)
{
    if (w->level == w->level_count || level != w->level || x != w->x ||
        y != w->y)
        return otx_fail(
            w->run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(w->path),
            "chunk (%d, %d) of level %d is not the next one of the EXR", x, y,
            level);
    OTX_TRY(check_chunk(w, chunk));
    OTX_TRY(check(
        w, w->tiled ? exr_write_tile_chunk(
                          w->file, w->part, x, y, level, level, chunk->bytes,
                          chunk->size)
                    : exr_write_scanline_chunk(
                          w->file, w->part, place_of(w, level, x, y).y,
                          chunk->bytes, chunk->size)));
    w->clamped_count += chunk->clamped_count;
    advance(w);
    return OSDTEX_OK;
}

/* ---- files -------------------------------------------------------------- */

static otx_status
check_size(otx_run *run, const char *path, otx_exr_size size)
{
    if (size.width < 1 || size.width > OTX_IMAGE_MAX_SIDE || size.height < 1 ||
        size.height > OTX_IMAGE_MAX_SIDE ||
        (size.channels != 1 && size.channels != 3 && size.channels != 4))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(path),
            "an EXR has 1 to %d pixels a side and 1, 3 or 4 channels, not "
            "%d x %d and %d",
            OTX_IMAGE_MAX_SIDE, size.width, size.height, size.channels);
    return OSDTEX_OK;
}

/* Room for a chunk of any part. */
static otx_status
make_packers(
    otx_run *run, otx_exr_writer *w, const otx_exr_part *parts, int32_t count)
{
    const int32_t threads = otx_pool_threads(run->pool);
    size_t bytes = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        otx_exr_writer part = *w;
        size_t here;

        turn_to(&part, &parts[i]);
        here = otx_exr_packed_bytes(&part);
        bytes = here > bytes ? here : bytes;
    }
    w->packers = OTX_ZNEW(run->scratch, otx_exr_packer, threads);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < threads; ++i)
    {
        w->packers[i].is_quick = parts->options->is_quick;
        w->packers[i].rows = OTX_NEW(run->scratch, uint8_t, bytes);
        w->packers[i].split = OTX_NEW(run->scratch, uint8_t, bytes);
        OTX_TRY(otx_run_ok(run));
    }
    w->packer_count = threads;
    return OSDTEX_OK;
}

static otx_status
check_whole(const otx_exr_writer *w)
{
    if (w->level != w->level_count)
        return otx_fail(
            w->run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(w->path),
            "the EXR is ended before its last chunk, at level %d of %d",
            w->level, w->level_count);
    return OSDTEX_OK;
}

otx_status
otx_exr_open_parts(
    otx_run *run, const char *path, const char *temporary,
    const otx_exr_part *parts, int32_t count, otx_exr_writer **out)
{
    exr_context_initializer_t setup = otx_exr_core_writing();
    otx_exr_writer *w = OTX_ZNEW(run->scratch, otx_exr_writer, 1);

    *out = NULL;
    for (int32_t i = 0; i < count; ++i)
        OTX_TRY(check_size(run, path, parts[i].size));
    if (!w || !otx_arena_defer(run->scratch, writer_close, w))
        return otx_fail_memory(run, "picture");
    w->run = run;
    w->path = path;
    OTX_TRY(check(
        w,
        exr_start_write(&w->file, temporary, EXR_WRITE_FILE_DIRECTLY, &setup)));
    OTX_TRY(write_header(w, parts, count));
    w->part = 0;
    turn_to(w, &parts[0]);
    OTX_TRY(make_packers(run, w, parts, count));
    *out = w;
    return OSDTEX_OK;
}

otx_status
otx_exr_open(
    otx_run *run, const char *path, const char *temporary, otx_exr_size size,
    const otx_exr_options *options, otx_exr_writer **out)
{
    const otx_exr_part part = {NULL, size, options};

    return otx_exr_open_parts(run, path, temporary, &part, 1, out);
}

otx_status
otx_exr_next(otx_exr_writer *w, const otx_exr_part *part)
{
    OTX_TRY(check_whole(w));
    ++w->part;
    turn_to(w, part);
    return OSDTEX_OK;
}

otx_status
otx_exr_begin(
    otx_run *run, otx_atomic_file_set *set, const char *path, otx_exr_size size,
    const otx_exr_options *options, otx_exr_writer **out)
{
    const char *temporary;

    *out = NULL;
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    return otx_exr_open(run, path, temporary, size, options, out);
}

otx_status
otx_exr_end(otx_exr_writer *w)
{
    exr_result_t code;

    OTX_TRY(check_whole(w));
    code = exr_finish(&w->file);
    w->file = NULL;
    if (w->clamped_count > 0)
        otx_note(
            w->run, OSDTEX_SEVERITY_WARNING, "picture", otx_where_file(w->path),
            "%lld values beyond the half range were clamped to 65504",
            (long long)w->clamped_count);
    return check(w, code);
}

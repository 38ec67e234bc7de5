/* exr_write.c -- EXR through OpenEXR's C core, chunk by chunk in file order.
 *
 * Two traps of the 3.1 core are stepped over here. Its tile information clips
 * tiles to the size of level 0 whatever their level, and encoding then
 * succeeds with a file that no reader accepts: sizes are set again from the
 * level's. And start_x, start_y of a tile are tile indices, not pixels: they
 * stay as they are. */
#include "file/exr.h"

#include "image/pyramid.h"

/* The table of the C++ library is not linked. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <openexr.h>
#include <stdio.h>
#include <string.h>

enum
{
    SHORT_NAME_BYTES = 31, /* longer names need a flag in the file */
    ZIP_LEVEL = 4          /* half the time of zlib's 6, 2 to 3% larger */
};

struct otx_exr_writer
{
    otx_run *run;
    const char *path;
    exr_context_t file;
    exr_encode_pipeline_t pipeline;
    bool pipeline_is_open;
    otx_exr_size size;
    bool tiled;
    bool full_float;
    int32_t level_count;
    int32_t level, x, y;   /* of the chunk to come */
    int64_t clamped_count; /* values beyond the half range */
    uint8_t *staging;      /* a chunk in file order: planes A, B, G, R */
};

/* The place of a chunk in its level, in texels, y from the top. */
typedef struct place
{
    int32_t x, y, width, height;
} place;

static otx_where
where_of(const char *path)
{
    otx_where where = OTX_NOWHERE;

    where.file = path;
    return where;
}

/* Without a handler the core prints. */
static void
on_error(exr_const_context_t file, exr_result_t code, const char *message)
{
    (void)file;
    (void)code;
    (void)message;
}

static otx_status
check(const otx_exr_writer *w, exr_result_t code)
{
    if (code == EXR_ERR_SUCCESS)
        return OSDTEX_OK;
    if (code == EXR_ERR_OUT_OF_MEMORY)
        return otx_fail_memory(w->run, "picture");
    return otx_fail(
        w->run, OSDTEX_ERROR_IO, "picture", where_of(w->path),
        "the EXR cannot be written (%s); is the disk full?",
        exr_get_default_error_message(code));
}

static void
writer_close(void *object)
{
    otx_exr_writer *w = object;

    if (w->pipeline_is_open)
        exr_encoding_destroy(w->file, &w->pipeline);
    if (w->file)
        exr_finish(&w->file);
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
write_layout(otx_exr_writer *w)
{
    static const char *const names[4] = {"A", "B", "G", "R"};
    exr_result_t code;
    int part;

    code = exr_add_part(
        w->file, NULL, w->tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE,
        &part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(
            w->file, part, w->size.width, w->size.height, EXR_COMPRESSION_ZIP);
    if (code == EXR_ERR_SUCCESS && w->tiled)
        code = exr_set_tile_descriptor(
            w->file, part, OTX_EXR_TILE, OTX_EXR_TILE, EXR_TILE_MIPMAP_LEVELS,
            EXR_TILE_ROUND_DOWN);
    for (int32_t i = 4 - w->size.channels; i < 4; ++i)
        if (code == EXR_ERR_SUCCESS)
            code = exr_add_channel(
                w->file, part, names[i], pixel_type(w),
                EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return code;
}

static exr_result_t
write_text(otx_exr_writer *w, const char *name, const char *text)
{
    return text ? exr_attr_set_string(w->file, 0, name, text) : EXR_ERR_SUCCESS;
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
            w->file, 0, "chromaticities", &chromaticities);
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
        return exr_attr_set_int(w->file, 0, a->name, a->integer);
    default:
        return exr_attr_set_float(w->file, 0, a->name, a->real);
    }
}

static otx_status
write_attributes(otx_exr_writer *w, const otx_exr_options *options)
{
    char software[64];

    snprintf(
        software, sizeof software, "osdtex %d.%d.%d", OSDTEX_VERSION_MAJOR,
        OSDTEX_VERSION_MINOR, OSDTEX_VERSION_PATCH);
    OTX_TRY(check(w, write_text(w, "Software", software)));
    OTX_TRY(check(w, write_color(w, options)));
    if (w->tiled)
        OTX_TRY(check(w, write_texture(w, options)));
    for (int32_t i = 0; i < options->attribute_count; ++i)
        if (write_attribute(w, &options->attributes[i]) != EXR_ERR_SUCCESS)
            return otx_fail(
                w->run, OSDTEX_ERROR_ARGUMENT, "picture", where_of(w->path),
                "attribute \"%s\" cannot be set in the EXR; is its name there "
                "twice, empty or too long?",
                options->attributes[i].name);
    return OSDTEX_OK;
}

static bool
has_long_name(const otx_exr_options *options)
{
    for (int32_t i = 0; i < options->attribute_count; ++i)
        if (strlen(options->attributes[i].name) > SHORT_NAME_BYTES)
            return true;
    return false;
}

static otx_status
write_header(otx_exr_writer *w, const otx_exr_options *options)
{
    if (has_long_name(options))
        OTX_TRY(check(w, exr_set_longname_support(w->file, 1)));
    OTX_TRY(check(w, write_layout(w)));
    OTX_TRY(write_attributes(w, options));
    return check(w, exr_write_header(w->file));
}

/* ---- chunks ------------------------------------------------------------- */

static int32_t
level_width(const otx_exr_writer *w)
{
    return otx_pyramid_side(w->size.width, w->level);
}

static int32_t
level_height(const otx_exr_writer *w)
{
    return otx_pyramid_side(w->size.height, w->level);
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

/* The chunk to come, clipped to its level. */
static place
next_place(const otx_exr_writer *w)
{
    const int32_t x = w->x * chunk_width(w);
    const int32_t y = w->y * chunk_height(w);

    return (place){
        x, y, smaller(chunk_width(w), level_width(w) - x),
        smaller(chunk_height(w), level_height(w) - y)};
}

/* Counts on to the next chunk in file order. */
static void
advance(otx_exr_writer *w)
{
    if (++w->x * chunk_width(w) < level_width(w))
        return;
    w->x = 0;
    if (++w->y * chunk_height(w) < level_height(w))
        return;
    w->y = 0;
    ++w->level;
}

static otx_status
not_finite(const otx_exr_writer *w)
{
    return otx_fail(
        w->run, OSDTEX_ERROR_NUMERIC, "picture", where_of(w->path),
        "the picture to write holds a value that is not finite; please report "
        "how it was made");
}

static uint16_t
to_half(otx_exr_writer *w, float value)
{
    if (fabsf(value) > (float)HALF_MAX)
    {
        ++w->clamped_count;
        value = copysignf((float)HALF_MAX, value);
    }
    return imath_float_to_half(value);
}

/* One row of one channel into its plane. Native byte order: the core swaps. */
static bool
stage_row(otx_exr_writer *w, const float *in, int32_t width, size_t first_value)
{
    for (int32_t x = 0; x < width; ++x, in += w->size.channels)
    {
        if (!isfinite(*in))
            return false;
        if (w->full_float)
            ((float *)(void *)w->staging)[first_value + (size_t)x] = *in;
        else
            ((uint16_t *)(void *)w->staging)[first_value + (size_t)x] =
                to_half(w, *in);
    }
    return true;
}

/* Turns rows over and channels into planes in the file's order. */
static otx_status
stage(otx_exr_writer *w, place p, const float *pixels, ptrdiff_t stride)
{
    const size_t width = (size_t)p.width;

    for (int32_t plane = 0; plane < w->size.channels; ++plane)
        for (int32_t y = 0; y < p.height; ++y)
        {
            const float *row = pixels + (p.height - 1 - y) * stride +
                               (w->size.channels - 1 - plane);
            const size_t first =
                ((size_t)plane * (size_t)p.height + (size_t)y) * width;

            if (!stage_row(w, row, p.width, first))
                return not_finite(w);
        }
    return OSDTEX_OK;
}

static exr_result_t
chunk_info(const otx_exr_writer *w, place p, exr_chunk_info_t *chunk)
{
    const uint64_t texel_bytes =
        (uint64_t)w->size.channels * (w->full_float ? 4u : 2u);
    exr_result_t code;

    if (!w->tiled)
        return exr_write_scanline_chunk_info(w->file, 0, p.y, chunk);
    code = exr_write_tile_chunk_info(
        w->file, 0, w->x, w->y, w->level, w->level, chunk);
    chunk->width = p.width;
    chunk->height = p.height;
    chunk->unpacked_size = (uint64_t)p.width * (uint64_t)p.height * texel_bytes;
    return code;
}

/* Points the pipeline at the staged planes. */
static void
connect(otx_exr_writer *w, place p)
{
    const int32_t value_bytes = w->full_float ? 4 : 2;
    const size_t plane_bytes =
        (size_t)p.width * (size_t)p.height * (size_t)value_bytes;

    for (int32_t c = 0; c < w->pipeline.channel_count; ++c)
    {
        exr_coding_channel_info_t *info = &w->pipeline.channels[c];

        info->encode_from_ptr = w->staging + (size_t)c * plane_bytes;
        info->user_pixel_stride = value_bytes;
        info->user_line_stride = value_bytes * p.width;
        info->user_bytes_per_element = (int16_t)value_bytes;
        info->user_data_type = (uint16_t)pixel_type(w);
    }
}

static exr_result_t
encode(otx_exr_writer *w, place p)
{
    const bool is_first = !w->pipeline_is_open;
    exr_chunk_info_t chunk = {0};
    exr_result_t code = chunk_info(w, p, &chunk);

    if (code == EXR_ERR_SUCCESS)
        code = is_first
                   ? exr_encoding_initialize(w->file, 0, &chunk, &w->pipeline)
                   : exr_encoding_update(w->file, 0, &chunk, &w->pipeline);
    if (code != EXR_ERR_SUCCESS)
        return code;
    w->pipeline_is_open = true;
    connect(w, p);
    if (is_first)
        code = exr_encoding_choose_default_routines(w->file, 0, &w->pipeline);
    return code == EXR_ERR_SUCCESS ? exr_encoding_run(w->file, 0, &w->pipeline)
                                   : code;
}

otx_status
otx_exr_put(
    otx_exr_writer *w, int32_t level, int32_t x, int32_t y, const float *pixels,
    ptrdiff_t stride)
{
    if (w->level == w->level_count || level != w->level || x != w->x ||
        y != w->y)
        return otx_fail(
            w->run, OSDTEX_ERROR_ARGUMENT, "picture", where_of(w->path),
            "chunk (%d, %d) of level %d is not the next one of the EXR", x, y,
            level);

    const place p = next_place(w);

    OTX_TRY(stage(w, p, pixels, stride));
    OTX_TRY(check(w, encode(w, p)));
    advance(w);
    return OSDTEX_OK;
}

/* ---- files --------------------------------------------------------------- */

static otx_status
check_size(otx_run *run, const char *path, otx_exr_size size)
{
    if (size.width < 1 || size.width > OTX_IMAGE_MAX_SIDE || size.height < 1 ||
        size.height > OTX_IMAGE_MAX_SIDE ||
        (size.channels != 3 && size.channels != 4))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "picture", where_of(path),
            "an EXR has 1 to %d pixels a side and 3 or 4 channels, not %d x "
            "%d and %d",
            OTX_IMAGE_MAX_SIDE, size.width, size.height, size.channels);
    return OSDTEX_OK;
}

/* Opens `temporary`, in which the file that will be `path` grows. */
static otx_status
begin(
    otx_run *run, const char *path, const char *temporary, otx_exr_size size,
    const otx_exr_options *options, otx_exr_writer **out)
{
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    otx_exr_writer *w = OTX_ZNEW(run->scratch, otx_exr_writer, 1);

    if (!w || !otx_arena_defer(run->scratch, writer_close, w))
        return otx_fail_memory(run, "picture");
    w->run = run;
    w->path = path;
    w->size = size;
    w->tiled = options->tiled;
    w->full_float = options->full_float;
    w->level_count = w->tiled ? otx_pyramid_count(size.width, size.height) : 1;
    w->staging = OTX_NEW(
        run->scratch, uint8_t,
        (size_t)chunk_width(w) * (size_t)chunk_height(w) *
            (size_t)size.channels * sizeof(float));
    if (!w->staging)
        return otx_fail_memory(run, "picture");
    setup.error_handler_fn = on_error;
    setup.zip_level = ZIP_LEVEL;
    OTX_TRY(check(
        w,
        exr_start_write(&w->file, temporary, EXR_WRITE_FILE_DIRECTLY, &setup)));
    OTX_TRY(write_header(w, options));
    *out = w;
    return OSDTEX_OK;
}

otx_status
otx_exr_begin(
    otx_run *run, otx_atomic_file_set *set, const char *path, otx_exr_size size,
    const otx_exr_options *options, otx_exr_writer **out)
{
    const char *temporary;

    *out = NULL;
    OTX_TRY(check_size(run, path, size));
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    return begin(run, path, temporary, size, options, out);
}

otx_status
otx_exr_end(otx_exr_writer *w)
{
    exr_result_t code;

    if (w->level != w->level_count)
        return otx_fail(
            w->run, OSDTEX_ERROR_ARGUMENT, "picture", where_of(w->path),
            "the EXR is ended before its last chunk, at level %d of %d",
            w->level, w->level_count);
    exr_encoding_destroy(w->file, &w->pipeline);
    w->pipeline_is_open = false;
    code = exr_finish(&w->file);
    w->file = NULL;
    if (w->clamped_count > 0)
        otx_note(
            w->run, OSDTEX_SEVERITY_WARNING, "picture", where_of(w->path),
            "%lld values beyond the half range were clamped to 65504",
            (long long)w->clamped_count);
    return check(w, code);
}

/* Puts all chunks of the level that is next. */
static otx_status
put_level(otx_exr_writer *w, const otx_image *image)
{
    const int32_t level = w->level;

    while (w->level == level && w->level < w->level_count)
    {
        const place p = next_place(w);
        const int32_t lower = image->height - p.y - p.height;

        if (level == 0 && w->x == 0)
            OTX_TRY(
                otx_progress(w->run, "write", p.y / (double)w->size.height));
        OTX_TRY(otx_exr_put(
            w, level, w->x, w->y, otx_image_at(image, p.x, lower),
            (ptrdiff_t)image->width * image->channels));
    }
    return OSDTEX_OK;
}

static otx_status
write_levels(
    otx_exr_writer *w, const otx_image *image, const otx_exr_options *options)
{
    otx_image above = *image;

    OTX_TRY(put_level(w, image));
    for (int32_t level = 1; level < w->level_count; ++level)
    {
        otx_image next;

        if (options->levels)
            next = options->levels[level - 1];
        else
            OTX_TRY(otx_pyramid_reduce(w->run, w->run->scratch, &above, &next));
        OTX_TRY(put_level(w, &next));
        above = next;
    }
    return otx_exr_end(w);
}

static otx_status
check_levels(
    otx_run *run, const char *path, const otx_image *image,
    const otx_exr_options *options)
{
    const int32_t count = otx_pyramid_count(image->width, image->height) - 1;
    bool ok = options->level_count == count;

    if (!options->tiled || !options->levels)
        return OSDTEX_OK;
    for (int32_t i = 0; ok && i < count; ++i)
    {
        const otx_image *level = &options->levels[i];

        ok = level->width == otx_pyramid_side(image->width, i + 1) &&
             level->height == otx_pyramid_side(image->height, i + 1) &&
             level->channels == image->channels;
    }
    if (!ok)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "picture", where_of(path),
            "the mip levels given do not fit a picture of %d x %d",
            image->width, image->height);
    return OSDTEX_OK;
}

otx_status
otx_exr_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, const otx_exr_options *options)
{
    const otx_exr_size size = {image->width, image->height, image->channels};
    const char *temporary;
    otx_exr_writer *w;
    otx_status status;

    OTX_TRY(check_size(run, path, size));
    OTX_TRY(check_levels(run, path, image, options));
    /* Before the mark: the set may live in the scratch arena too. */
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));

    const otx_arena_mark mark = otx_arena_here(run->scratch);

    status = begin(run, path, temporary, size, options, &w);
    if (status == OSDTEX_OK)
        status = write_levels(w, image, options);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* exr_read.c -- EXR through OpenEXR's C core.
 *
 * The core reads and decompresses chunks; samples are unpacked here. Its own
 * unpack routines are chosen by heuristics over channel layout, and its
 * buffers are sized by what a header says: unpacking by hand lets every bound
 * be checked against the chunk that was really read. */
#include "file/exr.h"

#include "bridge/openexr.h"
#include "file/exr_core.h"
#include "file/exr_layer.h"

/* The table of the C++ library is not linked. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    MAX_BLOCK_BYTES = 1 << 29
};

typedef struct reader
{
    otx_run *run;
    const char *path;
    exr_context_t file;
    exr_decode_pipeline_t pipeline;
    bool pipeline_is_open;
    otx_picture *out;
    otx_exr_layer layer;
    exr_compression_t compression;
} reader;

static otx_status
reader_failed(const reader *r, exr_result_t code)
{
    const char *reason = exr_get_default_error_message(code);

    switch (code)
    {
    case EXR_ERR_OUT_OF_MEMORY:
        return otx_fail(
            r->run, OSDTEX_ERROR_MEMORY, "picture", otx_where_file(r->path),
            "the EXR asks for more memory than there is; it may be damaged: "
            "write it again");
    case EXR_ERR_FILE_ACCESS:
        return otx_fail(
            r->run, OSDTEX_ERROR_IO, "picture", otx_where_file(r->path),
            "the EXR cannot be opened (%s)", reason);
    case EXR_ERR_FEATURE_NOT_IMPLEMENTED:
        return otx_fail(
            r->run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(r->path),
            "the EXR is of a kind that is not read (%s); convert it to ZIP "
            "compressed scanlines",
            reason);
    default:
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(r->path),
            "the EXR is damaged or cut short (%s); write it again", reason);
    }
}

static void
reader_close(void *object)
{
    reader *r = object;

    if (r->pipeline_is_open)
        exr_decoding_destroy(r->file, &r->pipeline);
    if (r->file)
        exr_finish(&r->file);
}

static otx_status
reader_open(reader *r)
{
    exr_context_initializer_t setup = otx_exr_core_reading();
    exr_result_t code;

    code = exr_start_read(&r->file, r->path, &setup);
    return code == EXR_ERR_SUCCESS ? OSDTEX_OK : reader_failed(r, code);
}

/* Whether the core cannot read the pixels, and the C++ library has to. */
static bool
needs_library(const reader *r)
{
    return r->layer.is_chroma || r->compression == EXR_COMPRESSION_DWAA ||
           r->compression == EXR_COMPRESSION_DWAB;
}

static otx_status
read_compression(reader *r)
{
    const exr_result_t code =
        exr_get_compression(r->file, r->layer.part, &r->compression);

    return code == EXR_ERR_SUCCESS ? OSDTEX_OK : reader_failed(r, code);
}

/* ---- header ------------------------------------------------------------- */

/* A string attribute as printable ASCII in the run's arena, or NULL. */
static const char *
read_text(const reader *r, const char *name)
{
    const char *text = NULL;
    int32_t length = 0;
    char *copy;

    if (exr_attr_get_string(r->file, r->layer.part, name, &length, &text) !=
            EXR_ERR_SUCCESS ||
        !text || length <= 0)
        return NULL;
    copy = OTX_ZNEW(r->run->arena, char, (size_t)length + 1);
    if (!copy)
        return NULL;
    for (int32_t i = 0; i < length && text[i]; ++i)
        copy[i] = text[i] < ' ' || text[i] > '~' ? '?' : text[i];
    return copy;
}

static void
read_metadata(reader *r)
{
    exr_attr_chromaticities_t c;
    otx_picture *out = r->out;

    out->part = r->layer.part;
    out->layer = r->layer.name;
    out->is_gray = r->layer.is_gray;
    out->bits = r->layer.bits;
    out->is_float = true;
    out->alpha_is_premultiplied = r->layer.channels[3] != OTX_EXR_NO_CHANNEL;
    out->interop_id = read_text(r, "colorInteropID");
    out->oiio_space = read_text(r, "oiio:ColorSpace");
    out->tiles = read_text(r, "osdtex:tiles");
    if (exr_attr_get_chromaticities(
            r->file, r->layer.part, "chromaticities", &c) != EXR_ERR_SUCCESS)
        return;
    const float values[8] = {c.red_x,  c.red_y,  c.green_x, c.green_y,
                             c.blue_x, c.blue_y, c.white_x, c.white_y};

    out->has_chromaticities = true;
    memcpy(out->chromaticities, values, sizeof values);
}

static otx_picture_window
window_of(exr_attr_box2i_t box)
{
    return (otx_picture_window){box.min.x, box.min.y, box.max.x, box.max.y};
}

static int32_t
larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static int32_t
smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* What is shown of what is stored. */
static otx_picture_window
visible_window(const otx_picture *p)
{
    return (otx_picture_window){
        larger(p->data_window.x_min, p->display_window.x_min),
        larger(p->data_window.y_min, p->display_window.y_min),
        smaller(p->data_window.x_max, p->display_window.x_max),
        smaller(p->data_window.y_max, p->display_window.y_max)};
}

static int64_t
span_of(int32_t min, int32_t max)
{
    return (int64_t)max - min + 1;
}

static otx_status
check_windows(const reader *r)
{
    const otx_picture_window data = r->out->data_window;
    const otx_picture_window display = r->out->display_window;
    const otx_picture_window visible = visible_window(r->out);

    OTX_TRY(otx_picture_check_size(
        r->run, r->path, span_of(data.x_min, data.x_max),
        span_of(data.y_min, data.y_max)));
    if (visible.x_min > visible.x_max || visible.y_min > visible.y_max)
        return otx_fail(
            r->run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(r->path),
            "no pixel of the EXR lies in its display window; reset the display "
            "window");
    if (memcmp(&visible, &display, sizeof visible) != 0)
        otx_note(
            r->run, OSDTEX_SEVERITY_WARNING, "picture", otx_where_file(r->path),
            "the EXR fills only a part of its display window; the picture is "
            "that part, (%d, %d) to (%d, %d)",
            visible.x_min, visible.y_min, visible.x_max, visible.y_max);
    else if (memcmp(&visible, &data, sizeof visible) != 0)
        otx_note(
            r->run, OSDTEX_SEVERITY_INFO, "picture", otx_where_file(r->path),
            "the EXR has pixels beyond its display window; they are left out");
    return OSDTEX_OK;
}

static otx_status
read_windows(reader *r)
{
    exr_attr_box2i_t data, display;
    exr_result_t code = exr_get_data_window(r->file, r->layer.part, &data);

    if (code == EXR_ERR_SUCCESS)
        code = exr_get_display_window(r->file, r->layer.part, &display);
    if (code != EXR_ERR_SUCCESS)
        return reader_failed(r, code);
    r->out->data_window = window_of(data);
    r->out->display_window = window_of(display);
    OTX_TRY(check_windows(r));

    const otx_picture_window visible = visible_window(r->out);

    return otx_picture_create(
        r->run, r->path, span_of(visible.x_min, visible.x_max),
        span_of(visible.y_min, visible.y_max),
        r->layer.channels[3] == OTX_EXR_NO_CHANNEL ? 3 : 4, r->out);
}

/* ---- pixels ------------------------------------------------------------- */

/* Buffers of the pipeline start at zero, so that what a damaged chunk leaves
 * out is the same in every run, and absurd sizes are refused. */
static void *
alloc_zeroed(exr_transcoding_pipeline_buffer_id_t id, size_t bytes)
{
    (void)id;
    return bytes <= MAX_BLOCK_BYTES ? calloc(1, bytes) : NULL;
}

static void
free_zeroed(exr_transcoding_pipeline_buffer_id_t id, void *buffer)
{
    (void)id;
    free(buffer);
}

static float
load_sample(const uint8_t *at, uint16_t type)
{
    const uint16_t word = (uint16_t)(at[0] | at[1] << 8);
    uint32_t quad;
    float value;

    if (type == EXR_PIXEL_HALF)
        return imath_half_to_float(word);
    quad = word | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    if (type == EXR_PIXEL_UINT)
        return (float)quad;
    memcpy(&value, &quad, sizeof value);
    return value;
}

/* One channel's row of a chunk, at pixel (x, y) of the data window's plane. */
static void
store_row(
    const reader *r, int32_t channel, const uint8_t *at, int32_t x, int32_t y)
{
    const exr_coding_channel_info_t *info = &r->pipeline.channels[channel];
    const otx_picture_window visible = visible_window(r->out);
    const int32_t channels = r->out->image.channels;
    const int32_t first = larger(x, visible.x_min);
    const int32_t last = smaller(x + info->width - 1, visible.x_max);

    if (y < visible.y_min || y > visible.y_max)
        return;
    for (int32_t c = 0; c < channels; ++c)
    {
        float *row = otx_picture_row(r->out, y - visible.y_min) + c;

        if (r->layer.channels[c] != channel)
            continue;
        for (int32_t i = first; i <= last; ++i)
            row[(size_t)(i - visible.x_min) * (size_t)channels] = load_sample(
                at + (size_t)(i - x) * (size_t)info->bytes_per_element,
                info->data_type);
    }
}

/* A decoded chunk holds, for each of its rows, each channel's samples in
 * turn; subsampled channels only on their rows. */
static bool
unpack(const reader *r, int32_t x, int32_t y)
{
    const exr_decode_pipeline_t *p = &r->pipeline;
    const uint8_t *at = p->unpacked_buffer;
    uint64_t left = p->chunk.unpacked_size;

    for (int32_t row = 0; row < p->chunk.height; ++row)
        for (int32_t c = 0; c < p->channel_count; ++c)
        {
            const exr_coding_channel_info_t *info = &p->channels[c];
            const uint64_t bytes =
                (uint64_t)info->width * (uint64_t)info->bytes_per_element;

            if (info->height == 0 || (y + row) % info->y_samples != 0)
                continue;
            if (!at || bytes > left)
                return false;
            store_row(r, c, at, x, y + row);
            at += bytes;
            left -= bytes;
        }
    return true;
}

/* Reads, decompresses and stores one chunk whose first pixel is (x, y). */
static otx_status
read_chunk(reader *r, const exr_chunk_info_t *chunk, int32_t x, int32_t y)
{
    const bool is_raw = r->compression == EXR_COMPRESSION_NONE;
    exr_result_t code;

    /* The core takes an empty chunk, or a short raw one, as a success. */
    if (chunk->packed_size == 0 ||
        (is_raw && chunk->packed_size != chunk->unpacked_size))
        return reader_failed(r, EXR_ERR_CORRUPT_CHUNK);
    if (chunk->unpacked_size > MAX_BLOCK_BYTES)
        return otx_fail(
            r->run, OSDTEX_ERROR_LIMIT, "picture", otx_where_file(r->path),
            "the EXR has tiles or blocks of %llu bytes; write it with smaller "
            "tiles or fewer channels",
            (unsigned long long)chunk->unpacked_size);
    if (r->pipeline_is_open)
        code = exr_decoding_update(r->file, r->layer.part, chunk, &r->pipeline);
    else
    {
        code = exr_decoding_initialize(
            r->file, r->layer.part, chunk, &r->pipeline);
        r->pipeline_is_open = code == EXR_ERR_SUCCESS;
        r->pipeline.alloc_fn = alloc_zeroed;
        r->pipeline.free_fn = free_zeroed;
        if (code == EXR_ERR_SUCCESS)
            code = exr_decoding_choose_default_routines(
                r->file, r->layer.part, &r->pipeline);
        r->pipeline.unpack_and_convert_fn = NULL;
    }
    if (code == EXR_ERR_SUCCESS)
        code = exr_decoding_run(r->file, r->layer.part, &r->pipeline);
    if (code == EXR_ERR_SUCCESS && !unpack(r, x, y))
        code = EXR_ERR_CORRUPT_CHUNK;
    return code == EXR_ERR_SUCCESS ? OSDTEX_OK : reader_failed(r, code);
}

static otx_status
read_scanlines(reader *r)
{
    const otx_picture_window data = r->out->data_window;
    int32_t rows = 0;
    exr_result_t code =
        exr_get_scanlines_per_chunk(r->file, r->layer.part, &rows);

    if (code != EXR_ERR_SUCCESS || rows < 1)
        return reader_failed(r, code);
    for (int64_t y = data.y_min; y <= data.y_max; y += rows)
    {
        exr_chunk_info_t chunk = {0};

        code = exr_read_scanline_chunk_info(
            r->file, r->layer.part, (int)y, &chunk);
        if (code != EXR_ERR_SUCCESS)
            return reader_failed(r, code);
        OTX_TRY(read_chunk(r, &chunk, data.x_min, (int32_t)y));
    }
    return OSDTEX_OK;
}

static otx_status
read_tile(reader *r, int32_t x, int32_t y, int32_t width, int32_t height)
{
    const otx_picture_window data = r->out->data_window;
    exr_chunk_info_t chunk = {0};
    const exr_result_t code =
        exr_read_tile_chunk_info(r->file, r->layer.part, x, y, 0, 0, &chunk);

    if (code != EXR_ERR_SUCCESS)
        return reader_failed(r, code);
    return read_chunk(
        r, &chunk, data.x_min + x * width, data.y_min + y * height);
}

/* Level 0 of a tiled part, whatever its other levels. */
static otx_status
read_tiles(reader *r)
{
    const otx_picture_window data = r->out->data_window;
    int32_t width = 0, height = 0;
    const exr_result_t code =
        exr_get_tile_sizes(r->file, r->layer.part, 0, 0, &width, &height);

    if (code != EXR_ERR_SUCCESS || width < 1 || height < 1)
        return reader_failed(r, code);
    for (int32_t y = 0; y <= (data.y_max - data.y_min) / height; ++y)
        for (int32_t x = 0; x <= (data.x_max - data.x_min) / width; ++x)
            OTX_TRY(read_tile(r, x, y, width, height));
    return OSDTEX_OK;
}

/* A row of the data window, as far as it is visible. */
static void
keep_row(void *user, int32_t y, const float *row, int32_t x_min, int32_t width)
{
    const reader *r = user;
    const otx_picture_window visible = visible_window(r->out);
    const int32_t channels = r->out->image.channels;
    float *to = otx_picture_row(r->out, y - visible.y_min);

    (void)width;
    for (int32_t x = visible.x_min; x <= visible.x_max; ++x)
        memcpy(
            to + (size_t)(x - visible.x_min) * (size_t)channels,
            row + 4 * (size_t)(x - x_min), (size_t)channels * sizeof *to);
}

/* What the core does not decode. The windows have been checked by it. */
static otx_status
read_by_library(reader *r)
{
    const otx_picture_window visible = visible_window(r->out);
    const exr_attr_chlist_t *list = NULL;
    otx_openexr_picture picture = {
        .path = r->path,
        .part = r->layer.part,
        .is_chroma = r->layer.is_chroma,
        .y_min = visible.y_min,
        .y_max = visible.y_max};
    char reason[OTX_OPENEXR_REASON_BYTES];
    otx_status status;

    exr_get_channels(r->file, r->layer.part, &list);
    for (int c = 0; c < 4; ++c)
        if (r->layer.channels[c] != OTX_EXR_NO_CHANNEL)
            picture.channels[c] = list->entries[r->layer.channels[c]].name.str;
    status = otx_openexr_read(&picture, keep_row, r, reason);
    if (status == OSDTEX_OK)
        return status;
    if (status == OSDTEX_ERROR_MEMORY)
        return reader_failed(r, EXR_ERR_OUT_OF_MEMORY);
    return otx_fail(
        r->run, status, "picture", otx_where_file(r->path),
        "the EXR is damaged or cut short (%s); write it again", reason);
}

otx_status
otx_exr_read_layer(
    otx_run *run, const char *path, const char *layer, otx_picture *out)
{
    reader *r = OTX_ZNEW(run->scratch, reader, 1);
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;

    if (!r || !otx_arena_defer(run->scratch, reader_close, r))
        return otx_fail_memory(run, "picture");
    r->run = run;
    r->path = path;
    r->out = out;
    OTX_TRY(reader_open(r));
    OTX_TRY(otx_exr_layer_choose(run, path, r->file, layer, &r->layer));
    OTX_TRY(read_compression(r));
    read_metadata(r);
    OTX_TRY(read_windows(r));
    if (needs_library(r))
        return read_by_library(r);
    exr_get_storage(r->file, r->layer.part, &storage);
    return storage == EXR_STORAGE_TILED ? read_tiles(r) : read_scanlines(r);
}

otx_status
otx_exr_read(otx_run *run, const char *path, otx_picture *out)
{
    return otx_exr_read_layer(run, path, NULL, out);
}

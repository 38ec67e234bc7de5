/* exr_picture.c -- a whole picture as an EXR: its levels, packed on all threads
 * and put chunk by chunk. */
#include "file/exr.h"

#include "image/pyramid.h"

enum
{
    BATCH = 64 /* chunks packed at once */
};

/* A run of chunks of one level, packed on all threads. */
typedef struct batch
{
    const otx_exr_writer *writer;
    const otx_image *image;
    int32_t level;
    int32_t width, height; /* of a chunk */
    int32_t columns;
    int64_t first; /* chunks before it */
    otx_exr_chunk chunks[BATCH];
} batch;

static otx_status
pack_one(void *context, int64_t index, otx_worker *worker)
{
    batch *b = context;
    const otx_image *image = b->image;
    const int32_t x = (int32_t)((b->first + index) % b->columns);
    const int32_t y = (int32_t)((b->first + index) / b->columns);
    const int32_t lower = image->height - (y + 1) * b->height;

    otx_exr_pack(
        b->writer, worker->index, b->level, x, y,
        otx_image_at(image, x * b->width, lower > 0 ? lower : 0),
        (ptrdiff_t)image->width * image->channels, &b->chunks[index]);
    return OSDTEX_OK;
}

static otx_status
put_chunks(otx_run *run, otx_exr_writer *writer, batch *b, int64_t count)
{
    const int64_t left = count - b->first;
    const int32_t here = left < BATCH ? (int32_t)left : BATCH;

    if (b->level == 0)
        OTX_TRY(otx_progress(run, "write", (double)b->first / (double)count));
    OTX_TRY(otx_pool_for(run->pool, here, pack_one, b));
    for (int32_t i = 0; i < here; ++i, ++b->first)
        OTX_TRY(otx_exr_put(
            writer, b->level, (int32_t)(b->first % b->columns),
            (int32_t)(b->first / b->columns), &b->chunks[i]));
    return OSDTEX_OK;
}

static otx_status
put_level(
    otx_run *run, otx_exr_writer *writer, int32_t level, const otx_image *image,
    bool tiled)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const size_t bytes = otx_exr_packed_bytes(writer);
    const int32_t width = tiled ? OTX_EXR_TILE : image->width;
    const int32_t height = tiled ? OTX_EXR_TILE : OTX_EXR_ROWS;
    const int32_t columns = (image->width + width - 1) / width;
    const int32_t rows = (image->height + height - 1) / height;
    const int64_t count = (int64_t)columns * rows;
    batch *b = OTX_ZNEW(run->scratch, batch, 1);

    OTX_TRY(otx_run_ok(run));
    b->writer = writer;
    b->image = image;
    b->level = level;
    b->width = width;
    b->height = height;
    b->columns = columns;
    for (int32_t i = 0; i < BATCH && i < count; ++i)
    {
        b->chunks[i].bytes = OTX_NEW(run->scratch, uint8_t, bytes);
        OTX_TRY(otx_run_ok(run));
    }
    while (b->first < count)
        OTX_TRY(put_chunks(run, writer, b, count));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static otx_status
put_levels(
    otx_run *run, otx_exr_writer *writer, const otx_image *image,
    const otx_exr_options *options)
{
    const int32_t count =
        options->tiled ? otx_pyramid_count(image->width, image->height) : 1;
    otx_image above = *image;

    OTX_TRY(put_level(run, writer, 0, image, options->tiled));
    for (int32_t level = 1; level < count; ++level)
    {
        otx_image next;

        if (options->levels)
            next = options->levels[level - 1];
        else
            OTX_TRY(otx_pyramid_reduce(run, run->scratch, &above, &next));
        OTX_TRY(put_level(run, writer, level, &next, true));
        above = next;
    }
    return OSDTEX_OK;
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
            run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(path),
            "the mip levels given do not fit a picture of %d x %d",
            image->width, image->height);
    return OSDTEX_OK;
}

/* Headers, then the chunks of one page after the other. */
static otx_status
put_pages(
    otx_run *run, const char *path, const char *temporary,
    const otx_exr_page *pages, int32_t count)
{
    otx_exr_part *parts = OTX_NEW(run->scratch, otx_exr_part, count);
    otx_exr_writer *writer;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_image *image = pages[i].image;

        parts[i] = (otx_exr_part){
            pages[i].name,
            {image->width, image->height, image->channels},
            &pages[i].options};
    }
    OTX_TRY(otx_exr_open_parts(run, path, temporary, parts, count, &writer));
    for (int32_t i = 0; i < count; ++i)
    {
        if (i > 0)
            OTX_TRY(otx_exr_next(writer, &parts[i]));
        OTX_TRY(put_levels(run, writer, pages[i].image, &pages[i].options));
    }
    return otx_exr_end(writer);
}

otx_status
otx_exr_write_pages(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exr_page *pages, int32_t count)
{
    const char *temporary;
    otx_status status;

    for (int32_t i = 0; i < count; ++i)
        OTX_TRY(check_levels(run, path, pages[i].image, &pages[i].options));
    /* Before the mark: the set may live in the scratch arena too. */
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));

    const otx_arena_mark mark = otx_arena_here(run->scratch);

    status = put_pages(run, path, temporary, pages, count);
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_exr_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, const otx_exr_options *options)
{
    const otx_exr_page page = {NULL, image, *options};

    return otx_exr_write_pages(run, set, path, &page, 1);
}

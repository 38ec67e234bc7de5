/* exr.h -- OpenEXR files through OpenEXR's C core.
 *
 * Reading is by picture.h. Writing gives one part, or several, with the
 * channels R, G, B (and A) or Y, ZIP compressed. A *texture* is tiled 64 x 64
 * and mip-mapped with sizes rounded down; a *render* is scanlines. The same
 * input gives the same bytes: no dates, no host, chunks in order. */
#ifndef OTX_FILE_EXR_H
#define OTX_FILE_EXR_H

#include "file/atomic_file.h"
#include "file/exr_chunk.h"
#include "file/picture.h"

enum
{
    OTX_EXR_TILE = 64,
    OTX_EXR_ROWS = 16 /* of a chunk of a scanline file, fixed by ZIP */
};

typedef enum otx_exr_kind
{
    OTX_EXR_TEXT,
    OTX_EXR_INTEGER,
    OTX_EXR_REAL
} otx_exr_kind;

/* One more line of the header. Names must not repeat those written anyway. */
typedef struct otx_exr_attribute
{
    const char *name; /* at most 255 bytes */
    otx_exr_kind kind;
    const char *text;
    int32_t integer;
    float real;
} otx_exr_attribute;

typedef struct otx_exr_options
{
    bool tiled;      /* a texture; false: scanlines, no mip levels */
    bool full_float; /* 32 bits a channel; false: half */
    bool is_quick;   /* packed in half the time, and a little larger */
    bool wrap_x;     /* the picture repeats: "periodic", else "clamp" */
    bool wrap_y;
    bool has_chromaticities;
    float chromaticities[8]; /* R, G, B, W as xy pairs */
    const char *color_space; /* oiio:ColorSpace, NULL leaves it out */
    const char *interop_id;  /* colorInteropID, NULL leaves it out */
    const otx_exr_attribute *attributes; /* [attribute_count] */
    int32_t attribute_count;
    /* Mip levels 1, 2, ... made by the caller, where averaging over the whole
     * picture would mix what must stay apart. [level_count], NULL: box filter.
     * Level l must be max(1, width >> l) by max(1, height >> l), and all
     * otx_pyramid_count(width, height) - 1 of them must be there. */
    const otx_image *levels;
    int32_t level_count;
} otx_exr_options;

static inline otx_exr_options
otx_exr_options_default(void)
{
    return (otx_exr_options){.tiled = true};
}

/* Writes `image` (1, 3 or 4 channels) as the file `path` of `set`, which the
 * caller commits. Finite values beyond 65504 are clamped to it in half files,
 * with a note. ARGUMENT, NUMERIC (a value is not finite), IO, MEMORY. */
otx_status otx_exr_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, const otx_exr_options *options);

/* One of several pictures in a file. */
typedef struct otx_exr_page
{
    const char *name;
    const otx_image *image;
    otx_exr_options options;
} otx_exr_page;

/* Writes `count` pictures as the parts of one file, in their order. */
otx_status otx_exr_write_pages(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exr_page *pages, int32_t count);

/* The same in pieces, for pictures that are never in memory as a whole. */
typedef struct otx_exr_writer otx_exr_writer;

/* What a streamed picture is. */
typedef struct otx_exr_size
{
    int32_t width, height;
    int32_t channels; /* 1, 3 or 4 */
} otx_exr_size;

/* Adds `path` to `set` and writes its header. The writer lives in run->scratch
 * and closes the file when that is released; `path` must live as long.
 * options->levels is not looked at: every level is put by the caller. ARGUMENT,
 * IO, MEMORY. */
otx_status otx_exr_begin(
    otx_run *run, otx_atomic_file_set *set, const char *path, otx_exr_size size,
    const otx_exr_options *options, otx_exr_writer **out);

/* The same for a path that is in a set already, under the name `temporary`. */
otx_status otx_exr_open(
    otx_run *run, const char *path, const char *temporary, otx_exr_size size,
    const otx_exr_options *options, otx_exr_writer **out);

/* A part of a file of several. */
typedef struct otx_exr_part
{
    const char *name; /* of its own; NULL: the only part */
    otx_exr_size size;
    const otx_exr_options *options;
} otx_exr_part;

/* otx_exr_open of a file of `count` parts. The chunks of the first one are put,
 * then otx_exr_next turns to the next. */
otx_status otx_exr_open_parts(
    otx_run *run, const char *path, const char *temporary,
    const otx_exr_part *parts, int32_t count, otx_exr_writer **out);
otx_status otx_exr_next(otx_exr_writer *writer, const otx_exr_part *part);

/* Packs a chunk, which every thread of run->pool can do for other chunks at the
 * same time.
 *
 *   lane    the thread's number; no two at a time in one lane
 *   x, y    of the chunk, counted in chunks; y from the top
 *   pixels  the texel at the lower left corner of the chunk
 *   stride  floats from a row of texels to the one above
 *   chunk   its bytes have room for otx_exr_packed_bytes
 *
 * Chunks at the right and lower rim are clipped to the level. What is wrong
 * with the pixels is said when the chunk is put. */
void otx_exr_pack(
    const otx_exr_writer *writer, int32_t lane, int32_t level, int32_t x,
    int32_t y, const float *pixels, ptrdiff_t stride, otx_exr_chunk *chunk);
size_t otx_exr_packed_bytes(const otx_exr_writer *writer);

/* Writes the next chunk, in file order: levels from 0 up; within a level rows
 * of tiles from the TOP, within a row from the left. A scanline file has level
 * 0 and x 0 only, and chunks of OTX_EXR_ROWS rows. ARGUMENT when it is not the
 * next one, NUMERIC, IO, MEMORY. */
otx_status otx_exr_put(
    otx_exr_writer *writer, int32_t level, int32_t x, int32_t y,
    const otx_exr_chunk *chunk);

/* Writes the offsets and closes the file. All chunks must be there. */
otx_status otx_exr_end(otx_exr_writer *writer);

/* Reads an EXR into `out`; called by otx_picture_read. */
otx_status otx_exr_read(otx_run *run, const char *path, otx_picture *out);
/* The same of a layer or part by name; NULL: see exr_layer.h. */
otx_status otx_exr_read_layer(
    otx_run *run, const char *path, const char *layer, otx_picture *out);

#endif

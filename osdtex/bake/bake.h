/* bake.h -- a mapping evaluated into textures of the cage.
 *
 * Block by block, in the order of the file that they go to, so that a texture
 * is never in memory as a whole: what is kept is some rows of blocks and the
 * lists of what is in them. See docs/notes/bake.md. */
#ifndef OTX_BAKE_BAKE_H
#define OTX_BAKE_BAKE_H

#include "bake/texel.h"

enum
{
    OTX_BAKE_SLOTS = 128 /* blocks that are taken and not yet put, at most */
};

/* A block of a level; y counts from the top, rows of pixels from the bottom. */
typedef struct otx_bake_block
{
    int32_t level, x, y;
    int32_t width, height; /* texels, OTX_MIP_BLOCK but at the right and lower
                            * rim */
    const float *pixels;   /* the lower left texel */
    ptrdiff_t stride;      /* floats from a row to the one above */
    /* Of the maps that are baked with the colour, each by itself: the lower
     * left texel, values as files have them; NULL where there is none. */
    const float *maps[OTX_COMPANION_COUNT];
    ptrdiff_t map_strides[OTX_COMPANION_COUNT];
} otx_bake_block;

/* Where the blocks go.
 *
 *   take  gets a block as soon as it is made, on the thread that made it:
 *         what can be done to blocks side by side. `slot` is its number until
 *         it is put, `lane` the thread's. The pixels are gone afterwards.
 *   put   gets the slots in file order, one at a time: levels from 0 up, rows
 *         from the top. On any thread, beside the blocks that are made. */
typedef struct otx_bake_sink
{
    void (*take)(
        void *user, int32_t slot, int32_t lane, const otx_bake_block *block);
    otx_status (*put)(
        void *user, int32_t slot, int32_t level, int32_t x, int32_t y);
    void *user;
    bool put_by_caller;  /* put is called by the thread that bakes, while the
                          * others wait */
    int32_t first_level; /* that it gets */
    int32_t level_count; /* and how many; 0: all that there are */
    /* What the tile is of all that is made: progress goes from `begin` on by
     * `share`. */
    double begin, share;
} otx_bake_sink;

typedef struct otx_bake_options
{
    otx_texel_kind kind;
    /* Texels of level 0 across which patches are blended where they meet, half
     * of them on either side; 0: not at all. */
    double seam_blend;
    uint32_t maps;       /* also those of the materials, with the colour: of
                          * these kinds, as bits 1 << kind */
    bool maps_alone;     /* and not the colour itself */
    bool normals_y_down; /* written as DirectX has them */
} otx_bake_options;

typedef struct otx_bake
{
    otx_texel_source source;
    otx_map_source maps; /* which `source` is not moved apart from */
    double seam_blend;
    bool maps_alone; /* blocks have no pixels of their own */
} otx_bake;

/* Prepares a bake, in run->arena; borrows all. It may not be moved. MEMORY. */
otx_status otx_bake_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, const otx_bake_options *options, otx_bake *out);

/* How many blocks are: with maps fewer, so that all maps together take what the
 * colour does alone. */
int32_t otx_bake_slots(const otx_bake *bake);

/* Bakes the layout's tile number `tile` (its index), each level by itself. The
 * same bits for any number of threads. CANCELLED, MEMORY, what the sink
 * returns. */
otx_status otx_bake_tile(
    otx_run *run, const otx_bake *bake, int32_t tile,
    const otx_bake_sink *sink);

/* Puts a block into a picture of its level. */
void otx_bake_copy(const otx_bake_block *block, const otx_image *image);

/* The same block of one of the maps that are baked with the colour; of -1 the
 * block itself. */
static inline otx_bake_block
otx_bake_block_of(const otx_bake_block *block, int32_t map)
{
    otx_bake_block result = *block;

    if (map < 0)
        return result;
    result.pixels = block->maps[map];
    result.stride = block->map_strides[map];
    return result;
}

/* "color", "patch", "uv", "stretch", "seam", "source", "slice". */
const char *otx_bake_kind_name(otx_texel_kind kind);

#endif

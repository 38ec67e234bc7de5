/* stack.h -- pictures along a material axis, [Ray09, §1].
 *
 * Between two pictures that tile lie slices whose features go from those of the
 * one to those of the other: masks by stack/morph.h, then both pictures remade
 * under every mask (stack/slices.h) and mixed. Several pictures make a row of
 * such stretches. See docs/notes/stack.md. */
#ifndef OTX_STACK_STACK_H
#define OTX_STACK_STACK_H

#include "exemplar/exemplar.h"
#include "stack/morph.h"

/* A picture along the row. */
typedef struct otx_stack_key
{
    /* Tiles in both axes. Its maps, of all keys the same, are of the picture's
     * size. */
    const otx_exemplar *exemplar;
    const uint8_t *mask; /* [height * width] of its feature */
} otx_stack_key;

/* What a slice shows: a mixture of two keys, texel by texel. */
typedef struct otx_stack_slice
{
    double position;     /* along the axis, 0 to 1 */
    int32_t keys[2];     /* that it lies between */
    double weight;       /* of the second */
    const uint8_t *mask; /* [height * width] */
    /* [height * width] the texel of each that is shown; NULL where it has no
     * weight. */
    const int32_t *texels[2];
    otx_image linear; /* of the keys' channels */
    otx_image maps;   /* as the keys' companions; no pixels: there are none */
} otx_stack_slice;

typedef struct otx_stack_options
{
    int32_t slices; /* of a stretch, with both ends */
    otx_morph_kind morph;
    uint64_t seed;
} otx_stack_options;

typedef struct otx_stack
{
    int32_t width, height;
    int32_t count; /* (keys - 1) * (slices - 1) + 1 */
    otx_stack_slice *slices;
    otx_morph *morphs; /* [keys - 1]; NULL of one key */
} otx_stack;

/* In run->arena. Keys are of one size and have the same channels. ARGUMENT,
 * FORMAT (other sizes, an empty or full mask), CANCELLED, MEMORY. */
otx_status otx_stack_make(
    otx_run *run, const otx_stack_key *keys, int32_t key_count,
    const otx_stack_options *options, otx_stack *out);

/* options->slices pictures of one key, which all have its mask and otherwise
 * nothing in the same place: to hide the period of a tile. CANCELLED, MEMORY.
 */
otx_status otx_stack_vary(
    otx_run *run, const otx_stack_key *key, const otx_stack_options *options,
    otx_stack *out);

#endif

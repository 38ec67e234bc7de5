/* map_source.h -- the maps of materials as what a bake evaluates. */
#ifndef OTX_BAKE_MAP_SOURCE_H
#define OTX_BAKE_MAP_SOURCE_H

#include "bake/texel_source.h"
#include "mapping/map_textures.h"

/* What is baked of all exemplars, besides their colours. */
typedef struct otx_map_source
{
    otx_texel_source texels; /* channels 0: no exemplar has a map */
    otx_carry carry;         /* that `texels` points to */
    /* First channel of a kind's values; -1: no exemplar has it. */
    int32_t first[OTX_COMPANION_COUNT];
    bool y_down; /* normals are written as DirectX has them */
    /* Heights by themselves, for what looks up nothing else. */
    otx_texture heights[OTX_EXEMPLARS_MAX];
    otx_carry height_carry;
} otx_map_source;

/* Prepares the maps that any of the exemplars has, in run->arena: where another
 * has none, it is flat and neutral. Borrows all; `out` may not be moved.
 * MEMORY.
 *
 *   kinds  of maps, as bits 1 << kind */
otx_status otx_map_source_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, uint32_t kinds, bool y_down, otx_map_source *out);

/* Whether there are heights, which both sides of a rim must agree on. */
static inline bool
otx_map_source_welds(const otx_map_source *source)
{
    return source->first[OTX_COMPANION_HEIGHT] >= 0;
}

/* Values of a texel as files have them: normals of length 1, (n + 1) / 2. */
void otx_map_source_encode(const otx_map_source *source, float *values);

#endif

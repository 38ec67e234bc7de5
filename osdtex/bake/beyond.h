/* beyond.h -- the facets around one, unfolded into its plane.
 *
 * A walk (walk.h) from a facet over its sides is the same affine map for every
 * texel that it leads to the same facet. So facets are unfolded once, as far as
 * texels have been asked for, and what is known of a facet (mip_facet.h) is
 * known of them. What is found does not depend on what was asked before. */
#ifndef OTX_BAKE_BEYOND_H
#define OTX_BAKE_BEYOND_H

#include "bake/mip_facet.h"

enum
{
    OTX_BEYOND_ROOTS = 128, /* facets that walks begin at; a power of two */
    OTX_BEYOND_NODES = 1024 /* facets that are kept, all roots together */
};

typedef struct otx_beyond_node
{
    otx_mip_facet placed;
    int32_t next[3]; /* across its sides; 0 not looked for, -1 none */
} otx_beyond_node;

typedef struct otx_beyond
{
    otx_beyond_node *nodes; /* [OTX_BEYOND_NODES], of which 0 is none */
    int32_t count;
    int32_t roots[OTX_BEYOND_ROOTS]; /* by hash of the facet; 0 none */
} otx_beyond;

/* What the facets are asked for. */
typedef struct otx_beyond_scene
{
    const otx_texel_source *source, *maps;
    int32_t n; /* samples to a texel's side */
} otx_beyond_scene;

/* Nothing unfolded. False when memory is out. */
bool otx_beyond_begin(otx_arena *scratch, otx_beyond *out);

/* The facet that a texel position lies in, beyond `root` as it goes on; NULL
 * where the surface ends on the way, or `steps` do not lead there. Holds until
 * the next call. */
const otx_mip_facet *otx_beyond_find(
    otx_beyond *beyond, const otx_beyond_scene *scene,
    const otx_mip_facet *root, otx_vec2 texel, int32_t steps);

#endif

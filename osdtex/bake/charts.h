/* charts.h -- texture coordinates that a painter can use: few islands, which
 * lie flat and hang together. */
#ifndef OTX_BAKE_CHARTS_H
#define OTX_BAKE_CHARTS_H

#include "bake/atlas.h"

/* As otx_atlas_pack, with charts instead of blocks; corners of a chart that are
 * one vertex are one coordinate. Holes have no place: their coordinates are
 * (0, 0). Notes how many charts there are, how much of the tiles they use, and
 * their stretch. */
otx_status otx_charts_make(
    otx_run *run, const otx_surface *surface, const otx_atlas_options *options,
    otx_atlas *out);

#endif

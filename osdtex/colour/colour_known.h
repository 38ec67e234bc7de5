/* colour_known.h -- the spaces that pipelines agree upon, however they are
 * called. For the files of colour only. */
#ifndef OTX_COLOUR_COLOUR_KNOWN_H
#define OTX_COLOUR_COLOUR_KNOWN_H

#include "colour/colour.h"
#include "colour/primaries.h"

/* The space that a file's tag names: as it is, else by another name of the
 * same space. NULL where the configuration has none. */
const char *otx_colour_known_tagged(const otx_colour *colour, const char *tag);

/* The well-known linear space of this colorInteropID, by its usual names, else
 * by its primaries; NULL where the configuration has none. */
const char *otx_colour_known_by_id(const otx_colour *colour, const char *id);

/* The matrix from ACES2065-1 to a linear space, measured; false where it is not
 * linear or there is nothing to measure by. */
bool otx_colour_from_aces(
    const otx_colour *colour, const char *space,
    otx_primaries_matrix *from_aces);

/* The first linear space that is found by one of its usual names. */
const char *otx_colour_known_linear(const otx_colour *colour);

/* The space of linear light that the configuration works in: role
 * scene_linear, else a well-known linear space, else NULL. */
const char *otx_colour_scene_linear(const otx_colour *colour);

/* The linear space of these primaries and white, whatever its name. */
const char *
otx_colour_known_by_chromaticities(const otx_colour *colour, const float xy[8]);

#endif

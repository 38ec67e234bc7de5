/* data_maps.h -- the maps of a material besides its colour, as the texts that
 * describe a look name them.
 *
 * File names relative to the text; they may hold <UDIM>. NULL: there is none.
 * All hold numbers, not colours. */
#ifndef OTX_FILE_DATA_MAPS_H
#define OTX_FILE_DATA_MAPS_H

#include <stdbool.h>

typedef struct otx_data_maps
{
    const char *normal; /* (n + 1) / 2 in the tangent space, y up */
    bool normal_y_down; /* or down */
    const char *roughness;
    const char *metalness;
    const char *height; /* scene units along the normal */
    const char *occlusion;
} otx_data_maps;

#endif

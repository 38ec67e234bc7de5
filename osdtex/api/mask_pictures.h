/* mask_pictures.h -- a mask that is one picture, or one for each UDIM tile. */
#ifndef OTX_API_MASK_PICTURES_H
#define OTX_API_MASK_PICTURES_H

#include "image/image.h"
#include "surface/surface.h"

/* Writes what a mask asks for into `demand`, as otx_demand_picture. One picture
 * at a time is in memory.
 *
 *   path   of the picture; with a token of file/udim_name.h, of those of the
 *          tiles that the cage's UVs lie in
 *   count  of exemplars
 *
 * ARGUMENT, IO (with the tile that has no picture), FORMAT, LIMIT, NUMERIC,
 * SUPPORT, MEMORY. */
otx_status otx_mask_pictures_take(
    otx_run *run, const otx_surface *surface, const char *path, int32_t count,
    uint8_t *demand);

/* What a picture of numbers, or of those of the tiles, says at the vertices:
 * the mean of otx_demand_values, 0 where it says nothing. [leaf vert_count]. As
 * otx_mask_pictures_take. */
otx_status otx_mask_pictures_values(
    otx_run *run, const otx_surface *surface, const char *path, double *values);

/* otx_mask_pictures_take by a picture in memory, of 3 or 4 channels. ARGUMENT,
 * MEMORY. */
otx_status otx_mask_pictures_take_image(
    otx_run *run, const otx_surface *surface, const otx_image *image,
    int32_t count, uint8_t *demand);

#endif

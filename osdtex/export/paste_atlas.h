/* paste_atlas.h -- the pictures of pastes side by side, cut out by alpha.
 *
 * The texels of a cell are those of the exemplar, so that a lookup in between
 * is the same as there. The rim of a cell is transparent at every mip level at
 * which the cell is larger than 2 x 2 [Praun00, sec. 4]. */
#ifndef OTX_EXPORT_PASTE_ATLAS_H
#define OTX_EXPORT_PASTE_ATLAS_H

#include "export/paste_list.h"
#include "image/pyramid.h"

typedef struct otx_paste_atlas
{
    const otx_paste_list *list;
    int32_t width, height; /* texels */
    int32_t *places;       /* [cell_count * 2] x, y of the cells */
    int32_t *sides;        /* [cell_count * 2] what they take there */
    int32_t *units;        /* [cell_count] all of these are multiples of it: a
                            * power of two, 3 or 4 of which are the longer side */
} otx_paste_atlas;

/* Finds room for all cells, in run->scratch. LIMIT, MEMORY. */
otx_status otx_paste_atlas_pack(
    otx_run *run, const otx_paste_list *list, otx_paste_atlas *out);

/* R, G, B multiplied by alpha, and alpha: all mip levels in run->scratch.
 * MEMORY, CANCELLED. */
otx_status otx_paste_atlas_fill(
    otx_run *run, const otx_paste_atlas *atlas, otx_pyramid *out);

/* The maps of the exemplar's material on the same atlas, in run->scratch. Not
 * cut out: the colour's alpha says where they are. MEMORY, CANCELLED. */
otx_status otx_paste_atlas_maps(
    otx_run *run, const otx_paste_atlas *atlas, otx_companions *out);

/* UV of corner k of a face above the first layer. */
static inline otx_vec2
otx_paste_atlas_uv(
    const otx_paste_atlas *atlas, const otx_paste_face *face, int32_t k)
{
    const otx_vec2 at = otx_paste_list_at(atlas->list, face, k);
    const int32_t *place = atlas->places + 2 * (size_t)face->cell;

    return (otx_vec2){
        (at.x + place[0]) / atlas->width, (at.y + place[1]) / atlas->height};
}

#endif

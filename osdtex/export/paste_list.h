/* paste_list.h -- pastes as layers of faces, for receivers that lay them over
 * one another themselves [Praun00, sec. 4].
 *
 * The first layer is opaque and looks up the exemplar; faces of the others look
 * up cells: pieces of the exemplar, each cut out as one fragment is. Fragments
 * of one outline at one place of the exemplar share a cell. */
#ifndef OTX_EXPORT_PASTE_LIST_H
#define OTX_EXPORT_PASTE_LIST_H

#include "exemplar/exemplar.h"
#include "mapping/mapping.h"

/* A piece of the exemplar: texels of its linear picture, which it may leave. */
typedef struct otx_paste_cell
{
    int32_t fragment; /* that cuts it out */
    int32_t x, y;     /* the lower left of what its faces look up */
    int32_t width, height;
    bool fades; /* by the weights of its faces, which it does not share */
} otx_paste_cell;

typedef struct otx_paste_face
{
    int32_t face;             /* of the leaf level */
    int32_t cell;             /* -1: the exemplar */
    const otx_lookup *lookup; /* at its corners; NULL: the face's own UVs */
} otx_paste_face;

typedef struct otx_paste_list
{
    const otx_mapping *mapping;
    const otx_exemplar *exemplar;
    int32_t layer_count;
    int32_t *layer_first;  /* [layer_count + 1] into faces */
    otx_paste_face *faces; /* layer by layer, bottom first; in a layer in the
                            * order of the leaf level */
    int32_t corner_count;  /* of all of them */
    int32_t cell_count;
    otx_paste_cell *cells;
    int32_t *shift; /* [fragment_count * 2] texels from the cell of a fragment
                     * to where the fragment is */
} otx_paste_list;

/* Made in run->scratch. Of a mapping whose lookups lie over one another, of one
 * exemplar. LIMIT (more faces or a larger piece than files take), MEMORY. */
otx_status otx_paste_list_make(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    otx_paste_list *out);

/* Where corner k of a face is in its cell, texels from the cell's corner. */
otx_vec2 otx_paste_list_at(
    const otx_paste_list *list, const otx_paste_face *face, int32_t k);

#endif

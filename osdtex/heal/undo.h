/* undo.h -- sections that mending has not helped, as they were cut. */
#ifndef OTX_HEAL_UNDO_H
#define OTX_HEAL_UNDO_H

#include "territory/target.h"

/* What charts have made, and where they are to make it again. */
typedef struct otx_undo
{
    uint8_t **again;           /* [territory.count] 1: near what is undone */
    uint8_t **kinds;           /* [territory.count] as they were */
    otx_synth_match **matches; /* likewise */
} otx_undo;

/* Keeps what the charts of the exemplar at hand have made; in run->scratch.
 *
 *   undone  [leaf edge_count] 1: not to be mended
 *   reach   texels from there that are made again
 *
 * MEMORY. */
otx_status otx_undo_keep(
    const otx_target_set *set, const uint8_t *undone, double reach,
    otx_undo *out);

/* After targets are filled without what is undone: what was made is put back,
 * and what is not near it stays so. */
void otx_undo_freeze(otx_target_set *set, const otx_undo *kept);

/* After they are made again: what stayed counts as made, too. */
void otx_undo_thaw(otx_target_set *set, const otx_undo *kept);

#endif

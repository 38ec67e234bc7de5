/* window_map.h -- how far what each face shows is from the exemplar.
 *
 * The judge of --heal auto, face by face, over what the exemplar's own windows
 * are from the rest of it: at 1 a place is as odd as the exemplar is. */
#ifndef OTX_HEAL_WINDOW_MAP_H
#define OTX_HEAL_WINDOW_MAP_H

#include "mapping/mapping.h"
#include "mapping/source.h"

typedef struct otx_window_map
{
    float *faces;       /* [leaf face_count] ratio; -1: nothing to judge */
    double mean;        /* over all windows... */
    double share_above; /* ... and the share of them above 1 */
} otx_window_map;

/* Of a finished mapping, as its field shows it if it has one; in run->arena.
 * CANCELLED, MEMORY. */
otx_status otx_window_map_make(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_window_map *out);

#endif

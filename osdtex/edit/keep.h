/* keep.h -- a mapping kept through a change of the cage.
 *
 * Leaves whose shape has hardly changed keep patch and UVs to the bit; others
 * keep their patch and are relaxed between them; where that would stretch the
 * texture too far it is covered anew. */
#ifndef OTX_EDIT_KEEP_H
#define OTX_EDIT_KEEP_H

#include "method/method.h"

typedef struct otx_keep
{
    /* Its surface is the changed one; scale, exemplars and settings are those
     * of the mapping. */
    const otx_job *job;
    const otx_method *method; /* that made the mapping */
    const otx_mapping *from;  /* of the same leaf faces */
    const float *points;      /* [leaf vert_count * 3] as it was made for */
    /* [leaf face_count] how many corners of a face lie beyond its patch, where
     * it shows what it did not: it may move though its shape has not changed.
     * NULL: of none. */
    const uint8_t *loose;
} otx_keep;

/* Leaf faces by what became of them. */
typedef struct otx_keep_tally
{
    int32_t held;    /* as they were */
    int32_t moved;   /* relaxed */
    int32_t covered; /* anew, with what lies around them */
    double texels;   /* share of the area that shows what it did, within one */
} otx_keep_tally;

/* Makes the mapping, in run->arena. What was made by texels and a lattice are
 * not carried over. SUPPORT for a mapping that cannot be made anew in part; as
 * otx_refit_run. */
otx_status
otx_keep_run(const otx_keep *keep, otx_mapping *out, otx_keep_tally *tally);

/* What may become of each face, OTX_REFIT_..., into `state` ([leaf
 * face_count]). MEMORY. */
otx_status otx_keep_states(const otx_keep *keep, uint8_t *state);

#endif

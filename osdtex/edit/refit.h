/* refit.h -- part of a mapping made anew, all else left as it is to the bit.
 *
 * What edits come to: some faces are covered anew by a method that continues
 * what is around them, some are only moved, and the others, with a ring of them
 * around the part, are given to the method and held. The work is done on a
 * surface of the part and its ring, so that it costs what the part does. */
#ifndef OTX_EDIT_REFIT_H
#define OTX_EDIT_REFIT_H

#include "method/method.h"

/* What may become of a leaf face. */
enum
{
    OTX_REFIT_HELD = 0, /* as it is */
    OTX_REFIT_FREE = 1, /* keeps its patch unless another fits better; moves */
    OTX_REFIT_EITHER =
        2,             /* covered anew, or as it was where that fits better */
    OTX_REFIT_OPEN = 3 /* covered anew */
};

typedef struct otx_refit
{
    /* Its surface is the whole one, with the density that is wanted; of the
     * request scale, guide and demand are read, the latter two of the whole
     * surface. Settings are those of `method`. */
    const otx_job *job;
    const otx_method *method; /* that fills; NULL: the first that can, with its
                               * defaults */
    const otx_mapping *from;  /* of the same leaf faces */
    const uint8_t *state;     /* [leaf face_count] OTX_REFIT_... */
    int32_t avoid;            /* as otx_patch_given.avoid */
} otx_refit;

/* Makes the mapping, in run->arena: UVs and patches; guide and density are the
 * job's. A patch that has lost all of its faces gives its number to a new one;
 * the others keep theirs. Lookups and fields by texels are not carried over.
 *
 * As method->fill; SUPPORT where none can. */
otx_status otx_refit_run(const otx_refit *refit, otx_mapping *out);

#endif

/* icc_profile.h -- an ICC profile out of a picture file, as what it means: CIE
 * XYZ for each texel.
 *
 * Little CMS does the work. A profile comes from a file of somebody else, so
 * its header and its table of tags are checked here before it is handed over.
 * See docs/notes/colour.md for why not OpenColorIO. */
#ifndef OTX_COLOUR_ICC_PROFILE_H
#define OTX_COLOUR_ICC_PROFILE_H

#include "base/run.h"

enum
{
    OTX_ICC_NAME_BYTES = 80,
    OTX_ICC_REASON_BYTES = 160
};

typedef struct otx_icc_profile otx_icc_profile;

/* Opens the profile in `bytes`, for a picture of grey or of R, G, B. Where it
 * cannot be applied `*out` is NULL and `reason` says why, in words that go on
 * after "the profile". `name` is what the profile calls itself, "" unknown; it
 * holds printable ASCII only. Lives in run->arena. MEMORY. */
otx_status otx_icc_profile_open(
    otx_run *run, const uint8_t *bytes, size_t size, bool is_gray,
    otx_icc_profile **out, char name[OTX_ICC_NAME_BYTES],
    char reason[OTX_ICC_REASON_BYTES]);

/* R, G, B as encoded to XYZ under D50, white at Y = 1, in place (relative
 * colorimetric). A grey profile looks at R. Several threads may do so at once.
 * Values outside [0, 1] are not clipped where the profile is a matrix. */
void otx_icc_profile_to_xyz(
    const otx_icc_profile *profile, float *texels, int32_t count);

#endif

/* uv_choice.h -- onto which texture coordinates a bake goes, and why. */
#ifndef OTX_BAKE_UV_CHOICE_H
#define OTX_BAKE_UV_CHOICE_H

#include "bake/uv_survey.h"

typedef enum otx_layout_source
{
    OTX_LAYOUT_AUTO, /* the cage's UVs where they can be baked onto */
    OTX_LAYOUT_OWN,
    OTX_LAYOUT_ATLAS,
    OTX_LAYOUT_CHARTS
} otx_layout_source;

/* Replaces OTX_LAYOUT_AUTO by what it comes to: the cage's own UVs, or an atlas
 * where it has none that can be baked onto, for a reason that is said in one
 * finding.
 *
 * Own UVs that are asked for are refused where no texture can come of them:
 * they leave the UDIM tiles, have no area, or were never laid out apart
 * (TOPOLOGY); the cage has none (ARGUMENT). Faces that lie on others and faces
 * without area are said, once, where they are baked onto all the same.
 *
 *   draft   the cage (draft.h), or the surface itself
 *   survey  what was seen; zeros where the cage has no UVs */
otx_status otx_uv_choose(
    otx_run *run, const otx_surface *draft, otx_layout_source asked,
    otx_layout_source *out, otx_uv_survey *survey);

#endif

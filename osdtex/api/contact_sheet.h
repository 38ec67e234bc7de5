/* contact_sheet.h -- all that is asked of a mapping first, in one picture. */
#ifndef OTX_API_CONTACT_SHEET_H
#define OTX_API_CONTACT_SHEET_H

#include "api/handle.h"

/* What `show` calls it. */
#define OTX_CONTACT_SHEET "sheet"

/* Draws one picture, in run->arena. */
typedef otx_status otx_contact_draw(
    otx_run *run, const osdtex_model *model,
    const osdtex_render_options *options, otx_image *out);

/* Texture, patches, seams and stretch above field and the three worst seams,
 * four by two to the picture that `options` ask for, each with its name. What
 * the model has not is shown as clay: a field; or left empty: seams.
 *
 * ARGUMENT for a picture too small to part, and what `draw` fails of. */
otx_status otx_contact_sheet_make(
    otx_run *run, const osdtex_model *model,
    const osdtex_render_options *options, otx_contact_draw *draw,
    otx_image *out);

#endif

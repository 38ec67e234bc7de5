/* receiver.h -- for which program textures are written, and what that settles:
 * their colour space and their file type.
 *
 * What each program takes a texture to be by its own defaults is in
 * docs/pipeline.md, with what was run and what was read. */
#ifndef OTX_COLOUR_RECEIVER_H
#define OTX_COLOUR_RECEIVER_H

#include "colour/colour.h"

/* The values of osdtex_receiver. */
typedef enum otx_receiver
{
    OTX_RECEIVER_ANY, /* nobody in particular */
    OTX_RECEIVER_BLENDER,
    OTX_RECEIVER_MAYA,
    OTX_RECEIVER_HOUDINI,
    OTX_RECEIVER_USD, /* UsdPreviewSurface, without a configuration */
    OTX_RECEIVER_WEB, /* three.js and the like: 8-bit sRGB */
    OTX_RECEIVER_COUNT
} otx_receiver;

/* What is written for a receiver. */
typedef struct otx_receiver_choice
{
    const char *space; /* of the pixels as they are held: linear, unless `to`
                        * said otherwise */
    bool as_png;       /* files are 8-bit PNG, with the sRGB curve on `space`,
                        * which is linear Rec.709 then; else EXR in `space` */
} otx_receiver_choice;

/* "blender", "maya", "houdini", "usd", "web"; NULL for nobody and others. */
const char *otx_receiver_name(otx_receiver receiver);

/* Resolves the output space: `to` (which wins, and means an EXR), else what the
 * receiver takes by default, else otx_colour_resolve_linear. Says it in one
 * finding. COLOUR. */
otx_status otx_receiver_resolve(
    otx_run *run, const otx_colour *colour, otx_receiver receiver,
    const char *to, otx_receiver_choice *out);

#endif

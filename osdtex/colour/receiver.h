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

/* The values of osdtex_texture_type: which files textures are. */
typedef enum otx_texture_type
{
    OTX_TEXTURE_ANY, /* what the receiver takes */
    OTX_TEXTURE_EXR,
    OTX_TEXTURE_PNG,  /* 8 bits */
    OTX_TEXTURE_TIFF, /* 16 bits */
    OTX_TEXTURE_JPEG, /* 8 bits, no alpha */
    OTX_TEXTURE_COUNT
} otx_texture_type;

/* What is written for a receiver. */
typedef struct otx_receiver_choice
{
    const char *space; /* of the pixels as they are held: linear, unless `to`
                        * said otherwise */
    otx_texture_type type; /* EXR is in `space`; all others have the sRGB curve
                            * on it, which is linear Rec.709 then */
} otx_receiver_choice;

/* "blender", "maya", "houdini", "usd", "web"; NULL for nobody and others. */
const char *otx_receiver_name(otx_receiver receiver);

/* Resolves the output space: `to` (which wins, and means an EXR), else what the
 * receiver takes by default, else otx_colour_resolve_linear. A `type` of
 * integers is sRGB for all of them, and `to` is not asked then. Says it in one
 * finding. ARGUMENT (`to` and such a type), COLOUR. */
otx_status otx_receiver_resolve(
    otx_run *run, const otx_colour *colour, otx_receiver receiver,
    const char *to, otx_texture_type type, otx_receiver_choice *out);

#endif

/* receiver.c -- one row for each program. */
#include "colour/receiver.h"

#include "colour/colour_known.h"

#include <stddef.h>

static const char stage[] = "colour";

typedef struct row
{
    const char *name;
    const char *interop_id; /* of the space that it takes an EXR to be in */
    bool reads_environment; /* it works by $OCIO too, where that is set */
    const char *advice;     /* ends the sentence on the output space */
} row;

static const row rows[OTX_RECEIVER_COUNT] = {
    [OTX_RECEIVER_BLENDER] =
        {"blender", "lin_rec709_scene", true,
         ", which Blender takes an EXR to be in"},
    [OTX_RECEIVER_MAYA] =
        {"maya", "lin_ap1_scene", true,
         "; Maya's rule for EXR, Raw, shows it right while the rendering space "
         "is ACEScg, its default"},
    [OTX_RECEIVER_HOUDINI] =
        {"houdini", "lin_rec709_scene", true,
         ", scene_linear of Houdini's own configuration"},
    [OTX_RECEIVER_USD] =
        {"usd", "lin_rec709_scene", false,
         ", which UsdPreviewSurface takes raw numbers to be in"},
    [OTX_RECEIVER_WEB] =
        {"web", "lin_rec709_scene", false,
         "; textures are 8-bit sRGB PNG, which web viewers expect"},
};

const char *
otx_receiver_name(otx_receiver receiver)
{
    return (unsigned)receiver < OTX_RECEIVER_COUNT ? rows[receiver].name : NULL;
}

/* The receiver's own space by its usual names in the configuration. */
static otx_status
own_space(
    otx_run *run, const otx_colour *colour, const row *r, const char **space)
{
    *space = otx_colour_known_by_id(colour, r->interop_id);
    if (*space)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(colour->path),
        "{for} %s: the configuration has no space '%s'; say {to} to "
        "name one",
        r->name, r->interop_id);
}

/* Files of integers: programs take them to be sRGB, whoever reads them. */
static otx_status
resolve_integers(
    otx_run *run, const otx_colour *colour, const char *to,
    otx_texture_type type, otx_receiver_choice *out)
{
    static const char *const names[OTX_TEXTURE_COUNT] = {
        [OTX_TEXTURE_PNG] = "8-bit PNG",
        [OTX_TEXTURE_TIFF] = "16-bit TIFF",
        [OTX_TEXTURE_JPEG] = "JPEG"};

    if (to && to[0])
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, stage, OTX_NOWHERE,
            "textures of integers are sRGB, so {to} has no say; leave it out, "
            "or write EXR");
    out->space = otx_colour_known_by_id(colour, "lin_rec709_scene");
    if (!out->space)
        return otx_fail(
            run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(colour->path),
            "the configuration has no linear Rec.709, which textures of "
            "integers are made in; write EXR");
    out->type = type;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, OTX_NOWHERE,
        "output space: sRGB, as %s textures are read", names[type]);
    return OSDTEX_OK;
}

otx_status
otx_receiver_resolve(
    otx_run *run, const otx_colour *colour, otx_receiver receiver,
    const char *to, otx_texture_type type, otx_receiver_choice *out)
{
    const row *r = &rows[receiver];
    const bool own = receiver != OTX_RECEIVER_ANY && !(to && to[0]);

    *out = (otx_receiver_choice){.type = OTX_TEXTURE_EXR};
    if (type > OTX_TEXTURE_EXR)
        return resolve_integers(run, colour, to, type, out);
    /* A program that works by $OCIO has the same scene_linear as we. */
    if (!own || (r->reads_environment && colour->is_from_environment))
        return otx_colour_resolve_linear(run, colour, to, &out->space);
    OTX_TRY(own_space(run, colour, r, &out->space));
    if (receiver == OTX_RECEIVER_WEB && type == OTX_TEXTURE_ANY)
        out->type = OTX_TEXTURE_PNG;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, OTX_NOWHERE,
        "output space: '%s' ({for} %s)%s", out->space, r->name,
        type == OTX_TEXTURE_EXR && receiver == OTX_RECEIVER_WEB ? ""
                                                                : r->advice);
    return OSDTEX_OK;
}

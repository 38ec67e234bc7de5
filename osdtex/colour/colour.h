/* colour.h -- which colour space is what, and by which rule.
 *
 * Every decision is made here, by a stated rule, and said in one finding of
 * stage "colour": nothing is guessed in silence. See docs/notes/colour.md. */
#ifndef OTX_COLOUR_COLOUR_H
#define OTX_COLOUR_COLOUR_H

#include "bridge/ocio.h"
#include "image/image.h"

/* A colour configuration in use; lives in the arena of the run that opened
 * it. */
typedef struct otx_colour
{
    const otx_ocio *config;
    const char *path;         /* of the file; NULL for the one built in */
    bool is_from_environment; /* `path` is that of $OCIO */
} otx_colour;

/* Opens the configuration `path` (--colorconfig), else `environment` (the
 * value of $OCIO), else the one built in; NULL and "" mean not given. */
otx_status otx_colour_open(
    otx_run *run, const char *path, const char *environment, otx_colour *out);

/* The proper name of the space called `name`. When there is none: COLOUR, and
 * a sentence that opens with `what` ("--from") and lists near names. */
otx_status otx_colour_find(
    otx_run *run, const otx_colour *colour, const char *what, const char *name,
    const char **space);

/* How the numbers of a file are decoded, see decoder.h. */
struct otx_decoder;

/* What is known about the colours of a file. Strings may be NULL. */
typedef struct otx_colour_source
{
    const char *path;       /* for the file rules and the findings */
    const char *from;       /* the user's word (--from) */
    const char *interop_id; /* EXR attribute colorInteropID */
    const char *oiio_space; /* EXR attribute oiio:ColorSpace */
    bool has_chromaticities;
    bool is_float;           /* half or float samples */
    float chromaticities[8]; /* R, G, B, W xy pairs */
    /* Of PNG, TIFF and JPEG. */
    const uint8_t *icc; /* [icc_bytes], NULL none; not looked at yet */
    size_t icc_bytes;
    const char *icc_fault; /* why there is none though the file has one */
    float gamma;           /* the encoding exponent, 0 not stated */
    bool says_srgb;
    bool says_adobe_rgb;
    bool is_gray;
} otx_colour_source;

/* The colour space of a file: --from, else colorInteropID, else
 * oiio:ColorSpace, else ICC profile, Exif, gamma or chromaticities, else a file
 * rule that is not the Default rule, else sRGB for integers and scene_linear
 * for floats. A rule that finds data beats a profile.
 *
 *   decoder  NULL where `*space` is the space of the file's numbers; else what
 *            brings them there first. In run->arena. May be NULL: then
 *            nothing that needs one is looked at. */
otx_status otx_colour_resolve(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char **space, const struct otx_decoder **decoder);

/* The space that pixels are written in: `to`, else otx_colour_scene_linear.
 * The finding also says what a reader of the pixels must be told. */
otx_status otx_colour_resolve_linear(
    otx_run *run, const otx_colour *colour, const char *to, const char **space);

/* The display-like space in which colours are compared: `match_space`, else
 * role color_picking, else sRGB. NULL when the configuration has none; then
 * the sRGB curve is put on the linear picture. `*is_linear` says that the
 * space needs that curve too. */
otx_status otx_colour_resolve_match(
    otx_run *run, const otx_colour *colour, const char *match_space,
    const char **space, bool *is_linear);

/* The sRGB-encoded space for textures and PNG pictures by its usual names;
 * NULL where the configuration has none. */
const char *otx_colour_srgb(const otx_colour *colour);

/* Whether `space` is proportional to scene light. */
bool otx_colour_is_linear(const otx_colour *colour, const char *space);

/* The primaries and white of a linear space as xy pairs R, G, B, W; false
 * where the configuration has no space of known primaries to measure by. */
bool otx_colour_chromaticities(
    const otx_colour *colour, const char *space, float xy[8]);

/* colorInteropID of a well-known space, NULL for others. */
const char *otx_colour_interop_id(const otx_colour *colour, const char *space);

/* Converts an image of 3 or 4 channels in place, over all threads. With 4,
 * colour is taken as it stands: see exemplar.h for alpha. */
otx_status otx_colour_convert(
    otx_run *run, const otx_colour *colour, const char *from, const char *to,
    otx_image *image);

#endif

/* colour_known.c -- the spaces that pipelines agree upon.
 *
 * Configurations name the same space in many ways; the names in use are in one
 * table, and what a space is, is measured by sending colours through it rather
 * than believed from its name. */
#include "colour/colour_known.h"

#include "colour/primaries.h"

#include <math.h>
#include <string.h>

enum
{
    NAMES_MAX = 8
};

/* A linear space that pipelines agree upon. */
typedef struct known_space
{
    const char *interop_id;
    float xy[8];
    const char *names[NAMES_MAX]; /* the first that is found, NULL ends */
} known_space;

static const known_space known_spaces[] = {
    {"lin_ap1_scene",
     {0.713F, 0.293F, 0.165F, 0.830F, 0.128F, 0.044F, 0.32168F, 0.33767F},
     {"lin_ap1_scene", "ACEScg", "lin_ap1", "ACES - ACEScg", "Linear ACEScg"}},
    {"lin_ap0_scene",
     {0.7347F, 0.2653F, 0.0F, 1.0F, 0.0001F, -0.0770F, 0.32168F, 0.33767F},
     {"lin_ap0_scene", "ACES2065-1", "lin_ap0", "ACES - ACES2065-1",
      "Linear ACES"}},
    {"lin_rec709_scene",
     {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F},
     {"lin_rec709_scene", "Linear Rec.709 (sRGB)", "lin_rec709", "lin_srgb",
      "lin_rec709_srgb", "Utility - Linear - sRGB", "Linear Rec.709",
      "scene-linear Rec.709-sRGB"}},
    {"lin_p3d65_scene",
     {0.680F, 0.320F, 0.265F, 0.690F, 0.150F, 0.060F, 0.3127F, 0.3290F},
     {"lin_p3d65_scene", "lin_p3d65", "Linear P3-D65",
      "Utility - Linear - P3-D65"}},
    {"lin_rec2020_scene",
     {0.708F, 0.292F, 0.170F, 0.797F, 0.131F, 0.046F, 0.3127F, 0.3290F},
     {"lin_rec2020_scene", "lin_rec2020", "Linear Rec.2020",
      "Utility - Linear - Rec.2020"}},
};

enum
{
    KNOWN_COUNT = sizeof known_spaces / sizeof known_spaces[0]
};

static const char srgb_id[] = "srgb_rec709_scene";

static const char *const srgb_names[] = {
    "srgb_rec709_scene",
    "srgb_texture",
    "srgb_tx",
    "sRGB - Texture",
    "Utility - sRGB - Texture",
    "sRGB Encoded Rec.709 (sRGB)",
    "sRGB",
    "srgb_tex",
};

/* Two matrices to ACES2065-1 that differ by less are of the same space: files
 * round chromaticities to three digits, distinct spaces differ by 0.02. */
static const double same_space = 4e-3;

static const char *
find_known(const otx_ocio *config, const known_space *known)
{
    for (int i = 0; i < NAMES_MAX && known->names[i]; ++i)
    {
        const char *space = otx_ocio_find(config, known->names[i]);
        if (space)
            return space;
    }
    return NULL;
}

static const known_space *
known_by_name(const char *name)
{
    for (int k = 0; k < KNOWN_COUNT; ++k)
        for (int i = 0; i < NAMES_MAX && known_spaces[k].names[i]; ++i)
            if (strcmp(known_spaces[k].names[i], name) == 0)
                return &known_spaces[k];
    return NULL;
}

const char *
otx_colour_srgb(const otx_colour *colour)
{
    const size_t count = sizeof srgb_names / sizeof srgb_names[0];

    for (size_t i = 0; i < count; ++i)
    {
        const char *space = otx_ocio_find(colour->config, srgb_names[i]);
        if (space)
            return space;
    }
    /* What an 8-bit picture is painted in, unless that is a grading space. */
    const char *paint = otx_ocio_role(colour->config, "texture_paint");
    if (paint &&
        strcmp(otx_ocio_encoding(colour->config, paint), "sdr-video") == 0)
        return paint;
    return NULL;
}

const char *
otx_colour_known_linear(const otx_colour *colour)
{
    for (int k = 0; k < KNOWN_COUNT; ++k)
    {
        const char *space = find_known(colour->config, &known_spaces[k]);
        if (space)
            return space;
    }
    return NULL;
}

const char *
otx_colour_known_tagged(const otx_colour *colour, const char *tag)
{
    const char *space = otx_ocio_find(colour->config, tag);
    const known_space *known = known_by_name(tag);

    if (space)
        return space;
    if (known)
        return find_known(colour->config, known);
    for (size_t i = 0; i < sizeof srgb_names / sizeof srgb_names[0]; ++i)
        if (strcmp(srgb_names[i], tag) == 0)
            return otx_colour_srgb(colour);
    return NULL;
}

/* A few colours through a conversion; false where there is none. */
static bool
send(
    const otx_colour *colour, const char *from, const char *to, float *rgb,
    int32_t count)
{
    char message[OTX_OCIO_MESSAGE_BYTES];
    otx_ocio_conversion *conversion = NULL;

    if (otx_ocio_convert(colour->config, from, to, &conversion, message) !=
        OSDTEX_OK)
        return false;

    const otx_status status =
        otx_ocio_conversion_apply(conversion, rgb, count, 3, message);

    otx_ocio_conversion_destroy(conversion);
    return status == OSDTEX_OK;
}

/* A space of known primaries to measure others by. */
static const char *
reference(const otx_colour *colour, const known_space **known)
{
    const char *space = otx_ocio_role(colour->config, "aces_interchange");

    if (space)
    {
        *known = known_by_name("lin_ap0_scene");
        return space;
    }
    for (int k = 0; k < KNOWN_COUNT; ++k)
    {
        *known = &known_spaces[k];
        space = find_known(colour->config, *known);
        if (space)
            return space;
    }
    return NULL;
}

/* Sends black, grey, two brightnesses of each primary: light is proportional
 * when twice as much in is twice as much out. Without a reference the role
 * scene_linear must do. */
bool
otx_colour_is_linear(const otx_colour *colour, const char *space)
{
    float rgb[9][3] = {
        {0.0F, 0.0F, 0.0F}, {0.2F, 0.2F, 0.2F}, {0.4F, 0.4F, 0.4F},
        {0.3F, 0.0F, 0.0F}, {0.6F, 0.0F, 0.0F}, {0.0F, 0.3F, 0.0F},
        {0.0F, 0.6F, 0.0F}, {0.0F, 0.0F, 0.3F}, {0.0F, 0.0F, 0.6F}};
    const known_space *known = NULL;
    const char *to = reference(colour, &known);

    if (!to)
        to = otx_ocio_role(colour->config, "scene_linear");
    if (otx_ocio_is_data(colour->config, space))
        return false;
    if (!to || !send(colour, space, to, rgb[0], 9))
        return strcmp(
                   otx_ocio_encoding(colour->config, space), "scene-linear") ==
               0;
    for (int k = 0; k < 3; ++k)
    {
        if (!(fabsf(rgb[0][k]) < 1e-4F))
            return false;
        for (int i = 1; i < 9; i += 2)
            if (!(fabsf(rgb[i + 1][k] - 2.0F * rgb[i][k]) < 1e-3F))
                return false;
    }
    return true;
}

/* Matrix of a linear space to ACES2065-1: its columns are where the primaries
 * go. */
static bool
measure(
    const otx_colour *colour, const char *space, otx_primaries_matrix *to_aces)
{
    float rgb[3][3] = {
        {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
    const known_space *known = NULL;
    const char *to = reference(colour, &known);
    otx_primaries_matrix columns;

    if (!to || !otx_colour_is_linear(colour, space) ||
        !send(colour, space, to, rgb[0], 3) ||
        !otx_primaries_to_aces(known->xy, to_aces))
        return false;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            columns.m[i][j] = (double)rgb[j][i];
    *to_aces = otx_primaries_multiply(*to_aces, columns);
    return true;
}

bool
otx_colour_from_aces(
    const otx_colour *colour, const char *space,
    otx_primaries_matrix *from_aces)
{
    otx_primaries_matrix to_aces;

    return measure(colour, space, &to_aces) &&
           otx_primaries_invert(to_aces, from_aces);
}

static const known_space *
known_by_matrix(const otx_primaries_matrix *to_aces)
{
    otx_primaries_matrix other;

    for (int k = 0; k < KNOWN_COUNT; ++k)
        if (otx_primaries_to_aces(known_spaces[k].xy, &other) &&
            otx_primaries_difference(*to_aces, other) < same_space)
            return &known_spaces[k];
    return NULL;
}

bool
otx_colour_chromaticities(
    const otx_colour *colour, const char *space, float xy[8])
{
    otx_primaries_matrix to_aces;

    if (!measure(colour, space, &to_aces))
        return false;

    const known_space *known = known_by_matrix(&to_aces);

    if (!known)
        return otx_primaries_from_aces(&to_aces, xy);
    memcpy(xy, known->xy, sizeof known->xy);
    return true;
}

const char *
otx_colour_interop_id(const otx_colour *colour, const char *space)
{
    otx_primaries_matrix to_aces;
    const char *srgb = otx_colour_srgb(colour);

    if (otx_ocio_is_data(colour->config, space))
        return "data";
    if (srgb && strcmp(srgb, space) == 0)
        return srgb_id;
    if (!measure(colour, space, &to_aces))
        return NULL;

    const known_space *known = known_by_matrix(&to_aces);

    return known ? known->interop_id : NULL;
}

static bool
space_matches(
    const otx_colour *colour, const char *space, otx_primaries_matrix wanted)
{
    otx_primaries_matrix to_aces;

    return measure(colour, space, &to_aces) &&
           otx_primaries_difference(to_aces, wanted) < same_space;
}

/* The well-known names first, since a configuration may hold several spaces of
 * the same primaries; then whatever says that it is scene-linear. */
const char *
otx_colour_known_by_chromaticities(const otx_colour *colour, const float xy[8])
{
    otx_primaries_matrix wanted;

    if (!otx_primaries_to_aces(xy, &wanted))
        return NULL;
    for (int k = 0; k < KNOWN_COUNT; ++k)
    {
        const char *space = find_known(colour->config, &known_spaces[k]);
        if (space && space_matches(colour, space, wanted))
            return space;
    }
    for (int32_t i = 0; i < otx_ocio_space_count(colour->config); ++i)
    {
        const char *space = otx_ocio_space_name(colour->config, i);
        const char *encoding = otx_ocio_encoding(colour->config, space);

        if (strcmp(encoding, "scene-linear") == 0 &&
            space_matches(colour, space, wanted))
            return space;
    }
    return NULL;
}

const char *
otx_colour_known_by_id(const otx_colour *colour, const char *id)
{
    const known_space *known = known_by_name(id);
    const char *space = known ? find_known(colour->config, known) : NULL;

    return space || !known
               ? space
               : otx_colour_known_by_chromaticities(colour, known->xy);
}

const char *
otx_colour_scene_linear(const otx_colour *colour)
{
    const char *space = otx_ocio_role(colour->config, "scene_linear");

    return space ? space : otx_colour_known_linear(colour);
}

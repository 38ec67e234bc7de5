/* colour_resolve.c -- the rules by which colour spaces are chosen.
 *
 * An explicit word beats a tag of the file, a tag beats a rule of the
 * configuration, a rule beats the default of the pixel type. The Default file
 * rule is no rule: in the older ACES configurations it calls every PNG
 * ACES2065-1. */
#include "colour/colour_known.h"
#include "colour/decoder.h"

#include <ctype.h>
#include <string.h>

static const char stage[] = "colour";

/* A tag of the file; one that the configuration does not know is passed over
 * with a word. */
static const char *
resolve_tag(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char *attribute, const char *tag)
{
    const char *space = NULL;

    if (!tag || !tag[0] || strcmp(tag, "unknown") == 0)
        return NULL;
    space = strcmp(tag, "data") == 0 ? otx_ocio_role(colour->config, "data")
                                     : otx_colour_known_tagged(colour, tag);
    if (!space)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, stage, otx_where_file(source->path),
            "passing over %s '%s', which the configuration does not know",
            attribute, tag);
    return space;
}

/* A space of the configuration that has the primaries of a linear file. */
static const char *
resolve_chromaticities(
    const otx_colour *colour, const otx_colour_source *source)
{
    return source->is_float && source->has_chromaticities
               ? otx_colour_known_by_chromaticities(
                     colour, source->chromaticities)
               : NULL;
}

/* Whether `name` stands in `path` between characters that are no letters or
 * digits. */
static bool
is_word_of(const char *name, const char *path)
{
    const size_t length = strlen(name);

    for (const char *at = strcasestr(path, name); at;
         at = strcasestr(at + 1, name))
        if ((at == path || !isalnum((unsigned char)at[-1])) &&
            !isalnum((unsigned char)at[length]))
            return true;
    return false;
}

/* OpenColorIO's search for names of spaces in a path is content with part of a
 * word, and finds Raw in "/drawings/brick.png". Only whole words count here. */
static bool
is_named_in_path(const otx_colour *colour, const char *space, const char *path)
{
    const char *name = NULL;

    for (int32_t i = 0; (name = otx_ocio_name(colour->config, i)) != NULL; ++i)
        if (name[0] && is_word_of(name, path) &&
            strcmp(otx_ocio_find(colour->config, name), space) == 0)
            return true;
    return false;
}

static const char *
resolve_file_rule(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char **rule)
{
    const char *space = NULL;

    if (source->path)
        space = otx_ocio_file_rule(colour->config, source->path, rule);
    if (!space || strcmp(*rule, "ColorSpaceNamePathSearch") != 0 ||
        is_named_in_path(colour, space, source->path))
        return space;
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, otx_where_file(source->path),
        "passing over the space '%s', whose name OpenColorIO sees in part of a "
        "word of the path",
        space);
    return NULL;
}

static otx_status
say_source(
    otx_run *run, const otx_colour_source *source, const char *space,
    const char *rule, const char *detail)
{
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, otx_where_file(source->path),
        "input space: '%s' (%s%s)", space, rule, detail);
    return OSDTEX_OK;
}

static otx_status
resolve_default(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char **space)
{
    *space = source->is_float ? otx_ocio_role(colour->config, "scene_linear")
                              : otx_colour_srgb(colour);
    if (*space)
        return say_source(
            run, source, *space,
            source->is_float ? "float pixels: role scene_linear"
                             : "integer pixels: sRGB",
            "");
    return otx_fail(
        run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(source->path),
        "the configuration has no %s, so the colours of this picture are "
        "unknown; say {from} to name their space",
        source->is_float ? "role scene_linear" : "space for sRGB textures");
}

/* What the file says of its encoding in other words than the name of a space.
 * `*space` NULL: nothing that is of use. */
static otx_status
resolve_encoding(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char **space, const otx_decoder **decoder)
{
    const bool says_something =
        source->icc || source->icc_fault || source->says_adobe_rgb ||
        source->gamma != 0.0F || source->has_chromaticities;
    const char *rule = NULL;

    *space = NULL;
    if (!decoder || !says_something)
        return OSDTEX_OK;
    /* Painters put the profile of their screen into every map. */
    *space =
        source->is_float ? NULL : resolve_file_rule(run, colour, source, &rule);
    if (*space && otx_ocio_is_data(colour->config, *space))
        return say_source(
            run, source, *space, "the configuration's file rule ", rule);
    *space = NULL;
    OTX_TRY(otx_decoder_create(
        run, colour, source, source->is_float && source->has_chromaticities,
        decoder));
    if (!*decoder)
        return OSDTEX_OK;
    *space = otx_decoder_space(*decoder);
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, otx_where_file(source->path),
        "input space: %s, brought to '%s'", otx_decoder_name(*decoder), *space);
    return OSDTEX_OK;
}

/* The tags of an EXR, in their order. */
static otx_status
resolve_tags(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char **space)
{
    *space =
        resolve_tag(run, colour, source, "colorInteropID", source->interop_id);
    if (*space)
        return say_source(run, source, *space, "the file's colorInteropID", "");
    *space =
        resolve_tag(run, colour, source, "oiio:ColorSpace", source->oiio_space);
    if (*space)
        return say_source(
            run, source, *space, "the file's oiio:ColorSpace", "");
    *space = resolve_chromaticities(colour, source);
    if (*space)
        return say_source(run, source, *space, "the file's chromaticities", "");
    return OSDTEX_OK;
}

otx_status
otx_colour_resolve(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const char **space, const otx_decoder **decoder)
{
    const char *rule = NULL;

    if (decoder)
        *decoder = NULL;
    if (source->from && source->from[0])
    {
        OTX_TRY(otx_colour_find(
            run, colour, OTX_OPTION_NAME("from"), source->from, space));
        return say_source(run, source, *space, OTX_OPTION_NAME("from"), "");
    }
    OTX_TRY(resolve_tags(run, colour, source, space));
    if (!*space)
        OTX_TRY(resolve_encoding(run, colour, source, space, decoder));
    if (*space)
        return OSDTEX_OK;
    *space = resolve_file_rule(run, colour, source, &rule);
    if (*space)
        return say_source(
            run, source, *space, "the configuration's file rule ", rule);
    return resolve_default(run, colour, source, space);
}

/* What whoever loads pixels of `space` must know. Programs that read OBJ, USD
 * or the web's formats take an EXR for linear Rec.709, and those that use a
 * configuration for its scene_linear. */
static const char *
advice(const otx_colour *colour, const char *space)
{
    const char *id = otx_colour_interop_id(colour, space);

    if (otx_ocio_is_data(colour->config, space))
        return "";
    if (id && strcmp(id, "lin_rec709_scene") == 0)
        return ", which readers take an EXR to be in";
    return "; tell it to readers that do not use this configuration: they take "
           "an EXR to be in linear Rec.709";
}

static otx_status
say_linear(
    otx_run *run, const otx_colour *colour, const char *space, const char *rule)
{
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, OTX_NOWHERE,
        "output space: '%s' (%s)%s", space, rule, advice(colour, space));
    if (!otx_colour_is_linear(colour, space))
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, stage, OTX_NOWHERE,
            "the output space '%s' is not linear, so renderers will filter "
            "and light it wrongly",
            space);
    return OSDTEX_OK;
}

otx_status
otx_colour_resolve_linear(
    otx_run *run, const otx_colour *colour, const char *to, const char **space)
{
    if (to && to[0])
    {
        OTX_TRY(otx_colour_find(run, colour, OTX_OPTION_NAME("to"), to, space));
        return say_linear(run, colour, *space, OTX_OPTION_NAME("to"));
    }
    *space = otx_colour_scene_linear(colour);
    if (*space)
        return say_linear(
            run, colour, *space,
            otx_ocio_role(colour->config, "scene_linear")
                ? "role scene_linear"
                : "no role scene_linear: the first linear space that is known");
    return otx_fail(
        run, OSDTEX_ERROR_COLOUR, stage, otx_where_file(colour->path),
        "the configuration has neither a role scene_linear nor a linear space "
        "by a usual name; say {to} to name one");
}

/* The candidate for matching, and by which rule. */
static otx_status
choose_match(
    otx_run *run, const otx_colour *colour, const char *match_space,
    const char **space, const char **rule)
{
    *rule = OTX_OPTION_NAME("match-space");
    if (match_space && match_space[0])
        return otx_colour_find(
            run, colour, OTX_OPTION_NAME("match-space"), match_space, space);
    *rule = "role color_picking";
    *space = otx_ocio_role(colour->config, "color_picking");
    if (*space)
        return OSDTEX_OK;
    *rule = "no role color_picking: sRGB";
    *space = otx_colour_srgb(colour);
    return OSDTEX_OK;
}

otx_status
otx_colour_resolve_match(
    otx_run *run, const otx_colour *colour, const char *match_space,
    const char **space, bool *is_linear)
{
    const char *rule = NULL;

    *is_linear = false;
    OTX_TRY(choose_match(run, colour, match_space, space, &rule));
    if (*space && otx_ocio_is_data(colour->config, *space))
    {
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, stage, OTX_NOWHERE,
            "the matching space '%s' (%s) holds data, not colours; using sRGB",
            *space, rule);
        *space = otx_colour_srgb(colour);
        rule = "instead of data: sRGB";
    }
    if (!*space)
        rule = "no sRGB space in the configuration";
    *is_linear = !*space || otx_colour_is_linear(colour, *space);
    otx_note(
        run, OSDTEX_SEVERITY_INFO, stage, OTX_NOWHERE,
        "matching space: %s%s%s (%s)%s", *space ? "'" : "",
        *space ? *space : "the linear space", *space ? "'" : "", rule,
        *is_linear ? "; it is linear, so the sRGB curve is put on it" : "");
    return OSDTEX_OK;
}

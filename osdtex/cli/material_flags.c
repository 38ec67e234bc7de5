/* material_flags.c -- --material FOLDER|PREFIX, --map KIND=FILE,...,
 * --match-maps, --normal-y, and --height-range. */
#include "cli/material_flags.h"

#include "cli/value.h"

#include <string.h>

/* Words of --map. A packed file is three maps. */
static const struct
{
    const char *word;
    osdtex_map_kind kind;
    int32_t channel, y_down, inverted;
} WORDS[] = {
    {"normal", OSDTEX_MAP_NORMAL, 0, 0, 0},
    {"normal-dx", OSDTEX_MAP_NORMAL, 0, 1, 0},
    {"roughness", OSDTEX_MAP_ROUGHNESS, 0, 0, 0},
    {"gloss", OSDTEX_MAP_ROUGHNESS, 0, 0, 1},
    {"height", OSDTEX_MAP_HEIGHT, 0, 0, 0},
    {"metalness", OSDTEX_MAP_METALNESS, 0, 0, 0},
    {"occlusion", OSDTEX_MAP_OCCLUSION, 0, 0, 0},
    {"arm", OSDTEX_MAP_OCCLUSION, 0, 0, 0},
    {"arm", OSDTEX_MAP_ROUGHNESS, 1, 0, 0},
    {"arm", OSDTEX_MAP_METALNESS, 2, 0, 0},
};

/* In the place of one of its kind, if there is one. */
static void
put(otx_material_flags *out, osdtex_companion map)
{
    int i = 0;

    while (i < out->count && out->maps[i].kind != map.kind)
        ++i;
    out->maps[i] = map;
    out->count += i == out->count;
}

/* One map of a file that --map names. A file of its own wins over a packed one,
 * whichever comes first.
 *
 *   named  bit k: a file of its own is named for maps of kind k */
static bool
take_word(
    size_t word, const char *path, uint32_t *named, otx_material_flags *out)
{
    const uint32_t bit = 1u << WORDS[word].kind;
    const bool is_packed = strcmp(WORDS[word].word, "arm") == 0;

    if (*named & bit)
    {
        if (!is_packed)
            otx_session_refuse(
                "--map names two files for the %s map; name one of them",
                osdtex_map_kind_name(WORDS[word].kind));
        return is_packed;
    }
    *named |= is_packed ? 0u : bit;
    put(out, (osdtex_companion){
                 .path = path,
                 .kind = WORDS[word].kind,
                 .channel = WORDS[word].channel,
                 .y_down = WORDS[word].y_down,
                 .inverted = WORDS[word].inverted});
    return true;
}

/* KIND=FILE, cut off from the rest. */
static bool
take_map(
    const char *item, const char *all, uint32_t *named, otx_material_flags *out)
{
    const char *equals = strchr(item, '=');
    const size_t length = equals ? (size_t)(equals - item) : 0;
    bool known = false;

    for (size_t i = 0; equals && i < sizeof WORDS / sizeof *WORDS; ++i)
    {
        if (strlen(WORDS[i].word) != length ||
            strncmp(WORDS[i].word, item, length) != 0)
            continue;
        if (!take_word(i, equals + 1, named, out))
            return false;
        known = true;
    }
    if (known && equals[1])
        return true;
    otx_session_refuse(
        "--map takes KIND=FILE with commas between, of the kinds normal, "
        "normal-dx, roughness, gloss, height, metalness, occlusion and arm, "
        "not '%s'",
        all);
    return false;
}

static bool
take_maps(const otx_flag_values *values, otx_material_flags *out)
{
    const char *all = values->text[OTX_FLAG_MAP];
    char *item = out->text;
    uint32_t named = 0;

    if (!all)
        return true;
    if (strlen(all) >= sizeof out->text)
    {
        otx_session_refuse("the files that --map names are too many");
        return false;
    }
    strcpy(out->text, all);
    for (char *next; item; item = next)
    {
        next = strchr(item, ',');
        if (next)
            *next++ = '\0';
        if (!take_map(item, all, &named, out))
            return false;
    }
    return true;
}

static osdtex_status
take_found(
    otx_session *session, otx_flag_values *values, int operand,
    osdtex_exemplar_options *options, otx_material_flags *out)
{
    const char *text = values->text[OTX_FLAG_MATERIAL];
    const osdtex_material_info *info;
    osdtex_status status;

    if (!text)
        return OSDTEX_OK;
    status = osdtex_material_find(session->context, text, &out->found);
    if (status != OSDTEX_OK)
        return status;
    info = osdtex_material_describe(out->found);
    for (int i = 0; i < info->map_count; ++i)
        put(out, info->maps[i]);
    if (info->color_layer && !values->text[OTX_FLAG_LAYER])
        options->layer = info->color_layer;
    /* Before the cage there is none. */
    if (values->operand_count == operand && !values->inputs.saved.path)
        values->operands[values->operand_count++] = info->color;
    return OSDTEX_OK;
}

static bool
take_normal_y(const otx_flag_values *values, osdtex_exemplar_options *options)
{
    const char *text = values->text[OTX_FLAG_NORMAL_Y];

    if (!text || strcmp(text, "up") == 0)
        return true;
    options->normals_y_down = 1;
    if (strcmp(text, "down") == 0)
        return true;
    otx_session_refuse(
        "--normal-y takes up (OpenGL) or down (DirectX), not '%s'", text);
    return false;
}

/* Name and weight of what is matched. */
static bool
take_match_item(const char *item, osdtex_exemplar_options *options)
{
    const char *equals = strchr(item, '=');
    const size_t length = equals ? (size_t)(equals - item) : strlen(item);
    double weight = 1.0;

    if (equals && (!otx_value_real(equals + 1, &weight) || !(weight >= 0.0)))
        return false;
    if (length == 5 && strncmp(item, "color", 5) == 0)
    {
        options->match_color = weight;
        return true;
    }
    for (osdtex_map_kind k = 0; k < OSDTEX_MAP_KINDS; ++k)
        if (strlen(osdtex_map_kind_name(k)) == length &&
            strncmp(osdtex_map_kind_name(k), item, length) == 0)
        {
            options->match_maps[k] = weight;
            return true;
        }
    return false;
}

static bool
take_match(const otx_flag_values *values, osdtex_exemplar_options *options)
{
    const char *all = values->text[OTX_FLAG_MATCH_MAPS];
    char text[256];
    bool good = all && strlen(all) < sizeof text;

    if (!all)
        return true;
    if (good)
        strcpy(text, all);
    for (char *item = text, *next; good && item; item = next)
    {
        next = strchr(item, ',');
        if (next)
            *next++ = '\0';
        good = take_match_item(item, options);
    }
    if (!good)
        otx_session_refuse(
            "--match-maps takes names with commas between, color, normal, "
            "roughness, height, metalness and occlusion, each with =WEIGHT if "
            "it is not 1, not '%s'",
            all);
    return good;
}

static bool
take_range(const otx_flag_values *values, osdtex_exemplar_options *options)
{
    const char *range = values->text[OTX_FLAG_HEIGHT_RANGE];
    const char *middle = values->text[OTX_FLAG_HEIGHT_MIDDLE];

    if (range && (!otx_value_real(range, &options->height_range) ||
                  !(options->height_range > 0.0)))
    {
        otx_session_refuse(
            "--height-range takes a positive number of scene units, not '%s'",
            range);
        return false;
    }
    if (middle && !otx_value_real(middle, &options->height_middle))
    {
        otx_session_refuse(
            "--height-middle takes a value of the height map, not '%s'",
            middle);
        return false;
    }
    return true;
}

/* As inputs, each file once. */
static void
list_inputs(const otx_material_flags *flags, otx_flag_inputs *inputs)
{
    inputs->map_count = 0;
    for (int i = 0; i < flags->count; ++i)
    {
        bool listed = false;

        for (int k = 0; k < inputs->map_count; ++k)
            listed |= strcmp(inputs->maps[k], flags->maps[i].path) == 0;
        if (!listed)
            inputs->maps[inputs->map_count++] = flags->maps[i].path;
    }
}

osdtex_status
otx_material_flags_take(
    otx_session *session, otx_flag_values *values, int operand,
    osdtex_exemplar_options *options, otx_material_flags *out)
{
    osdtex_status status = take_found(session, values, operand, options, out);

    if (status != OSDTEX_OK)
        return status;
    if (!take_maps(values, out) || !take_normal_y(values, options) ||
        !take_range(values, options) || !take_match(values, options))
        return OSDTEX_ERROR_ARGUMENT;
    options->maps = out->maps;
    options->map_count = out->count;
    list_inputs(out, &values->inputs);
    return OSDTEX_OK;
}

uint32_t
otx_material_flags_kinds(const otx_material_flags *flags)
{
    uint32_t kinds = 0;

    for (int i = 0; i < flags->count; ++i)
        kinds |= 1u << flags->maps[i].kind;
    return kinds;
}

void
otx_material_flags_destroy(otx_material_flags *flags)
{
    osdtex_material_destroy(flags->found);
}

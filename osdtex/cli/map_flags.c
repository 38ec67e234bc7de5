/* map_flags.c -- what osdtex map and osdtex bake are asked for: options, and
 * the names of what is written. */
#include "cli/map_flags.h"

#include "cli/bake_flags.h"
#include "cli/bake_outputs.h"
#include "cli/inputs.h"
#include "cli/picture_flags.h"
#include "cli/saved_files.h"
#include "cli/up_to_date.h"
#include "cli/value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define DEGREES (3.14159265358979323846 / 180.0)

/* FOLDER/NAME of an OBJ and another end. */
static bool
name_beside(const char *obj, const char *suffix, char out[OTX_MAP_PATH_BYTES])
{
    const int base = (int)strlen(obj) - 4;

    return snprintf(out, OTX_MAP_PATH_BYTES, "%.*s%s", base, obj, suffix) <
           OTX_MAP_PATH_BYTES;
}

/* What textures are: what -o says, else PNG for the web, unless --to names
 * their space. */
static osdtex_texture_type
texture_type(const otx_map_flags *r)
{
    const osdtex_exemplar_options *e = &r->exemplar_options;

    if (e->texture_type != OSDTEX_TEXTURE_ANY)
        return e->texture_type;
    return e->receiver == OSDTEX_RECEIVER_WEB && !e->to ? OSDTEX_TEXTURE_PNG
                                                        : OSDTEX_TEXTURE_EXR;
}

static const char *
texture_extension(const otx_map_flags *r)
{
    return osdtex_texture_extension(texture_type(r), -1);
}

/* A list of pastes is of one exemplar, and instead of a bake. */
static bool
name_pastes(otx_map_flags *r, const char *extension)
{
    char suffix[32];

    if (r->bakes || r->exr_count > 1)
    {
        otx_session_refuse(
            r->bakes ? "--pastes writes a list instead of a bake; leave --bake "
                       "out"
                     : "--pastes writes pieces of one exemplar; leave --also "
                       "out");
        return false;
    }
    snprintf(suffix, sizeof suffix, "_pastes%s", extension);
    r->exr_count = 2;
    return name_beside(r->mtl, suffix, r->exrs[1]) &&
           name_beside(r->mtl, ".usda", r->usda);
}

/* NAME.exr, or of several exemplars NAME_1.exr and so on. */
bool
otx_map_flags_name(otx_map_flags *r)
{
    const char *extension = texture_extension(r);
    char suffix[32];

    r->exr_count = r->values->inputs.saved.path
                       ? otx_saved_files_exemplars(r->values)
                       : r->also.count + 1;
    snprintf(suffix, sizeof suffix, "%s", extension);
    for (int k = 0; k < r->exr_count; ++k)
    {
        if (r->exr_count > 1)
            snprintf(suffix, sizeof suffix, "_%d%s", k + 1, extension);
        if (!name_beside(r->mtl, suffix, r->exrs[k]))
        {
            otx_session_refuse("'%s' is too long a name", r->obj);
            return false;
        }
    }
    return !r->maps || !r->values->text[OTX_FLAG_PASTES] || r->exr_count == 0 ||
           name_pastes(r, extension);
}

/* Those that exemplar k has in its own file, a stack. */
static uint32_t
kinds_inside(const otx_map_flags *r, int k)
{
    if (r->exemplar_options.layer)
        return 0;
    return osdtex_stack_maps(
        k == 0               ? r->values->operands[1]
        : k <= r->also.count ? r->also.files[k - 1]
                             : NULL);
}

/* Bit i: exemplar k has a map of kind i: those that flags give, else, of the
 * same picture, those of the saved mapping. */
static uint32_t
kinds_of(const otx_map_flags *r, int k)
{
    const osdtex_material_info *set;
    uint32_t kinds = 0;

    k = r->usda[0] ? 0 : k;
    if (k == 0)
        kinds = otx_material_flags_kinds(&r->material);
    if (kinds == 0)
        kinds = kinds_inside(r, k);
    if (r->values->inputs.saved.path && kinds == 0 &&
        !(k == 0 && r->values->operands[1]))
        kinds = r->values->inputs.saved.maps[k];
    if (k == 0 || r->values->inputs.saved.path)
        return kinds;
    set = k <= r->also.count ? otx_also_flags_set(&r->also, k - 1) : NULL;
    for (int i = 0; set && i < set->map_count; ++i)
        kinds |= 1u << set->maps[i].kind;
    return kinds;
}

/* NAME_normal.exr and so on, beside NAME.exr, of exemplar k; false where it has
 * no such map. */
static bool
name_map(
    const otx_map_flags *r, int k, osdtex_map_kind kind,
    char out[OTX_MAP_PATH_BYTES])
{
    const char *color = r->exrs[k];

    return (kinds_of(r, k) & 1u << kind) &&
           snprintf(
               out, OTX_MAP_PATH_BYTES, "%.*s_%s%s",
               (int)(strrchr(color, '.') - color), color,
               osdtex_map_kind_name(kind),
               osdtex_texture_extension(texture_type(r), kind)) <
               OTX_MAP_PATH_BYTES;
}

/* The textures that the suffix of the output asks for. False where it is none
 * that there is. */
static bool
take_suffix(const char *path, osdtex_texture_type *out)
{
    if (otx_value_has_extension(path, ".obj"))
        return true;
    for (*out = OSDTEX_TEXTURE_EXR; *out <= OSDTEX_TEXTURE_JPEG; ++*out)
        if (otx_value_has_extension(path, osdtex_texture_extension(*out, -1)))
            return true;
    return false;
}

/* NAME.mtl and NAME.exr beside NAME.obj, NAME_cage.obj and NAME_cage.mtl of a
 * bake; what readers would not take becomes `_` there. */
static bool
name_outputs(otx_map_flags *r)
{
    const char *path = r->values->text[OTX_FLAG_OUTPUT];
    const size_t length = path ? strlen(path) : 0;
    char *name;

    if (!path || !take_suffix(path, &r->exemplar_options.texture_type) ||
        path[length - 5] == '/' || length >= OTX_MAP_PATH_BYTES)
    {
        otx_session_refuse(
            "the output is called NAME.obj: -o DIR/NAME.obj; NAME.png, "
            "NAME.tif or NAME.jpg asks for such textures");
        return false;
    }
    memcpy(r->obj, path, length + 1);
    if (r->exemplar_options.texture_type != OSDTEX_TEXTURE_ANY)
        memcpy(r->obj + length - 4, ".obj", 5);
    memcpy(r->mtl, path, length + 1);
    r->mtl[length - 4] = '\0';
    name = strrchr(r->mtl, '/');
    osdtex_outputs_word(name ? name + 1 : r->mtl);
    memcpy(r->mtl + length - 4, ".mtl", 5);
    if (!otx_map_flags_name(r))
        return false;
    if (name_beside(r->mtl, "_cage.obj", r->cage_obj) &&
        name_beside(r->mtl, "_cage.mtl", r->cage_mtl))
        return true;
    otx_session_refuse("'%s' is too long a name", path);
    return false;
}

static bool
is_picture(const char *path)
{
    return !path || otx_value_has_extension(path, ".png") ||
           otx_value_has_extension(path, ".exr");
}

static bool
parse_numbers(otx_map_flags *r)
{
    const char *level = r->values->text[OTX_FLAG_LEVEL];
    const char *seed = r->values->text[OTX_FLAG_SEED];
    int64_t number;

    if (level && strcmp(level, "auto") != 0)
    {
        if (!otx_value_int(level, 0, OSDTEX_LEVEL_MAX, &number))
        {
            otx_session_refuse(
                "--level takes a number from 0 to %d or auto, not '%s'",
                OSDTEX_LEVEL_MAX, level);
            return false;
        }
        r->surface_options.level = (int32_t)number;
    }
    r->map_options.scale = r->also.scale;
    if (seed && !otx_value_int(seed, 0, INT64_MAX, &number))
    {
        otx_session_refuse("--seed takes a whole number, not '%s'", seed);
        return false;
    }
    if (seed)
        r->map_options.seed = (uint64_t)number;
    return true;
}

static bool
parse_heal(otx_map_flags *r)
{
    const char *text = r->values->text[OTX_FLAG_HEAL];
    double *heal = &r->map_options.heal;

    if (!text)
        return true;
    if (strcmp(text, "auto") == 0)
        *heal = OSDTEX_HEAL_AUTO;
    else if (!otx_value_real(text, heal) || !(*heal >= 0.0 && *heal <= 512.0))
    {
        otx_session_refuse(
            "--heal takes a number of texels up to 512 or auto, not '%s'",
            text);
        return false;
    }
    return true;
}

/* --tile-level is a setting of the method, and the level of the surface where
 * none is given. */
static bool
parse_tile_level(otx_map_flags *r)
{
    const char *text = r->values->text[OTX_FLAG_TILE_LEVEL];
    int64_t level;

    memcpy(
        r->settings, r->values->settings,
        (size_t)r->values->setting_count * sizeof *r->settings);
    r->map_options.settings = r->settings;
    r->map_options.setting_count = r->values->setting_count;
    if (!text)
        return true;
    if (!otx_value_int(text, 0, OSDTEX_LEVEL_MAX, &level))
    {
        otx_session_refuse(
            "--tile-level takes a number from 0 to %d, not '%s'",
            OSDTEX_LEVEL_MAX, text);
        return false;
    }
    if (!r->values->text[OTX_FLAG_LEVEL])
        r->surface_options.level = (int32_t)level;
    r->settings[r->map_options.setting_count++] =
        (osdtex_setting){"level", text};
    return true;
}

static bool
parse_fields(otx_map_flags *r)
{
    const char *text = r->values->text[OTX_FLAG_GENERATORS];

    r->map_options.mask = r->values->text[OTX_FLAG_MASK];
    r->map_options.constraints = r->values->text[OTX_FLAG_CONSTRAINTS];
    r->map_options.follow = r->values->text[OTX_FLAG_FOLLOW];
    r->map_options.along = r->values->text[OTX_FLAG_ALONG];
    r->map_options.place = r->values->text[OTX_FLAG_PLACE];
    r->map_options.exemplar_class = r->values->text[OTX_FLAG_EXEMPLAR_CLASS];
    if (!text || otx_value_reals(text, 4, r->map_options.generators))
        return true;
    otx_session_refuse("--generators takes X,Y,X,Y, not '%s'", text);
    return false;
}

static bool
parse_first_patch(otx_map_flags *r)
{
    const char *text = r->values->text[OTX_FLAG_FIRST_PATCH];
    double v[4];

    if (!text)
        return true;
    if (!otx_value_reals(text, 4, v) || v[0] < 0.0 || v[0] > INT32_MAX ||
        v[0] != floor(v[0]))
    {
        otx_session_refuse(
            "--first-patch takes FACE,U,V,ANGLE, not '%s'", text);
        return false;
    }
    r->map_options.first_face = (osdtex_index)v[0];
    r->map_options.first_u = v[1];
    r->map_options.first_v = v[2];
    r->map_options.first_angle = v[3] * DEGREES;
    return true;
}

/* Cage and exemplar are easily taken for each other. */
static bool
cage_comes_first(const otx_map_flags *r)
{
    const char *cage = r->values->operands[0];

    if (!cage || !otx_inputs_is_picture(cage))
        return true;
    otx_session_refuse(
        "'%s' is a picture, where the cage, an OBJ, is expected: osdtex %s "
        "CAGE.obj EXEMPLAR",
        cage, r->maps ? "map" : "bake");
    return false;
}

/* Textures of a bake have numbers in their names; nothing else may. Which maps
 * there will be is not known yet. */
static bool
pictures_are_apart(const otx_map_flags *r)
{
    const char *const others[] = {
        r->preview, r->report, r->maps ? r->exrs[0] : NULL};

    for (int i = 0; r->bakes && i < 3; ++i)
        if (otx_bake_outputs_may_be(
                r->cage_obj, &r->bake_options, UINT32_MAX, texture_type(r),
                others[i]))
        {
            otx_session_refuse(
                "'%s' may be the name of a baked texture too; give it another "
                "name",
                others[i]);
            return false;
        }
    return true;
}

/* What was decided when the mapping was saved cannot be asked for again. */
static bool
saved_stays(const otx_map_flags *r)
{
    static const otx_flag_id decided[] = {
        OTX_FLAG_METHOD,      OTX_FLAG_SCALE,
        OTX_FLAG_LEVEL,       OTX_FLAG_SEED,
        OTX_FLAG_SET,         OTX_FLAG_TILE_LEVEL,
        OTX_FLAG_ALSO,        OTX_FLAG_MASK,
        OTX_FLAG_FIRST_PATCH, OTX_FLAG_CONSTRAINTS,
        OTX_FLAG_FOLLOW,      OTX_FLAG_GENERATORS,
        OTX_FLAG_SCHEME,      OTX_FLAG_BOUNDARY,
        OTX_FLAG_FVAR,        OTX_FLAG_MATCH_SPACE,
        OTX_FLAG_MATCH_IN,    OTX_FLAG_WRAP,
        OTX_FLAG_TILEABLE,    OTX_FLAG_EXEMPLAR_CLASS,
        OTX_FLAG_ALONG,       OTX_FLAG_KEEP,
        OTX_FLAG_REST};

    for (size_t i = 0;
         r->values->inputs.saved.path && i < sizeof decided / sizeof *decided;
         ++i)
        if (r->values->text[decided[i]])
        {
            otx_session_refuse(
                "--%s was decided when the mapping was saved; leave it out, or "
                "map anew",
                otx_flag_at(decided[i])->name);
            return false;
        }
    return true;
}

static bool
parse_save(otx_map_flags *r)
{
    r->save = r->values->text[OTX_FLAG_SAVE];
    if (!r->save || otx_value_has_extension(r->save, ".osdtex"))
        return true;
    otx_session_refuse("--save writes a NAME.osdtex, not '%s'", r->save);
    return false;
}

/* Defaults, and what the flags say of cage and exemplars. */
static bool
begin(const otx_flag_values *values, bool bake_only, otx_map_flags *r)
{
    *r = (otx_map_flags){
        .values = values,
        .maps = !bake_only,
        .bakes = bake_only || values->text[OTX_FLAG_BAKE],
    };
    r->surface_options = osdtex_surface_options_default();
    r->map_options = osdtex_map_options_default();
    r->map_options.method = values->text[OTX_FLAG_METHOD];
    r->preview = values->text[OTX_FLAG_PREVIEW];
    r->report = values->text[OTX_FLAG_JSON_REPORT];
    return otx_inputs_cage(values, &r->cage_options) &&
           otx_inputs_exemplar(values, &r->exemplar_options) &&
           otx_bake_flags_parse(values, &r->bake_options) &&
           otx_picture_flags_parse(values, &r->picture) &&
           otx_also_flags_parse(values, &r->also);
}

/* What they say of the mapping. */
static bool
parse_mapping(otx_map_flags *r)
{
    return parse_numbers(r) && parse_tile_level(r) && parse_first_patch(r) &&
           parse_fields(r) && parse_heal(r);
}

bool
otx_map_flags_parse_mapping(const otx_flag_values *values, otx_map_flags *r)
{
    return begin(values, false, r) && parse_mapping(r) && cage_comes_first(r);
}

bool
otx_map_flags_parse(
    const otx_flag_values *values, bool bake_only, otx_map_flags *r)
{
    if (!begin(values, bake_only, r) || !name_outputs(r) || !parse_mapping(r))
        return false;
    if (r->exemplar_options.texture_type > OSDTEX_TEXTURE_EXR &&
        r->exemplar_options.to)
    {
        otx_session_refuse(
            "textures of integers are sRGB, so --to has no say; leave it out, "
            "or write EXR: -o NAME.obj");
        return false;
    }
    /* Then the textures are PNG themselves. */
    if (strcmp(texture_extension(r), ".png") == 0)
        r->bake_options.preview_png = 0;
    if (!is_picture(r->preview))
    {
        otx_session_refuse(
            "--preview writes a .png or .exr, not '%s'", r->preview);
        return false;
    }
    if (r->report && strcmp(r->report, "-") == 0)
    {
        otx_session_refuse(
            "--json-report writes a file that appears with the others, not to "
            "the standard output: --json-report NAME.json");
        return false;
    }
    return saved_stays(r) && parse_save(r) && cage_comes_first(r) &&
           pictures_are_apart(r);
}

/* Of any exemplar: those that a bake has. */
static uint32_t
all_kinds(const otx_map_flags *r)
{
    uint32_t kinds = 0;

    for (int k = 0; k < r->exr_count; ++k)
        kinds |= kinds_of(r, k);
    return kinds;
}

void
otx_map_flags_outputs(const otx_map_flags *r, otx_path_list *out)
{
    char path[OTX_MAP_PATH_BYTES];

    if (r->maps)
    {
        otx_path_list_add(out, r->obj);
        otx_path_list_add(out, r->mtl);
    }
    for (int k = 0; r->maps && k < r->exr_count; ++k)
        otx_path_list_add(out, r->exrs[k]);
    for (int i = 0; r->maps && i < r->exr_count * OSDTEX_MAP_KINDS; ++i)
        if (name_map(r, i / OSDTEX_MAP_KINDS, i % OSDTEX_MAP_KINDS, path))
            otx_path_list_add(out, path);
    if (r->usda[0])
        otx_path_list_add(out, r->usda);
    if (r->bakes)
        otx_bake_outputs_list(
            r->cage_obj, &r->bake_options, all_kinds(r), texture_type(r), out);
    otx_path_list_add(out, r->preview);
    otx_path_list_add(out, r->report);
    otx_path_list_add(out, r->save);
}

/* Those of materials that are written beside the OBJ. */
static bool
maps_are_done(const otx_map_flags *r, const char hash[OSDTEX_HASH_BYTES])
{
    char path[OTX_MAP_PATH_BYTES];

    for (int i = 0; r->maps && i < r->exr_count * OSDTEX_MAP_KINDS; ++i)
        if (name_map(r, i / OSDTEX_MAP_KINDS, i % OSDTEX_MAP_KINDS, path) &&
            !otx_up_to_date_check(path, hash))
            return false;
    return true;
}

bool
otx_map_flags_is_done(
    const otx_map_flags *r, const char hash[OSDTEX_HASH_BYTES])
{
    const char *const files[] = {
        r->maps ? r->obj : NULL,
        r->maps ? r->mtl : NULL,
        r->preview,
        r->report,
        r->save,
        r->usda[0] ? r->usda : NULL};

    for (int i = 0; i < 6; ++i)
        if (files[i] && !otx_up_to_date_check(files[i], hash))
            return false;
    for (int k = 0; r->maps && k < r->exr_count; ++k)
        if (!otx_up_to_date_check(r->exrs[k], hash))
            return false;
    return maps_are_done(r, hash) &&
           (!r->bakes || otx_bake_outputs_are_done(
                             r->cage_obj, &r->bake_options, all_kinds(r),
                             texture_type(r), hash));
}

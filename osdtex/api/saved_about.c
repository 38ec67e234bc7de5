/* saved_about.c -- what a saved mapping says besides its arrays. */
#include "api/saved_about.h"

#include "api/saved_constraints.h"
#include "base/hash.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "mapping";

static void
drop_json(void *json)
{
    json_decref(json);
}

otx_status
otx_saved_topology(otx_run *run, const otx_cage *cage, const char **out)
{
    const size_t faces = (size_t)cage->face_count + 1;
    const size_t corners = (size_t)cage->face_first[cage->face_count];
    int32_t *all = OTX_NEW(run->scratch, int32_t, faces + corners);
    char hash[OTX_HASH_TEXT_BYTES];

    OTX_TRY(otx_run_ok(run));
    memcpy(all, cage->face_first, faces * sizeof *all);
    memcpy(all + faces, cage->face_verts, corners * sizeof *all);
    otx_hash_text(all, (faces + corners) * sizeof *all, hash);
    *out = otx_arena_strdup(run->arena, hash);
    return otx_run_ok(run);
}

/* ---- printing ---- */

static json_t *
text_or_null(const char *text)
{
    return text ? json_string(text) : json_null();
}

static json_t *
print_cage(const osdtex_cage *cage, const char *topology, int32_t level)
{
    const osdtex_cage_info *c = &cage->info;

    return json_pack(
        "{s:o, s:o, s:s, s:f, s:i, s:i, s:i, s:i}", "path",
        text_or_null(c->path), "hash", text_or_null(c->hash), "topology",
        topology, "weld", cage->weld, "scheme", (int)c->scheme, "boundary",
        (int)c->boundary, "fvar", (int)c->fvar, "level", (int)level);
}

/* The other maps of a material, by their kinds. */
static json_t *
print_maps(const otx_companions *companions)
{
    json_t *list = json_array();

    for (int k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        const otx_companion *map = &companions->maps[k];

        if (map->is_there && map->path)
            json_array_append_new(
                list, json_pack(
                          "{s:s, s:s, s:o, s:i, s:b, s:b}", "kind",
                          otx_companion_name((otx_companion_kind)k), "path",
                          map->path, "layer", text_or_null(map->layer),
                          "channel", (int)map->channel, "y_down", map->y_down,
                          "inverted", map->is_inverted));
    }
    return list;
}

static json_t *
print_exemplar(const osdtex_exemplar *handle, const otx_exemplar *compared)
{
    const otx_exemplar_cuts *c = &handle->cuts;
    const otx_exemplar *e = &handle->exemplar;

    return json_pack(
        "{s:s, s:o, s:o, s:s, s:s, s:i, s:o, s:i, s:i, s:[i,i], s:[i,i,i,i], "
        "s:b, "
        "s:[i,i], s:[i,i], s:[b,b], s:o, s:f, s:f}",
        "path", e->source_path, "hash", text_or_null(e->source_hash), "layer",
        text_or_null(c->layer), "from", e->source_space, "to", e->linear_space,
        "receiver", (int)e->receiver, "match_space",
        text_or_null(e->match_space), "embedding", (int)e->embedding, "wrap",
        (int)c->wrap, "file_size", c->file_width, c->file_height, "kept", c->x,
        c->y, c->width, c->height, "rearranged", c->texels != NULL, "size",
        e->linear.width, e->linear.height, "compared", compared->match.width,
        compared->match.height, "wraps", e->wrap_x, e->wrap_y, "maps",
        print_maps(&e->companions), "height_range", e->companions.height_range,
        "height_middle", e->companions.height_middle);
}

/* What is placed over the mapping. */
static json_t *
print_pictures(const otx_decals *decals)
{
    json_t *list = json_array();

    for (int32_t k = 0; decals && k < decals->picture_count; ++k)
        json_array_append_new(
            list,
            json_pack(
                "{s:s, s:o, s:s}", "path", decals->pictures[k].source_path,
                "hash", text_or_null(decals->pictures[k].source_hash), "from",
                decals->pictures[k].source_space));
    return list;
}

static json_t *
print_settings(const osdtex_mapping *mapping)
{
    json_t *settings = json_object();
    char text[64];

    for (int32_t i = 0; i < mapping->method->option_count; ++i)
    {
        const otx_option *option = &mapping->method->options[i];

        otx_option_text(option, mapping->settings, text);
        json_object_set_new(settings, option->name, json_string(text));
    }
    return settings;
}

static json_t *
print_all(const osdtex_mapping *mapping, const char *topology)
{
    const otx_mapping *m = &mapping->mapping;
    json_t *exemplars = json_array();
    char seed[32];

    for (int32_t k = 0; k < mapping->source_count; ++k)
        json_array_append_new(
            exemplars,
            print_exemplar(mapping->sources[k], &mapping->exemplars[k]));
    snprintf(seed, sizeof seed, "%" PRIu64, mapping->seed);
    return json_pack(
        "{s:i, s:s, s:o, s:o, s:s, s:o, s:f, s:s, s:i, s:i, s:i, s:f, s:i, "
        "s:o, s:o}",
        "format", OTX_SAVED_FORMAT, "program", osdtex_version(), "cage",
        print_cage(
            mapping->surface->cage, topology, mapping->surface->info.level),
        "exemplars", exemplars, "method", mapping->method->name, "settings",
        print_settings(mapping), "scale", m->scale, "seed", seed, "patch_count",
        (int)m->patch_count, "layering",
        m->lookups ? (int)m->lookups->layering : 0, "guide_symmetry",
        m->guide ? (int)m->guide->symmetry : 0, "guide_angle",
        m->guide ? m->guide->angle : 0.0, "defect_count",
        m->lattice ? (int)m->lattice->defect_count : 0, "constraints",
        otx_saved_constraints_print(mapping->request.constraints), "pictures",
        print_pictures(m->decals));
}

static otx_status
check_maps(otx_run *run, const osdtex_mapping *mapping)
{
    for (int32_t k = 0; k < mapping->source_count; ++k)
        for (int m = 0; m < OTX_COMPANION_COUNT; ++m)
        {
            const otx_companion *map =
                &mapping->sources[k]->exemplar.companions.maps[m];

            if (map->is_there && !map->path)
                return otx_fail(
                    run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                    "the %s map of exemplar %d was made from pixels, and a "
                    "saved mapping names a file of it; write it as an EXR and "
                    "read it",
                    otx_companion_name((otx_companion_kind)m), (int)k + 1);
        }
    return OSDTEX_OK;
}

otx_status
otx_saved_about_print(
    otx_run *run, const osdtex_mapping *mapping, const char **out)
{
    const char *topology;
    json_t *root;
    char *text;

    if (!mapping->surface->cage->info.path)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the cage was made from arrays, and a saved mapping names a file "
            "of it; write the cage as an OBJ and read it");
    for (int32_t k = 0; k < mapping->source_count; ++k)
        if (!mapping->sources[k]->exemplar.source_path)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "exemplar %d was made from pixels, and a saved mapping names a "
                "file of it; write it as an EXR and read it",
                (int)k + 1);
    OTX_TRY(check_maps(run, mapping));
    OTX_TRY(otx_saved_topology(run, &mapping->surface->cage->cage, &topology));
    root = print_all(mapping, topology);
    text = root ? json_dumps(root, JSON_COMPACT | JSON_SORT_KEYS) : NULL;
    json_decref(root);
    *out = text ? otx_arena_strdup(run->scratch, text) : NULL;
    free(text);
    return *out ? OSDTEX_OK : otx_fail_memory(run, STAGE);
}

/* ---- parsing ---- */

/* The object that is read. Whatever is missing or of another type makes it
 * unsound, which is asked once at the end. */
typedef struct parser
{
    otx_run *run;
    bool sound;
    bool memory;
} parser;

static int32_t
get_int(parser *p, const json_t *value, int64_t low, int64_t high)
{
    const int64_t n = json_integer_value(value);

    if (json_is_integer(value) && n >= low && n <= high)
        return (int32_t)n;
    p->sound = false;
    return (int32_t)low;
}

static int32_t
get_member(
    parser *p, const json_t *object, const char *key, int64_t low, int64_t high)
{
    return get_int(p, json_object_get(object, key), low, high);
}

static double
get_real(parser *p, const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);

    if (json_is_number(value) && isfinite(json_number_value(value)))
        return json_number_value(value);
    p->sound = false;
    return 0.0;
}

/* NULL for null where that may be. */
static const char *
get_text(parser *p, const json_t *object, const char *key, bool may_be_null)
{
    const json_t *value = json_object_get(object, key);
    const char *copy;

    if (json_is_null(value) && may_be_null)
        return NULL;
    if (!json_is_string(value))
    {
        p->sound = false;
        return "";
    }
    copy = otx_arena_strdup(p->run->arena, json_string_value(value));
    p->memory = p->memory && copy;
    return copy ? copy : "";
}

static void
get_pair(
    parser *p, const json_t *object, const char *key, int32_t *a, int32_t *b)
{
    const json_t *pair = json_object_get(object, key);

    *a = get_int(p, json_array_get(pair, 0), 1, OTX_IMAGE_MAX_SIDE);
    *b = get_int(p, json_array_get(pair, 1), 1, OTX_IMAGE_MAX_SIDE);
}

static void
parse_cage(parser *p, const json_t *json, otx_saved_about *out)
{
    out->cage = osdtex_cage_options_default();
    out->cage_path = get_text(p, json, "path", false);
    out->cage_hash = get_text(p, json, "hash", true);
    out->topology = get_text(p, json, "topology", false);
    out->cage.weld = get_real(p, json, "weld");
    out->cage.scheme = get_member(
        p, json, "scheme", OSDTEX_SCHEME_CATMARK, OSDTEX_SCHEME_NONE);
    out->cage.boundary = get_member(
        p, json, "boundary", OSDTEX_UNSET, OSDTEX_BOUNDARY_EDGE_AND_CORNER);
    out->cage.fvar = get_member(p, json, "fvar", OSDTEX_UNSET, OSDTEX_FVAR_ALL);
    out->level = get_member(p, json, "level", 0, OSDTEX_LEVEL_MAX);
}

static void
parse_cuts(parser *p, const json_t *json, otx_saved_exemplar *out)
{
    const json_t *kept = json_object_get(json, "kept");
    otx_exemplar_cuts *c = &out->cuts;

    c->wrap = get_member(p, json, "wrap", OSDTEX_WRAP_AUTO, OSDTEX_WRAP_YES);
    get_pair(p, json, "file_size", &c->file_width, &c->file_height);
    c->x = get_int(p, json_array_get(kept, 0), 0, c->file_width - 1);
    c->y = get_int(p, json_array_get(kept, 1), 0, c->file_height - 1);
    c->width = get_int(p, json_array_get(kept, 2), 1, c->file_width - c->x);
    c->height = get_int(p, json_array_get(kept, 3), 1, c->file_height - c->y);
}

/* Of a file that was saved before there were any: none. */
static void
parse_maps(parser *p, const json_t *json, otx_saved_exemplar *out)
{
    const json_t *list = json_object_get(json, "maps");
    const size_t count = json_array_size(list);

    p->sound = p->sound && count <= OSDTEX_MAP_KINDS;
    for (size_t i = 0; p->sound && i < count; ++i)
    {
        const json_t *map = json_array_get(list, i);
        const char *kind = get_text(p, map, "kind", false);
        int k = 0;

        while (k < OTX_COMPANION_COUNT &&
               strcmp(kind, otx_companion_name((otx_companion_kind)k)) != 0)
            ++k;
        p->sound = p->sound && k < OTX_COMPANION_COUNT;
        out->maps[i] = (osdtex_companion){
            .path = get_text(p, map, "path", false),
            .kind = k,
            .channel = get_member(p, map, "channel", 0, 3),
            .y_down = json_is_true(json_object_get(map, "y_down")),
            .inverted = json_is_true(json_object_get(map, "inverted"))};
        if (json_object_get(map, "layer"))
            out->maps[i].layer = get_text(p, map, "layer", true);
    }
    out->options.map_count = (int32_t)count;
    if (count == 0)
        return;
    out->options.height_range = get_real(p, json, "height_range");
    out->options.height_middle = get_real(p, json, "height_middle");
}

static void
parse_exemplar(parser *p, const json_t *json, otx_saved_exemplar *out)
{
    const json_t *wraps = json_object_get(json, "wraps");

    *out = (otx_saved_exemplar){
        .path = get_text(p, json, "path", false),
        .hash = get_text(p, json, "hash", true),
        .options = osdtex_exemplar_options_default(),
    };
    parse_cuts(p, json, out);
    out->options.from = get_text(p, json, "from", false);
    out->options.layer = get_text(p, json, "layer", true);
    out->options.to = get_text(p, json, "to", false);
    out->options.receiver =
        get_member(p, json, "receiver", 0, OTX_RECEIVER_COUNT - 1);
    out->options.match_space = get_text(p, json, "match_space", true);
    out->options.embedding =
        get_member(p, json, "embedding", 0, OTX_EMBEDDING_COUNT - 1);
    out->options.wrap = out->cuts.wrap;
    get_pair(p, json, "size", &out->width, &out->height);
    get_pair(p, json, "compared", &out->match_width, &out->match_height);
    p->sound = p->sound && json_is_boolean(json_object_get(json, "rearranged"));
    p->sound = p->sound && json_is_boolean(json_array_get(wraps, 0)) &&
               json_is_boolean(json_array_get(wraps, 1));
    out->rearranged = json_is_true(json_object_get(json, "rearranged"));
    out->wrap_x = json_is_true(json_array_get(wraps, 0));
    out->wrap_y = json_is_true(json_array_get(wraps, 1));
    parse_maps(p, json, out);
}

/* Of a file that was saved before there were any: none. */
static void
parse_pictures(parser *p, const json_t *list, otx_saved_about *out)
{
    const size_t count = json_array_size(list);
    otx_saved_picture *pictures =
        OTX_ZNEW(p->run->arena, otx_saved_picture, count);

    p->memory = p->memory && pictures;
    p->sound = p->sound && count <= OSDTEX_PLACE_PICTURES_MAX;
    for (size_t k = 0; pictures && p->sound && k < count; ++k)
    {
        const json_t *json = json_array_get(list, k);

        pictures[k] = (otx_saved_picture){
            get_text(p, json, "path", false), get_text(p, json, "hash", true),
            get_text(p, json, "from", false)};
    }
    out->pictures = pictures;
    out->picture_count = pictures ? (int32_t)count : 0;
}

static void
parse_settings(parser *p, json_t *json, otx_saved_about *out)
{
    const char *key;
    json_t *value;

    p->sound = p->sound && json_is_object(json) &&
               json_object_size(json) <= OTX_SAVED_SETTINGS_MAX;
    json_object_foreach(json, key, value)
    {
        if (!p->sound)
            return;
        out->settings[out->setting_count++] = (osdtex_setting){
            otx_arena_strdup(p->run->arena, key),
            get_text(p, json, key, false)};
        p->memory =
            p->memory && out->settings[out->setting_count - 1].key != NULL;
    }
}

/* As the text that it was. */
static void
parse_constraints(parser *p, const json_t *json, otx_saved_about *out)
{
    char *text;

    if (!json_is_object(json))
        return;
    text = json_dumps(json, JSON_COMPACT);
    out->constraints = text ? otx_arena_strdup(p->run->arena, text) : NULL;
    p->memory = p->memory && out->constraints;
    free(text);
}

static void
parse_all(parser *p, const json_t *root, otx_saved_about *out)
{
    json_t *exemplars = json_object_get(root, "exemplars");
    const size_t count = json_array_size(exemplars);
    const char *seed;

    parse_cage(p, json_object_get(root, "cage"), out);
    p->sound = p->sound && count >= 1 && count <= OTX_EXEMPLARS_MAX;
    for (size_t k = 0; p->sound && k < count; ++k)
        parse_exemplar(
            p, json_array_get(exemplars, k),
            &out->exemplars[out->exemplar_count++]);
    parse_pictures(p, json_object_get(root, "pictures"), out);
    out->program = get_text(p, root, "program", false);
    out->method = get_text(p, root, "method", false);
    parse_settings(p, json_object_get(root, "settings"), out);
    out->scale = get_real(p, root, "scale");
    p->sound = p->sound && out->scale > 0.0;
    seed = get_text(p, root, "seed", false);
    out->seed = strtoull(seed, NULL, 10);
    out->patch_count = get_member(p, root, "patch_count", 0, INT32_MAX);
    out->layering =
        get_member(p, root, "layering", OTX_LAYERING_MEAN, OTX_LAYERING_OVER);
    out->guide_symmetry = get_member(p, root, "guide_symmetry", 0, 4);
    out->guide_angle = get_real(p, root, "guide_angle");
    out->defect_count = get_member(p, root, "defect_count", 0, INT32_MAX);
    parse_constraints(p, json_object_get(root, "constraints"), out);
}

otx_status
otx_saved_about_parse(
    otx_run *run, const char *path, const char *text, otx_saved_about *out)
{
    const otx_where where = otx_where_file(path);
    parser p = {run, true, true};
    json_t *root = text ? json_loads(text, JSON_REJECT_DUPLICATES, NULL) : NULL;
    const json_t *format = json_object_get(root, "format");

    *out = (otx_saved_about){0};
    if (root && !otx_arena_defer(run->scratch, drop_json, root))
    {
        json_decref(root);
        return otx_fail_memory(run, STAGE);
    }
    if (!json_is_integer(format))
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, STAGE, where,
            "the file is no saved mapping of osdtex");
    if (json_integer_value(format) != OTX_SAVED_FORMAT)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, STAGE, where,
            "the mapping was saved in format %lld, and this version reads %d; "
            "read it with the version that wrote it",
            (long long)json_integer_value(format), OTX_SAVED_FORMAT);
    parse_all(&p, root, out);
    if (!p.memory)
        return otx_fail_memory(run, STAGE);
    return p.sound ? OSDTEX_OK
                   : otx_fail(
                         run, OSDTEX_ERROR_FORMAT, STAGE, where,
                         "the saved mapping is damaged: something that it says "
                         "of itself is missing or out of range");
}

/* recipe.c -- all that a person has asked for, as one JSON object. */
#include "studio/recipe.h"
#include "studio/sentence.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define DEGREES (3.14159265358979323846 / 180.0)

enum
{
    DEPTH_MOST = 32
};

static const char *const KEYS[] = {"exemplar",       "seed",
                                   "scale",          "first-patch",
                                   "exemplar-class", "constraints"};
static const char *const CLASSES[] = {
    "isotropic", "directional", "weak-lattice", "lattice"};

static bool
is_among(const char *word, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (strcmp(word, words[i]) == 0)
            return true;
    return false;
}

static bool
is_number_from(const json_t *value, double low, double high)
{
    const double number = json_number_value(value);

    return json_is_number(value) && number >= low && number <= high;
}

static bool
is_first_patch(const json_t *value)
{
    if (!value || json_is_null(value))
        return true;
    if (!json_is_array(value) || json_array_size(value) != 4)
        return false;
    for (size_t i = 0; i < 4; ++i)
        if (!is_number_from(json_array_get(value, i), -1e9, 1e9))
            return false;
    return json_is_integer(json_array_get(value, 0)) &&
           json_integer_value(json_array_get(value, 0)) >= 0;
}

static bool
is_class(const json_t *value)
{
    return !value || json_is_null(value) ||
           (json_is_string(value) && is_among(
                                         json_string_value(value), CLASSES,
                                         sizeof CLASSES / sizeof *CLASSES));
}

/* What is wrong with a recipe; NULL nothing. */
static const char *
fault_of(json_t *recipe, int exemplars)
{
    const json_t *exemplar = json_object_get(recipe, "exemplar");
    const json_t *seed = json_object_get(recipe, "seed");
    const char *key;
    json_t *value;

    json_object_foreach(recipe, key, value) if (
        !is_among(key, KEYS, sizeof KEYS / sizeof *KEYS)) return "it has a key "
                                                                 "that is none";
    if (!json_is_integer(exemplar) ||
        !is_number_from(exemplar, 0.0, exemplars - 1.0))
        return "its exemplar is none of those to choose among";
    if (!json_is_integer(seed) || json_integer_value(seed) < 0)
        return "its seed is no whole number";
    if (!is_number_from(json_object_get(recipe, "scale"), 0.0, 1e12))
        return "its scale is no width in scene units";
    if (!is_first_patch(json_object_get(recipe, "first-patch")))
        return "its first patch is not a face, u, v and an angle";
    if (!is_class(json_object_get(recipe, "exemplar-class")))
        return "its exemplar class is none";
    if (!json_is_object(json_object_get(recipe, "constraints")))
        return "it has no object of constraints";
    return NULL;
}

json_t *
otx_recipe_parse(
    const char *text, size_t bytes, int exemplars,
    char error[OTX_STUDIO_ERROR_BYTES])
{
    json_error_t where;
    json_t *recipe = json_loadb(text, bytes, JSON_REJECT_DUPLICATES, &where);
    const char *fault;

    if (!recipe)
    {
        otx_sentence(
            error, "what was sent is no JSON: line %d: %.200s", where.line,
            where.text);
        return NULL;
    }
    fault = json_is_object(recipe) ? fault_of(recipe, exemplars)
                                   : "it is no JSON object";
    if (!fault)
        return recipe;
    otx_sentence(error, "what was sent cannot be mapped: %s", fault);
    json_decref(recipe);
    return NULL;
}

/* A file of constraints as an object; an empty one where there is none. */
static json_t *
read_constraints(const char *path)
{
    json_t *constraints =
        path ? json_load_file(path, JSON_REJECT_DUPLICATES, NULL) : NULL;

    if (constraints && json_is_object(constraints))
        return constraints;
    json_decref(constraints);
    return json_pack("{s:[]}", "constraints");
}

json_t *
otx_recipe_first(const osdtex_map_options *options)
{
    json_t *patch =
        options->first_face < 0
            ? json_null()
            : json_pack(
                  "[i,f,f,f]", (int)options->first_face, options->first_u,
                  options->first_v, options->first_angle / DEGREES);
    json_t *class = options->exemplar_class
                        ? json_string(options->exemplar_class)
                        : json_null();

    return json_pack(
        "{s:i, s:I, s:f, s:o, s:o, s:o}", "exemplar", 0, "seed",
        (json_int_t)options->seed, "scale", options->scale, "first-patch",
        patch, "exemplar-class", class, "constraints",
        read_constraints(options->constraints));
}

int
otx_recipe_exemplar(const json_t *recipe)
{
    return (int)json_integer_value(json_object_get(recipe, "exemplar"));
}

void
otx_recipe_apply(const json_t *recipe, osdtex_map_options *options)
{
    const json_t *patch = json_object_get(recipe, "first-patch");

    options->seed =
        (uint64_t)json_integer_value(json_object_get(recipe, "seed"));
    options->scale = json_number_value(json_object_get(recipe, "scale"));
    options->exemplar_class =
        json_string_value(json_object_get(recipe, "exemplar-class"));
    options->first_face = -1;
    if (!json_is_array(patch))
        return;
    options->first_face =
        (osdtex_index)json_integer_value(json_array_get(patch, 0));
    options->first_u = json_number_value(json_array_get(patch, 1));
    options->first_v = json_number_value(json_array_get(patch, 2));
    options->first_angle =
        json_number_value(json_array_get(patch, 3)) * DEGREES;
}

bool
otx_recipe_write(const json_t *object, const char *path)
{
    char part[OTX_STUDIO_PATH_BYTES + 16];

    snprintf(part, sizeof part, "%s.part%ld", path, (long)getpid());
    if (json_dump_file(
            object, part, JSON_INDENT(1) | JSON_REAL_PRECISION(15)) == 0 &&
        rename(part, path) == 0)
        return true;
    unlink(part);
    return false;
}

/* One word of a shell: in quotes where it needs them. */
static void
put_word(FILE *out, const char *word)
{
    static const char PLAIN[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRST"
                                "UVWXYZ0123456789/._-+=,:@%";

    if (word[0] && word[strspn(word, PLAIN)] == '\0')
    {
        fprintf(out, " %s", word);
        return;
    }
    fputs(" '", out);
    for (; *word; ++word)
        if (*word == '\'')
            fputs("'\\''", out);
        else
            fputc(*word, out);
    fputc('\'', out);
}

static void
put_flags(FILE *out, const json_t *recipe, const osdtex_map_options *o)
{
    if (o->seed != 1)
        fprintf(out, " --seed %llu", (unsigned long long)o->seed);
    if (o->scale > 0.0)
        fprintf(out, " --scale %.17g", o->scale);
    for (int k = 0; o->scale > 0.0 && k < o->also_count; ++k)
        if (o->also[k].scale > 0.0)
            fprintf(out, ",%.17g", o->also[k].scale);
    if (o->exemplar_class)
        fprintf(out, " --exemplar-class %s", o->exemplar_class);
    if (o->first_face >= 0)
        fprintf(
            out, " --first-patch %d,%.17g,%.17g,%.17g", (int)o->first_face,
            o->first_u, o->first_v,
            json_number_value(
                json_array_get(json_object_get(recipe, "first-patch"), 3)));
}

char *
otx_recipe_command(const json_t *recipe, const otx_studio_options *options)
{
    osdtex_map_options map = options->map;
    char *line = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&line, &bytes);

    if (!out)
        return NULL;
    otx_recipe_apply(recipe, &map);
    fputs("osdtex map", out);
    put_word(out, osdtex_cage_describe(options->cage)->path);
    put_word(out, options->exemplars[otx_recipe_exemplar(recipe)]);
    for (int i = 0; i < options->word_count; ++i)
        put_word(out, options->words[i]);
    put_flags(out, recipe, &map);
    fputs(" --constraints", out);
    put_word(out, options->files->constraints);
    fputs(" -o", out);
    put_word(out, options->files->model);
    if (fclose(out) == 0)
        return line;
    free(line);
    return NULL;
}

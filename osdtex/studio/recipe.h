/* recipe.h -- all that a person has asked for, as one JSON object.
 *
 *     {"exemplar": 0, "seed": 1, "scale": 0, "first-patch": null,
 *      "exemplar-class": null,
 *      "constraints": {"constraints": [{"point": [0, 1, 0], ...}]}}
 *
 * `exemplar` counts those to choose among from 0; a scale of 0 is the default;
 * `first-patch` is face of the cage, u, v and degrees, as --first-patch takes
 * them. `constraints` is the documented file as it is. */
#ifndef OTX_STUDIO_RECIPE_H
#define OTX_STUDIO_RECIPE_H

#include "studio/studio.h"

#include <jansson.h>

/* A new reference, or NULL after saying in `error` what is wrong. That the
 * constraints can be held is not looked at.
 *
 *   text       [bytes], of whoever sent it
 *   exemplars  how many there are to choose among */
json_t *otx_recipe_parse(
    const char *text, size_t bytes, int exemplars,
    char error[OTX_STUDIO_ERROR_BYTES]);

/* What the command line asks for. NULL when memory is out. */
json_t *otx_recipe_first(const osdtex_map_options *options);

int otx_recipe_exemplar(const json_t *recipe);

/* Changes what a recipe has a say in; the class is lent by the recipe. */
void otx_recipe_apply(const json_t *recipe, osdtex_map_options *options);

/* Writes an object as text, whole or not at all. */
bool otx_recipe_write(const json_t *object, const char *path);

/* The command line that makes the same. To be freed; NULL when memory is out.
 */
char *
otx_recipe_command(const json_t *recipe, const otx_studio_options *options);

#endif

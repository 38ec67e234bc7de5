/* fuzz_recipe.c -- what is sent to the studio: refused with a sentence, or a
 * recipe whose options and command are whole. */
#include "fuzz.h"

#include "studio/recipe.h"

#include <math.h>
#include <string.h>

enum
{
    EXEMPLARS = 3
};

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[OTX_STUDIO_ERROR_BYTES] = "";
    osdtex_map_options options = osdtex_map_options_default();
    json_t *recipe =
        otx_recipe_parse((const char *)data, size, EXEMPLARS, error);

    if (!recipe)
    {
        fuzz_check(strlen(error) > 3 && strlen(error) < sizeof error);
        return 0;
    }
    fuzz_check(
        otx_recipe_exemplar(recipe) >= 0 &&
        otx_recipe_exemplar(recipe) < EXEMPLARS);
    otx_recipe_apply(recipe, &options);
    fuzz_check(options.scale >= 0.0 && isfinite(options.scale));
    fuzz_check(options.first_face >= -1);
    fuzz_check(
        isfinite(options.first_u) && isfinite(options.first_v) &&
        isfinite(options.first_angle));
    json_decref(recipe);
    return 0;
}

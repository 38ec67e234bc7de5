/* fuzz_saved.c -- saved mappings, with all that they say of themselves: refused
 * with a sentence, or a mapping that can be measured, edited and saved. */
#include "fuzz.h"

#include <math.h>

static void
check_mapping(osdtex_context *context, const osdtex_mapping *mapping)
{
    const osdtex_mapping_info *info = osdtex_mapping_describe(mapping);
    osdtex_edit_options options = osdtex_edit_options_default();
    osdtex_constraint redo = osdtex_constraint_none();
    osdtex_mapping *edited;
    osdtex_seams *seams;
    osdtex_status status;

    for (osdtex_index i = 0; i < 2 * info->corner_count; ++i)
        fuzz_check(isfinite(info->uvs[i]));
    for (osdtex_index f = 0; f < info->face_count; ++f)
        fuzz_check(info->face_patch[f] < info->patch_count);
    status = osdtex_seams_create(context, mapping, 9, &seams);
    fuzz_judge(context, status, seams);
    osdtex_seams_destroy(seams);
    redo.face = 1;
    redo.redo = 1;
    options.constraint_items = &redo;
    options.constraint_count = 1;
    status = osdtex_mapping_edit(context, mapping, &options, &edited);
    fuzz_judge(context, status, edited);
    osdtex_mapping_destroy(edited);
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static osdtex_context *context;
    osdtex_mapping_read_options options = osdtex_mapping_read_options_default();
    osdtex_mapping *mapping;
    osdtex_status status;

    if (!context)
        context = fuzz_context();
    osdtex_diagnostic_clear(context);
    /* Not what a file names: those are read by targets of their own. */
    options.cage = "tests/fuzz/corpus/cage/cube.obj";
    for (int k = 0; k < OSDTEX_EXEMPLARS_MAX; ++k)
        options.exemplars[k] = "tests/fuzz/corpus/picture/rgb.png";
    status = osdtex_mapping_read(
        context, fuzz_file("m.osdtex", data, size), &options, &mapping);
    fuzz_judge(context, status, mapping);
    if (status == OSDTEX_OK)
        check_mapping(context, mapping);
    osdtex_mapping_destroy(mapping);
    return 0;
}

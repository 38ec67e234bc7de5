/* fuzz_constraints.c -- constraints as JSON or CSV, on a field of a small cage.
 *
 * A file that begins with a bracket is JSON. */
#include "fuzz.h"

#include <math.h>

static const float points[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                               -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
static const osdtex_index sizes[] = {4, 4, 4, 4, 4, 4};
static const osdtex_index verts[] = {
    0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};

static osdtex_surface *
make_surface(osdtex_context *context)
{
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_cage *cage;
    osdtex_surface *surface;

    arrays.vert_count = 8;
    arrays.face_count = 6;
    arrays.points = points;
    arrays.face_sizes = sizes;
    arrays.face_verts = verts;
    refine.level = 1;
    fuzz_check(
        osdtex_cage_create(context, &arrays, NULL, &cage) == OSDTEX_OK &&
        osdtex_surface_refine(context, cage, &refine, &surface) == OSDTEX_OK);
    return surface;
}

static void
check_field(const osdtex_field *field)
{
    const osdtex_field_info *info = osdtex_field_describe(field);

    for (osdtex_index i = 0; i < 3 * info->face_count; ++i)
        fuzz_check(isfinite(info->directions[i]));
    for (osdtex_index i = 0; i < info->vert_count; ++i)
        fuzz_check(
            isfinite(info->scales[i]) && info->scales[i] > 0.0f &&
            isfinite(info->materials[i]));
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static osdtex_context *context;
    static osdtex_surface *surface;
    osdtex_field_options options = osdtex_field_options_default();
    osdtex_field *field;
    osdtex_status status;
    const int is_json = size > 0 && (data[0] == '{' || data[0] == '[');

    if (!context)
    {
        context = fuzz_context();
        surface = make_surface(context);
    }
    osdtex_diagnostic_clear(context);
    options.constraints = fuzz_file(is_json ? "c.json" : "c.csv", data, size);
    status = osdtex_field_create(context, surface, &options, &field);
    fuzz_judge(context, status, field);
    if (status == OSDTEX_OK)
        check_field(field);
    osdtex_field_destroy(field);
    return 0;
}

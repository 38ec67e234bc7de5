/* fuzz_cage.c -- OBJ with tags, through the cage and two steps of refinement.
 *
 * Whatever is taken for a surface has finite limit points and unit normals. */
#include "fuzz.h"

#include <math.h>

static void
check_surface(const osdtex_surface *surface)
{
    const osdtex_surface_info *info = osdtex_surface_describe(surface);

    for (osdtex_index i = 0; i < 3 * info->vert_count; ++i)
        fuzz_check(isfinite(info->points[i]) && isfinite(info->normals[i]));
    for (osdtex_index c = 0; c < info->corner_count; ++c)
        fuzz_check(
            info->face_verts[c] >= 0 && info->face_verts[c] < info->vert_count);
    fuzz_check(isfinite(info->area) && isfinite(info->mean_edge_length));
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    osdtex_context *context = fuzz_context();
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_cage *cage;
    osdtex_surface *surface;
    osdtex_status status;

    status = osdtex_cage_read(
        context, fuzz_file("cage.obj", data, size), NULL, &cage);
    fuzz_judge(context, status, cage);
    refine.level = size % 3;
    if (status == OSDTEX_OK)
    {
        status = osdtex_surface_refine(context, cage, &refine, &surface);
        fuzz_judge(context, status, surface);
        if (status == OSDTEX_OK)
            check_surface(surface);
        osdtex_surface_destroy(surface);
    }
    osdtex_cage_destroy(cage);
    osdtex_context_destroy(context);
    return 0;
}

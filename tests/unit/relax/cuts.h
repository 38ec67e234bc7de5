/* cuts.h -- rectangles of a grid as offers. */
#ifndef OTX_TESTS_CUTS_H
#define OTX_TESTS_CUTS_H

#include "grid.h"

#include "relax/cut.h"
#include "relax/cut_cost.h"

enum
{
    DENSITY = 8 /* texels per scene unit; faces are unit squares */
};

/* Offers the faces of the rectangle [x0, x1) x [y0, y1), turned by `angle` and
 * moved by `shift` texels. */
static inline otx_offer
offer_rectangle(
    otx_arena *arena, const otx_surface *surface, int32_t nx,
    const int32_t box[4], double angle, otx_vec2 shift)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t count = (box[2] - box[0]) * (box[3] - box[1]);
    int32_t *faces = OTX_NEW(arena, int32_t, count);
    int32_t *first = OTX_NEW(arena, int32_t, count + 1);
    otx_vec2 *uvs = OTX_NEW(arena, otx_vec2, 4 * count);
    int32_t n = 0;

    for (int32_t y = box[1]; y < box[3]; ++y)
        for (int32_t x = box[0]; x < box[2]; ++x, ++n)
        {
            faces[n] = y * nx + x;
            first[n] = 4 * n;
            for (int k = 0; k < 4; ++k)
            {
                const otx_vec3 p = otx_vec3_load(
                    surface->points, leaf->face_verts[4 * faces[n] + k]);

                uvs[4 * n + k] = otx_vec2_add(
                    shift, otx_vec2_mul(
                               otx_vec2_polar(angle),
                               (otx_vec2){DENSITY * p.x, DENSITY * p.y}));
            }
        }
    first[count] = 4 * count;
    return (otx_offer){count, faces, uvs, first, NULL, 0};
}

static inline otx_cut_options
unit_options(void)
{
    otx_cut_options options = otx_cut_options_default();

    options.texels_per_unit = DENSITY;
    return options;
}

#endif

/* mip_facet.c -- a facet on a mip level: everything on it is affine. */
#include "bake/mip_facet.h"

/* Barycentric coordinates over the texels of a mip level. */
static void
set_coordinates(const otx_mip *mip, otx_mip_facet *placed)
{
    otx_vec2 p[3];

    for (int k = 0; k < 3; ++k)
        p[k] = otx_mip_texel(mip, placed->facet.corners[k]);

    const double area2 =
        otx_vec2_cross(otx_vec2_sub(p[1], p[0]), otx_vec2_sub(p[2], p[0]));

    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 a = p[(k + 1) % 3], b = p[(k + 2) % 3];

        placed->at[k] = otx_vec2_cross(a, b) / area2;
        placed->dx[k] = (a.y - b.y) / area2;
        placed->dy[k] = (b.x - a.x) / area2;
    }
}

/* How a whole texel is looked up, and where that takes several, a sample. */
static void
set_probes(const otx_show_view *show, double share, otx_mip_facet *placed)
{
    placed->probes =
        otx_texture_measure(placed->texture, placed->uv_dx, placed->uv_dy);
    placed->is_plain = placed->probes.count == 1 && placed->probes.level == 0 &&
                       placed->probes.fraction == 0.0 &&
                       !otx_show_is_layered(show, placed->facet.face);
    if (!placed->is_plain)
        placed->probes = otx_texture_measure(
            placed->texture, otx_vec2_scale(share, placed->uv_dx),
            otx_vec2_scale(share, placed->uv_dy));
}

/* How maps come into the frame of the texture. */
static void
set_carry(const otx_texel_source *source, otx_mip_facet *placed)
{
    const otx_carry *carry = source->show.carry;
    const int32_t *corners = placed->facet.corners;
    otx_vec2 uvs[3];

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = source->mapping->uvs + 2 * (size_t)corners[k];

        uvs[k] = (otx_vec2){uv[0], uv[1]};
    }
    placed->carry = otx_carry_matrix_of(
        carry, corners, uvs, otx_source_of(source->mapping, placed->facet.face),
        placed->dx, placed->dy);
    placed->scale = otx_carry_scale(carry, corners, placed->at);
    placed->scale_dx = otx_carry_scale(carry, corners, placed->dx);
    placed->scale_dy = otx_carry_scale(carry, corners, placed->dy);
}

otx_mip_facet
otx_mip_facet_make(
    const otx_texel_source *source, const otx_mip *mip, double share,
    int64_t id)
{
    const otx_level *leaf = otx_surface_leaf(source->layout->surface);
    const int32_t face = otx_mip_facet_face(id);
    otx_mip_facet placed = {
        .id = id,
        .chart = source->layout->chart[face],
        .texture = otx_texel_texture(source, face),
        .facet = otx_facet_at(leaf, face, id & 0xFFFF),
    };

    set_coordinates(mip, &placed);
    placed.uv = otx_mip_facet_mix(source->mapping, &placed.facet, placed.at);
    placed.uv_dx = otx_mip_facet_mix(source->mapping, &placed.facet, placed.dx);
    placed.uv_dy = otx_mip_facet_mix(source->mapping, &placed.facet, placed.dy);
    set_probes(&source->show, share, &placed);
    if (source->show.carry)
        set_carry(source, &placed);
    return placed;
}

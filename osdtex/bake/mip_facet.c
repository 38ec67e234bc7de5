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

enum
{
    MAPS_FINENESS = 2 /* data need no more: they are not seen by themselves */
};

/* How a whole texel is looked up, and where that takes several, a sample. */
static otx_mip_lookup
lookup_in(
    const otx_texel_source *source, int32_t n, const otx_mip_facet *placed)
{
    const otx_texture *texture = otx_texel_texture(source, placed->facet.face);
    const int32_t fineness = source->kind == OTX_TEXEL_MAPS ? MAPS_FINENESS : n;
    const double share = 1.0 / fineness;
    otx_mip_lookup out = {
        .texture = texture,
        .probes = otx_texture_measure(texture, placed->uv_dx, placed->uv_dy),
        .fineness = fineness};

    out.is_plain = out.probes.count == 1 && out.probes.level == 0 &&
                   out.probes.fraction == 0.0 &&
                   !otx_show_is_layered(&source->show, placed->facet.face);
    if (!out.is_plain)
        out.probes = otx_texture_measure(
            texture, otx_vec2_scale(share, placed->uv_dx),
            otx_vec2_scale(share, placed->uv_dy));
    return out;
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
    const otx_texel_source *source, const otx_texel_source *maps,
    const otx_mip *mip, int32_t n, int64_t id)
{
    const otx_level *leaf = otx_surface_leaf(source->layout->surface);
    const int32_t face = otx_mip_facet_face(id);
    otx_mip_facet placed = {
        .id = id,
        .chart = source->layout->chart[face],
        .facet = otx_facet_at(leaf, face, id & 0xFFFF),
    };

    set_coordinates(mip, &placed);
    placed.uv = otx_mip_facet_mix(source->mapping, &placed.facet, placed.at);
    placed.uv_dx = otx_mip_facet_mix(source->mapping, &placed.facet, placed.dx);
    placed.uv_dy = otx_mip_facet_mix(source->mapping, &placed.facet, placed.dy);
    placed.own = lookup_in(source, n, &placed);
    if (maps)
        placed.maps = lookup_in(maps, n, &placed);
    if (maps || source->show.carry)
        set_carry(maps ? maps : source, &placed);
    return placed;
}

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
        .whole = otx_texture_measure(texture, placed->uv_dx, placed->uv_dy),
        .fineness = fineness};

    out.is_plain = out.whole.count == 1 && out.whole.level == 0 &&
                   out.whole.fraction == 0.0 &&
                   !otx_show_is_layered(&source->show, placed->facet.face);
    out.probes = out.is_plain
                     ? out.whole
                     : otx_texture_measure(
                           texture, otx_vec2_scale(share, placed->uv_dx),
                           otx_vec2_scale(share, placed->uv_dy));
    return out;
}

/* That of maps: the colour's, where they are as large. */
static otx_mip_lookup
maps_lookup(
    const otx_texel_source *maps, int32_t n, const otx_mip_facet *placed)
{
    const otx_texture *texture = otx_texel_texture(maps, placed->facet.face);
    const otx_image *image = &texture->pyramid.levels[0];
    const otx_image *own = &placed->own.texture->pyramid.levels[0];
    otx_mip_lookup out = placed->own;

    if (own->width != image->width || own->height != image->height ||
        !(out.is_plain || n == MAPS_FINENESS))
        return lookup_in(maps, n, placed);
    out.texture = texture;
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

/* All that follows from the coordinates. */
static void
finish(
    const otx_texel_source *source, const otx_texel_source *maps, int32_t n,
    otx_mip_facet *placed)
{
    const otx_mapping *mapping = source->mapping;

    placed->chart = source->layout->chart[placed->facet.face];
    placed->uv = otx_mip_facet_mix(mapping, &placed->facet, placed->at);
    placed->uv_dx = otx_mip_facet_mix(mapping, &placed->facet, placed->dx);
    placed->uv_dy = otx_mip_facet_mix(mapping, &placed->facet, placed->dy);
    placed->own = lookup_in(source, n, placed);
    if (maps)
        placed->maps = maps_lookup(maps, n, placed);
    if (maps || source->show.carry)
        set_carry(maps ? maps : source, placed);
}

otx_mip_facet
otx_mip_facet_make(
    const otx_texel_source *source, const otx_texel_source *maps,
    const otx_mip *mip, int32_t n, int64_t id)
{
    const otx_level *leaf = otx_surface_leaf(source->layout->surface);
    otx_mip_facet placed = {
        .id = id,
        .facet = otx_facet_at(leaf, otx_mip_facet_face(id), id & 0xFFFF),
    };

    set_coordinates(mip, &placed);
    finish(source, maps, n, &placed);
    return placed;
}

otx_mip_facet
otx_mip_facet_of_walk(
    const otx_texel_source *source, const otx_texel_source *maps, int32_t n,
    const otx_walk *walk)
{
    otx_mip_facet placed = {
        .id = otx_mip_facet_id(walk->facet.face, walk->facet.index),
        .facet = walk->facet};

    for (int k = 0; k < 3; ++k)
    {
        placed.at[k] = walk->at[k];
        placed.dx[k] = walk->dx[k];
        placed.dy[k] = walk->dy[k];
    }
    finish(source, maps, n, &placed);
    return placed;
}

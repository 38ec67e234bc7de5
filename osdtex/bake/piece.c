/* piece.c -- a facet on a page: everything on it is affine. */
#include "bake/piece.h"

#include "bake/mixture.h"

/* Barycentric coordinates over the texels of a page. */
static void
set_coordinates(const otx_page *page, otx_piece *piece)
{
    otx_vec2 p[3];

    for (int k = 0; k < 3; ++k)
        p[k] = otx_page_texel(page, piece->facet.corners[k]);

    const double area2 =
        otx_vec2_cross(otx_vec2_sub(p[1], p[0]), otx_vec2_sub(p[2], p[0]));

    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 a = p[(k + 1) % 3], b = p[(k + 2) % 3];

        piece->at[k] = otx_vec2_cross(a, b) / area2;
        piece->dx[k] = (a.y - b.y) / area2;
        piece->dy[k] = (b.x - a.x) / area2;
    }
}

/* How a whole texel is looked up, and where that takes several, a sample. */
static void
set_probes(const otx_mapping *mapping, double share, otx_piece *piece)
{
    piece->probes =
        otx_texture_measure(piece->texture, piece->uv_dx, piece->uv_dy);
    piece->is_plain = piece->probes.count == 1 && piece->probes.level == 0 &&
                      piece->probes.fraction == 0.0 &&
                      !otx_mixture_has(mapping, piece->facet.face);
    if (!piece->is_plain)
        piece->probes = otx_texture_measure(
            piece->texture, otx_vec2_scale(share, piece->uv_dx),
            otx_vec2_scale(share, piece->uv_dy));
}

otx_piece
otx_piece_make(
    const otx_texel_source *source, const otx_page *page, double share,
    int64_t id)
{
    const otx_level *leaf = otx_surface_leaf(source->layout->surface);
    const int32_t face = otx_piece_face(id);
    otx_piece piece = {
        .id = id,
        .chart = source->layout->chart[face],
        .texture = otx_texel_texture(source, face),
        .facet = otx_facet_at(leaf, face, id & 0xFFFF),
    };

    set_coordinates(page, &piece);
    piece.uv = otx_piece_mix(source->mapping, &piece.facet, piece.at);
    piece.uv_dx = otx_piece_mix(source->mapping, &piece.facet, piece.dx);
    piece.uv_dy = otx_piece_mix(source->mapping, &piece.facet, piece.dy);
    set_probes(source->mapping, share, &piece);
    return piece;
}

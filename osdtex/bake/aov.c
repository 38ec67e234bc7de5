/* aov.c -- what is baked besides colours: values at a texel's centre. */
#include "bake/aov.h"

/* Lengths, on the surface, of the steps of a unit in the exemplar: singular
 * values of the map from the exemplar (in scene units) to the surface. */
static void
stretch_of(const otx_texel_source *source, const otx_facet *facet, double s[2])
{
    const otx_surface *surface = source->layout->surface;
    const int32_t *verts = otx_surface_leaf(surface)->face_verts;
    const otx_vec2 unit = otx_source_unit(
        source->mapping, source->exemplars,
        otx_source_of(source->mapping, facet->face));
    otx_vec3 p[3];
    otx_vec2 q[3];

    for (int k = 0; k < 3; ++k)
    {
        const float *uv = source->mapping->uvs + 2 * (size_t)facet->corners[k];

        p[k] = otx_vec3_load(surface->points, verts[facet->corners[k]]);
        q[k] = (otx_vec2){uv[0] * unit.x, uv[1] * unit.y};
    }

    const otx_vec2 q1 = otx_vec2_sub(q[1], q[0]), q2 = otx_vec2_sub(q[2], q[0]);
    const otx_vec3 p1 = otx_vec3_sub(p[1], p[0]), p2 = otx_vec3_sub(p[2], p[0]);
    const double area2 = otx_vec2_cross(q1, q2);

    s[0] = s[1] = 0.0;
    if (!(fabs(area2) > 0.0))
        return;

    const otx_vec3 du = otx_vec3_mix(q2.y / area2, p1, -q1.y / area2, p2);
    const otx_vec3 dv = otx_vec3_mix(-q2.x / area2, p1, q1.x / area2, p2);
    const double a = otx_vec3_dot(du, du), c = otx_vec3_dot(dv, dv);
    const double half = 0.5 * (a + c), mixed = otx_vec3_dot(du, dv);
    const double root =
        sqrt(fmax(0.25 * (a - c) * (a - c) + mixed * mixed, 0.0));

    s[0] = sqrt(half + root);
    s[1] = sqrt(fmax(half - root, 0.0));
}

/* The one of a face's terms that shows most at a place; of equals the last,
 * which may lie over the others. */
static otx_show_term
main_term(const otx_texel_source *source, const otx_show_place *place)
{
    const int32_t exemplar = otx_source_of(source->mapping, place->face);
    otx_show_term best = otx_show_term_at(&source->show, place, exemplar, 0);

    for (int32_t i = 1; i < otx_show_term_count(&source->show, place->face);
         ++i)
    {
        const otx_show_term term =
            otx_show_term_at(&source->show, place, exemplar, i);

        if (term.weight >= best.weight)
            best = term;
    }
    return best;
}

/* What is looked up at a place: the exemplar, u and v there, and the side of
 * the square that covers as much of it as the texel does, in its widths. */
static void
source_at(const otx_texel_source *source, const otx_walk *walk, float *values)
{
    const otx_show_place place = {
        walk->facet.face, walk->facet.corners, walk->at, walk->dx, walk->dy};
    const otx_show_term term = main_term(source, &place);
    const otx_image *image = &source->exemplars[term.exemplar].linear;
    const double area = otx_vec2_cross(
        otx_show_mix(&source->show, &place, &term, walk->dx),
        otx_show_mix(&source->show, &place, &term, walk->dy));

    values[0] = (float)term.exemplar;
    values[1] = (float)term.uv.x;
    values[2] = (float)term.uv.y;
    values[3] = (float)sqrt(fabs(area) * image->height / image->width);
}

/* The values at a place, of the kind that is baked; 0 of seams, which are found
 * texel by texel.
 *
 *   surface  1 on it, 0 beyond */
static void
values_at(
    const otx_texel_source *source, const otx_walk *walk, float surface,
    float *values)
{
    const int32_t face = walk->facet.face;
    otx_vec2 uv;
    double s[2];

    values[0] = values[1] = 0.0f;
    values[2] = surface;
    switch (source->kind)
    {
    case OTX_TEXEL_PATCH:
        values[0] = (float)source->mapping->face_patch[face];
        values[1] =
            (float)otx_surface_leaf(source->layout->surface)->face_cage[face];
        return;
    case OTX_TEXEL_UV:
        uv = otx_mip_facet_mix(source->mapping, &walk->facet, walk->at);
        values[0] = (float)uv.x;
        values[1] = (float)uv.y;
        return;
    case OTX_TEXEL_STRETCH:
        stretch_of(source, &walk->facet, s);
        values[0] = (float)sqrt(0.5 * (s[0] * s[0] + s[1] * s[1]));
        values[1] = s[1] > 0.0 ? (float)(s[0] / s[1]) : 0.0f;
        return;
    case OTX_TEXEL_SOURCE:
        source_at(source, walk, values);
        return;
    case OTX_TEXEL_SLICE:
        if (source->show.along)
            values[0] = (float)otx_show_along(
                &source->show,
                &(otx_show_place){
                    face, walk->facet.corners, walk->at, walk->dx, walk->dy});
        return;
    default:
        return;
    }
}

/* Whether samples of a texel lie in different patches. */
static bool
has_seam(const otx_block *block, int32_t x, int32_t y)
{
    const int32_t *patch = block->source->mapping->face_patch;
    int32_t seen = -1;

    for (int32_t s = 0; s < block->raster.n * block->raster.n; ++s)
    {
        const int64_t id = otx_block_sample(block, x, y, s);

        if (id < 0)
            continue;
        if (seen >= 0 && patch[otx_mip_facet_face(id)] != seen)
            return true;
        seen = patch[otx_mip_facet_face(id)];
    }
    return false;
}

/* Whether patches meet at a rim, of which a texel's centre is within a texel.
 */
static bool
is_at_seam(const otx_block *block, int32_t x, int32_t y)
{
    const size_t i = otx_block_index(block, x, y);
    const int32_t rim = block->near.rim.edges[i];

    return rim >= 0 && block->near.rim.distance[i] < 1.0f &&
           otx_mip_is_seam(
               block->source->layout, block->source->mapping->face_patch,
               &block->mip->rims[rim]);
}

void
otx_aov_inside(
    otx_block *block, int32_t x, int32_t y, int32_t first, float *out)
{
    const otx_mip_facet *home =
        otx_block_piece(block, otx_block_sample(block, x, y, first));
    const otx_walk walk =
        otx_block_walk(block, home, otx_raster_texel(&block->raster, x, y));

    values_at(block->source, &walk, 1.0f, out);
    if (block->source->kind == OTX_TEXEL_SEAM)
        out[0] = has_seam(block, x, y) || is_at_seam(block, x, y) ? 1.0f : 0.0f;
}

void
otx_aov_gutter(
    const otx_block *block, int32_t x, int32_t y, const otx_walk *walk,
    float *out)
{
    values_at(block->source, walk, 0.0f, out);
    if (block->source->kind == OTX_TEXEL_SEAM)
        out[0] = is_at_seam(block, x, y) ? 1.0f : 0.0f;
}

/* sources.c -- plain UVs that come nearest to what was made. */
#include "method/vertex/vertex.h"

/* The match of the texel nearest to the middle of a face. */
static otx_synth_match
match_of(const otx_vertex *v, int32_t face)
{
    const int32_t k = v->set.territory.owner[face];
    const otx_plot *plot = k >= 0 ? &v->set.plots[k] : NULL;
    otx_vec2 sum = {0.0, 0.0};
    int32_t size, x, y;

    if (!plot || plot->width == 0)
        return (otx_synth_match){0.0f, 0.0f, 1.0f, 0.0f};
    size = otx_level_face_size(otx_surface_leaf(v->mapping.surface), face);
    for (int32_t i = 0; i < size; ++i)
        sum = otx_vec2_add(
            sum, otx_plot_corner(plot, v->set.territory.slot[face], i));
    x = (int32_t)(sum.x / size);
    y = (int32_t)(sum.y / size);
    return v->set.targets[k].matches[(int64_t)y * plot->width + x];
}

/* Rotation from the metric's frame of a face's first facet to the facet. */
static otx_vec2
rotation_of(const otx_vertex *v, int32_t face)
{
    const int32_t k = v->set.territory.owner[face];
    otx_plot_facet f;

    return k >= 0 && otx_plot_facet_of(
                         &v->set.plots[k], v->mapping.surface, v->set.texels,
                         v->set.territory.slot[face], 0, &f)
               ? f.rotation
               : (otx_vec2){1.0, 0.0};
}

/* Corners about the middle, as they lie in the plane of the face, along the
 * first facet's side; in texels. */
static void
unfold(const otx_vertex *v, int32_t face, int32_t size, otx_vec2 *out)
{
    const otx_surface *surface = v->mapping.surface;
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t *verts = leaf->face_verts + leaf->face_first[face];
    const double unit =
        v->set.texels * otx_surface_density(surface, verts, size);
    otx_vec3 middle = {0, 0, 0}, normal = {0, 0, 0}, along, across;

    for (int32_t i = 0; i < size; ++i)
        middle = otx_vec3_add(
            middle, otx_vec3_scale(
                        1.0 / size, otx_vec3_load(surface->points, verts[i])));
    for (int32_t i = 0; i < size; ++i)
        normal = otx_vec3_add(
            normal,
            otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(surface->points, verts[i]), middle),
                otx_vec3_sub(
                    otx_vec3_load(surface->points, verts[(i + 1) % size]),
                    middle)));
    normal = otx_vec3_unit(normal);
    along = otx_vec3_sub(
        otx_vec3_load(surface->points, verts[1]),
        otx_vec3_load(surface->points, verts[0]));
    across = otx_vec3_unit(otx_vec3_cross(normal, along));
    along = otx_vec3_cross(across, normal);
    for (int32_t i = 0; i < size; ++i)
    {
        const otx_vec3 d = otx_vec3_scale(
            unit,
            otx_vec3_sub(otx_vec3_load(surface->points, verts[i]), middle));

        out[i] = (otx_vec2){otx_vec3_dot(d, along), otx_vec3_dot(d, across)};
    }
}

/* Brings a coordinate's range into a picture that ends; smaller, where it is
 * too large for that. */
static void
fit(double side, bool wraps, double low, double high, double *scale,
    double *shift)
{
    *scale = 1.0;
    *shift = 0.0;
    if (wraps)
        return;
    if (high - low > side)
        *scale = side / (high - low);
    if (*scale * low < 0.0)
        *shift = -*scale * low;
    else if (*scale * high > side)
        *shift = side - *scale * high;
}

static void
lay_face(otx_vertex *v, int32_t face, int32_t size, otx_vec2 *flat)
{
    const otx_level *leaf = otx_surface_leaf(v->mapping.surface);
    const otx_exemplar *e = v->job->exemplars;
    const otx_synth_match m = match_of(v, face);
    const otx_vec2 back = rotation_of(v, face);
    const otx_vec2 turn = otx_vec2_mul(
        (otx_vec2){(double)m.c, (double)m.s}, (otx_vec2){back.x, -back.y});
    float *uv = v->mapping.uvs + 2 * (size_t)leaf->face_first[face];
    otx_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    otx_vec2 scale, shift;

    unfold(v, face, size, flat);
    for (int32_t i = 0; i < size; ++i)
    {
        flat[i] = otx_vec2_add(
            (otx_vec2){(double)m.x, (double)m.y}, otx_vec2_mul(turn, flat[i]));
        low.x = fmin(low.x, flat[i].x);
        low.y = fmin(low.y, flat[i].y);
        high.x = fmax(high.x, flat[i].x);
        high.y = fmax(high.y, flat[i].y);
    }
    fit(e->match.width, e->wrap_x, low.x, high.x, &scale.x, &shift.x);
    fit(e->match.height, e->wrap_y, low.y, high.y, &scale.y, &shift.y);
    for (int32_t i = 0; i < size; ++i)
    {
        uv[2 * i] = (float)((scale.x * flat[i].x + shift.x) / e->match.width);
        uv[2 * i + 1] =
            (float)((scale.y * flat[i].y + shift.y) / e->match.height);
    }
}

/* The most corners of a face. */
static int32_t
most_corners(const otx_level *leaf)
{
    int32_t most = 0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        most = otx_level_face_size(leaf, f) > most
                   ? otx_level_face_size(leaf, f)
                   : most;
    return most;
}

otx_status
otx_vertex_lay_uvs(otx_vertex *v)
{
    const otx_level *leaf = otx_surface_leaf(v->mapping.surface);
    otx_vec2 *flat = OTX_NEW(v->run->scratch, otx_vec2, most_corners(leaf));

    OTX_TRY(otx_run_ok(v->run));
    v->mapping.patch_count = v->set.territory.count;
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t owner = v->set.territory.owner[f];

        if (leaf->face_hole[f])
            continue;
        v->mapping.face_patch[f] = owner < 0 ? 0 : owner;
        lay_face(v, f, otx_level_face_size(leaf, f), flat);
    }
    return OSDTEX_OK;
}

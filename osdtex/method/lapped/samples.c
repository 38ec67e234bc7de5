/* samples.c -- which parts of the surface are textured already. */
#include "method/lapped/samples.h"

/* Samples of a triangle whose sides have so many steps. */
static int32_t
triangle_samples(int32_t steps)
{
    return (steps + 1) * (steps + 2) / 2;
}

static double
longest_side(const otx_surface *surface, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    double longest = 0.0;

    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t next = k + 1 < size ? k + 1 : 0;

        longest = fmax(
            longest,
            otx_vec3_length(otx_vec3_sub(
                otx_vec3_load(surface->points, leaf->face_verts[first + next]),
                otx_vec3_load(surface->points, leaf->face_verts[first + k]))));
    }
    return longest;
}

static uint8_t
steps_of(const otx_samples *c, int32_t face, double texels, double spacing)
{
    const int32_t first = c->leaf->face_first[face];
    const double density = otx_surface_density(
        c->surface, c->leaf->face_verts + first,
        otx_level_face_size(c->leaf, face));
    const double steps =
        ceil(longest_side(c->surface, face) * texels * density / spacing);

    return (uint8_t)fmin(fmax(steps, 2.0), OTX_SAMPLES_STEPS_MAX);
}

static otx_status
make_lattices(otx_run *run, otx_samples *c)
{
    for (int32_t n = 1; n <= OTX_SAMPLES_STEPS_MAX; ++n)
    {
        otx_vec2 *at = OTX_NEW(run->scratch, otx_vec2, triangle_samples(n));
        int32_t count = 0;

        if (!at)
            return otx_fail_memory(run, "map");
        for (int32_t i = 0; i <= n; ++i)
            for (int32_t j = 0; j <= n - i; ++j)
                at[count++] = (otx_vec2){(double)i / n, (double)j / n};
        c->lattice[n] = at;
    }
    return OSDTEX_OK;
}

otx_status
otx_samples_create(
    otx_run *run, const otx_surface *surface, double texels, double spacing,
    otx_samples *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    *out = (otx_samples){
        .surface = surface,
        .leaf = leaf,
        .first = OTX_ZNEW(run->scratch, int64_t, (int64_t)leaf->face_count + 1),
        .steps = OTX_NEW(run->scratch, uint8_t, leaf->face_count),
        .open = OTX_ZNEW(run->scratch, int32_t, leaf->face_count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        out->steps[f] = steps_of(out, f, texels, spacing);
        if (!leaf->face_hole[f])
            out->open[f] =
                otx_facet_count(leaf, f) * triangle_samples(out->steps[f]);
        out->first[f + 1] = out->first[f] + out->open[f];
    }
    out->left = out->first[leaf->face_count];
    out->covered = OTX_ZNEW(run->scratch, uint8_t, out->left);
    out->shown = OTX_ZNEW(run->scratch, float, 3 * out->left);
    OTX_TRY(otx_run_ok(run));
    return make_lattices(run, out);
}

otx_sample_place
otx_samples_at(const otx_samples *cover, int32_t face, int32_t index)
{
    const int32_t steps = cover->steps[face];
    const int32_t count = triangle_samples(steps);
    const otx_facet facet = otx_facet_at(cover->leaf, face, index / count);
    const otx_vec2 w = cover->lattice[steps][index % count];

    return (otx_sample_place){
        {facet.corners[0], facet.corners[1], facet.corners[2]},
        {1.0 - w.x - w.y, w.x, w.y}};
}

int32_t
otx_samples_facet(const otx_samples *cover, int32_t face)
{
    return triangle_samples(cover->steps[face]);
}

bool
otx_samples_set(const otx_samples *cover, int32_t face, int64_t index)
{
    const bool fresh = !cover->covered[index];

    cover->open[face] -= fresh;
    cover->covered[index] = 1;
    return fresh;
}

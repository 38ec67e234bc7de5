/* flat.h -- a flat sheet with a mapping whose colours tell where they are. */
#ifndef OTX_TESTS_FLAT_H
#define OTX_TESTS_FLAT_H

#include "unit/surface/meshes.h"

#include "bake/bake.h"
#include "base/random.h"

#include <math.h>

/* n x n quads over [0, n]^2, subdivided without smoothing. */
static inline otx_surface *
flat_surface(otx_run *run, int32_t n, int32_t level)
{
    otx_cage_options options = otx_cage_options_default();
    otx_cage *cage = OTX_NEW(run->arena, otx_cage, 1);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    const otx_cage_input in = mesh_grid(run, n);

    options.scheme = OTX_SCHEME_BILINEAR;
    *cage = mesh_build(run, &in, &options);
    *surface = mesh_refine(run, cage, level);
    return surface;
}

/* UV = (0.25 + 0.5 x / n, 0.25 + 0.5 y / n): the middle of the exemplar, from
 * which footprints do not reach its border. */
static inline otx_mapping *
flat_mapping(otx_run *run, const otx_surface *surface, double n)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_mapping *mapping = OTX_ZNEW(run->arena, otx_mapping, 1);

    mapping->surface = surface;
    mapping->scale = 2.0 * n;
    mapping->patch_count = 1;
    mapping->uvs = OTX_NEW(run->arena, float, 2 * leaf->corner_count);
    mapping->face_patch = OTX_ZNEW(run->arena, int32_t, leaf->face_count);
    for (int32_t c = 0; c < leaf->corner_count; ++c)
        for (int k = 0; k < 2; ++k)
            mapping->uvs[2 * c + k] =
                (float)(0.25 + 0.5 * surface->points[3 * leaf->face_verts[c] + k] / n);
    return mapping;
}

/* A picture of `channels` that does not tile. */
static inline otx_exemplar *
flat_exemplar(otx_run *run, int32_t side, int32_t channels)
{
    otx_exemplar *exemplar = OTX_ZNEW(run->arena, otx_exemplar, 1);

    assert_int_equal(
        otx_image_create(
            run, run->arena, side, side, channels, &exemplar->linear),
        OSDTEX_OK);
    exemplar->match.width = exemplar->match.height = side;
    return exemplar;
}

/* R is u, G is v, B is 1/2. */
static inline otx_exemplar *
flat_ramp(otx_run *run, int32_t side)
{
    otx_exemplar *exemplar = flat_exemplar(run, side, 3);

    for (int32_t y = 0; y < side; ++y)
        for (int32_t x = 0; x < side; ++x)
        {
            float *p = otx_image_at(&exemplar->linear, x, y);

            p[0] = ((float)x + 0.5f) / (float)side;
            p[1] = ((float)y + 0.5f) / (float)side;
            p[2] = 0.5f;
        }
    return exemplar;
}

/* Maps of a picture of `side` texels: one normal throughout, and heights that
 * rise along u by `range` scene units, 0 in the middle. */
static inline void
flat_add_ramp(
    otx_run *run, int32_t side, const float normal[3], double range,
    otx_exemplar *exemplar)
{
    otx_companions *set = &exemplar->companions;

    assert_int_equal(
        otx_image_create(run, run->arena, side, side, 4, &set->image),
        OSDTEX_OK);
    for (int32_t y = 0; y < side; ++y)
        for (int32_t x = 0; x < side; ++x)
        {
            float *p = otx_image_at(&set->image, x, y);

            memcpy(p, normal, 3 * sizeof *p);
            p[3] = ((float)x + 0.5f) / (float)side;
        }
    set->maps[OTX_COMPANION_NORMAL].is_there = true;
    set->maps[OTX_COMPANION_HEIGHT] =
        (otx_companion){.is_there = true, .first = 3};
    set->height_middle = 0.5;
    set->height_range = range;
}

/* All levels of one baked tile. */
typedef struct flat_levels
{
    int32_t count;
    otx_image levels[OTX_PYRAMID_MAX_LEVELS];
} flat_levels;

static inline void
flat_take(void *user, int32_t slot, int32_t lane, const otx_bake_block *block)
{
    (void)slot;
    (void)lane;
    otx_bake_copy(block, &((flat_levels *)user)->levels[block->level]);
}

static inline otx_status
flat_put(void *user, int32_t slot, int32_t level, int32_t x, int32_t y)
{
    (void)user;
    (void)slot;
    (void)level;
    (void)x;
    (void)y;
    return OSDTEX_OK;
}

static inline otx_bake_sink
flat_sink(flat_levels *out)
{
    return (otx_bake_sink){.take = flat_take, .put = flat_put, .user = out};
}

static inline flat_levels
flat_bake(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplar,
    const otx_layout *layout, const otx_bake_options *options, int32_t tile)
{
    flat_levels out = {otx_pyramid_count(layout->side, layout->side), {{0}}};
    const otx_bake_sink sink = flat_sink(&out);
    otx_bake bake;

    assert_int_equal(
        otx_bake_create(run, mapping, exemplar, layout, options, &bake),
        OSDTEX_OK);
    for (int32_t l = 0; l < out.count; ++l)
        assert_int_equal(
            otx_image_create(
                run, run->arena, otx_pyramid_side(layout->side, l),
                otx_pyramid_side(layout->side, l), bake.source.channels,
                &out.levels[l]),
            OSDTEX_OK);
    assert_int_equal(otx_bake_tile(run, &bake, tile, &sink), OSDTEX_OK);
    return out;
}

static inline otx_layout
flat_layout(
    otx_run *run, const otx_mapping *mapping, otx_layout_source source,
    int32_t side, int32_t margin)
{
    const otx_layout_options options = {source, side, margin, 0.0};
    otx_layout layout;

    if (otx_layout_build(run, mapping, &options, &layout) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return layout;
}

#endif

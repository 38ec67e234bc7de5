/* textures_scene.h -- a small mapping, and what a host bakes of it. */
#ifndef OTX_TESTS_TEXTURES_SCENE_H
#define OTX_TESTS_TEXTURES_SCENE_H

#include "meter.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    TEXTURES = 7,
    LEVELS = 7, /* 96 48 24 12 6 3 1 */
    SIDE = 96   /* more than a block, and no whole number of them */
};

typedef struct scene
{
    osdtex_context *context;
    osdtex_mapping *mapping;
    osdtex_textures *textures;
} scene;

static const uint32_t ALL = OSDTEX_BAKE_PATCH | OSDTEX_BAKE_UV |
                            OSDTEX_BAKE_STRETCH | OSDTEX_BAKE_SEAM |
                            OSDTEX_BAKE_SOURCE | OSDTEX_BAKE_SLICE;

static inline osdtex_bake_options
small_bake(void)
{
    osdtex_bake_options options = osdtex_bake_options_default();

    options.resolution = SIDE;
    options.uvs = OSDTEX_BAKE_UVS_ATLAS;
    options.margin = 4;
    options.extras = ALL;
    return options;
}

static inline osdtex_status
map_small(osdtex_context *context, osdtex_mapping **out)
{
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_exemplar *exemplar = NULL;
    osdtex_cage *cage = NULL;
    osdtex_status status =
        osdtex_cage_read(context, "models/cages/plane.obj", NULL, &cage);

    map.level = 1;
    map.scale = 4.0;
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(
            context, "models/exemplars/gravel_tile.png", NULL, &exemplar);
    if (status == OSDTEX_OK)
        status = osdtex_map(context, cage, exemplar, &map, out);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    return status;
}

/* Maps for all tests: a mapping may be used with any context. */
static inline int
map_once(void **state)
{
    osdtex_mapping *mapping = NULL;
    osdtex_context *context;

    if (osdtex_context_create(NULL, &context) != OSDTEX_OK ||
        map_small(context, &mapping) != OSDTEX_OK)
        return 1;
    osdtex_context_destroy(context);
    *state = mapping;
    return 0;
}

static inline int
forget(void **state)
{
    osdtex_mapping_destroy(*state);
    return 0;
}

static inline void
open_scene(
    void **state, scene *s, const osdtex_bake_options *options, int32_t threads)
{
    osdtex_context_options how = osdtex_context_options_default();

    how.threads = threads;
    s->mapping = *state;
    assert_int_equal(osdtex_context_create(&how, &s->context), OSDTEX_OK);
    if (osdtex_textures_create(s->context, s->mapping, options, &s->textures) !=
        OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(s->context)->message);
}

static inline void
close_scene(scene *s)
{
    osdtex_textures_destroy(s->textures);
    osdtex_context_destroy(s->context);
}

static inline osdtex_image *
image_of(const scene *s, int32_t texture, int32_t tile, int32_t level)
{
    const osdtex_texture_part part = {texture, tile, level};
    osdtex_image *image;

    assert_int_equal(
        osdtex_textures_image(s->context, s->textures, &part, &image),
        OSDTEX_OK);
    return image;
}

static inline size_t
values_of(const osdtex_image_info *info)
{
    return (size_t)info->width * (size_t)info->height * (size_t)info->channels;
}

#endif

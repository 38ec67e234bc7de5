/* field_scene.h -- a surface to solve fields on, as a host has it. */
#ifndef OTX_TESTS_FIELD_SCENE_H
#define OTX_TESTS_FIELD_SCENE_H

#include "meter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct scene
{
    osdtex_context *context;
    osdtex_cage *cage;
    osdtex_surface *surface;
} scene;

static inline void
assert_directions_everywhere(const osdtex_field_info *info)
{
    for (int32_t f = 0; f < info->face_count; ++f)
    {
        const float *d = info->directions + 3 * (size_t)f;

        assert_true(fabs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1.0) < 1e-5);
    }
}

static inline osdtex_status
open_scheme(
    scene *s, const char *path, int32_t level, const osdtex_cage_options *how,
    const osdtex_context_options *options)
{
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_status status;

    *s = (scene){0};
    refine.level = level;
    status = osdtex_context_create(options, &s->context);
    if (status == OSDTEX_OK)
        status = osdtex_cage_read(s->context, path, how, &s->cage);
    if (status == OSDTEX_OK)
        status =
            osdtex_surface_refine(s->context, s->cage, &refine, &s->surface);
    return status;
}

static inline osdtex_status
open_scene(
    scene *s, const char *path, int32_t level,
    const osdtex_context_options *options)
{
    return open_scheme(s, path, level, NULL, options);
}

static inline void
close_scene(scene *s)
{
    osdtex_surface_destroy(s->surface);
    osdtex_cage_destroy(s->cage);
    osdtex_context_destroy(s->context);
}

static const char *
last_message(const scene *s)
{
    const int32_t count = osdtex_diagnostic_count(s->context);
    osdtex_diagnostic d;

    if (count == 0 ||
        osdtex_diagnostic_get(s->context, count - 1, &d) != OSDTEX_OK)
        return "";
    return d.message;
}

static inline osdtex_field *
make_field(scene *s, const char *follow, int32_t symmetry)
{
    osdtex_field_options options = osdtex_field_options_default();
    osdtex_field *field;

    options.follow = follow;
    options.symmetry = symmetry;
    if (osdtex_field_create(s->context, s->surface, &options, &field) !=
        OSDTEX_OK)
        fail_msg("%s: %s", follow ? follow : "none", last_message(s));
    return field;
}

#endif

/* strip_pastes.h -- a mapping of pastes by hand, for tests of what is written.
 *
 * Four quads in a row, 16 texels long. Over the second and the third lies one
 * round piece, from places of the exemplar that look alike; over the fourth
 * lies another that fades along the quad, and over that the first once more. */
#ifndef OTX_TESTS_STRIP_PASTES_H
#define OTX_TESTS_STRIP_PASTES_H

#include "mapping/mapping.h"
#include "support.h"

enum
{
    STRIP_SIDE = 32, /* of the exemplar */
    STRIP_FACES = 4,
    STRIP_VERTS = 10,
    STRIP_CORNERS = 16,
    STRIP_ITEMS = 28, /* corners of 7 lookups */
    STRIP_FRAGMENTS = 4
};

typedef struct strip_pastes
{
    otx_run *run;
    otx_cage cage;
    otx_level leaf;
    otx_surface surface;
    otx_exemplar exemplar;
    otx_mapping mapping;
    otx_lookups lookups;
    otx_radial outline, other;
    otx_fragment fragments[STRIP_FRAGMENTS];
    otx_lookup items[STRIP_ITEMS];
    int64_t item_first[STRIP_FACES + 1];
    int32_t face_first[STRIP_FACES + 1], face_verts[STRIP_CORNERS];
    int32_t face_cage[STRIP_FACES], patches[STRIP_FACES];
    uint8_t holes[STRIP_FACES];
    float points[STRIP_VERTS * 3], uvs[STRIP_CORNERS * 2];
} strip_pastes;

static inline otx_radial
strip_circle(float radius)
{
    otx_radial r = {.feather = 2.0f};

    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
        r.radius[i] = radius;
    otx_radial_bound(&r);
    return r;
}

/* The lookup of a face that has its lower left at a texel of the exemplar. */
static inline void
strip_lookup(
    otx_lookup items[4], float x, float y, int32_t fragment, float last)
{
    static const float U[] = {0, 16, 16, 0}, V[] = {0, 0, 16, 16};

    for (int k = 0; k < 4; ++k)
        items[k] = (otx_lookup){
            {(x + U[k]) / STRIP_SIDE, (y + V[k]) / STRIP_SIDE},
            U[k] > 0.0f ? last : 1.0f,
            fragment};
}

static inline void
strip_exemplar(strip_pastes *s)
{
    otx_exemplar *e = &s->exemplar;

    otx_image_create(
        s->run, s->run->arena, STRIP_SIDE, STRIP_SIDE, 3, &e->linear);
    for (int32_t i = 0; i < STRIP_SIDE * STRIP_SIDE * 3; ++i)
        e->linear.pixels[i] = (float)(i * 37 % 1001) / 1001.0f + 0.001f;
    e->wrap_x = e->wrap_y = true;
    e->match = e->linear;
    e->linear_space = "Linear Rec.709 (sRGB)";
}

static inline void
strip_mesh(strip_pastes *s)
{
    for (int32_t v = 0; v < STRIP_VERTS; ++v)
    {
        s->points[3 * v] = (float)(v / 2);
        s->points[3 * v + 1] = (float)(v % 2);
    }
    for (int32_t f = 0; f < STRIP_FACES; ++f)
    {
        const int32_t corners[] = {2 * f, 2 * f + 2, 2 * f + 3, 2 * f + 1};

        s->face_first[f + 1] = 4 * (f + 1);
        s->face_cage[f] = f;
        memcpy(s->face_verts + 4 * f, corners, sizeof corners);
    }
    s->leaf = (otx_level){
        .face_count = STRIP_FACES,
        .vert_count = STRIP_VERTS,
        .corner_count = STRIP_CORNERS,
        .face_first = s->face_first,
        .face_verts = s->face_verts,
        .face_cage = s->face_cage,
        .face_hole = s->holes};
    s->cage = (otx_cage){.face_count = STRIP_FACES};
    s->surface = (otx_surface){
        .cage = &s->cage,
        .level_count = 1,
        .levels = &s->leaf,
        .points = s->points,
        .area = 4.0};
}

static inline void
strip_fragments(strip_pastes *s)
{
    const float unit = 1.0f / STRIP_SIDE;

    s->outline = strip_circle(7.0f);
    s->other = strip_circle(9.0f);
    /* Of one place of the exemplar, and of that and a width. */
    s->fragments[0] = (otx_fragment){
        .outline = &s->outline, .frame = {0.5f, 0.25f, unit, unit}};
    s->fragments[1] = (otx_fragment){
        .outline = &s->outline, .frame = {1.5f, 0.25f, unit, unit}};
    s->fragments[2] = (otx_fragment){
        .outline = &s->other, .frame = {0.25f, 0.5f, unit, unit}};
    s->fragments[3] = (otx_fragment){.patch = -1};
}

static inline strip_pastes *
strip_pastes_create(otx_run *run)
{
    strip_pastes *s = OTX_ZNEW(run->arena, strip_pastes, 1);
    const int32_t counts[] = {0, 2, 2, 3};

    s->run = run;
    strip_exemplar(s);
    strip_mesh(s);
    strip_fragments(s);
    for (int32_t f = 0; f < STRIP_FACES; ++f)
        s->item_first[f + 1] = s->item_first[f] + 4 * counts[f];
    strip_lookup(s->items, 0.0f, 0.0f, 3, 1.0f);
    strip_lookup(s->items + 4, 8.0f, 0.0f, 0, 1.0f);
    strip_lookup(s->items + 8, 16.0f, 0.0f, 3, 1.0f);
    strip_lookup(s->items + 12, 40.0f, 0.0f, 1, 1.0f);
    strip_lookup(s->items + 16, 0.0f, 16.0f, 3, 1.0f);
    strip_lookup(s->items + 20, 0.0f, 8.0f, 2, 0.0f);
    strip_lookup(s->items + 24, 10.0f, 2.0f, 0, 1.0f);
    s->lookups = (otx_lookups){
        .first = s->item_first,
        .items = s->items,
        .layering = OTX_LAYERING_OVER,
        .fragment_count = STRIP_FRAGMENTS,
        .fragments = s->fragments};
    s->mapping = (otx_mapping){
        .surface = &s->surface,
        .scale = 2.0,
        .uvs = s->uvs,
        .face_patch = s->patches,
        .patch_count = 1,
        .lookups = &s->lookups};
    return s;
}

#endif

/* light_map.h -- how much light reaches what the pixels show.
 *
 * Shadows and the sky that the model hides change slowly over a surface: a few
 * rays at the middle of each pixel, averaged over the pixels around it that
 * show the same piece of surface, find them with less noise than many rays in
 * each. */
#ifndef OTX_RENDER_LIGHT_MAP_H
#define OTX_RENDER_LIGHT_MAP_H

#include "render/shade.h"

/* What the middle of a pixel shows. */
typedef struct otx_light_texel
{
    float normal[3]; /* unit, to shade with */
    float depth;     /* along the camera's forward; 0: nothing is met */
    float key, sky;  /* see otx_light_known */
} otx_light_texel;

typedef struct otx_light_map
{
    int32_t width, height;
    otx_light_texel *texels; /* [width * height]; NULL: there is no map */
    uint8_t *covered;        /* blocks of the picture that anything is in */
    int32_t columns;         /* of blocks */
} otx_light_map;

enum
{
    OTX_LIGHT_MAP_BLOCK = 8 /* pixels of a block's side */
};

/* Finds which blocks may show the model and, where `rays`, what light reaches
 * them; in run->scratch. On all threads. MEMORY, CANCELLED. */
otx_status otx_light_map_make(
    otx_run *run, const otx_shade *shade, int32_t width, int32_t height,
    bool rays, otx_light_map *out);

/* Whether pixel (x, y) may show the model. */
static inline bool
otx_light_map_covers(const otx_light_map *map, int32_t x, int32_t y)
{
    return map->covered
               [(size_t)(y / OTX_LIGHT_MAP_BLOCK) * (size_t)map->columns +
                (size_t)(x / OTX_LIGHT_MAP_BLOCK)] != 0;
}

/* The light on a place that pixel (x, y) shows. False where too little of what
 * is around it is the same surface.
 *
 *   normal  unit, to shade with
 *   depth   along the camera's forward
 *   pixel   a pixel's side there, in the tracer's units */
bool otx_light_map_at(
    const otx_light_map *map, int32_t x, int32_t y, otx_vec3 normal,
    double depth, double pixel, otx_light_known *out);

#endif

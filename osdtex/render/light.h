/* light.h -- the fixed lighting of previews: a key from the upper left of the
 * camera and a sky, both softened by rays to the model itself. */
#ifndef OTX_RENDER_LIGHT_H
#define OTX_RENDER_LIGHT_H

#include "render/camera.h"
#include "render/gloss.h"
#include "render/tracer.h"

typedef struct otx_light
{
    const otx_tracer *tracer;
    otx_vec3 key;          /* unit, towards the light */
    otx_vec3 key_x, key_y; /* across it, as long as its disc is wide */
    bool shadows;
} otx_light;

/* A key that goes with the camera, so that every view is lit alike. */
otx_light otx_light_create(
    const otx_tracer *tracer, const otx_camera_frame *frame, bool shadows);

/* What is known of a place before a ray is sent: how much of the key's disc it
 * sees, and how much of the sky's light reaches it. */
typedef struct otx_light_known
{
    double key, sky;
} otx_light_known;

/* Which of its pixel's rays are sent. */
typedef struct otx_light_rays
{
    int32_t number, count;        /* this one of how many of the pixel */
    uint64_t key;                 /* of the pixel: what their pattern is turned
                                   * by */
    const otx_light_known *known; /* NULL: it is for the rays to find out */
} otx_light_rays;

/* What a place sends to the eye: of its colour, and by its gloss. */
typedef struct otx_lit
{
    double matte;
    otx_gloss gloss;
} otx_lit;

/* A place that is lit. */
typedef struct otx_light_place
{
    otx_vec3 at;     /* on the model, in the tracer's units */
    otx_vec3 face;   /* unit normal of the triangle, towards the eye */
    otx_vec3 normal; /* unit, to shade with */
    otx_vec3 eye;    /* unit, towards it */
    double roughness;
    double open; /* of the sky, that what no ray sees leaves: occlusion */
} otx_light_place;

/* The light on a place of a material. */
otx_lit otx_light_material(
    const otx_light *light, const otx_light_place *place,
    const otx_light_rays *rays);

/* How much light a white matte surface gives off, 1 being about as much as it
 * shows under the key.
 *
 *   at       on the model, in the tracer's units
 *   face     unit normal of the triangle, towards the eye
 *   normal   unit normal to shade with */
double otx_light_at(
    const otx_light *light, otx_vec3 at, otx_vec3 face, otx_vec3 normal,
    const otx_light_rays *rays);

/* What `count` rays of each kind find out at a place, numbered from 0; `key` as
 * above. */
otx_light_known otx_light_probe(
    const otx_light *light, otx_vec3 at, otx_vec3 face, otx_vec3 normal,
    int32_t count, uint64_t key);

/* Of an even sky's light on a place, what the model itself lets through: from
 * 0, none, to 1.
 *
 *   at      on the model, in the tracer's units
 *   normal  unit
 *   count   rays */
double otx_light_open(
    const otx_tracer *tracer, otx_vec3 at, otx_vec3 normal, int32_t count);

#endif

/* gloss.h -- how much a rough surface mirrors of a light.
 *
 * A microfacet surface: the distribution of [Trowbridge75], known as GGX, with
 * alpha the square of the roughness, the joint masking of [Heitz14],
 * Fresnel as [Schlick94] has it. What is mirrored is
 * F0 * facing + grazing, F0 the colour at normal incidence: .04 of what is no
 * metal, of metals their colour. */
#ifndef OTX_RENDER_GLOSS_H
#define OTX_RENDER_GLOSS_H

#include "math/vec.h"

typedef struct otx_gloss
{
    double facing, grazing;
} otx_gloss;

/* Of a light that a white matte surface which faces it would show as 1.
 *
 *   normal, to, eye  unit
 *   roughness        from 0 to 1; below .05 it is .05, or a light would be a
 *                    dot between the samples */
otx_gloss
otx_gloss_light(otx_vec3 normal, otx_vec3 to, otx_vec3 eye, double roughness);

/* Of a sky that is 1 everywhere, within .06 of the sum of all lights where
 * the eye is less than 60 degrees from the normal. */
otx_gloss otx_gloss_sky(otx_vec3 normal, otx_vec3 eye, double roughness);

/* The direction that stands for what is mirrored of a sky which is no darker
 * on one side than on another: the mirrored one of what is smooth, and what a
 * matte surface takes, two thirds of the normal, of what is rough. */
otx_vec3 otx_gloss_direction(otx_vec3 normal, otx_vec3 eye, double roughness);

#endif

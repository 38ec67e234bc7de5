/* embedding.h -- where the colours of an exemplar are compared.
 *
 * Raw hue cannot be compared by Euclidean distance: reds at 0.99 and 0.01 lie
 * at opposite ends, and grey has no hue at all. Each embedding maps a
 * display-like RGB in [0, 1] to a point of R^3 in which distance is
 * meaningful, so that every sum-of-squares search works on it unchanged. */
#ifndef OTX_COLOUR_EMBEDDING_H
#define OTX_COLOUR_EMBEDDING_H

#include "base/status.h"

typedef enum otx_embedding
{
    OTX_EMBEDDING_HSV_CONE,     /* (V S cos 2πH, V S sin 2πH, V) */
    OTX_EMBEDDING_HSV_CYLINDER, /* (S cos 2πH, S sin 2πH, V): noisy in the
                                 * dark, where S and H mean little */
    OTX_EMBEDDING_LAB,          /* CIELAB of the picture read as sRGB, D65 */
    OTX_EMBEDDING_RGB,          /* unchanged */
    OTX_EMBEDDING_COUNT
} otx_embedding;

/* "hsv", "hsv-cylinder", "lab", "rgb". */
const char *otx_embedding_name(otx_embedding embedding);

/* Embeds one display-like colour. Values outside [0, 1] are clamped. */
void
otx_embedding_map(otx_embedding embedding, const float rgb[3], float point[3]);

/* Compresses a scene-linear colour so that `peak`, the largest value of the
 * picture, comes to 1: highlights would otherwise dominate every distance, or
 * be lost to the clamp. The curve works on m = max(R, G, B), keeps hue, is
 * monotone and smooth, is the identity below the knee of 0.75, and is the
 * identity throughout when `peak` is at most 1. */
void otx_embedding_shape(float peak, const float linear[3], float shaped[3]);

/* The sRGB curve, for spaces that turn out to be linear: [0, 1] to [0, 1],
 * mirrored below zero. */
float otx_embedding_encode(float linear);
float otx_embedding_decode(float encoded);

#endif

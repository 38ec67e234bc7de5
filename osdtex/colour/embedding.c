/* embedding.c -- where the colours of an exemplar are compared.
 *
 * The cone is the default: it is the HSV that the paper asks for, and it is
 * continuous where raw HSV is not, at red, at grey and at black. */
#include "colour/embedding.h"

#include <math.h>

/* Below the knee, in scene-linear units, the shaper is the identity. */
static const float shape_knee = 0.75F;

static const char *const names[OTX_EMBEDDING_COUNT] = {
    [OTX_EMBEDDING_HSV_CONE] = "hsv",
    [OTX_EMBEDDING_HSV_CYLINDER] = "hsv-cylinder",
    [OTX_EMBEDDING_LAB] = "lab",
    [OTX_EMBEDDING_RGB] = "rgb",
};

const char *
otx_embedding_name(otx_embedding embedding)
{
    return (unsigned)embedding < OTX_EMBEDDING_COUNT ? names[embedding] : "";
}

/* (chroma cos, chroma sin, value), where chroma = max - min = V S.
 *
 * cos and sin of the hexagonal hue of [Smith78], but through its angle: hue is
 * piecewise linear in RGB, so the point is continuous wherever chroma is. */
static void
hsv_point(const float rgb[3], bool cone, float point[3])
{
    const float r = rgb[0];
    const float g = rgb[1];
    const float b = rgb[2];
    const float value = fmaxf(r, fmaxf(g, b));
    const float chroma = value - fminf(r, fminf(g, b));
    float sixth = 0.0F;

    point[0] = point[1] = 0.0F;
    point[2] = value;
    if (!(chroma > 0.0F))
        return;
    if (value == r)
        sixth = (g - b) / chroma;
    else if (value == g)
        sixth = 2.0F + (b - r) / chroma;
    else
        sixth = 4.0F + (r - g) / chroma;

    const float angle = sixth * (float)(OTX_PI / 3.0);
    const float radius = cone ? chroma : chroma / value;

    point[0] = radius * cosf(angle);
    point[1] = radius * sinf(angle);
}

/* The f of CIELAB [CIE 15, 8.2.1]. */
static float
lab_f(float t)
{
    if (t > 216.0F / 24389.0F)
        return cbrtf(t);
    return (24389.0F / 27.0F * t + 16.0F) / 116.0F;
}

static void
lab_point(const float rgb[3], float point[3])
{
    const float r = otx_embedding_decode(rgb[0]);
    const float g = otx_embedding_decode(rgb[1]);
    const float b = otx_embedding_decode(rgb[2]);
    /* Rec.709 to XYZ [IEC 61966-2-1], each row divided by the white's: the
     * rows add up to 1, so that grey has no colour at all. */
    const float x = lab_f(0.4339530F * r + 0.3762195F * g + 0.1898275F * b);
    const float y = lab_f(0.2126729F * r + 0.7151522F * g + 0.0721749F * b);
    const float z = lab_f(0.0177578F * r + 0.1094770F * g + 0.8727652F * b);

    point[0] = 116.0F * y - 16.0F;
    point[1] = 500.0F * (x - y);
    point[2] = 200.0F * (y - z);
}

void
otx_embedding_map(otx_embedding embedding, const float rgb[3], float point[3])
{
    float c[3];

    for (int k = 0; k < 3; ++k)
        c[k] = fminf(fmaxf(rgb[k], 0.0F), 1.0F);
    switch (embedding)
    {
    case OTX_EMBEDDING_LAB:
        lab_point(c, point);
        return;
    case OTX_EMBEDDING_RGB:
    case OTX_EMBEDDING_COUNT:
        point[0] = c[0];
        point[1] = c[1];
        point[2] = c[2];
        return;
    case OTX_EMBEDDING_HSV_CYLINDER:
        hsv_point(c, false, point);
        return;
    case OTX_EMBEDDING_HSV_CONE:
        hsv_point(c, true, point);
        return;
    }
}

/* With t = (m - knee) / (1 - knee) and w the same of the peak:
 *
 *     m' = knee + (1 - knee) t (1 + t / w^2) / (1 + t)   [Reinhard02, eq. 4]
 *
 * whose slope at the knee is 1, which takes the peak to 1, and which is the
 * identity for w = 1, so that a picture just past 1 hardly changes. */
void
otx_embedding_shape(float peak, const float linear[3], float shaped[3])
{
    const float m = fmaxf(linear[0], fmaxf(linear[1], linear[2]));
    float scale = 1.0F;

    if (peak > 1.0F && m > shape_knee)
    {
        const float room = 1.0F - shape_knee;
        const float t = (m - shape_knee) / room;
        const float w = (peak - shape_knee) / room;

        scale = (shape_knee + room * t * (1.0F + t / w / w) / (1.0F + t)) / m;
    }
    for (int k = 0; k < 3; ++k)
        shaped[k] = linear[k] * scale;
}

/* [IEC 61966-2-1]. */
float
otx_embedding_encode(float linear)
{
    const float x = fabsf(linear);
    const float y =
        x <= 0.0031308F ? 12.92F * x : 1.055F * powf(x, 1.0F / 2.4F) - 0.055F;

    return copysignf(y, linear);
}

float
otx_embedding_decode(float encoded)
{
    const float x = fabsf(encoded);
    const float y =
        x <= 0.04045F ? x / 12.92F : powf((x + 0.055F) / 1.055F, 2.4F);

    return copysignf(y, encoded);
}

/* tint.c -- palettes. */
#include "render/tint.h"

#include "base/random.h"

#include <math.h>

static void
mix(const float a[3], const float b[3], double t, float rgb[3])
{
    for (int32_t c = 0; c < 3; ++c)
        rgb[c] = (float)(a[c] + t * (b[c] - a[c]));
}

/* One channel of a hue circle that is a cosine: no banding at the primaries
 * and sums that are alike for all hues. */
static float
hue_channel(double hue, double shift, double base, double swing)
{
    return (
        float)(base * (1.0 + swing * cos(2.0 * 3.14159265358979 * (hue - shift))));
}

void
otx_tint_patch(int32_t index, float rgb[3])
{
    /* The golden section spreads any run of numbers over the circle. */
    const double hue = fmod(0.11 + 0.61803398875 * index, 1.0);
    const double jitter = otx_random_unit(0, 0, (uint64_t)index);
    const double base = 0.20 + 0.28 * jitter;
    const double swing = 0.85 - 0.35 * jitter;

    for (int32_t c = 0; c < 3; ++c)
        rgb[c] = index < 0 ? 0.18f : hue_channel(hue, c / 3.0, base, swing);
}

void
otx_tint_stretch(double stretch, float rgb[3])
{
    static const float BLUE[3] = {0.02f, 0.09f, 0.55f};
    static const float WHITE[3] = {0.62f, 0.62f, 0.62f};
    static const float RED[3] = {0.60f, 0.03f, 0.02f};
    static const float BROKEN[3] = {0.80f, 0.0f, 0.80f};
    const double steps = log(stretch) / log(OTX_TINT_STRETCH_FULL);

    if (!isfinite(steps))
        mix(BROKEN, BROKEN, 0.0, rgb);
    else if (steps < 0.0)
        mix(WHITE, BLUE, fmin(1.0, -steps), rgb);
    else
        mix(WHITE, RED, fmin(1.0, steps), rgb);
}

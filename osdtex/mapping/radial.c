/* radial.c -- a mask that is an outline as seen from its middle. */
#include "mapping/radial.h"

static const double TAU = 6.283185307179586;

double
otx_radial_at(const otx_radial *radial, otx_vec2 direction)
{
    const double turn = atan2(direction.y, direction.x) / TAU;
    const double at = (turn - floor(turn)) * OTX_RADIAL_ANGLES;
    const int32_t i = (int32_t)at;
    const double t = at - i;

    return (1.0 - t) * (double)radial->radius[i % OTX_RADIAL_ANGLES] +
           t * (double)radial->radius[(i + 1) % OTX_RADIAL_ANGLES];
}

void
otx_radial_bound(otx_radial *radial)
{
    radial->least = radial->most = radial->radius[0];
    for (int32_t i = 1; i < OTX_RADIAL_ANGLES; ++i)
    {
        radial->least = fminf(radial->least, radial->radius[i]);
        radial->most = fmaxf(radial->most, radial->radius[i]);
    }
}

/* The slope is as wide as the feather, or as the filter where that is wider;
 * its middle stays. Most places are far from it on either side. */
double
otx_radial_alpha(const otx_radial *radial, otx_vec2 at, double width)
{
    const double feather = (double)radial->feather;
    const double slope = fmax(fmax(feather, width), 1e-6);
    const double middle = otx_vec2_length(at) + 0.5 * feather;

    if (middle <= (double)radial->least - 0.5 * slope)
        return 1.0;
    if (middle >= (double)radial->most + 0.5 * slope)
        return 0.0;

    const double inside = (otx_radial_at(radial, at) - middle) / slope;

    return fmin(fmax(0.5 + inside, 0.0), 1.0);
}

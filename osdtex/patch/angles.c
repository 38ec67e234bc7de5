/* angles.c -- how a patch may be turned. */
#include "patch/angles.h"
#include "patch/continuation.h"
#include "patch/follow.h"

#include "base/random.h"

/* Degrees about the continuing orientation that are left out where exact
 * continuation is to be avoided: on what is flat it would always win, and the
 * picture repeat itself. */
static const double AVOIDED = 5.0;

/* From -drift to drift as `share` goes from 0 to 1, but for what is avoided. */
static double
offset_of(const otx_patch_settings *s, double drift, double share)
{
    const double avoided =
        s->continuation ? 0.0 : fmin(AVOIDED * OTX_PI / 180.0, 0.5 * drift);
    const double x = 2.0 * share - 1.0;

    return copysign(avoided, x) + x * (drift - avoided);
}

/* Orientations to search, into angles[360]; how many. Drawn at random, so that
 * the exact continuation of a single neighbour is not among them unless it is
 * wanted [Soler02, sec. 4.2]; within `drift` of what continues the neighbours,
 * so that the first patch's direction spreads. */
int32_t
otx_angles_list(
    const otx_mosaic *m, int32_t index, const otx_mask *mask, double *angles)
{
    const otx_node *node = &m->forest.nodes[index];
    const otx_supply *supply = otx_supply_of(m, node);
    const otx_patch_settings *s = &supply->settings;
    const double continuing = otx_continuation_angle(mask);
    const double chance = otx_random_unit(
        m->job.run->seed, OTX_ANGLES_DRAW, (uint64_t)index * 64u);
    const double drift = s->drift * OTX_PI / 180.0;

    if (supply->guide)
        return otx_follow_angles(m, node, continuing, angles);
    for (int32_t k = 0; k < s->angles; ++k)
        if (drift >= OTX_PI)
            angles[k] = (s->continuation ? continuing : 2.0 * OTX_PI * chance) +
                        2.0 * OTX_PI * k / s->angles;
        else
            angles[k] = continuing +
                        offset_of(
                            s, drift,
                            (k + (s->continuation ? 0.5 : chance)) / s->angles);
    return s->angles;
}

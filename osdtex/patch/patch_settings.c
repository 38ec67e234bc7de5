/* patch_settings.c -- what "auto" comes to. */
#include "patch/patch_settings.h"

#include <math.h>

/* Halvings that leave the shorter side at about 64 texels: the search there
 * finds the same matches as at full resolution for a fraction of the time. */
static int32_t
coarse_levels(const otx_exemplar *exemplar)
{
    int32_t side = exemplar->match.width < exemplar->match.height
                       ? exemplar->match.width
                       : exemplar->match.height;
    int32_t levels = 0;

    for (; side / 2 >= 56; side /= 2)
        ++levels;
    return levels;
}

/* Large patches carry the exemplar's structure and have few seams; beyond
 * this share of the exemplar's shorter side there is too little choice left of
 * where to take them from. */
static double
patch_size(const otx_exemplar *exemplar)
{
    return 0.65 * fmin(exemplar->match.width, exemplar->match.height);
}

/* Seams do not show while they stay below the exemplar's own contrast between
 * adjacent texels. */
static double
visible_error(const otx_exemplar *exemplar)
{
    const double contrast = exemplar->match_sigma > 0.0
                                ? exemplar->match_step / exemplar->match_sigma
                                : 0.0;

    return fmin(fmax(contrast, 0.15), 0.45);
}

static void
choose(int32_t *setting, bool paper, int32_t of_paper, int32_t of_best)
{
    if (*setting == OTX_PATCH_AUTO)
        *setting = paper ? of_paper : of_best;
}

void
otx_patch_adapt(
    otx_patch_settings *s, const otx_exemplar *first,
    const otx_exemplar *exemplar)
{
    if (s->patch == patch_size(first))
        s->patch = patch_size(exemplar);
    if (s->coarse == coarse_levels(first))
        s->coarse = coarse_levels(exemplar);
    if (s->tau == visible_error(first))
        s->tau = visible_error(exemplar);
}

/* A plain mesh has no subdivision: its hierarchy is grown, as the paper's is
 * on meshes [Soler02, sec. 3.1]. */
static bool
is_plain(const otx_cage *cage)
{
    return cage && cage->scheme == OTX_SCHEME_NONE;
}

void
otx_patch_resolve(
    otx_patch_settings *s, const otx_exemplar *exemplar, const otx_cage *cage)
{
    const bool paper = s->mode == OTX_PATCH_PAPER;

    choose(
        &s->clusters, paper && !is_plain(cage), OTX_PATCH_SUBDIVISION,
        OTX_PATCH_GROWN);
    choose(&s->flatten, paper, OTX_PATCH_RECURSIVE, OTX_PATCH_JOINT);
    choose(&s->cut, paper, OTX_PATCH_OFF, OTX_PATCH_ON);
    choose(&s->relax, paper, OTX_PATCH_RELAX_LOOP, OTX_PATCH_RELAX_GLOBAL);
    if (paper)
        s->guide = OTX_PATCH_OFF;
    if (s->drift == 0.0)
        s->drift = paper ? 180.0 : 25.0;
    if (s->angles == 0)
        s->angles = s->drift < 90.0 ? 9 : 19;
    if (s->edges < 0.0)
        s->edges = paper ? 0.0 : 0.7;
    if (s->usage < 0.0)
        s->usage = paper ? 0.0 : 0.5;
    /* The cut takes over the ends of a bent patch, relaxation evens it out: of
     * eight pairs, 1.12 had a fifth more fits, and the same seams and stretch
     * (1.0507 instead of 1.0516). */
    if (s->flatness == 0.0)
        s->flatness = paper ? 1.12 : 1.2;
    if (s->coarse < 0)
        s->coarse = paper ? 0 : coarse_levels(exemplar);
    if (s->patch == 0.0)
        s->patch = patch_size(exemplar);
    /* Splitting trades few strong seams for many mild ones and leaves their
     * sum as it was; the cut lowers the sum, so best mode hardly ever splits
     * for error. */
    if (s->tau == 0.0)
        s->tau = paper ? visible_error(exemplar) : 10.0;
}

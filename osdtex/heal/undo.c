/* undo.c -- sections that mending has not helped, as they were cut. */
#include "heal/undo.h"

#include <string.h>

static int64_t
texels_of(const otx_target_set *set, int32_t k)
{
    return set->territory.exemplar[k] == set->exemplar && set->targets[k].kinds
               ? (int64_t)set->plots[k].width * set->plots[k].height
               : 0;
}

otx_status
otx_undo_keep(
    const otx_target_set *set, const uint8_t *undone, double reach,
    otx_undo *out)
{
    otx_arena *arena = set->run->scratch;
    const int32_t count = set->territory.count;

    *out = (otx_undo){
        OTX_ZNEW(arena, uint8_t *, count), OTX_ZNEW(arena, uint8_t *, count),
        OTX_ZNEW(arena, otx_synth_match *, count)};
    OTX_TRY(otx_run_ok(set->run));
    for (int32_t k = 0; k < count; ++k)
    {
        const int64_t n = texels_of(set, k);
        otx_plot around = set->plots[k];

        out->again[k] = around.near = OTX_ZNEW(arena, uint8_t, n);
        out->kinds[k] = OTX_NEW(arena, uint8_t, n);
        out->matches[k] = OTX_NEW(arena, otx_synth_match, n);
        OTX_TRY(otx_run_ok(set->run));
        if (n == 0)
            continue;
        otx_plot_mark(set->mapping->surface, undone, reach, &around);
        memcpy(out->kinds[k], set->targets[k].kinds, (size_t)n);
        memcpy(
            out->matches[k], set->targets[k].matches,
            (size_t)n * sizeof *out->matches[k]);
    }
    return OSDTEX_OK;
}

/* Whether the owner of a collar's texel makes it again. */
static bool
is_made_again(
    const otx_target_set *set, const otx_undo *kept,
    const otx_synth_place *place)
{
    return kept
        ->again[place->chart]
               [(int64_t)floorf(place->y) * set->plots[place->chart].width +
                (int64_t)floorf(place->x)];
}

void
otx_undo_freeze(otx_target_set *set, const otx_undo *kept)
{
    const int32_t count = set->territory.count;

    for (int32_t k = 0; k < count; ++k)
        for (int64_t i = 0; i < texels_of(set, k); ++i)
            if (set->targets[k].kinds[i] == OTX_SYNTH_FREE &&
                kept->kinds[k][i] == OTX_SYNTH_FREE)
                set->targets[k].matches[i] = kept->matches[k][i];
    for (int32_t k = 0; k < count; ++k)
        if (texels_of(set, k) > 0)
            otx_target_read_collar(set, k);
    for (int32_t k = 0; k < count; ++k)
    {
        otx_target *t = &set->targets[k];

        t->free = texels_of(set, k) > 0 ? 0 : t->free;
        for (int64_t i = 0; i < texels_of(set, k); ++i)
        {
            if ((t->kinds[i] == OTX_SYNTH_FREE && !kept->again[k][i]) ||
                (t->kinds[i] == OTX_SYNTH_COLLAR &&
                 !is_made_again(set, kept, &t->places[i])))
            {
                kept->kinds[k][i] = t->kinds[i];
                t->kinds[i] = OTX_SYNTH_FROZEN;
            }
            else
                kept->kinds[k][i] = OTX_SYNTH_VOID;
            t->free += t->kinds[i] == OTX_SYNTH_FREE;
        }
    }
}

void
otx_undo_thaw(otx_target_set *set, const otx_undo *kept)
{
    for (int32_t k = 0; k < set->territory.count; ++k)
    {
        otx_target *t = &set->targets[k];

        for (int64_t i = 0; i < texels_of(set, k); ++i)
            if (kept->kinds[k][i] != OTX_SYNTH_VOID)
            {
                t->kinds[i] = kept->kinds[k][i];
                t->free += t->kinds[i] == OTX_SYNTH_FREE;
            }
    }
}

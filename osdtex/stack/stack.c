/* stack.c -- stretch by stretch. */
#include "stack/stack.h"

#include "stack/mixture.h"
#include "stack/slices.h"

#include <string.h>

enum
{
    CLEAN = 24, /* texels of a picture of 256 x 256 */
    SIDE = 256
};

#define MASK_WEIGHT 4.0
#define ANCHOR 0.8

static const char STAGE[] = "stack";

static int32_t
clean_of(const otx_exemplar *exemplar)
{
    const double texels =
        (double)exemplar->lab.width * (double)exemplar->lab.height;
    const double least = CLEAN * texels / (SIDE * SIDE);

    return least < 8.0 ? 8 : least > 1e6 ? 1000000 : (int32_t)least;
}

/* A key remade under the masks of a stretch, from its own end on. */
static otx_status
remake(
    otx_run *run, const otx_stack_key *key, const otx_morph *morph, bool back,
    uint64_t seed, int32_t **out)
{
    const int32_t last = morph->slices - 1;
    const uint8_t **masks =
        OTX_NEW(run->scratch, const uint8_t *, morph->slices);
    int32_t **made = OTX_NEW(run->scratch, int32_t *, morph->slices);
    otx_slices_input input = {
        .lab = &key->exemplar->lab,
        .masks = masks,
        .count = last, /* at the other end it has no weight */
        .mask_weight = MASK_WEIGHT,
        .anchor = ANCHOR,
        .seed = seed};

    OTX_TRY(otx_run_ok(run));
    for (int32_t m = 0; m <= last; ++m)
        masks[m] = morph->masks[back ? last - m : m];
    OTX_TRY(otx_slices_make(run, &input, made));
    out[back ? 0 : last] = NULL;
    for (int32_t m = 0; m < last; ++m)
        out[back ? last - m : m] = made[m];
    return OSDTEX_OK;
}

/* Which channels of the maps are no matter of contrast: how far normals point
 * up follows from the other two. */
static uint32_t
plain_maps(const otx_companions *maps)
{
    const otx_companion *normal = &maps->maps[OTX_COMPANION_NORMAL];

    return normal->is_there ? 4u << normal->first : 0u;
}

static otx_status
mix_slice(otx_run *run, const otx_stack_key *keys, otx_stack_slice *slice)
{
    const otx_exemplar *from = keys[slice->keys[0]].exemplar;
    const otx_exemplar *to = keys[slice->keys[1]].exemplar;
    otx_mixture mixture = {
        .from = &from->linear,
        .to = &to->linear,
        .from_texels = slice->texels[0],
        .to_texels = slice->texels[1],
        .weight = slice->weight,
        .plain = 8u,
        .as_seen = true};

    OTX_TRY(otx_mixture_make(run, &mixture, &slice->linear));
    if (!otx_companions_are_there(&from->companions))
        return OSDTEX_OK;
    mixture.from = &from->companions.image;
    mixture.to = &to->companions.image;
    mixture.plain = plain_maps(&from->companions);
    mixture.bounded = true;
    mixture.as_seen = false;
    return otx_mixture_make(run, &mixture, &slice->maps);
}

/* Slices first to first + slices - 1 lie between keys k and k + 1. */
static otx_status
make_stretch(
    otx_run *run, const otx_stack_key *keys, int32_t k,
    const otx_stack_options *options, otx_stack *out)
{
    const int32_t last = options->slices - 1;
    int32_t **near = OTX_NEW(run->scratch, int32_t *, options->slices);
    int32_t **far = OTX_NEW(run->scratch, int32_t *, options->slices);
    otx_morph *morph = &out->morphs[k];
    const otx_morph_options how = {
        .kind = options->morph,
        .slices = options->slices,
        .clean = clean_of(keys[k].exemplar)};

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_morph_make(
        run, keys[k].mask, keys[k + 1].mask, out->width, out->height, &how,
        morph));
    OTX_TRY(remake(run, &keys[k], morph, false, options->seed, near));
    OTX_TRY(remake(run, &keys[k + 1], morph, true, options->seed + SIDE, far));
    for (int32_t m = k > 0; m <= last; ++m)
    {
        otx_stack_slice *slice = &out->slices[k * last + m];

        *slice = (otx_stack_slice){
            .position = (double)(k * last + m) / (out->count - 1),
            .keys = {k, k + 1},
            .weight = (double)m / last,
            .mask = morph->masks[m],
            .texels = {near[m], far[m]}};
        OTX_TRY(mix_slice(run, keys, slice));
    }
    return OSDTEX_OK;
}

static otx_status
check(
    otx_run *run, const otx_stack_key *keys, int32_t key_count,
    const otx_stack_options *options)
{
    const otx_exemplar *first = keys[0].exemplar;

    if (key_count < 2 || options->slices < 2)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a stack goes from one picture to another, by 2 slices or more");
    for (int32_t k = 1; k < key_count; ++k)
    {
        const otx_exemplar *e = keys[k].exemplar;

        if (e->linear.width != first->linear.width ||
            e->linear.height != first->linear.height ||
            e->linear.channels != first->linear.channels)
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(e->source_path),
                "the picture has %d x %d texels and %d channels, the first "
                "one %d x %d and %d",
                e->linear.width, e->linear.height, e->linear.channels,
                first->linear.width, first->linear.height,
                first->linear.channels);
    }
    return OSDTEX_OK;
}

otx_status
otx_stack_make(
    otx_run *run, const otx_stack_key *keys, int32_t key_count,
    const otx_stack_options *options, otx_stack *out)
{
    OTX_TRY(check(run, keys, key_count, options));
    *out = (otx_stack){
        .width = keys[0].exemplar->linear.width,
        .height = keys[0].exemplar->linear.height,
        .count = (key_count - 1) * (options->slices - 1) + 1};
    out->slices = OTX_ZNEW(run->arena, otx_stack_slice, out->count);
    out->morphs = OTX_ZNEW(run->arena, otx_morph, key_count - 1);
    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k + 1 < key_count; ++k)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);

        OTX_TRY(make_stretch(run, keys, k, options, out));
        otx_arena_release(run->scratch, mark);
    }
    return OSDTEX_OK;
}

otx_status
otx_stack_vary(
    otx_run *run, const otx_stack_key *key, const otx_stack_options *options,
    otx_stack *out)
{
    const int32_t count = options->slices;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t **made = OTX_NEW(run->scratch, int32_t *, count);
    const otx_slices_input input = {
        .lab = &key->exemplar->lab,
        .masks = &key->mask,
        .count = count,
        .mask_weight = MASK_WEIGHT,
        .seed = options->seed};

    *out = (otx_stack){
        .width = key->exemplar->linear.width,
        .height = key->exemplar->linear.height,
        .count = count,
        .slices = OTX_ZNEW(run->arena, otx_stack_slice, count)};
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_slices_vary(run, &input, made));
    for (int32_t m = 0; m < count; ++m)
    {
        out->slices[m] = (otx_stack_slice){
            .position = (double)m / (count - 1),
            .mask = key->mask,
            .texels = {made[m], NULL}};
        OTX_TRY(mix_slice(run, key, &out->slices[m]));
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

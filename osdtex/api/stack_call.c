/* stack_call.c -- making stacks. */
#include "api/call.h"
#include "api/exemplar_slices.h"
#include "api/handle.h"
#include "api/stack_maps.h"
#include "api/stack_measure.h"
#include "export/stack_file.h"
#include "stack/feature_mask.h"
#include "stack/stack.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char STAGE[] = "stack";

/* What is made, on its way. */
typedef struct work
{
    otx_run *run;
    osdtex_stack_options options;
    int32_t count;
    otx_exemplar exemplars[OSDTEX_STACK_KEYS_MAX]; /* of one size */
    otx_stack_key keys[OSDTEX_STACK_KEYS_MAX];
    otx_feature_mask masks[OSDTEX_STACK_KEYS_MAX];
    otx_feature_kind feature;
    otx_stack stack;
} work;

static otx_status
check(
    otx_run *run, const osdtex_exemplar *const *keys, int32_t key_count,
    const char *path, const osdtex_stack_options *o)
{
    if (!keys || !path || key_count < (o->vary ? 1 : 2) ||
        key_count > (o->vary ? 1 : OSDTEX_STACK_KEYS_MAX))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a stack is made of 2 to %d pictures, or of 1 to {vary}, and has a "
            "path",
            OSDTEX_STACK_KEYS_MAX);
    if (o->slices < 2 || o->slices > OSDTEX_STACK_SLICES_MAX || o->width < 0 ||
        o->morph < OSDTEX_MORPH_AUTO || o->morph > OSDTEX_MORPH_LINEAR ||
        o->feature < OSDTEX_FEATURE_AUTO || o->feature > OSDTEX_FEATURE_JOINTS)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "slices (2 to %d), width, morph or feature is none of the values "
            "of stack.h",
            OSDTEX_STACK_SLICES_MAX);
    for (int32_t k = 0; k < key_count; ++k)
    {
        const osdtex_exemplar *key = keys[k];

        if (!key)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "picture %d of the stack is not given", k + 1);
        if (key->exemplar.tiles.cell > 0 || !key->exemplar.wrap_x ||
            !key->exemplar.wrap_y)
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE,
                otx_where_file(key->exemplar.source_path),
                "the pictures of a stack tile in both axes, and this one does "
                "not; make it to: {tileable}=make");
    }
    return OSDTEX_OK;
}

/* Brings a picture to the size of the slices. */
static otx_status
fit(work *w, int32_t k, const otx_exemplar *from)
{
    const otx_image *first = &w->exemplars[0].linear;
    int32_t width = first->width, height = first->height;

    if (k == 0)
    {
        width = w->options.width > 0 ? w->options.width : from->linear.width;
        height =
            (int32_t)((double)from->linear.height * width / from->linear.width + 0.5);
    }
    if (width == from->linear.width && height == from->linear.height &&
        from->lab.width == width && from->lab.height == height &&
        (!otx_companions_are_there(&from->companions) ||
         from->companions.image.width == width))
    {
        w->exemplars[k] = *from;
        return OSDTEX_OK;
    }
    if (k > 0 && from->linear.width != width)
        otx_note(
            w->run, OSDTEX_SEVERITY_INFO, STAGE,
            otx_where_file(from->source_path),
            "the picture is scaled from %d x %d to %d x %d texels, the size of "
            "the slices",
            from->linear.width, from->linear.height, width, height);
    return otx_exemplar_rescale(w->run, from, width, height, &w->exemplars[k]);
}

/* The mask that was given, looked up at the middles of texels. */
static otx_status
take_mask(work *w, int32_t k, const osdtex_image *given)
{
    const otx_image *from = &given->image;
    const otx_image *to = &w->exemplars[k].linear;
    const double skew =
        (double)from->width * to->height - (double)from->height * to->width;
    uint8_t *texels =
        OTX_NEW(w->run->arena, uint8_t, (int64_t)to->width * to->height);

    OTX_TRY(otx_run_ok(w->run));
    if (skew > 0.02 * from->width * to->height ||
        skew < -0.02 * from->width * to->height)
        return otx_fail(
            w->run, OSDTEX_ERROR_FORMAT, STAGE,
            otx_where_file(w->exemplars[k].source_path),
            "the mask has %d x %d texels, which is another shape than the "
            "picture's %d x %d",
            from->width, from->height, to->width, to->height);
    for (int32_t y = 0; y < to->height; ++y)
        for (int32_t x = 0; x < to->width; ++x)
        {
            const float *v = otx_image_at(
                from, (int32_t)((x + 0.5) * from->width / to->width),
                (int32_t)((y + 0.5) * from->height / to->height));
            const float mean =
                from->channels < 3 ? v[0] : (v[0] + v[1] + v[2]) / 3.0f;

            texels[(ptrdiff_t)y * to->width + x] = mean > 0.5f;
        }
    w->masks[k] = (otx_feature_mask){texels, 0.0, 1.0};
    w->masks[k].share =
        otx_feature_mask_share(texels, (int64_t)to->width * to->height);
    return OSDTEX_OK;
}

static otx_status
align_maps(work *w)
{
    const otx_image *first = &w->exemplars[0].linear;
    otx_stack_maps sets[OSDTEX_STACK_KEYS_MAX];

    for (int32_t k = 0; k < w->count; ++k)
        sets[k] = (otx_stack_maps){
            &w->exemplars[k].companions, w->exemplars[k].source_path};
    return otx_stack_maps_align(
        w->run, sets, w->count, first->width, first->height);
}

static bool
is_given(const work *w, int32_t k)
{
    return w->options.masks && w->options.masks[k];
}

/* Finds one kind of feature in all pictures without a mask; how clear it is. */
static otx_status
find_masks(
    work *w, otx_feature_kind feature, otx_feature_mask *masks, double *clarity)
{
    *clarity = 0.0;
    for (int32_t k = 0; k < w->count; ++k)
        if (!is_given(w, k))
        {
            OTX_TRY(otx_feature_mask_find(
                w->run, &w->exemplars[k].lab, feature, &masks[k]));
            *clarity += masks[k].clarity;
        }
    return OSDTEX_OK;
}

/* The minority phase is the feature: where masks are given, in all pictures
 * alike. */
static void
turn_masks(work *w)
{
    const int64_t texels =
        (int64_t)w->exemplars[0].lab.width * w->exemplars[0].lab.height;
    double share = 0.0;

    for (int32_t k = 0; k < w->count; ++k)
        share += w->masks[k].share / w->count;
    for (int32_t k = 0; k < w->count && share > 0.5; ++k)
    {
        for (int64_t i = 0; i < texels; ++i)
            w->masks[k].texels[i] = !w->masks[k].texels[i];
        w->masks[k].share = 1.0 - w->masks[k].share;
    }
}

static otx_status
choose_masks(work *w)
{
    otx_feature_mask spots[OSDTEX_STACK_KEYS_MAX],
        joints[OSDTEX_STACK_KEYS_MAX];
    const osdtex_feature asked = w->options.feature;
    double spot = 0.0, joint = 0.0;

    if (asked != OSDTEX_FEATURE_JOINTS)
        OTX_TRY(find_masks(w, OTX_FEATURE_SPOTS, spots, &spot));
    if (asked != OSDTEX_FEATURE_SPOTS)
        OTX_TRY(find_masks(w, OTX_FEATURE_JOINTS, joints, &joint));
    w->feature = joint > spot ? OTX_FEATURE_JOINTS : OTX_FEATURE_SPOTS;
    for (int32_t k = 0; k < w->count; ++k)
    {
        if (is_given(w, k))
            OTX_TRY(take_mask(w, k, w->options.masks[k]));
        else
            w->masks[k] = joint > spot ? joints[k] : spots[k];
    }
    turn_masks(w);
    for (int32_t k = 0; k < w->count; ++k)
        w->keys[k] = (otx_stack_key){&w->exemplars[k], w->masks[k].texels};
    return OSDTEX_OK;
}

static otx_status
write_files(work *w, const char *path)
{
    otx_run *run = w->run;
    const size_t stem = strlen(path) - strlen(".exr");
    otx_stack_page *pages =
        OTX_NEW(run->scratch, otx_stack_page, w->stack.count);
    otx_atomic_file_set *set;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < w->stack.count; ++i)
    {
        const otx_stack_slice *slice = &w->stack.slices[i];

        pages[i] = (otx_stack_page){
            &slice->linear, &slice->maps, slice->mask, slice->position};
    }
    OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    OTX_TRY(otx_stack_file_write(
        run, set, path, &w->exemplars[0], pages, w->stack.count));
    for (int32_t k = 0; k < w->count; ++k)
    {
        const size_t bytes = stem + sizeof "_mask00.png";
        char *name = OTX_NEW(run->scratch, char, bytes);

        OTX_TRY(otx_run_ok(run));
        snprintf(name, bytes, "%.*s_mask%d.png", (int)stem, path, k + 1);
        OTX_TRY(otx_stack_file_write_mask(
            run, set, name, w->masks[k].texels, w->stack.width,
            w->stack.height));
    }
    return otx_atomic_file_commit(run, set, true);
}

static void
tell(const work *w, osdtex_stack_info *out)
{
    *out = (osdtex_stack_info){
        .slice_count = w->stack.count,
        .width = w->stack.width,
        .height = w->stack.height,
        .morph = w->stack.morphs ? (osdtex_morph)w->stack.morphs[0].kind
                                 : OSDTEX_MORPH_AUTO,
        .flips = 1.0,
        .feature = w->feature == OTX_FEATURE_JOINTS ? OSDTEX_FEATURE_JOINTS
                                                    : OSDTEX_FEATURE_SPOTS};
    for (int32_t k = 0; k + 1 < w->count; ++k)
    {
        const otx_morph *m = &w->stack.morphs[k];
        const double ratio =
            m->flips_mean > 0.0 ? (double)m->flips_most / m->flips_mean : 1.0;

        out->flips = ratio > out->flips ? ratio : out->flips;
    }
    for (int32_t k = 0; k < w->count; ++k)
        out->mask_share[k] = w->masks[k].share;
}

static otx_status
write_stack(
    otx_call *call, const osdtex_exemplar *const *keys, int32_t key_count,
    const osdtex_stack_options *options, const char *path,
    osdtex_stack_info *out)
{
    otx_run *run = &call->run;
    work *w = OTX_ZNEW(run->arena, work, 1);
    otx_stack_options how;
    size_t length;

    OTX_TRY(otx_run_ok(run));
    w->run = run;
    w->options = osdtex_stack_options_default();
    OTX_TRY(otx_call_options(run, &w->options, sizeof w->options, options));
    OTX_TRY(check(run, keys, key_count, path, &w->options));
    length = strlen(path);
    if (length < 5 || strcasecmp(path + length - 4, ".exr") != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, otx_where_file(path),
            "a stack is written as NAME.exr");
    w->count = key_count;
    run->seed = w->options.seed;
    for (int32_t k = 0; k < key_count; ++k)
        OTX_TRY(fit(w, k, &keys[k]->exemplar));
    OTX_TRY(align_maps(w));
    OTX_TRY(choose_masks(w));
    how = (otx_stack_options){
        .slices = w->options.slices,
        .morph = (otx_morph_kind)w->options.morph,
        .seed = w->options.seed};
    OTX_TRY(
        w->options.vary
            ? otx_stack_vary(run, w->keys, &how, &w->stack)
            : otx_stack_make(run, w->keys, key_count, &how, &w->stack));
    OTX_TRY(otx_stack_measure(call, &w->stack, w->keys, w->options.figures));
    OTX_TRY(write_files(w, path));
    if (out)
        tell(w, out);
    return OSDTEX_OK;
}

uint32_t
osdtex_stack_maps(const char *path)
{
    uint32_t kinds = 0;
    otx_slice_maps maps;

    if (!path || otx_exr_slice_count(path) == 0)
        return 0;
    otx_exemplar_slices_maps(path, 0, &maps);
    for (int32_t i = 0; i < maps.count; ++i)
        kinds |= 1u << maps.list[i].kind;
    return kinds;
}

osdtex_status
osdtex_stack_write(
    osdtex_context *context, const osdtex_exemplar *const *keys,
    int32_t key_count, const osdtex_stack_options *options, const char *path,
    osdtex_stack_info *out)
{
    otx_call call;

    if (out)
        *out = (osdtex_stack_info){0};
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_drop(
        &call, write_stack(&call, keys, key_count, options, path, out));
}

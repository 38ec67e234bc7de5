/* stack_measure.c -- slices as they are seen, and their figures. */
#include "api/stack_measure.h"

#include "stack/slice_figures.h"

#include <string.h>

/* Lab of what is written. What is decided about its colours was said of the
 * keys: `run` keeps it to itself. */
static otx_status
see_slices(
    otx_run *run, const otx_colour *colour, const otx_stack *stack,
    const otx_exemplar *like, otx_exemplar *out)
{
    for (int32_t i = 0; i < stack->count; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const otx_exemplar_input input = {
            .pixels = stack->slices[i].linear,
            .alpha_is_premultiplied = true,
            .source = {.from = like->linear_space, .is_float = true},
            .to = like->linear_space,
            .wrap = OTX_EXEMPLAR_WRAP_YES};

        OTX_TRY(otx_exemplar_build(run, colour, &input, &out[i]));
        otx_arena_release(run->scratch, mark);
    }
    return OSDTEX_OK;
}

static otx_status
measure(
    otx_call *call, otx_run *run, const otx_stack *stack,
    const otx_stack_key *keys, otx_slice_figures *out)
{
    otx_exemplar *labs = OTX_ZNEW(run->arena, otx_exemplar, stack->count);
    const otx_colour *colour;

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_call_colour(call, &colour));
    OTX_TRY(see_slices(run, colour, stack, keys[0].exemplar, labs));
    return otx_slice_figures_take(run, stack, keys, labs, out);
}

static osdtex_stack_figures
tell(const otx_slice_figures *f, size_t size)
{
    return (osdtex_stack_figures){
        .size = size,
        .lookup = f->lookup,
        .contrast_least = f->contrast_least,
        .contrast_most = f->contrast_most,
        .sharpness = f->sharpness,
        .flips_least = f->flips_least,
        .flips_most = f->flips_most,
        .step = f->step,
        .still = f->still,
        .colours = f->colours};
}

otx_status
otx_stack_measure(
    otx_call *call, const otx_stack *stack, const otx_stack_key *keys,
    osdtex_stack_figures *out)
{
    otx_slice_figures figures;
    osdtex_stack_figures told;
    otx_status status;
    otx_run run;

    if (!out)
        return OSDTEX_OK;
    OTX_TRY(otx_call_aside(call, &run));
    run.diagnostics = otx_diagnostics_create(run.allocator);
    if (!run.diagnostics)
        return otx_fail_memory(&call->run, "stack");
    status = measure(call, &run, stack, keys, &figures);
    otx_diagnostics_destroy(run.diagnostics);
    if (status != OSDTEX_OK)
        return otx_fail(
            &call->run, status, "stack", OTX_NOWHERE,
            "the slices cannot be measured");
    told = tell(&figures, out->size);
    memcpy(out, &told, out->size < sizeof told ? out->size : sizeof told);
    return OSDTEX_OK;
}

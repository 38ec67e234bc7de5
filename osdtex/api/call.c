/* call.c -- beginning and end of every entry. */
#include "api/call.h"

#include "base/clock.h"

#include <stdlib.h>
#include <string.h>

/* Seconds between calls of the host's progress from loops that know no end. */
static const double PULSE_SECONDS = 0.05;

static bool
relay(void *user, const char *stage, double fraction)
{
    osdtex_context *context = user;

    context->stage = stage;
    context->fraction = fraction;
    return context->options.progress(
        context->options.progress_user, stage, fraction);
}

/* Says again how far it has come, so that the host can stop it. */
static bool
pulse(void *user)
{
    osdtex_context *context = user;

    return relay(context, context->stage, context->fraction);
}

otx_status
otx_call_begin(osdtex_context *context, const char *stage, otx_call *call)
{
    if (!context)
        return OSDTEX_ERROR_ARGUMENT;
    otx_diagnostics_forget_error(context->diagnostics);
    *call = (otx_call){
        .context = context,
        .stage = stage,
        .run =
            {
                .scratch = context->scratch,
                .pool = context->pool,
                .allocator = context->allocator,
                .diagnostics = context->diagnostics,
                .progress = context->options.progress ? relay : NULL,
                .progress_user = context,
                .stage = stage,
                .outputs = context->outputs,
                .mark = context->outputs ? &context->mark : NULL,
            },
        .scratch = otx_arena_here(context->scratch),
        .begun = otx_clock_now(),
    };
    context->stage = stage;
    context->fraction = 0.0;
    otx_pool_watch(
        context->pool, context->options.progress ? pulse : NULL, context,
        PULSE_SECONDS);
    call->run.arena = otx_arena_create(context->allocator);
    if (!call->run.arena)
        return otx_fail_memory(&call->run, stage);
    return OSDTEX_OK;
}

static void
add_time(osdtex_context *context, const char *stage, double seconds)
{
    for (int32_t i = 0; i < context->time_count; ++i)
    {
        if (strcmp(context->times[i].stage, stage) == 0)
        {
            context->times[i].seconds += seconds;
            return;
        }
    }
    if (context->time_count < OTX_CALL_TIMES_MAX)
        context->times[context->time_count++] = (otx_call_time){stage, seconds};
}

/* What every end does: temporaries go, the time is kept. */
static void
finish(otx_call *call)
{
    otx_arena_release(call->run.scratch, call->scratch);
    add_time(call->context, call->stage, otx_clock_now() - call->begun);
}

otx_status
otx_call_end(otx_call *call, otx_status status, void *out)
{
    void *const nothing = NULL;

    finish(call);
    /* A stop that no stage has noticed may have left gaps in its result. */
    if (otx_pool_is_stopped(call->context->pool))
        status = OSDTEX_ERROR_CANCELLED;
    if (status == OSDTEX_OK)
        return status;
    /* Handles are of many types; all pointers to them look alike. */
    memcpy(out, &nothing, sizeof nothing);
    otx_arena_destroy(call->run.arena);
    return status;
}

otx_status
otx_call_drop(otx_call *call, otx_status status)
{
    finish(call);
    otx_arena_destroy(call->run.arena);
    return status;
}

otx_status
otx_call_options(otx_run *run, void *ours, size_t our_bytes, const void *theirs)
{
    size_t bytes;

    if (!theirs)
        return OSDTEX_OK;
    memcpy(&bytes, theirs, sizeof bytes);
    if (bytes < sizeof bytes || bytes > 65536)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "options", OTX_NOWHERE,
            "the size of an options struct is not set; begin with its "
            "*_default() or *_none() function");
    memcpy(ours, theirs, bytes < our_bytes ? bytes : our_bytes);
    memcpy(ours, &our_bytes, sizeof our_bytes);
    return OSDTEX_OK;
}

otx_status
otx_call_colour(otx_call *call, const otx_colour **out)
{
    osdtex_context *context = call->context;
    otx_run lasting = call->run;

    lasting.arena = context->arena;
    if (!context->colour_is_open)
        OTX_TRY(otx_colour_open(
            &lasting, context->options.colorconfig, getenv("OCIO"),
            &context->colour));
    context->colour_is_open = true;
    *out = &context->colour;
    return OSDTEX_OK;
}

otx_status
otx_call_hold(otx_run *run, otx_arena *other)
{
    return otx_arena_hold(run->arena, other) ? OSDTEX_OK
                                             : otx_fail_memory(run, "handle");
}

otx_status
otx_call_aside(otx_call *call, otx_run *out)
{
    otx_arena *aside = otx_arena_create(call->run.allocator);
    bool held;

    if (!aside)
        return otx_fail_memory(&call->run, call->stage);
    held = otx_arena_hold(call->run.scratch, aside);
    /* From here on the scratch arena alone owns it. */
    otx_arena_destroy(aside);
    if (!held)
        return otx_fail_memory(&call->run, call->stage);
    *out = call->run;
    out->arena = aside;
    return OSDTEX_OK;
}

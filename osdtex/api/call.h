/* call.h -- how every entry of the library begins and ends.
 *
 * An entry checks its arguments, makes a run (a fresh arena for the handle to
 * be, the context's threads and findings), calls one stage, and wraps. When
 * the stage fails the arena goes, and with it all that was half done. */
#ifndef OTX_API_CALL_H
#define OTX_API_CALL_H

#include "base/run.h"
#include "colour/colour.h"
#include "file/mark.h"

#include <osdtex/osdtex.h>

enum
{
    OTX_CALL_TIMES_MAX = 16
};

/* Wall seconds spent in the calls of one name. */
typedef struct otx_call_time
{
    const char *stage;
    double seconds;
} otx_call_time;

struct osdtex_context
{
    otx_allocator *allocator;
    otx_arena *arena; /* what lives as long as the context */
    otx_arena *scratch;
    otx_pool *pool;
    otx_diagnostics *diagnostics;
    osdtex_context_options options;
    otx_colour colour; /* see otx_call_colour */
    bool colour_is_open;
    otx_arena *outputs_arena; /* of the set below; NULL none */
    struct otx_atomic_file_set *outputs;
    /* How far the call at hand has said it is. */
    const char *stage;
    double fraction;
    otx_mark mark; /* of what is written into the set */
    double begun;  /* seconds of the clock */
    int32_t time_count;
    otx_call_time times[OTX_CALL_TIMES_MAX];
};

typedef struct otx_call
{
    osdtex_context *context;
    const char *stage; /* a literal */
    otx_run run;
    otx_arena_mark scratch;
    double begun; /* seconds */
} otx_call;

/* Fills `call`. ARGUMENT when there is no context, MEMORY. */
otx_status
otx_call_begin(osdtex_context *context, const char *stage, otx_call *call);

/* Ends a call that made a handle in call->run.arena. Unless `status` is
 * OSDTEX_OK the arena is destroyed, and the caller's pointer, whose address is
 * `out`, becomes NULL: a stage may have set it before it failed, and the host
 * destroys what it was given. Returns `status`. */
otx_status otx_call_end(otx_call *call, otx_status status, void *out);

/* Ends a call that keeps nothing. Returns `status`. */
otx_status otx_call_drop(otx_call *call, otx_status status);

/* Copies the caller's options over ours, which hold the defaults: as many
 * bytes as both know. `theirs` may be NULL. ARGUMENT when its size makes no
 * sense. */
otx_status otx_call_options(
    otx_run *run, void *ours, size_t our_bytes, const void *theirs);

/* The colour configuration of the context, opened at the first call. */
otx_status otx_call_colour(otx_call *call, const otx_colour **out);

/* Keeps the handle that lives in `other` for as long as that of the run: the
 * caller may destroy the two in any order. MEMORY. */
otx_status otx_call_hold(otx_run *run, otx_arena *other);

/* A run whose results go to an arena that is destroyed with the call: for what
 * is read, copied into the handle, and forgotten. MEMORY. */
otx_status otx_call_aside(otx_call *call, otx_run *out);

#endif

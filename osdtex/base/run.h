/* run.h -- what a stage is given besides its inputs.
 *
 * Memory, threads, the random seed, progress with cancellation, and the place
 * where findings go. There are no globals: two runs never see each other. */
#ifndef OTX_BASE_RUN_H
#define OTX_BASE_RUN_H

#include "base/arena.h"
#include "base/pool.h"

#include <osdtex/context.h>

/* Where a finding is. Zero-initialise with OTX_NOWHERE and set what is known.
 */
typedef struct otx_where
{
    const char *file; /* NULL none */
    int64_t line;     /* 1-based, 0 none */
    int32_t face;     /* 0-based, -1 none */
    int32_t vertex;   /* 0-based, -1 none */
} otx_where;

#define OTX_NOWHERE ((otx_where){NULL, 0, -1, -1})

/* A file as a whole. */
static inline otx_where
otx_where_file(const char *path)
{
    return (otx_where){path, 0, -1, -1};
}

/* Findings of a context, folded by (severity, stage, file, format string). */
typedef struct otx_diagnostics otx_diagnostics;

/* Returns false to cancel. Called from one thread at a time. */
typedef bool (*otx_progress_fn)(void *user, const char *stage, double fraction);

typedef struct otx_run
{
    otx_arena *arena;   /* results; outlives the stage */
    otx_arena *scratch; /* temporaries; mark and release */
    otx_pool *pool;
    otx_allocator *allocator;
    otx_diagnostics *diagnostics;
    const char *stage;        /* that memory may run out in; NULL: "run" */
    otx_progress_fn progress; /* NULL none */
    void *progress_user;
    uint64_t seed;
    struct otx_atomic_file_set *outputs; /* what is written goes there; NULL:
                                          * each call has a set of its own */
    const struct otx_mark *mark; /* what files say of themselves; NULL none */
} otx_run;

/* NULL when memory is out. */
otx_diagnostics *otx_diagnostics_create(otx_allocator *allocator);
void otx_diagnostics_destroy(otx_diagnostics *diagnostics);
int32_t otx_diagnostics_count(const otx_diagnostics *diagnostics);
void otx_diagnostics_get(
    const otx_diagnostics *diagnostics, int32_t index, osdtex_diagnostic *out);
/* The first error since errors were forgotten; its status is OSDTEX_OK when
 * there was none. It is told even when there is no memory for a finding. */
const osdtex_diagnostic *
otx_diagnostics_error(const otx_diagnostics *diagnostics);
void otx_diagnostics_forget_error(otx_diagnostics *diagnostics);
/* Called for each new finding (not for repeats); NULL none. */
void otx_diagnostics_listen(
    otx_diagnostics *diagnostics,
    void (*fn)(void *user, const osdtex_diagnostic *finding), void *user);

/* The name of an option where it is handed to a sentence as an argument. */
#define OTX_OPTION_NAME(name) "\x1f" name "\x1f"

/* Reports the error that ends a stage and returns `status`, so that a guard
 * reads `return otx_fail(run, …)`. The message is one sentence that says what
 * to do, without file and line: those are in `where`. Options that it speaks of
 * stand in braces, as `raise {level}`; no sentence knows the flags of a program
 * (see osdtex_diagnostic.marked). */
otx_status otx_fail(
    otx_run *run, otx_status status, const char *stage, otx_where where,
    const char *format, ...) OTX_PRINTF(5, 6);

/* Reports a warning or a decision. */
void otx_note(
    otx_run *run, osdtex_severity severity, const char *stage, otx_where where,
    const char *format, ...) OTX_PRINTF(5, 6);

/* MEMORY when an allocation in the arena or the scratch arena has failed since
 * they were marked: asked once after a group of allocations. */
otx_status otx_run_ok(otx_run *run);

/* `otx_fail` for an allocation that failed. */
otx_status otx_fail_memory(otx_run *run, const char *stage);

/* What a loop of the pool came to: with a finding where memory is out. */
otx_status otx_loop_result(otx_run *run, const char *stage, otx_status status);

/* Says how far a stage has come, in [0, 1]. OSDTEX_ERROR_CANCELLED when the
 * user asked to stop. Call it from the thread that owns the run. */
otx_status otx_progress(otx_run *run, const char *stage, double fraction);

/* The same without a word on how far: for loops that may last and know no end.
 * CANCELLED likewise. Cheap enough for every thousandth step of anything. */
static inline otx_status
otx_pulse(otx_run *run)
{
    return otx_pool_look(run->pool);
}

#endif

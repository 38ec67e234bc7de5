/* context.h -- memory, threads, colour, and where findings go.
 *
 *     osdtex_context_options options = osdtex_context_options_default();
 *     osdtex_context *context;
 *
 *     options.threads = 4;
 *     options.progress = show_progress;   // false cancels
 *     if (osdtex_context_create(&options, &context) != OSDTEX_OK)
 *         return out_of_memory();
 *     ...
 *     osdtex_context_destroy(context);
 *
 * Every call that works is given a context. It has a pool of threads, which a
 * call uses for as long as it lasts, and the findings of all calls so far. One
 * thread at a time may use a context; several contexts in one process share
 * nothing and may work side by side. Results do not depend on the number of
 * threads, nor on which context made a handle or uses it.
 *
 * Callbacks are called by the thread that made the call, but for alloc and
 * release. They may not use the context, nor leave by longjmp or an exception:
 * a host that throws keeps what it caught, returns false, and throws again when
 * the call has returned. A cancelled call returns CANCELLED, soon, and has
 * changed nothing; only OpenSubdiv's own refinement goes on to its end. */
#ifndef OSDTEX_CONTEXT_H
#define OSDTEX_CONTEXT_H

#include <osdtex/common.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_context osdtex_context;

typedef int32_t osdtex_severity;
enum
{
    OSDTEX_SEVERITY_INFO = 0, /* a decision the user may want to know */
    OSDTEX_SEVERITY_WARNING = 1,
    OSDTEX_SEVERITY_ERROR = 2
};

/* One finding. Like findings are folded: `count` says how many, the place is
 * that of the first. Strings live until osdtex_diagnostic_clear or the end of
 * the context. */
typedef struct osdtex_diagnostic
{
    osdtex_severity severity;
    osdtex_status status; /* OSDTEX_OK unless severity is ERROR */
    const char *stage;    /* "cage", "colour", "map", … */
    const char *file;     /* NULL where no file is concerned */
    int64_t line;         /* 1-based, 0 none */
    osdtex_index face;    /* 0-based, -1 none */
    osdtex_index vertex;  /* 0-based, -1 none */
    int64_t count;        /* 1 or more */
    const char *message;  /* one sentence */
    /* The same with a unit separator (U+001F) before and after each name of an
     * option, for programs that call options by other names: osdtex shows
     * `raise level` as `raise --level`. */
    const char *marked;
} osdtex_diagnostic;

typedef struct osdtex_context_options
{
    size_t size;
    /* Allocation hooks, called from several threads. `alloc` returns NULL on
     * failure, `release` gets the size back. NULL: malloc and free. */
    void *(*alloc)(void *user, size_t bytes);
    void (*release)(void *user, void *block, size_t bytes);
    void *alloc_user;
    size_t memory_limit; /* bytes, 0 none */
    /* Says how far `stage` has come, in [0, 1]; false cancels. Called from the
     * thread that made the call. NULL none. */
    bool (*progress)(void *user, const char *stage, double fraction);
    void *progress_user;
    /* Called for each new finding, not for its repeats. NULL none. */
    void (*log)(void *user, const osdtex_diagnostic *finding);
    void *log_user;
    /* OpenColorIO configuration file; NULL: $OCIO, else the one built in.
     * Opened when the first colour is met. */
    const char *colorconfig;
    int32_t threads; /* 0: the cores of the machine */
    int32_t argument_count;
    /* [argument_count] words that the host was run with, which reports tell.
     * Copied. NULL none. */
    const char *const *arguments;
} osdtex_context_options;

static inline osdtex_context_options
osdtex_context_options_default(void)
{
    osdtex_context_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_context_options_init(osdtex_context_options *out, size_t bytes);

/* Starts the threads; reads nothing yet.
 *
 *   options  NULL: the defaults. Copied, texts too; what a `user`
 * points to is the host's
 *
 * ARGUMENT (threads below 0 or above 256, a count below 0), MEMORY; there is no
 * context then to ask for a sentence. */
OSDTEX_API osdtex_status osdtex_context_create(
    const osdtex_context_options *options, osdtex_context **out);
/* Ends the threads. Handles that were made with it live on. NULL: nothing. */
OSDTEX_API void osdtex_context_destroy(osdtex_context *context);

/* Why the last call failed: the first error that it met, in its own words.
 * Never NULL; `status` is OSDTEX_OK and `message` empty when it did not fail.
 * Lent until the next call with this context or osdtex_diagnostic_clear.
 *
 *     if (osdtex_cage_read(context, path, NULL, &cage) != OSDTEX_OK)
 *         fprintf(stderr, "%s\n", osdtex_context_error(context)->message);
 */
OSDTEX_API const osdtex_diagnostic *
osdtex_context_error(const osdtex_context *context);

/* Findings in the order of their first occurrence. */
OSDTEX_API int32_t osdtex_diagnostic_count(const osdtex_context *context);
/* ARGUMENT when there is no finding `index`. */
OSDTEX_API osdtex_status osdtex_diagnostic_get(
    const osdtex_context *context, int32_t index, osdtex_diagnostic *out);
/* Forgets all findings: like ones are folded until then. MEMORY. */
OSDTEX_API osdtex_status osdtex_diagnostic_clear(osdtex_context *context);

OSDTEX_END_DECLS

#endif

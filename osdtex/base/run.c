/* run.c -- findings and progress.
 *
 * Findings are kept in the order of their first occurrence. Two findings are
 * alike when severity, stage, file and the *format string* agree: the numbers
 * in the sentence then differ only by place, and one example with a count says
 * more than a thousand lines. */
#include "base/run.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum
{
    MESSAGE_BYTES = 1024,
    STAGE_BYTES = 64,
    PATH_BYTES = 4096,
    MAX_FINDINGS = 1000
};

typedef struct finding
{
    osdtex_diagnostic public;
    const char *format;
} finding;

/* The error of the call that is running, or ended last, in storage of its own:
 * it can be said when memory is out, and in its own words where findings fold
 * it into one that was like it. */
typedef struct fault
{
    osdtex_diagnostic public;
    char message[MESSAGE_BYTES];
    char marked[MESSAGE_BYTES];
    char stage[STAGE_BYTES];
    char file[PATH_BYTES];
} fault;

struct otx_diagnostics
{
    otx_allocator *allocator;
    otx_arena *arena;
    finding *findings;
    int32_t count;
    void (*listener)(void *user, const osdtex_diagnostic *finding);
    void *listener_user;
    pthread_mutex_t mutex;
    fault fault;
};

otx_diagnostics *
otx_diagnostics_create(otx_allocator *allocator)
{
    otx_diagnostics *d = otx_allocator_alloc(allocator, sizeof *d);

    if (!d)
        return NULL;
    memset(d, 0, sizeof *d);
    d->allocator = allocator;
    otx_diagnostics_forget_error(d);
    d->arena = otx_arena_create(allocator);
    if (d->arena)
        d->findings = OTX_NEW(d->arena, finding, MAX_FINDINGS);
    pthread_mutex_init(&d->mutex, NULL);
    if (!d->findings)
    {
        otx_diagnostics_destroy(d);
        return NULL;
    }
    return d;
}

void
otx_diagnostics_destroy(otx_diagnostics *d)
{
    if (!d)
        return;
    pthread_mutex_destroy(&d->mutex);
    otx_arena_destroy(d->arena);
    otx_allocator_free(d->allocator, d, sizeof *d);
}

int32_t
otx_diagnostics_count(const otx_diagnostics *d)
{
    return d->count;
}

void
otx_diagnostics_get(
    const otx_diagnostics *d, int32_t index, osdtex_diagnostic *out)
{
    *out = d->findings[index].public;
}

void
otx_diagnostics_listen(
    otx_diagnostics *d,
    void (*fn)(void *user, const osdtex_diagnostic *finding), void *user)
{
    d->listener = fn;
    d->listener_user = user;
}

void
otx_diagnostics_forget_error(otx_diagnostics *d)
{
    fault *f = &d->fault;

    f->message[0] = f->marked[0] = f->stage[0] = f->file[0] = '\0';
    f->public = (osdtex_diagnostic){
        .severity = OSDTEX_SEVERITY_ERROR,
        .stage = f->stage,
        .face = -1,
        .vertex = -1,
        .count = 1,
        .message = f->message,
        .marked = f->marked};
}

const osdtex_diagnostic *
otx_diagnostics_error(const otx_diagnostics *d)
{
    return &d->fault.public;
}

/* The first error of a call is its cause; others follow from it. */
static void
keep_error(otx_diagnostics *d, const osdtex_diagnostic *said)
{
    fault *f = &d->fault;

    if (said->severity != OSDTEX_SEVERITY_ERROR ||
        f->public.status != OSDTEX_OK)
        return;
    f->public = *said;
    snprintf(f->message, sizeof f->message, "%s", said->message);
    snprintf(f->marked, sizeof f->marked, "%s", said->marked);
    snprintf(f->stage, sizeof f->stage, "%s", said->stage);
    f->public.message = f->message;
    f->public.marked = f->marked;
    f->public.stage = f->stage;
    if (!said->file)
        return;
    snprintf(f->file, sizeof f->file, "%s", said->file);
    f->public.file = f->file;
}

static bool
same_file(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

static finding *
find_alike(otx_diagnostics *d, const finding *f)
{
    for (int32_t i = 0; i < d->count; ++i)
    {
        finding *g = &d->findings[i];

        if (g->format == f->format &&
            g->public.severity == f->public.severity &&
            same_file(g->public.file, f->public.file))
            return g;
    }
    return NULL;
}

/* Whether a finding is one that was kept, said again: stages that know the same
 * thing may each say it. */
static bool
is_again(const finding *kept, const finding *f, const char *message)
{
    return kept->public.line == f->public.line &&
           kept->public.face == f->public.face &&
           kept->public.vertex == f->public.vertex &&
           strcmp(kept->public.message, message) == 0;
}

/* Tells the listener of the call's error from where it needs no memory. */
static void
tell_error(otx_diagnostics *d, const char *message)
{
    if (d->listener && strcmp(d->fault.message, message) == 0)
        d->listener(d->listener_user, &d->fault.public);
}

/* Keeps a finding. When memory is out or the list is full it is dropped, but
 * the error that ends a call is told all the same. */
static void
keep(otx_diagnostics *d, finding f)
{
    finding *alike = find_alike(d, &f);
    const char *message = f.public.message;

    if (alike)
    {
        /* An error is each time another call that failed. */
        alike->public.count += f.public.severity == OSDTEX_SEVERITY_ERROR ||
                               !is_again(alike, &f, message);
        return;
    }
    if (d->count == MAX_FINDINGS)
    {
        tell_error(d, message);
        return;
    }
    f.public.message = otx_arena_strdup(d->arena, f.public.message);
    f.public.marked = otx_arena_strdup(d->arena, f.public.marked);
    f.public.stage = otx_arena_strdup(d->arena, f.public.stage);
    if (f.public.file)
        f.public.file = otx_arena_strdup(d->arena, f.public.file);
    if (!f.public.message || !f.public.marked || !f.public.stage)
    {
        tell_error(d, message);
        return;
    }
    d->findings[d->count++] = f;
    if (d->listener)
        d->listener(d->listener_user, &d->findings[d->count - 1].public);
}

/* The characters between which the marked message has names of options. */
#define MARK '\x1f'

/* Names of options stand in braces in formats, {level} or {%s}: what a program
 * calls them is its own business. */
static void
mark_names(const char *format, char *marked)
{
    size_t n = 0;

    for (const char *at = format; *at && n + 1 < MESSAGE_BYTES; ++at)
        marked[n++] = *at == '{' || *at == '}' ? MARK : *at;
    marked[n] = '\0';
}

static void
remove_marks(const char *marked, char *plain)
{
    for (; *marked; ++marked)
        if (*marked != MARK)
            *plain++ = *marked;
    *plain = '\0';
}

static void
report(
    otx_run *run, osdtex_severity severity, otx_status status,
    const char *stage, otx_where where, const char *format, va_list arguments)
{
    char marked_format[MESSAGE_BYTES];
    char marked[MESSAGE_BYTES];
    char message[MESSAGE_BYTES];
    const finding f = {
        {.severity = severity,
         .status = status,
         .stage = stage,
         .file = where.file,
         .line = where.line,
         .face = where.face,
         .vertex = where.vertex,
         .count = 1,
         .message = message,
         .marked = marked},
        format};

    mark_names(format, marked_format);
    vsnprintf(marked, sizeof marked, marked_format, arguments);
    remove_marks(marked, message);
    pthread_mutex_lock(&run->diagnostics->mutex);
    keep_error(run->diagnostics, &f.public);
    keep(run->diagnostics, f);
    pthread_mutex_unlock(&run->diagnostics->mutex);
}

otx_status
otx_fail(
    otx_run *run, otx_status status, const char *stage, otx_where where,
    const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    report(run, OSDTEX_SEVERITY_ERROR, status, stage, where, format, arguments);
    va_end(arguments);
    return status;
}

void
otx_note(
    otx_run *run, osdtex_severity severity, const char *stage, otx_where where,
    const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    report(run, severity, OSDTEX_OK, stage, where, format, arguments);
    va_end(arguments);
}

otx_status
otx_fail_memory(otx_run *run, const char *stage)
{
    return otx_fail(
        run, OSDTEX_ERROR_MEMORY, stage, OTX_NOWHERE,
        "memory is out, or {memory-limit} is reached; lower {level}, or raise "
        "the limit");
}

otx_status
otx_loop_result(otx_run *run, const char *stage, otx_status status)
{
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(run, stage) : status;
}

otx_status
otx_run_ok(otx_run *run)
{
    if (!otx_arena_failed(run->arena) && !otx_arena_failed(run->scratch))
        return OSDTEX_OK;
    return otx_fail_memory(run, run->stage ? run->stage : "run");
}

otx_status
otx_progress(otx_run *run, const char *stage, double fraction)
{
    const osdtex_diagnostic said = {
        .severity = OSDTEX_SEVERITY_ERROR,
        .status = OSDTEX_ERROR_CANCELLED,
        .stage = stage,
        .face = -1,
        .vertex = -1,
        .count = 1,
        .message = "the progress callback asked to stop",
        .marked = "the progress callback asked to stop"};

    if (!run->progress || run->progress(run->progress_user, stage, fraction))
        return OSDTEX_OK;
    /* Whoever asked to stop needs no finding. */
    pthread_mutex_lock(&run->diagnostics->mutex);
    keep_error(run->diagnostics, &said);
    pthread_mutex_unlock(&run->diagnostics->mutex);
    return OSDTEX_ERROR_CANCELLED;
}

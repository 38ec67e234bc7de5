/* session.c -- a context with a person in front of it. */
#include "cli/session.h"
#include "cli/spool.h"
#include "cli/stop.h"
#include "cli/value.h"

#include "regress/process.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum
{
    MAX_THREADS = 256
};

bool
otx_session_is_stopped(void)
{
    return otx_stop_signal() != 0;
}

double
otx_session_seconds(const otx_session *session)
{
    return otx_process_seconds() - session->console.begun;
}

/* A sentence of the library, with its options as flags. */
static void
put_sentence(const osdtex_diagnostic *d)
{
    const char *at = d->marked;

    for (bool is_option = false; *at; is_option = !is_option)
    {
        const size_t length = strcspn(at, "\x1f");

        if (is_option)
            fputs("--", stderr);
        otx_console_put(at, length);
        at += length + (at[length] != '\0');
    }
}

void
otx_session_say(otx_session *session, const char *format, ...)
{
    va_list arguments;

    if (session->console.quiet)
        return;
    otx_console_wipe(&session->console);
    va_start(arguments, format);
    otx_console_line("osdtex: ", format, arguments);
    va_end(arguments);
}

int
otx_session_refuse(const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    otx_console_line("osdtex: error: ", format, arguments);
    va_end(arguments);
    return OTX_EXIT_USAGE;
}

void
otx_session_print(const char *format, ...)
{
    static const char LINE_END = '\x01'; /* of the format, while it is filled */
    char *lines = strdup(format), *text = NULL;
    va_list arguments;

    for (char *c = lines; c && *c; ++c)
        if (*c == '\n')
            *c = LINE_END;
    va_start(arguments, format);
    if (lines && vasprintf(&text, lines, arguments) < 0)
        text = NULL;
    va_end(arguments);
    for (const char *c = text; c && *c; ++c)
        putchar(*c == LINE_END ? '\n' : otx_console_plain(*c));
    free(text);
    free(lines);
}

void
otx_session_lap(otx_session *session, const char *what)
{
    const double t = otx_process_seconds();

    if (session->console.verbose)
        otx_session_say(session, "%s: %.3f s", what, t - session->console.lap);
    session->console.lap = t;
}

/* "shirt.obj:4711: ", "shirt.obj: " or "". */
static void
put_place(const otx_session *session, const osdtex_diagnostic *d)
{
    const char *name = otx_spool_name(session->values, d->file);

    if (!d->file)
        return;
    otx_console_put(name, strlen(name));
    if (d->line > 0)
        fprintf(stderr, ":%lld", (long long)d->line);
    fputs(": ", stderr);
}

static void
put_finding(void *user, const osdtex_diagnostic *d)
{
    otx_session *session = user;

    session->error_is_told |= d->severity == OSDTEX_SEVERITY_ERROR;
    if (session->console.quiet && d->severity != OSDTEX_SEVERITY_ERROR)
        return;
    otx_console_wipe(&session->console);
    fputs("osdtex: ", stderr);
    if (d->severity == OSDTEX_SEVERITY_ERROR)
        fputs("error: ", stderr);
    else if (d->severity == OSDTEX_SEVERITY_WARNING)
        fputs("warning: ", stderr);
    else
        fprintf(stderr, "%s: ", d->stage);
    put_place(session, d);
    put_sentence(d);
    fputc('\n', stderr);
}

/* Findings are printed when they are new; how many there were is known at the
 * end. */
static void
put_repeats(otx_session *session)
{
    osdtex_diagnostic d;

    for (int i = 0; i < osdtex_diagnostic_count(session->context); ++i)
    {
        if (osdtex_diagnostic_get(session->context, i, &d) != OSDTEX_OK ||
            d.count < 2 || d.severity == OSDTEX_SEVERITY_INFO ||
            (session->console.quiet && d.severity != OSDTEX_SEVERITY_ERROR))
            continue;
        fputs("osdtex: ", stderr);
        put_place(session, &d);
        fprintf(stderr, "%lld findings like this: ", (long long)d.count);
        put_sentence(&d);
        fputc('\n', stderr);
    }
}

static bool
show_progress(void *user, const char *stage, double fraction)
{
    otx_session *session = user;

    if (otx_stop_signal())
        return false;
    otx_console_progress(&session->console, stage, fraction);
    return true;
}

/* --threads, else the first of the environment's words that is a number. */
static bool
choose_threads(const otx_flag_values *values, int32_t *out)
{
    static const char *const names[] = {
        "OSDTEX_THREADS", "CUE_THREADS", "SLURM_CPUS_PER_TASK"};
    const char *text = values->text[OTX_FLAG_THREADS];
    int64_t threads = 0;

    if (text && !otx_value_int(text, 0, MAX_THREADS, &threads))
    {
        otx_session_refuse(
            "--threads takes a number from 0 to %d, not '%s'", MAX_THREADS,
            text);
        return false;
    }
    for (int i = 0; !text && i < 3; ++i)
    {
        text = getenv(names[i]);
        if (text && !otx_value_int(text, 0, MAX_THREADS, &threads))
        {
            fprintf(
                stderr,
                "osdtex: warning: %s is '%s', which is no number of "
                "threads; ignored\n",
                names[i], text);
            text = NULL;
        }
    }
    *out = (int32_t)threads;
    return true;
}

static bool
choose_memory(const otx_flag_values *values, size_t *out)
{
    const char *text = values->text[OTX_FLAG_MEMORY_LIMIT];
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page = sysconf(_SC_PAGE_SIZE);

    *out = pages > 0 && page > 0 ? (size_t)pages / 4 * 3 * (size_t)page : 0;
    if (!text || otx_value_bytes(text, out))
        return true;
    otx_session_refuse(
        "--memory-limit takes a size such as 500M or 8G, not '%s'", text);
    return false;
}

bool
otx_session_begin(otx_session *session, const otx_flag_values *values)
{
    osdtex_context_options options = osdtex_context_options_default();
    osdtex_status status;

    *session = (otx_session){
        .values = values,
        .console = otx_console_begin(
            values->text[OTX_FLAG_QUIET] != NULL,
            values->text[OTX_FLAG_VERBOSE] != NULL),
        .exit_code = OTX_EXIT_USAGE,
    };
    if (!choose_threads(values, &options.threads) ||
        !choose_memory(values, &options.memory_limit))
        return false;
    options.progress = show_progress;
    options.progress_user = session;
    options.log = put_finding;
    options.log_user = session;
    options.colorconfig = values->text[OTX_FLAG_COLORCONFIG];
    options.arguments = values->words;
    options.argument_count = values->word_count;
    session->options = options;
    otx_stop_listen();
    status = osdtex_context_create(&options, &session->context);
    if (status == OSDTEX_OK)
        status = osdtex_outputs_begin(session->context);
    if (status == OSDTEX_OK)
        return true;
    osdtex_context_destroy(session->context);
    fprintf(
        stderr, "osdtex: error: %s%s\n",
        status == OSDTEX_ERROR_MEMORY
            ? "there is no memory or no thread to begin with; raise the limit "
              "(ulimit -v), or lower --threads"
            : "no context: ",
        status == OSDTEX_ERROR_MEMORY ? "" : osdtex_status_name(status));
    session->exit_code = OTX_EXIT_LIMIT;
    return false;
}

static int
exit_code_of(osdtex_status status)
{
    switch (status)
    {
    case OSDTEX_OK:
        return OTX_EXIT_OK;
    case OSDTEX_ERROR_ARGUMENT:
        return OTX_EXIT_USAGE;
    case OSDTEX_ERROR_FORMAT:
    case OSDTEX_ERROR_TOPOLOGY:
    case OSDTEX_ERROR_NUMERIC:
    case OSDTEX_ERROR_SUPPORT:
        return OTX_EXIT_DATA;
    case OSDTEX_ERROR_IO:
        return OTX_EXIT_IO;
    case OSDTEX_ERROR_COLOUR:
        return OTX_EXIT_COLOUR;
    default:
        return OTX_EXIT_LIMIT;
    }
}

osdtex_status
otx_session_commit(otx_session *session)
{
    const osdtex_status status = osdtex_outputs_seal(session->context);

    if (status != OSDTEX_OK)
        return status;
    otx_stop_never();
    return osdtex_outputs_commit(session->context);
}

int
otx_session_end(otx_session *session, osdtex_status status)
{
    otx_stop_unwatch();
    otx_console_wipe(&session->console);
    put_repeats(session);
    osdtex_context_destroy(session->context);
    session->context = NULL;
    if (status == OSDTEX_ERROR_MEMORY && !session->error_is_told)
        fputs("osdtex: error: memory is out; nothing was written\n", stderr);
    if (status != OSDTEX_ERROR_CANCELLED)
        return exit_code_of(status);
    fprintf(
        stderr, "osdtex: stopped; %s\n",
        session->remains ? session->remains : "nothing was written");
    return otx_stop_signal() ? 128 + otx_stop_signal() : OTX_EXIT_LIMIT;
}

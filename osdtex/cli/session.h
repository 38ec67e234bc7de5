/* session.h -- a context with a person in front of it: findings and progress
 * on stderr, signals that cancel, statuses that become exit codes. */
#ifndef OTX_CLI_SESSION_H
#define OTX_CLI_SESSION_H

#include "cli/command.h"
#include "cli/console.h"

typedef struct otx_session
{
    osdtex_context *context;
    osdtex_context_options options; /* that it was made by */
    const otx_flag_values *values;
    otx_console console;
    bool error_is_told;
    const char *remains; /* what a stopped session says; NULL: that nothing was
                          * written */
    int exit_code;       /* of the usage error that otx_session_begin found */
} otx_session;

/* Makes the context from --threads, --memory-limit, --colorconfig, -v, -q and
 * the environment, begins a set of outputs, and catches signals. False after
 * saying what is wrong; then session->exit_code is what to return. The session
 * must not move. */
bool otx_session_begin(otx_session *session, const otx_flag_values *values);

/* Gives all that was written its names, unless a signal has come. Once for a
 * session: before it says that anything was written. */
osdtex_status otx_session_commit(otx_session *session);

/* Drops what was written and not committed, frees the context and returns the
 * exit code for `status`. */
int otx_session_end(otx_session *session, osdtex_status status);

/* A line on stderr, unless -q. */
void otx_session_say(otx_session *session, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* To stdout; of what is printed only the format ends lines and nothing is a
 * command for terminals, whatever names hold. */
void otx_session_print(const char *format, ...)
    __attribute__((format(printf, 1, 2)));

/* A line on stderr that opens with "osdtex: error: "; returns the exit code of
 * a usage error. */
int otx_session_refuse(const char *format, ...)
    __attribute__((format(printf, 1, 2)));

/* With -v: says how long it took since the last lap. */
void otx_session_lap(otx_session *session, const char *what);

/* Whether a signal has come that ends the program: for work outside of the
 * library, which asks by itself. */
bool otx_session_is_stopped(void);

/* Seconds since the session began. */
double otx_session_seconds(const otx_session *session);

#endif

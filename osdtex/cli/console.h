/* console.h -- what a person reads on stderr: lines, and how far work is.
 *
 * A bar on a terminal, which is wiped before a line; in a log now and then a
 * line. */
#ifndef OTX_CLI_CONSOLE_H
#define OTX_CLI_CONSOLE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct otx_console
{
    bool quiet, verbose;
    bool is_terminal;  /* stderr is */
    bool bar_is_shown; /* and must be wiped before a line */
    double begun;      /* seconds */
    double lap;        /* when the last lap ended */
    double shown;      /* when progress was last shown */
    char stage[32];    /* whose progress was last shown */
    int percent;
} otx_console;

otx_console otx_console_begin(bool quiet, bool verbose);

void otx_console_wipe(otx_console *console);

/* `length` characters, of which none is a command for terminals: names may hold
 * what is. */
void otx_console_put(const char *text, size_t length);

/* The same of one character. */
char otx_console_plain(char c);

/* A line of its own behind `opening`; the bar has to be wiped. */
void
otx_console_line(const char *opening, const char *format, va_list arguments);

/* Shows how far a stage is, at most ten times a second on a terminal and once a
 * second in a log: a job that is over at once says nothing. */
void
otx_console_progress(otx_console *console, const char *stage, double fraction);

#endif

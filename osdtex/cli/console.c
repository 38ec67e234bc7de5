/* console.c -- what a person reads on stderr: lines, and how far work is. */
#include "cli/console.h"

#include "regress/process.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum
{
    BAR_WIDTH = 40,
    LINE_BYTES = 16384 /* names of several files fit */
};

otx_console
otx_console_begin(bool quiet, bool verbose)
{
    const double now = otx_process_seconds();

    return (otx_console){
        .quiet = quiet,
        .verbose = verbose,
        .is_terminal = isatty(STDERR_FILENO) != 0,
        .begun = now,
        .lap = now,
        .shown = now,
        .percent = -1,
    };
}

void
otx_console_wipe(otx_console *console)
{
    if (console->bar_is_shown)
        fputs("\r\033[K", stderr);
    console->bar_is_shown = false;
}

char
otx_console_plain(char c)
{
    return (unsigned char)c >= ' ' && c != 127 ? c : '?';
}

void
otx_console_put(const char *text, size_t length)
{
    for (size_t i = 0; i < length; ++i)
        fputc(otx_console_plain(text[i]), stderr);
}

void
otx_console_line(const char *opening, const char *format, va_list arguments)
{
    char line[LINE_BYTES];

    vsnprintf(line, sizeof line, format, arguments);
    fputs(opening, stderr);
    otx_console_put(line, strlen(line));
    fputc('\n', stderr);
}

static void
put_bar(otx_console *console, const char *stage, double fraction)
{
    const int filled = (int)(fraction * BAR_WIDTH);

    fprintf(
        stderr, "\r\033[K%-10s [%.*s%*s] %3d%%", stage, filled,
        "########################################", BAR_WIDTH - filled, "",
        (int)(100.0 * fraction));
    fflush(stderr);
    console->bar_is_shown = true;
}

void
otx_console_progress(otx_console *console, const char *stage, double fraction)
{
    const double interval = console->is_terminal ? 0.1 : 1.0;
    const double t = otx_process_seconds();
    const int percent = (int)(100.0 * fraction);

    if (console->quiet || t - console->shown < interval)
        return;
    console->shown = t;
    if (console->is_terminal)
    {
        put_bar(console, stage, fraction);
        return;
    }
    if (percent == console->percent && strcmp(stage, console->stage) == 0)
        return;
    console->percent = percent;
    snprintf(console->stage, sizeof console->stage, "%s", stage);
    fprintf(stderr, "osdtex: %s %d%%\n", stage, percent);
}

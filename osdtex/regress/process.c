/* process.c -- fork, exec, wait. */
#include "regress/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum
{
    POLL_NANOSECONDS = 10000000,
    GRACE_SECONDS = 5, /* to clean up in, once a child is asked to end */
    CANNOT_START = 127 /* as shells say it */
};

static void
add(otx_process_words *words, const char *begin, size_t length)
{
    char **items =
        realloc(words->items, (words->count + 2) * sizeof *words->items);
    char *word = strndup(begin, length);

    if (items)
        words->items = items;
    if (!items || !word)
    {
        free(word);
        words->failed = true;
        return;
    }
    items[words->count++] = word;
    items[words->count] = NULL;
}

void
otx_process_add(otx_process_words *words, const char *word)
{
    add(words, word, strlen(word));
}

void
otx_process_add_text(otx_process_words *words, const char *text)
{
    while (text && *(text += strspn(text, " ")) != '\0')
    {
        const size_t length = strcspn(text, " ");

        add(words, text, length);
        text += length;
    }
}

void
otx_process_put_word(FILE *out, const char *text, size_t length)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyz0123456789"
                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ@%+=:,./-_";

    if (length > 0 && strspn(text, plain) >= length)
    {
        fprintf(out, "%.*s", (int)length, text);
        return;
    }
    fputc('\'', out);
    for (size_t i = 0; i < length; ++i)
        if (text[i] == '\'')
            fputs("'\\''", out);
        else
            fputc(text[i], out);
    fputc('\'', out);
}

char *
otx_process_line(const otx_process_words *words)
{
    char *line = NULL;
    size_t bytes;
    FILE *out = open_memstream(&line, &bytes);

    if (!out)
        return NULL;
    for (size_t i = 0; i < words->count; ++i)
    {
        if (i > 0)
            fputc(' ', out);
        otx_process_put_word(out, words->items[i], strlen(words->items[i]));
    }
    if (fclose(out) == 0)
        return line;
    free(line);
    return NULL;
}

void
otx_process_free(otx_process_words *words)
{
    for (size_t i = 0; i < words->count; ++i)
        free(words->items[i]);
    free(words->items);
    *words = (otx_process_words){0};
}

/* Never returns. The child goes when its parent does. */
static void
become(char *const *words, const char *log)
{
    const int fd = open(log, O_WRONLY | O_CREAT | O_APPEND, 0666);

    prctl(PR_SET_PDEATHSIG, SIGTERM);
    signal(SIGPIPE, SIG_DFL);
    if (fd < 0 || dup2(fd, STDOUT_FILENO) < 0 || dup2(fd, STDERR_FILENO) < 0)
        _exit(CANNOT_START);
    execvp(words[0], words);
    _exit(CANNOT_START);
}

double
otx_process_seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double
seconds_of(const struct timeval *t)
{
    return (double)t->tv_sec + 1e-6 * (double)t->tv_usec;
}

/* Asks it to end, which it may do in its own way, and then makes it. */
static int
put_down(pid_t child, struct rusage *used)
{
    const struct timespec nap = {0, POLL_NANOSECONDS};
    const double begun = otx_process_seconds();
    int state = 0;

    kill(child, SIGTERM);
    while (otx_process_seconds() - begun < GRACE_SECONDS)
    {
        if (wait4(child, &state, WNOHANG, used) == child)
            return state;
        nanosleep(&nap, NULL);
    }
    kill(child, SIGKILL);
    wait4(child, &state, 0, used);
    return state;
}

/* Waits for `child`, or makes an end of it. */
static int
attend(
    pid_t child, const otx_process_options *options, struct rusage *used,
    otx_process_end *out)
{
    const struct timespec nap = {0, POLL_NANOSECONDS};
    const double begun = otx_process_seconds();
    int state = 0;
    pid_t found;

    while ((found = wait4(child, &state, WNOHANG, used)) == 0 ||
           (found < 0 && errno == EINTR))
    {
        out->timed_out = otx_process_seconds() - begun > options->timeout;
        out->stopped = options->stop && options->stop();
        if (out->timed_out || out->stopped)
        {
            state = put_down(child, used);
            break;
        }
        nanosleep(&nap, NULL);
    }
    out->wall = otx_process_seconds() - begun;
    return state;
}

bool
otx_process_run(
    const otx_process_words *words, const otx_process_options *options,
    otx_process_end *out)
{
    struct rusage used = {0};
    pid_t child;
    int state;

    *out = (otx_process_end){.exit_code = -1};
    if (words->failed || words->count == 0)
        return false;
    child = fork();
    if (child < 0)
        return false;
    if (child == 0)
        become(words->items, options->log);
    state = attend(child, options, &used, out);
    out->cpu = seconds_of(&used.ru_utime) + seconds_of(&used.ru_stime);
    if (WIFEXITED(state))
        out->exit_code = WEXITSTATUS(state);
    if (WIFSIGNALED(state))
        out->signal = WTERMSIG(state);
    return true;
}

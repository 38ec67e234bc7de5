/* stop.c -- signals that end the program. */
#include "cli/stop.h"

#include <osdtex/osdtex.h>

#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum
{
    PATIENCE_MS = 700 /* for work that looks by itself */
};

typedef enum phase
{
    UNWATCHED,
    WATCHED, /* a signal may end the program */
    LAST,    /* files take their names, or have them */
    LEAVING  /* the program ends now */
} phase;

/* What a process has one of. */
static volatile sig_atomic_t caught;
static atomic_int now_in = UNWATCHED;
static sem_t asked; /* once for each signal, and at the end of the watch */
static pthread_t watcher;
static bool has_watcher;
static otx_path_list unfinished;

static void
catch_signal(int number)
{
    const bool is_meant =
        number == SIGINT || number == SIGTERM || number == SIGQUIT;
    const int error = errno;

    if (caught && is_meant && atomic_load(&now_in) == UNWATCHED)
    {
        signal(number, SIG_DFL);
        raise(number);
    }
    if (!caught || is_meant)
        sem_post(&asked);
    if (!caught)
        caught = number;
    errno = error;
}

void
otx_stop_listen(void)
{
    static const int numbers[] = {SIGINT,  SIGTERM, SIGQUIT,   SIGHUP,
                                  SIGXCPU, SIGUSR1, SIGUSR2,   SIGALRM,
                                  SIGPROF, SIGPWR,  SIGVTALRM, SIGIO};
    struct sigaction action = {0}, before;

    sem_init(&asked, 0, 0);
    action.sa_handler = catch_signal;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
        if (sigaction(numbers[i], NULL, &before) == 0 &&
            before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
    /* A closed pipe and a file too large (ulimit -f) are errors of the write,
     * not deaths that leave half a file. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

int
otx_stop_signal(void)
{
    return caught;
}

/* ---- the watch ----------------------------------------------------------- */

/* False when the work has got ahead of it. */
static bool
enter(phase next)
{
    int before = WATCHED;

    return atomic_compare_exchange_strong(&now_in, &before, next);
}

static void
leave(void)
{
    if (!enter(LEAVING))
        return;
    dprintf(STDERR_FILENO, "osdtex: stopped; nothing was written\n");
    for (int i = 0; i < unfinished.count; ++i)
        osdtex_outputs_sweep(unfinished.items[i].name);
    _exit(128 + caught);
}

/* Until somebody asks. */
static void
wait_to_be_asked(void)
{
    while (sem_wait(&asked) != 0 && errno == EINTR)
        ;
}

/* The same, but no longer than the patience lasts. */
static void
be_patient(void)
{
    struct timespec until;

    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += PATIENCE_MS * 1000000L;
    until.tv_sec += until.tv_nsec / 1000000000L;
    until.tv_nsec %= 1000000000L;
    while (sem_timedwait(&asked, &until) != 0 && errno == EINTR)
        ;
}

static void *
watch(void *unused)
{
    (void)unused;
    wait_to_be_asked();
    if (caught && atomic_load(&now_in) == WATCHED)
        be_patient();
    if (caught)
        leave();
    return NULL;
}

void
otx_stop_watch(const otx_path_list *outputs)
{
    sigset_t all, before;

    for (int i = 0; outputs && i < outputs->count; ++i)
        otx_path_list_add(&unfinished, outputs->items[i].name);
    atomic_store(&now_in, WATCHED);
    /* Signals are the other threads' to catch. */
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    has_watcher = pthread_create(&watcher, NULL, watch, NULL) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!has_watcher)
        atomic_store(&now_in, UNWATCHED);
}

/* Where the watcher was faster, the program has ended while this waits. */
static void
wait_for_the_end(void)
{
    while (atomic_load(&now_in) == LEAVING)
        pause();
}

void
otx_stop_never(void)
{
    if (!enter(LAST))
        wait_for_the_end();
    atomic_store(&now_in, LAST);
}

void
otx_stop_unwatch(void)
{
    otx_stop_never();
    if (has_watcher)
    {
        sem_post(&asked);
        pthread_join(watcher, NULL);
    }
    has_watcher = false;
    otx_path_list_free(&unfinished);
}

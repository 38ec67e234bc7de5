/* studio.c -- desk, worker and server together, until somebody ends it. */
#include "studio/studio.h"

#include "studio/sentence.h"
#include "studio/server.h"
#include "studio/worker.h"

#include <spawn.h>
#include <stdio.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

bool
otx_studio_is_built(void)
{
    return true;
}

/* Has the desktop open an address. The helper is let go: a browser may run on
 * beneath it. */
static void
open_browser(const char *address)
{
    char *const words[] = {
        (char[]){"sh"},
        (char[]){"-c"},
        (char[]){"xdg-open \"$1\" >/dev/null 2>&1 &"},
        (char[]){"sh"},
        (char *)(uintptr_t)address,
        NULL};
    pid_t child;

    if (posix_spawnp(&child, "sh", NULL, NULL, words, environ) == 0)
        waitpid(child, NULL, 0);
}

static void
wait_for_the_end(const otx_studio_options *options)
{
    const struct timespec moment = {0, 50000000};

    while (!options->is_stopped())
        nanosleep(&moment, NULL);
}

static osdtex_status
serve(
    const otx_studio_options *options, otx_desk *desk,
    char error[OTX_STUDIO_ERROR_BYTES])
{
    otx_server server;
    otx_studio_worker worker;
    char address[128];

    if (!otx_server_start(desk, &server, error))
        return OSDTEX_ERROR_IO;
    if (otx_worker_start(desk, &worker))
    {
        snprintf(
            address, sizeof address, "http://127.0.0.1:%u/%s/",
            server.door.port, server.door.token);
        options->say(options->say_user, address);
        if (options->opens_browser)
            open_browser(address);
        wait_for_the_end(options);
    }
    else
        otx_sentence(error, "there is no memory or no thread to begin with");
    otx_desk_end(desk);
    otx_server_stop(&server);

    const osdtex_status status =
        worker.is_started ? OSDTEX_OK : OSDTEX_ERROR_MEMORY;

    otx_worker_join(&worker);
    return status;
}

osdtex_status
otx_studio_run(
    const otx_studio_options *options, char error[OTX_STUDIO_ERROR_BYTES])
{
    otx_desk desk;
    osdtex_status status;

    error[0] = '\0';
    status = otx_desk_open(options, &desk, error);
    if (status == OSDTEX_OK)
        status = serve(options, &desk, error);
    otx_desk_close(&desk);
    return status;
}

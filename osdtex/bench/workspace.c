/* workspace.c -- opens and closes runs, and asks for resident memory. */
#include "bench/workspace.h"

#include <malloc.h>
#include <stdio.h>

static void
show(void *user, const osdtex_diagnostic *finding)
{
    (void)user;
    if (finding->severity >= OSDTEX_SEVERITY_WARNING)
        fprintf(stderr, "%s: %s\n", finding->stage, finding->message);
}

otx_status
bench_workspace_open(otx_run *run, int32_t threads)
{
    otx_allocator *allocator = otx_allocator_create(NULL);

    *run = (otx_run){.allocator = allocator, .seed = 1};
    if (!allocator)
        return OSDTEX_ERROR_MEMORY;
    run->arena = otx_arena_create(allocator);
    run->scratch = otx_arena_create(allocator);
    run->pool = otx_pool_create(allocator, threads);
    run->diagnostics = otx_diagnostics_create(allocator);
    if (run->arena && run->scratch && run->pool && run->diagnostics)
    {
        otx_diagnostics_listen(run->diagnostics, show, NULL);
        return OSDTEX_OK;
    }
    bench_workspace_close(run);
    return OSDTEX_ERROR_MEMORY;
}

void
bench_workspace_close(otx_run *run)
{
    if (!run->allocator)
        return;
    otx_pool_destroy(run->pool);
    otx_arena_destroy(run->scratch);
    otx_arena_destroy(run->arena);
    otx_diagnostics_destroy(run->diagnostics);
    otx_allocator_destroy(run->allocator);
    *run = (otx_run){0};
}

void
bench_workspace_reset_peak(void)
{
    FILE *file = fopen("/proc/self/clear_refs", "w");

    /* What was freed before is given back, so that it is not counted. */
    malloc_trim(0);
    if (!file)
        return;
    fputs("5", file);
    fclose(file);
}

double
bench_workspace_peak(void)
{
    FILE *file = fopen("/proc/self/status", "r");
    char line[256];
    double kilobytes = 0.0;

    if (!file)
        return 0.0;
    while (fgets(line, sizeof line, file))
        if (sscanf(line, "VmHWM: %lf kB", &kilobytes) == 1)
            break;
    fclose(file);
    return 1024.0 * kilobytes;
}

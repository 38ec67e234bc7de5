/* workspace.h -- a run of its own for each thing that is timed. */
#ifndef OTX_BENCH_WORKSPACE_H
#define OTX_BENCH_WORKSPACE_H

#include "base/run.h"

/* Everything in it is freed by the close; warnings and errors are printed. */
otx_status bench_workspace_open(otx_run *run, int32_t threads);
void bench_workspace_close(otx_run *run);

/* Resident memory of the process in bytes at its peak since the last reset; 0
 * where the system does not tell (only Linux does). */
void bench_workspace_reset_peak(void);
double bench_workspace_peak(void);

#endif

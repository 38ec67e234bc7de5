/* stop.h -- signals that end the program.
 *
 * The first one asks the work to stop, which it does as soon as it looks. Where
 * it is busy with something that cannot be asked (a library's refinement, a
 * disk), a thread ends the program instead: what is unfinished is removed, and
 * nothing waits for the work. A second signal from a person ends it at once. */
#ifndef OTX_CLI_STOP_H
#define OTX_CLI_STOP_H

#include "cli/path_list.h"

/* Catches all signals that would end the process, but those that the caller
 * ignores. */
void otx_stop_listen(void);

/* Number of the signal that has come; 0 none. */
int otx_stop_signal(void);

/* From here on the program ends within about a second of a signal. Without a
 * thread to be had, only when the work looks.
 *
 *   outputs  beside which unfinished files may lie; NULL none. Copied. */
void otx_stop_watch(const otx_path_list *outputs);

/* From here on nothing is left to stop: files take their names. */
void otx_stop_never(void);

/* Ends the watch, if there is one. */
void otx_stop_unwatch(void);

#endif

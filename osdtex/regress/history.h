/* history.h -- the figures of past runs, a line of JSON each. */
#ifndef OTX_REGRESS_HISTORY_H
#define OTX_REGRESS_HISTORY_H

#include <jansson.h>
#include <stdbool.h>

enum
{
    OTX_HISTORY_SHOWN = 60 /* runs that a trend goes back */
};

/* Appends time, version, machine, and of each case the status and figures. */
bool otx_history_append(const char *path, const json_t *run);

/* The last runs, oldest first; a damaged line is left out. */
json_t *otx_history_read(const char *path);

/* The figures of one metric of one case: numbers, oldest first. */
json_t *
otx_history_trend(const json_t *history, const char *name, const char *metric);

#endif

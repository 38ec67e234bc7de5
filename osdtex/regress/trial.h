/* trial.h -- one case run: what the program made of it, as children. */
#ifndef OTX_REGRESS_TRIAL_H
#define OTX_REGRESS_TRIAL_H

#include "regress/suite.h"

#include <osdtex/osdtex.h>

typedef struct otx_trial_options
{
    osdtex_context *context;
    const char *program;
    const char *output; /* folder; OUTPUT/CASE/ is filled, and what the last run
                         * left there goes */
    bool (*stop)(void);
} otx_trial_options;

/* What came out, as one object:
 *
 *     command  as a person would type it
 *     crash    why it ended before its end; absent when it did not
 *     log      the end of what it printed, when it crashed
 *     stopped  true: it was asked to
 *     seconds  wall
 *     picture  path
 *     files    name -> hash of content, but of logs and pictures
 *     metrics  name -> number
 */
json_t *otx_trial_run(
    const otx_suite *suite, const char *name, const json_t *item,
    const otx_trial_options *options);

#endif

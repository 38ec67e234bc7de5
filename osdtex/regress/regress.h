/* regress.h -- a suite of cases, run and held against its references. */
#ifndef OTX_REGRESS_REGRESS_H
#define OTX_REGRESS_REGRESS_H

#include "regress/suite.h"

#include <osdtex/osdtex.h>

typedef struct otx_regress_options
{
    osdtex_context *context;
    const char *folder;       /* of the suite */
    const char *output;       /* folder for results; exists */
    const char *history;      /* file of JSON lines */
    const char *program;      /* what runs the cases */
    const char *update;       /* a case or "all": references are rewritten */
    const char *const *names; /* [name_count] only these cases; 0: all */
    int name_count;
    bool (*stop)(void);
    void (*say)(void *user, const char *line);
    void *user;
} otx_regress_options;

typedef enum otx_regress_end
{
    OTX_REGRESS_PASSED,
    OTX_REGRESS_DIFFERS, /* a case differs, crashed, or has no reference */
    OTX_REGRESS_REFUSED, /* the table, a reference or a name of a case */
    OTX_REGRESS_UNWRITTEN,
    OTX_REGRESS_STOPPED
} otx_regress_end;

/* Runs the cases and writes OUTPUT/results.json, results.csv and report.html,
 * a line of `history`, and for `update` the references. `error` is filled
 * unless the suite passed or differs. */
otx_regress_end otx_regress_run(
    const otx_regress_options *options, char error[OTX_SUITE_ERROR_BYTES]);

#endif

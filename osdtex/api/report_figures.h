/* report_figures.h -- the numbers of a report as rows. */
#ifndef OTX_API_REPORT_FIGURES_H
#define OTX_API_REPORT_FIGURES_H

#include "base/run.h"
#include "mapping/figure.h"

#include <jansson.h>
#include <osdtex/osdtex.h>

/* Lists the figures of a report in run->arena, in its order.
 *
 *   own  what the method reported, with units; NULL none
 *
 * MEMORY. */
otx_status otx_report_figures(
    otx_run *run, const json_t *root, const otx_figures *own,
    const osdtex_figure **out, int32_t *count);

#endif

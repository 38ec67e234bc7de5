/* chart_check.h -- what holds of every chart.
 *
 * Builds with assertions check each chart that is made. */
#ifndef OTX_FLATTEN_CHART_CHECK_H
#define OTX_FLATTEN_CHART_CHECK_H

#include "flatten/chart.h"

/* NULL when the chart is sound, else what is not, for assert():
 *
 * - the core comes first, its faces have no distance to it;
 * - each face has the corners of its leaf, in the leaf's order;
 * - every vertex is used, and lies somewhere finite. */
const char *otx_chart_check(const otx_chart *chart, const otx_surface *surface);

#endif

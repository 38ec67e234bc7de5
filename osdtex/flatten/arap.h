/* arap.h -- as-rigid-as-possible flattening of a chart [Liu08].
 *
 * Start: faces are unfolded one after the other from the middle of the core.
 * Then rounds of two steps: every triangle takes the rotation that is nearest
 * to its map (local), and all vertices move to satisfy those rotations in the
 * least-squares sense (global, a cotangent Laplacian solved by conjugate
 * gradients from the last positions). Minimises the departure from isometry,
 * so scale is kept and a developable chart comes out exactly. */
#ifndef OTX_FLATTEN_ARAP_H
#define OTX_FLATTEN_ARAP_H

#include "flatten/chart.h"

/* Fills chart->flat. `space` still holds the chart's slots. MEMORY, without a
 * finding. */
otx_status otx_arap_flatten(
    otx_chart *chart, const otx_chart_request *request,
    const otx_chart_space *space, otx_arena *scratch);

#endif

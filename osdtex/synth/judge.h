/* judge.h -- whether what is seen exists in the exemplar, window by window.
 *
 * For windows around all texels that charts own, how far the pattern's nearest
 * one is. They are as large as a feature and low-passed, since windows of full
 * resolution mostly measure grain that was copied. The nearest is searched
 * from what the texels say themselves, so what is copied is found at once.
 *
 *     options = otx_judge_options_default();
 *     otx_judge_windows(run, &pattern, &chart, 1, &options, &judged);
 */
#ifndef OTX_SYNTH_JUDGE_H
#define OTX_SYNTH_JUDGE_H

#include "synth/synth.h"

typedef struct otx_judge_options
{
    int32_t level;  /* of the pattern; halved so often */
    int32_t radius; /* of windows, texels of the level */
    int32_t passes; /* of the search */
    uint64_t seed;
} otx_judge_options;

/* Windows of 56 texels at an eighth of the resolution. */
static inline otx_judge_options
otx_judge_options_default(void)
{
    return (otx_judge_options){3, 3, 5, 0};
}

/* A chart at the level. */
typedef struct otx_judged
{
    int32_t width, height;
    float step_x, step_y; /* texels of the chart to one of these */
    /* [width * height] RMS over the window, in the pattern's units; -1 where
     * the chart owns nothing or a quarter of the window is missing. */
    float *distances;
} otx_judged;

/* Charts show what their matches say; what of them is FREE is their own. Frozen
 * texels are seen in windows; those of collars are not, unless they are said to
 * be FROZEN, too.
 *
 *   out  [count], in run->scratch
 *
 * CANCELLED, MEMORY. */
otx_status otx_judge_windows(
    otx_run *run, const otx_pattern *pattern, const otx_synth_chart *charts,
    int32_t count, const otx_judge_options *options, otx_judged *out);

/* The same of the pattern against the rest of itself: windows nearer than
 * `apart` texels along both axes do not count. The mean and the quantile. */
otx_status otx_judge_itself(
    otx_run *run, const otx_pattern *pattern, double apart,
    const otx_judge_options *options, double quantile, double *mean,
    double *at_quantile);

#endif

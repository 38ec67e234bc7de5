/* metric.h -- the figures of a case, and how far they may move.
 *
 * Times are ratios: seconds over those of a fixed piece of work that is timed
 * in the same run, so that they mean something on another day and machine. */
#ifndef OTX_REGRESS_METRIC_H
#define OTX_REGRESS_METRIC_H

#include <jansson.h>
#include <stdbool.h>

/* Name -> number, from the JSON report of a run. What the report has no figure
 * for is left out.
 *
 *   cpu          seconds of the whole process
 *   calibration  seconds of otx_metric_calibrate */
json_t *otx_metric_take(const json_t *report, double cpu, double calibration);

/* The smaller of the times of both into `into`: what was measured twice. */
void otx_metric_keep_faster(json_t *into, const json_t *other);

bool otx_metric_is_time(const char *name);

/* CPU seconds of the fixed piece of work, the least of three; 0 when memory
 * ran out. */
double otx_metric_calibrate(void);

/* One row for each figure that is now or was in the reference: name, value,
 * reference, allowed (in words), status ("pass", "fail", "missing": without a
 * reference).
 *
 *   tolerances  name, or "time.*", -> relative tolerance, over those stated
 *               in metric.c; NULL none */
json_t *otx_metric_judge(
    const json_t *values, const json_t *reference, const json_t *tolerances);

#endif

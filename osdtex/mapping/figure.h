/* figure.h -- what a run did, in rows that a method reports itself.
 *
 * A method says what its figures are called, so that the report, the benchmark
 * and tests need not know which method has which. A name is the key in the
 * JSON report, below `mapping`; a dot in it leads into an object there:
 *
 *     otx_figures_count(job->figures, "lattice.faces", "faces", 96);
 *     otx_figures_real(job->figures, "threshold", "random pairs", 0.7);
 *
 * docs/report.md says what each figure means. Nothing here can fail: rows
 * beyond OTX_FIGURES_MAX are left out, and figures may be NULL. */
#ifndef OTX_MAPPING_FIGURE_H
#define OTX_MAPPING_FIGURE_H

#include "exemplar/exemplar.h"

enum
{
    OTX_STAGES_MAX = 16,
    OTX_FIGURES_MAX = 64
};

typedef enum otx_figure_kind
{
    OTX_FIGURE_COUNT, /* a whole number */
    OTX_FIGURE_REAL,
    OTX_FIGURE_ITEM /* a whole number of a list: rows of one name, in order */
} otx_figure_kind;

typedef struct otx_figure
{
    const char *name; /* static */
    const char *unit; /* static; what is counted, or "" for a plain number */
    otx_figure_kind kind;
    double value;
} otx_figure;

/* Wall seconds of a stage. */
typedef struct otx_stage_time
{
    const char *name; /* static */
    double seconds;
} otx_stage_time;

typedef struct otx_figures
{
    int32_t stage_count;
    otx_stage_time stages[OTX_STAGES_MAX];
    int32_t count;
    otx_figure rows[OTX_FIGURES_MAX];
    /* What each exemplar was taken for; NULL where it was not looked at. */
    const char *classes[OTX_EXEMPLARS_MAX];
} otx_figures;

/* Ends the stage that is running and starts the next; NULL only ends. */
void otx_figures_stage(otx_figures *figures, const char *name);

void otx_figures_count(
    otx_figures *figures, const char *name, const char *unit, int64_t value);
void otx_figures_real(
    otx_figures *figures, const char *name, const char *unit, double value);
/* Appends to the list of that name. */
void otx_figures_item(
    otx_figures *figures, const char *name, const char *unit, int64_t value);

/* The value of the first row of that name; NAN when there is none. */
double otx_figures_value(const otx_figures *figures, const char *name);

#endif

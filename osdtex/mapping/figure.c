/* figure.c -- what a run did, in rows that a method reports itself. */
#include "mapping/figure.h"

#include "base/clock.h"

#include <math.h>
#include <string.h>

/* A stage that runs has its start, negative, as its seconds. */
void
otx_figures_stage(otx_figures *figures, const char *name)
{
    const double time = otx_clock_now();

    if (!figures)
        return;
    if (figures->stage_count > 0 &&
        figures->stages[figures->stage_count - 1].seconds < 0.0)
        figures->stages[figures->stage_count - 1].seconds += time;
    if (name && figures->stage_count < OTX_STAGES_MAX)
        figures->stages[figures->stage_count++] = (otx_stage_time){name, -time};
}

static void
add(otx_figures *figures, otx_figure row)
{
    if (figures && figures->count < OTX_FIGURES_MAX)
        figures->rows[figures->count++] = row;
}

void
otx_figures_count(
    otx_figures *figures, const char *name, const char *unit, int64_t value)
{
    add(figures, (otx_figure){name, unit, OTX_FIGURE_COUNT, (double)value});
}

void
otx_figures_real(
    otx_figures *figures, const char *name, const char *unit, double value)
{
    add(figures, (otx_figure){name, unit, OTX_FIGURE_REAL, value});
}

void
otx_figures_item(
    otx_figures *figures, const char *name, const char *unit, int64_t value)
{
    add(figures, (otx_figure){name, unit, OTX_FIGURE_ITEM, (double)value});
}

double
otx_figures_value(const otx_figures *figures, const char *name)
{
    for (int32_t i = 0; i < figures->count; ++i)
        if (strcmp(figures->rows[i].name, name) == 0)
            return figures->rows[i].value;
    return NAN;
}

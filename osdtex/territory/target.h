/* target.h -- the texels of charts, as synthesis takes them.
 *
 * A texel of a chart's own faces that is near is FREE, one of a neighbour's is
 * that one's and COLLAR here; all others are FROZEN at what their UVs say. */
#ifndef OTX_TERRITORY_TARGET_H
#define OTX_TERRITORY_TARGET_H

#include "synth/synth.h"
#include "territory/plot.h"

/* What otx_synth_chart borrows of a chart; rows of its plot's width. */
typedef struct otx_target
{
    uint8_t *kinds;
    float *metric;
    otx_synth_match *matches;
    otx_synth_place *places;
    float *field; /* NULL without a guide */
    int64_t free; /* texels to make */
} otx_target;

typedef struct otx_target_set
{
    otx_run *run;
    const otx_mapping *mapping;
    const otx_exemplar *exemplars;
    double texels; /* per scene unit */
    otx_territory territory;
    otx_plot *plots;        /* [territory.count] */
    otx_target *targets;    /* likewise */
    int32_t exemplar;       /* at hand */
    const otx_guide *guide; /* that the exemplar at hand follows; NULL */
    const uint8_t *loose;   /* [leaf face_count] 1: it need not; NULL none */
    bool whole; /* all is near, and UVs may be reversed or without area */
} otx_target_set;

/* Parts the surface of set->mapping into charts and lays out their plots, in
 * run->scratch; nothing is near yet, and targets are empty.
 *
 *   side, collar  as of otx_territory_options
 *
 * CANCELLED, MEMORY. */
otx_status
otx_target_set_lay_out(otx_target_set *set, double side, double collar);

/* Chart k, whose exemplar is at hand; in run->scratch, where it is filled for
 * the first time. MEMORY. */
otx_status otx_target_fill(otx_target_set *set, int32_t k);

/* Sets the matches of a chart's collar to what their owners have made. */
void otx_target_read_collar(otx_target_set *set, int32_t k);

/* Those of the exemplar at hand for the engine. Those of others stand between
 * them without a texel, so that numbers stay.
 *
 *   out  [territory.count] */
void otx_target_charts(const otx_target_set *set, otx_synth_chart *out);

/* The exemplar at hand for the engine, in run->scratch. MEMORY. */
otx_status
otx_target_pattern(const otx_target_set *set, int32_t levels, otx_pattern *out);

#endif

/* occurrence.h -- how often each part of a pattern is taken.
 *
 * What is taken more often than its share costs more, so that the best windows
 * of an exemplar do not fill the picture: without it random starts collapse to
 * a few of them. Only at the coarsest level, and annealed away there: what
 * holds on below keeps joints from forming (docs/notes/synth.md). */
#ifndef OTX_SYNTH_OCCURRENCE_H
#define OTX_SYNTH_OCCURRENCE_H

#include "synth/canvas.h"

enum
{
    OTX_OCCURRENCE_CELLS = 32 /* along each side */
};

typedef struct otx_occurrence
{
    int32_t counts[OTX_OCCURRENCE_CELLS * OTX_OCCURRENCE_CELLS];
    float weight; /* cost of a cell, for each time that it is taken */
} otx_occurrence;

static inline int32_t
otx_occurrence_cell(const otx_pattern *p, otx_synth_match m)
{
    int32_t i = (int32_t)(m.x * (float)OTX_OCCURRENCE_CELLS / (float)p->width);
    int32_t j = (int32_t)(m.y * (float)OTX_OCCURRENCE_CELLS / (float)p->height);

    i = i < 0 ? 0 : i >= OTX_OCCURRENCE_CELLS ? OTX_OCCURRENCE_CELLS - 1 : i;
    j = j < 0 ? 0 : j >= OTX_OCCURRENCE_CELLS ? OTX_OCCURRENCE_CELLS - 1 : j;
    return j * OTX_OCCURRENCE_CELLS + i;
}

/* Counts what all canvases take, and what one more costs: `share` of the mean
 * cost now, times how often a cell is taken beside its share. */
void otx_occurrence_count(
    const otx_canvas *const *canvases, int32_t count, double share,
    otx_occurrence *out);

#endif

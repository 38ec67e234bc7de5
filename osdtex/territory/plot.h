/* plot.h -- a chart's texels, and what of the surface each shows.
 *
 * Texels are as large as the exemplar's. A texel is of the first face of the
 * chart that has its middle, and core faces come first, so a chart that
 * overlaps itself keeps its own part. */
#ifndef OTX_TERRITORY_PLOT_H
#define OTX_TERRITORY_PLOT_H

#include "surface/facet.h"
#include "territory/territory.h"

typedef struct otx_plot
{
    const otx_chart *chart;
    int32_t width, height;
    otx_vec2 origin; /* of texel (0, 0), in the chart */
    /* [width * height] 256 times the face, as the chart counts it, and the
     * facet of it; -1: nothing. */
    int32_t *facets;
    uint8_t *near; /* [width * height] 1: in reach of a seam */
} otx_plot;

/* A facet as a chart shows it. */
typedef struct otx_plot_facet
{
    otx_facet facet;
    otx_vec2 p[3]; /* in the plot, texels */
    /* Barycentric coordinates of the plot's origin, and per texel along x and
     * y. */
    double at[3], dx[3], dy[3];
    double metric[3];  /* (xx, xy, yy): the root of the first fundamental form,
                        * texels of the exemplar */
    otx_vec2 rotation; /* from the metric's frame to the facet's own */
} otx_plot_facet;

/* Lays out texels and finds their facets, in run->scratch. MEMORY; a chart that
 * is too large for a picture has no texels. */
otx_status otx_plot_build(
    otx_run *run, const otx_surface *surface, const otx_chart *chart,
    otx_plot *out);

/* Marks what is within `reach` texels of edges that are seams.
 *
 *   seam  [leaf edge_count] 1: a seam */
void otx_plot_mark(
    const otx_surface *surface, const uint8_t *seam, double reach,
    otx_plot *plot);

/* Facet `index` of face `slot` of the chart. False when it has no area. */
bool otx_plot_facet_of(
    const otx_plot *plot, const otx_surface *surface, double texels,
    int32_t slot, int32_t index, otx_plot_facet *out);

/* Barycentric coordinates of a texel's middle. */
static inline void
otx_plot_at(const otx_plot_facet *f, int32_t x, int32_t y, double at[3])
{
    for (int k = 0; k < 3; ++k)
        at[k] = f->at[k] + (x + 0.5) * f->dx[k] + (y + 0.5) * f->dy[k];
}

enum
{
    OTX_PLOT_FACETS = 256 /* of a face */
};

/* A facet as otx_plot.facets has it. */
static inline int32_t
otx_plot_id(int32_t slot, int32_t index)
{
    return slot * OTX_PLOT_FACETS + index;
}

/* The texels [x0, x1) x [y0, y1) that a facet may have: x0, y0, x1, y1. */
void
otx_plot_box(const otx_plot *plot, const otx_plot_facet *facet, int32_t box[4]);

/* A corner of face `slot`, in the plot. */
static inline otx_vec2
otx_plot_corner(const otx_plot *plot, int32_t slot, int32_t k)
{
    const otx_chart *c = plot->chart;

    return otx_vec2_sub(c->flat[c->corners[c->first[slot] + k]], plot->origin);
}

#endif

/* vertex.h -- what the parts of synthesis on a surface hand to each other
 * [Turk01]. See docs/notes/vertex.md. */
#ifndef OTX_METHOD_VERTEX_VERTEX_H
#define OTX_METHOD_VERTEX_VERTEX_H

#include "method/method.h"
#include "territory/target.h"

typedef enum otx_vertex_start
{
    OTX_VERTEX_START_AUTO,
    OTX_VERTEX_START_PATCHES, /* what patches of the same job show */
    OTX_VERTEX_START_RANDOM   /* places by chance */
} otx_vertex_start;

typedef enum otx_vertex_mode
{
    OTX_VERTEX_MODE_AUTO,
    OTX_VERTEX_MODE_CHARTS, /* texels of charts, by room synth */
    OTX_VERTEX_MODE_PAPER   /* vertices of a dense mesh, as published */
} otx_vertex_mode;

typedef struct otx_vertex_settings
{
    double tolerance; /* of the field, degrees */
    int32_t mode;
    int32_t start;
    int32_t levels; /* 0 automatic */
    int32_t starts; /* of the coarsest level; 0 automatic */
} otx_vertex_settings;

typedef struct otx_vertex
{
    const otx_job *job;
    otx_run *run;
    otx_vertex_settings settings;
    otx_analysis analysis;
    otx_mapping mapping; /* that comes of it */
    otx_guide guide;     /* combed; without directions: none */
    otx_target_set set;
    otx_synth_chart *charts; /* [set.territory.count] */
} otx_vertex;

/* The guide with each face's direction the one of its equals that goes on from
 * its neighbours': no two meet turned but where the field's poles ask for it.
 * In run->arena. MEMORY. */
otx_status otx_vertex_comb(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    otx_guide *out);

/* Faces within `reach` scene units of where the field turns fast.
 *
 *   out  [leaf face_count] 1: they are, in run->arena
 *
 * MEMORY. */
otx_status otx_vertex_find_poles(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    double reach, uint8_t **out);

/* UVs of every face as its middle goes on to its corners, and the chart that
 * it is in as its patch: in v->mapping. MEMORY. */
otx_status otx_vertex_lay_uvs(otx_vertex *v);

/* Reports what was made. MEMORY. */
otx_status otx_vertex_report(const otx_vertex *v);

#endif

/* mosaic_job.h -- what patches are to cover, with what, and how. */
#ifndef OTX_PATCH_MOSAIC_JOB_H
#define OTX_PATCH_MOSAIC_JOB_H

#include "base/run.h"
#include "cluster/dual.h"
#include "mapping/figure.h"
#include "mapping/mapping.h"
#include "patch/given.h"
#include "patch/patch_settings.h"

/* What is made of a job: mosaic.h. */
typedef struct otx_mosaic otx_mosaic;

/* The user's first patch, which is said of a face of the cage. */
typedef struct otx_first
{
    int32_t face;      /* -1 none */
    otx_vec2 position; /* UV that its middle lands on */
    double angle;      /* of its first edge there, radians */
} otx_first;

/* Nothing of it changes while patches are made. */
typedef struct otx_mosaic_job
{
    otx_run *run;
    const otx_surface *surface;
    otx_dual leaves;               /* of the surface's leaf level */
    const otx_exemplar *exemplars; /* [exemplar_count] */
    int32_t exemplar_count;
    const uint8_t *demand; /* [leaf face_count] which exemplar; NULL: one */
    double scale;          /* width of the first exemplar, scene units */
    double texels;         /* per scene unit */
    otx_first first;
    const otx_patch_given *given; /* NULL none */
    otx_patch_settings settings;  /* those of the first exemplar */
    otx_figures *figures;         /* NULL none */
} otx_mosaic_job;

#endif

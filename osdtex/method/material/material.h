/* material.h -- state of one run of material space texturing.
 *
 * [Ray09] Ray, Levy, Wang, Turk, Vallet: Material space texturing. CGF 28.
 *
 * The texture is laid over the whole surface by periodic coordinates whose
 * cell is the exemplar's lattice cell, so that rows and strands run through;
 * around defects of the coordinates patches fill in. See
 * docs/notes/material.md.
 */
#ifndef OTX_METHOD_MATERIAL_H
#define OTX_METHOD_MATERIAL_H

#include "field/direction.h"
#include "field/scale.h"
#include "field/singularity.h"
#include "image/analysis.h"
#include "method/material/phase.h"
#include "method/method.h"

/* Meaning, range and default of each: the table in settings.c. */
typedef struct otx_material_settings
{
    int32_t symmetry; /* 0 auto, 1 one, 2 two */
    double octaves;
    double clear;
    int32_t fill;
    double turn;
} otx_material_settings;

extern const otx_option otx_material_options[];
enum
{
    OTX_MATERIAL_OPTION_COUNT = 5
};

typedef struct otx_material
{
    otx_run *run;
    const otx_surface *surface;
    const otx_exemplar *exemplar;
    const otx_map_request *request;
    const otx_material_settings *settings;
    otx_map_stats *stats;
    otx_analysis analysis;
    double texels; /* per scene unit */
    double cell;   /* length of the shorter generator, scene units */

    int32_t level;             /* that is solved on */
    otx_connection connection; /* of that level */
    otx_direction field;
    double *log_scale; /* [vert_count] */
    otx_phase phase;
    double *distance; /* [face_count] from the nearest defect, scene units */

    int32_t *face_patch; /* [leaf face_count] */
    otx_vec2 *uvs;       /* [leaf corner_count] texels */
    int32_t patch_count;
} otx_material;

#endif

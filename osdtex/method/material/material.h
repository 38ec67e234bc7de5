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

#include "analysis/analysis.h"
#include "analysis/courses.h"
#include "field/nested.h"
#include "field/scale.h"
#include "field/singularity.h"
#include "method/method.h"
#include "periodic/rings.h"
#include "periodic/unwrap.h"

enum
{
    OTX_FILL_OFF,
    OTX_FILL_ON,
    OTX_FILL_BLEND
};

enum
{
    OTX_COURSING_AUTO,
    OTX_COURSING_ON,
    OTX_COURSING_OFF
};

/* Meaning, range and default of each: the table in settings.c. */
typedef struct otx_material_settings
{
    int32_t symmetry; /* 0 auto, 1 one, 2 two */
    int32_t courses;
    double octaves;
    double cancel;
    double clear;
    int32_t fill;
    double turn;
    double stretch;
} otx_material_settings;

extern const otx_option otx_material_options[];
enum
{
    OTX_MATERIAL_OPTION_COUNT = 8
};

/* What is reported, beside what the results hold. */
typedef struct otx_material_tally
{
    double clean_share;    /* of the area, over a cell from any defect */
    double filled_share;   /* of the area, covered by patches */
    int32_t blended_faces; /* that show the mean of several lookups */
    double blended_share;  /* of the area, theirs */
} otx_material_tally;

/* Periodic coordinates and what they were solved from, of one level. */
typedef struct otx_material_solved
{
    int32_t level;
    otx_connection connection; /* of that level */
    otx_direction field;
    double *log_scale; /* [vert_count] */
    otx_phase phase;
    otx_rings rings;
    double *distance; /* [face_count] from the nearest defect, scene units */
} otx_material_solved;

/* What the leaves show. */
typedef struct otx_material_laid
{
    int32_t *face_patch; /* [leaf face_count] */
    otx_vec2 *uvs;       /* [leaf corner_count] texels */
    int32_t patch_count;
    otx_vec2 *cells; /* [leaf corner_count] lattice coordinates */
    uint8_t *open;   /* [leaf face_count] 1: patches cover it */
} otx_material_laid;

typedef struct otx_material
{
    const otx_job *job;
    const otx_material_settings *settings;
    otx_analysis analysis;
    double texels; /* per scene unit */
    double cell;   /* length of the shorter generator, scene units; height of a
                    * course */
    otx_courses courses; /* count 0: the lattice is laid as a whole */
    otx_material_solved solved;
    otx_material_laid laid;
    otx_material_tally tally;
} otx_material;

/* Coordinates of leaf corners, [leaf corner_count] in `arena`, from those of
 * the solved level: linear along edges and to the middle of faces. MEMORY. */
otx_status otx_material_refine(
    const otx_material *m, otx_arena *arena, otx_vec2 *from, otx_vec2 **out);

/* label.c: takes whole cells off the faces that are not `open` ([leaf
 * face_count]), so that they lie inside an exemplar that does not tile.
 * SUPPORT when no cell does. */
otx_status
otx_label_windows(const otx_material *m, const uint8_t *open, otx_vec2 *cells);

/* Numbers patches of faces that are not open: within one, a vertex has one
 * UV. */
otx_status otx_label_patches(
    const otx_material *m, const uint8_t *open, const otx_vec2 *cells,
    int32_t *face_patch, int32_t *patch_count);

/* refill.c: opens the leaf faces that lie close to a dislocation. */
void otx_refill_clear(otx_material *m);
/* Opens also those that the periodic texture does not suit. MEMORY. */
otx_status otx_refill_choose(otx_material *m);
/* Covers them by patches that follow the field. */
otx_status otx_refill_run(otx_material *m, otx_mapping *out);

/* blend.c: whether the exemplar and the coordinates allow for it. SUPPORT. */
otx_status otx_blend_check(const otx_material *m);
/* Gives the faces of singular rings a lookup for each of their corners. */
otx_status otx_blend_run(otx_material *m, otx_mapping *out);

#endif

/* elastic_state.h -- what the files of the relaxation share.
 *
 * elastic.c runs rounds over levels, elastic_system.c makes and solves the
 * linear system of a round, elastic_guard.c takes back what may not be. */
#ifndef OTX_RELAX_ELASTIC_STATE_H
#define OTX_RELAX_ELASTIC_STATE_H

#include "image/pyramid.h"
#include "relax/elastic.h"
#include "relax/sheet.h"
#include "seam/difference.h"
#include "seam/edge.h"

enum
{
    /* Of a task. */
    OTX_ELASTIC_SEAMS = 256,
    OTX_ELASTIC_FACES = 1024,
    OTX_ELASTIC_ROWS = 2048
};

/* What one end of a seam adds to its variable's right-hand side (taken away)
 * and diagonal. */
typedef struct otx_elastic_share
{
    otx_vec2 g, diagonal;
} otx_elastic_share;

/* The rows of one end of a seam, and the variables that they are applied to.
 * Ends lie in the order of their own variables, so that a product reads memory
 * from front to back. */
typedef struct otx_elastic_end
{
    float row[2][8];
    int32_t v[4];
} otx_elastic_end;

/* An exemplar at the level of its pyramid that is worked on. */
typedef struct otx_elastic_view
{
    const otx_exemplar *exemplar;
    const otx_image *image;
} otx_elastic_view;

/* What seams compare. */
typedef struct otx_elastic_pictures
{
    const otx_exemplar *exemplars;
    int32_t count;
    otx_pyramid *pyramids;
    otx_elastic_view *views;
    uint8_t *source; /* [sheet.count] the exemplar of each variable */
} otx_elastic_pictures;

/* Ends of seams by their variables. */
typedef struct otx_elastic_ends
{
    int32_t *first; /* [sheet.count + 2] */
    otx_elastic_end *items;
    otx_elastic_share *shares; /* like items */
    int32_t *of; /* [4 * seam_count] where each end of a seam lies */
} otx_elastic_ends;

typedef struct otx_elastic_energy
{
    double *seams; /* [seam_count] */
    double *terms; /* [sheet.count] of rigidity */
    double total;  /* before the round */
} otx_elastic_energy;

/* [sheet.count] each: the equations of a round and its step. */
typedef struct otx_elastic_system
{
    otx_vec2 *step, *b, *diagonal;
} otx_elastic_system;

/* What a step is held against. Badness is the larger of stretch and its
 * inverse. */
typedef struct otx_elastic_guard
{
    otx_vec2 *from;  /* [sheet.count] positions before the step */
    uint8_t *held;   /* [sheet.count] variables taken back this round */
    double *before;  /* [face_count] badness of each face before the round */
    double *badness; /* [face_count] and now */
} otx_elastic_guard;

typedef struct otx_elastic
{
    otx_run *run;
    const otx_surface *surface;
    const otx_elastic_options *options;
    otx_elastic_pictures pictures;
    otx_sheet sheet;
    otx_rigid_fans fans;
    otx_elastic_ends ends;
    otx_elastic_energy energy;
    otx_elastic_system system;
    otx_elastic_guard guard;
} otx_elastic;

/* Runs a body over blocks of `size` of `count`. Bodies do not fail. */
static inline void
otx_elastic_over_blocks(
    otx_elastic *e, int32_t count, int32_t size, otx_pool_body body)
{
    otx_pool_for(e->run->pool, ((int64_t)count + size - 1) / size, body, e);
}

static inline int32_t
otx_elastic_block_end(int64_t first, int32_t size, int32_t count)
{
    return first + size < count ? (int32_t)first + size : count;
}

/* The variables at the four ends of a seam's two sides. */
static inline void
otx_elastic_variables(const otx_sheet_seam *seam, int32_t v[4])
{
    v[0] = seam->a[0];
    v[1] = seam->a[1];
    v[2] = seam->b[0];
    v[3] = seam->b[1];
}

/* What the two sides of a seam show. */
typedef struct otx_elastic_flanks
{
    otx_seam_side a, b;
    double weight; /* 1 / sigma^2, of the mean of both sides' sigma^2 */
} otx_elastic_flanks;

otx_elastic_flanks
otx_elastic_flanks_of(const otx_elastic *e, const otx_sheet_seam *seam);

/* Lists the ends of seams by their variables. */
void otx_elastic_list_ends(otx_elastic *e);

/* The Gauss-Newton step from where the sheets are. Pulls and products of the
 * energy, which was measured there, are used.
 *
 *   step  [count] in run->scratch
 *
 * MEMORY. */
otx_status otx_elastic_find_step(otx_elastic *e, otx_vec2 **step);

/* Judges all faces, into e->guard.badness. */
otx_status otx_elastic_judge(otx_elastic *e);

/* Moves by `share` of e->system.step, each variable by `longest` texels at
 * most, from e->guard.from (the state before). Moves that would flip a face or
 * stretch it past the limit are taken back, and counted. */
otx_status otx_elastic_move(
    otx_elastic *e, double share, double longest, int64_t *refused);

#endif

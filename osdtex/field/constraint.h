/* constraint.h -- what the artist asks of the fields on a surface.
 *
 * Constraints are tied to the cage, by face or by a point near the surface, so
 * that they hold at every level. The file format is described in
 * docs/formats-constraints.md; reading it is the file room's. */
#ifndef OTX_FIELD_CONSTRAINT_H
#define OTX_FIELD_CONSTRAINT_H

#include "field/direction.h"
#include "field/scale.h"

/* At a face of the cage (all of it), or around a point. */
typedef struct otx_constraint
{
    int32_t face;   /* of the cage; -1: at the point */
    otx_vec3 point; /* scene units */
    double radius;  /* around the point; at least the nearest face is held */
    bool has_direction;
    otx_vec3 direction;
    double scale; /* factor on the texture's size; 0 says nothing */
    bool has_material;
    double material; /* 0 .. 1 */
    /* That is to be shown, from 1; 0 says nothing. Not a field: mappings of
     * several exemplars read it. */
    int32_t exemplar;
    const char *exemplar_name; /* the same by its file; NULL none */
    /* Of edits of a mapping, which fields do not read. */
    int32_t edit; /* with which it is asked, from 1; 0: when it is made */
    int32_t redo; /* which other texture is to be tried, from 1; 0: says
                   * nothing */
    double reach; /* that the edit has along the surface, scene units; 0: a
                   * suitable one */
} otx_constraint;

/* What attracts the field where no constraint says otherwise. */
typedef enum otx_follow
{
    OTX_FOLLOW_NOTHING, /* the smoothest field */
    OTX_FOLLOW_AXIS,
    OTX_FOLLOW_EDGES,
    OTX_FOLLOW_CURVATURE
} otx_follow;

/* A field that is there already, on the leaves. */
typedef struct otx_constraint_field
{
    const otx_vec3 *directions; /* [leaf face_count] of any length, zero: free;
                                 * NULL: nothing is said of any */
    const double *log_scale;    /* [leaf vert_count] -ln of factors; NULL
                                 * likewise. Scales of constraints are in it */
} otx_constraint_field;

typedef struct otx_constraint_set
{
    const char *path; /* for messages; NULL none */
    int32_t symmetry; /* 1, 2, 4; 0: the exemplar's */
    otx_follow follow;
    bool follows;         /* it was said what to follow, if only smoothness */
    otx_vec3 axis;        /* of OTX_FOLLOW_AXIS */
    double follow_length; /* over which it gives way, scene units; 0: a
                           * twentieth of the diagonal */
    bool is_table;        /* has a line a face, if all are there */
    int32_t count;
    const otx_constraint *items;
    otx_constraint_field field; /* that the constraints add to */
} otx_constraint_set;

/* Whether a constraint can be held. ARGUMENT, naming it: a face that is not
 * there or a hole, what is no finite number or out of its range. */
otx_status otx_constraint_check(
    otx_run *run, const otx_constraint_set *set, const otx_cage *cage,
    int32_t index);

/* Whether a set that is a table has one line for each face of a cage.
 * ARGUMENT, MEMORY. */
otx_status otx_constraint_check_table(
    otx_run *run, const otx_constraint_set *set, int32_t face_count);

/* Turns constraints into pins on the faces of a level, in run->arena. `set`
 * may be NULL. ARGUMENT, naming the constraint, for what cannot be held: a
 * face that is not there or a hole, no finite numbers, a direction upright on
 * the surface. Contradictions are warnings: the later constraint holds. */
otx_status otx_constraint_pins(
    otx_run *run, const otx_constraint_set *set,
    const otx_connection *connection, otx_direction_request *out);

/* The pins alone, on the faces of `effect` ([face_count]; NULL: all). */
otx_status otx_constraint_hold(
    otx_run *run, const otx_constraint_set *set,
    const otx_connection *connection, const uint8_t *effect,
    otx_direction_request *out);

/* A scalar field on the vertices of a level. */
typedef enum otx_constraint_kind
{
    OTX_CONSTRAINT_SCALE,   /* -ln of the asked factors, +-ln 16 */
    OTX_CONSTRAINT_MATERIAL /* 0 .. 1 */
} otx_constraint_kind;

/* What is asked of a scalar field, smoothly interpolated; 0 on components of
 * which nothing is asked.
 *
 *   effect  [vert_count], 1 free, others keep `values`; NULL: all are free
 *   values  [vert_count] in and out; left alone where the set asks nothing */
otx_status otx_constraint_interpolate(
    otx_run *run, const otx_constraint_set *set,
    const otx_connection *connection, otx_constraint_kind kind,
    const uint8_t *effect, double *values);

/* Adds -ln of the asked scale factors to `log_scale` ([vert_count]). `set` may
 * be NULL. */
otx_status otx_constraint_scale(
    otx_run *run, const otx_constraint_set *set,
    const otx_connection *connection, double *log_scale);

/* The area in which an edit takes effect [Ray09, sec. 2.1]: faces nearest to
 * the constraint first, up to `radius` scene units along the surface; 1 each,
 * [face_count] in run->arena. INFINITY: the whole component. */
otx_status otx_constraint_effect(
    otx_run *run, const otx_connection *connection,
    const otx_constraint *constraint, double radius, uint8_t **out);

#endif

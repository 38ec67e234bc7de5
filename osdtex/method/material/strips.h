/* strips.h -- the courses on a surface, one by one.
 *
 * Between the lines on which the coordinate across is whole lie strips: rings
 * round a limb, bands that end at a border or at a dislocation, a spiral. Each
 * has a sense, along which its length is measured, and may slide along its
 * neighbours, so that no length has to agree with that of the next one. */
#ifndef OTX_METHOD_MATERIAL_STRIPS_H
#define OTX_METHOD_MATERIAL_STRIPS_H

#include "method/material/coursing.h"

typedef struct otx_course_strip
{
    int32_t faces;
    int32_t course; /* of the exemplar that it shows */
    int32_t loops;  /* places where it is torn */
    double length;  /* of a ring, once round, texels; else 0 */
    double closing; /* texels of the exemplar after which a ring is closed */
    double start;   /* texel with which it begins anew each time */
    double shift;   /* texels that `along` is moved by */
} otx_course_strip;

/* Two strips that lie side by side, a < b. */
typedef struct otx_strip_contact
{
    int32_t a, b, edge;
    double agree; /* scene units along which their senses agree, less those
                   * along which they do not */
    double above; /* units with b above a, less those with b below */
    otx_vec2 lag; /* sum of units times e^(2 pi i lag), the pictures that b is
                   * ahead of a */
} otx_strip_contact;

typedef struct otx_strips
{
    const otx_material *m;
    otx_connection leaf;
    int32_t count;
    otx_course_strip *strips;
    int32_t *of;     /* [leaf face_count] strip, -1 none */
    int8_t *sense;   /* [leaf face_count] -1: the coordinate across falls where
                      * its strip's rises */
    int32_t *course; /* [leaf face_count] whole part of the coordinate */
    otx_vec2 *rise;  /* [leaf face_count] its gradient, courses per unit */
    int8_t *edges;   /* [leaf edge_count] 1, -1: a strip goes on across it,
                      * with the same or the opposite sense; 2, -2: two meet;
                      * 0 neither */
    double *along;   /* [leaf corner_count] texels */
    otx_strip_contact *contacts; /* by a and b */
    int32_t contact_count;
} otx_strips;

/* Courses above the lower joint of its strip, at a corner of a leaf face;
 * 0 .. 1 but for faces that a joint runs through. */
static inline double
otx_strips_across(const otx_strips *s, int32_t face, int32_t corner)
{
    const double t = s->m->laid.cells[corner].y - s->course[face];

    return s->sense[face] > 0 ? t : 1.0 - t;
}

/* Finds the strips of the leaf faces that are not open by m->cells, and turns
 * them so that neighbours agree where they can. In run->scratch. MEMORY. */
otx_status otx_strips_find(const otx_material *m, otx_strips *out);

/* Lists the contacts anew, by what the strips now are. MEMORY. */
otx_status otx_strips_touch(otx_strips *s);

/* Visits all strips, the longest contacts with visited ones first; `from` is
 * -1, with no contact, for the first of each piece. MEMORY. */
typedef void otx_strips_visitor(
    otx_strips *s, int32_t strip, int32_t from,
    const otx_strip_contact *contact);
otx_status otx_strips_visit(otx_strips *s, otx_strips_visitor *visitor);

/* unroll.c: where strips meet themselves. */
typedef struct otx_strip_tear
{
    int32_t edge;
    int32_t low; /* the face of the edge where a round begins */
    double rest; /* texels from there to the other */
    int32_t group;
} otx_strip_tear;

typedef struct otx_strip_tears
{
    int32_t count, group_count;
    otx_strip_tear *tears;
    double *lengths; /* [group_count] texels round */
} otx_strip_tears;

/* Measures the way round each strip: `loops`, `length`. MEMORY. */
otx_status otx_unroll_measure(otx_strips *s, otx_strip_tears *out);
/* Lays `along` so that each strip is as little stretched as can be and closes
 * after `closing`, or, of several loops, whole pictures. NUMERIC, MEMORY. */
otx_status otx_unroll_solve(otx_strips *s, const otx_strip_tears *tears);

#endif

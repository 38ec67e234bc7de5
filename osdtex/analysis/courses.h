/* courses.h -- rows that may slide along each other: masonry, planks.
 *
 * Where a picture consists of courses with joints between them that look the
 * same all along, a course may be shifted against the next one at will, and
 * nobody sees it. A mapping then needs whole courses across, but no common
 * coordinate along them. See docs/notes/material.md. */
#ifndef OTX_ANALYSIS_COURSES_H
#define OTX_ANALYSIS_COURSES_H

#include "image/image.h"

enum
{
    OTX_COURSES_MAX = 64
};

typedef struct otx_courses
{
    int32_t count; /* in the picture; 0: it has none */
    bool upright;  /* they run along y, else along x */
    /* Texels across, from joint to joint, ascending: y, or -x of upright ones.
     * The last is the first of the next picture. */
    double joints[OTX_COURSES_MAX + 1];
    double period;   /* texels along, after which the picture repeats */
    double strength; /* share of the variance that repeats with the courses */
    double slip;     /* variance along the joints, of all; 0: no slip shows */
} otx_courses;

/* Looks for courses along x and along y in a picture that tiles (its Lab
 * version; the first channel is looked at). MEMORY. */
otx_status
otx_courses_find(otx_run *run, const otx_image *lab, otx_courses *out);

/* Whether slips are so little seen that courses should be laid one by one. */
bool otx_courses_are_plain(const otx_courses *courses);

/* The texel at a position along, in texels, and across, in courses from joint
 * 0; goes on beyond the picture on all sides. */
otx_vec2
otx_courses_texel(const otx_courses *courses, double along, double course);

#endif

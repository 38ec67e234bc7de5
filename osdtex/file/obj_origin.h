/* obj_origin.h -- where the points of an OBJ are counted from.
 *
 * Scans in map coordinates and set pieces of large worlds lie millions of units
 * away from the origin. A float holds seven digits, which there are used up by
 * where the thing is, so points are read as doubles and kept relative to an
 * origin near them. */
#ifndef OTX_FILE_OBJ_ORIGIN_H
#define OTX_FILE_OBJ_ORIGIN_H

#include "base/run.h"

/* The faces whose points decide. */
typedef struct otx_obj_places
{
    const char *path;     /* for messages */
    const double *places; /* [vert_count * 3], as the file says */
    int32_t vert_count, face_count;
    const int32_t *face_first; /* [face_count + 1] */
    const int32_t *face_verts;
} otx_obj_places;

/* Chooses the origin and takes the points relative to it. Near things keep the
 * origin of their scene: zero, and then the points are the file's numbers. One
 * warning where a float does not do: in programs that read the file as floats,
 * or even here, relative to the origin.
 *
 *   points  [vert_count * 3], out
 *   origin  out; whole numbers of a power of two, so that differences to it
 *           are exact
 */
void otx_obj_origin_take(
    otx_run *run, const otx_obj_places *places, float *points,
    double origin[3]);

#endif

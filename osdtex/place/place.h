/* place.h -- pictures put where they were asked for, over any mapping.
 *
 * A knot on the bark, a scar, a label: once or many times, this way up, so
 * large. See docs/notes/place.md. */
#ifndef OTX_PLACE_PLACE_H
#define OTX_PLACE_PLACE_H

#include "base/run.h"
#include "mapping/decals.h"
#include "math/vec.h"
#include "surface/surface.h"

/* One thing that was asked for. */
typedef struct otx_place_item
{
    int32_t picture;
    int32_t number;  /* as sentences count it, from 1 */
    int32_t face;    /* of the cage; -1: at the point, or anywhere */
    otx_vec3 point;  /* scene units */
    int32_t scatter; /* how many, anywhere; 0: one, where it is asked for */
    double width;    /* scene units */
    double height;   /* scene units; 0: as the picture's sides ask for */
    bool has_up;     /* else scene y, and z where that is the normal */
    otx_vec3 up;     /* scene axes */
    double turn;     /* radians, counter-clockwise as one looks at it */
    bool mirror;     /* left is right */
    double opacity;  /* 0 to 1 */
    otx_vec2 anchor; /* what of the picture lies at the place, 0 to 1 */
} otx_place_item;

typedef struct otx_place_list
{
    const char *path; /* that sentences name; NULL */
    int32_t count;
    const otx_place_item *items;  /* [count] later ones over earlier ones */
    const otx_exemplar *pictures; /* that they name, borrowed */
} otx_place_list;

typedef struct otx_place_figures
{
    int32_t count, faces;
    double stretch_p95;  /* the greatest of all decals: see footprint.h */
    double stretch_mean; /* of all, by their areas */
    double offset;       /* the greatest distance of an anchor from its place,
                          * texels of the picture */
} otx_place_figures;

/* Lays out all items, as the lookups of decals in run->arena.
 *
 * ARGUMENT (a face that is not there or is a hole, an up that points away from
 * the surface), LIMIT (larger than the surface allows), MEMORY, CANCELLED. */
otx_status otx_place_all(
    otx_run *run, const otx_surface *surface, const otx_place_list *list,
    otx_lookups *out, otx_place_figures *figures);

#endif

/* seams.h -- where the patches of a mapping meet, and where that shows most.
 *
 *     osdtex_seams *seams;
 *
 *     osdtex_seams_create(context, mapping, 10, &seams);
 *     const osdtex_seams_info *info = osdtex_seams_describe(seams);
 *
 *     for (int32_t i = 0; i < info->place_count; ++i)
 *         printf("%g units of seams that differ by %g\n",
 *                info->places[i].length, info->places[i].difference);
 *     osdtex_seams_destroy(seams);
 *
 * The figures of the report (report.h) say how good all seams of a mapping are;
 * this says where to look. The places are those of the views "seam1", "seam2"
 * and so on (render.h), in their order. */
#ifndef OSDTEX_SEAMS_H
#define OSDTEX_SEAMS_H

#include <osdtex/mapping.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_seams osdtex_seams;

enum
{
    OSDTEX_SEAM_PLACES_MAX = 99
};

/* An edge of the surface between two patches. */
typedef struct osdtex_seam
{
    osdtex_index corner; /* of the surface: the edge goes from there to the next
                          * corner of its face; of the two that an edge has the
                          * smaller one */
    float difference;    /* of what its sides show, RMS of square roots of
                          * linear colours: 0 the same .. 1 black beside white */
} osdtex_seam;

/* What is seen as one place: all seams in a cell of a grid, 24 across the
 * model. It is as bad as its length times its difference. */
typedef struct osdtex_seam_place
{
    double point[3];   /* scene units; where most of it is */
    double normal[3];  /* unit, out of the surface there */
    double length;     /* of its seams, scene units */
    double difference; /* their mean, 0 .. 1 */
} osdtex_seam_place;

typedef struct osdtex_seams_info
{
    const osdtex_seam *seams;        /* [seam_count] in the order of corners */
    const osdtex_seam_place *places; /* [place_count] the worst first, none
                                      * beside another */
    int32_t seam_count;
    int32_t place_count;
} osdtex_seams_info;

/* Looks at all seams, by what the UVs of their two faces show; what lies over
 * that (pastes, pictures that were placed, healed bands) is not looked at.
 *
 *   places  how many at most, 0 .. OSDTEX_SEAM_PLACES_MAX; there are fewer
 *           where no more show
 *
 * The same for any number of threads. The mapping may be destroyed before the
 * seams. ARGUMENT, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_seams_create(
    osdtex_context *context, const osdtex_mapping *mapping, int32_t places,
    osdtex_seams **out);
/* NULL for NULL. */
OSDTEX_API const osdtex_seams_info *
osdtex_seams_describe(const osdtex_seams *seams);
OSDTEX_API void osdtex_seams_destroy(osdtex_seams *seams);

OSDTEX_END_DECLS

#endif

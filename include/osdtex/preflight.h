/* preflight.h -- what can be known of a job before it runs.
 *
 *     osdtex_job job = osdtex_job_none();
 *     osdtex_forecast forecast;
 *
 *     job.map = &map_options;
 *     job.bake = &bake_options;
 *     if (osdtex_preflight(context, cage, exemplar, &job, &forecast) ==
 *             OSDTEX_OK && forecast.bytes < free_bytes)
 *         submit(&job);
 *
 * It changes nothing, and a job need not be looked over to be run. */
#ifndef OSDTEX_PREFLIGHT_H
#define OSDTEX_PREFLIGHT_H

#include <osdtex/bake.h>
#include <osdtex/mapping.h>
#include <osdtex/surface.h>

OSDTEX_BEGIN_DECLS

/* A job as the calls that run it will be given it; NULL for their defaults. */
typedef struct osdtex_job
{
    size_t size;
    const osdtex_surface_options *surface; /* with a leaf_edge of 0 it is that
                                            * of the exemplar; NULL: the map's
                                            * level */
    const osdtex_map_options *map;
    const osdtex_bake_options *bake; /* NULL: the job bakes nothing */
} osdtex_job;

static inline osdtex_job
osdtex_job_none(void)
{
    osdtex_job job = OSDTEX_ZERO;

    job.size = sizeof job;
    return job;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void osdtex_job_init(osdtex_job *out, size_t bytes);

/* What a job will come to. */
typedef struct osdtex_forecast
{
    double scale;        /* as resolved, scene units */
    double face_count;   /* of the surface; more than any index where the
                          * level is refused */
    double bytes;        /* of memory, about, for surface and mapping */
    double density;      /* texels of the exemplar to a scene unit */
    int32_t level;       /* as resolved */
    osdtex_bake_uvs uvs; /* of a bake: OWN, ATLAS or CHARTS */
    double bake_density; /* texels of the bake to a scene unit, about; 0: the
                          * job bakes nothing */
    double uv_overlap;   /* share of the texture that faces claim together, of
                          * own UVs that were looked at; else 0 */
    const char *method;  /* as resolved, also from "auto"; static */
} osdtex_forecast;

/* Looks a job over without doing it: refuses what would be refused later and
 * can be known from cage, exemplar and options, and leaves as findings what
 * their owner should know first (UVs that cannot be baked onto, a scale that
 * seems to be in other units, a bake that is coarser than the exemplar). The
 * calls that then do the job repeat none of it. Takes about as long for a
 * level of 10 as for one of 0: nothing is refined further than to some 20 000
 * faces.
 *
 *   out  NULL: only the findings matter
 *
 * ARGUMENT, FORMAT and IO (of constraints and masks), TOPOLOGY, LIMIT,
 * MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_preflight(
    osdtex_context *context, const osdtex_cage *cage,
    const osdtex_exemplar *exemplar, const osdtex_job *job,
    osdtex_forecast *out);

OSDTEX_END_DECLS

#endif

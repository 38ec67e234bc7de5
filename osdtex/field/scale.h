/* scale.h -- how large the texture is to be, so that it can follow the field.
 *
 * Two families of lines that follow a direction field and cross at right
 * angles are level lines of a parameterization only where their spacing
 * changes as the field turns: with the field's turn w against parallel
 * transport, the gradient is e^f d for
 *
 *     grad f = J w,
 *
 * solved in the least squares sense on vertices. f is held to a limit, which
 * trades an even size of the texture for dislocations; see docs/notes/field.md.
 */
#ifndef OTX_FIELD_SCALE_H
#define OTX_FIELD_SCALE_H

#include "field/direction.h"

/* f at the vertices of the field's level, natural logarithm of the density:
 * positive where the texture is smaller. The area-weighted mean of e^2f, which
 * is how many texels there are, is 1.
 *
 *   limit  largest |f| before that mean is restored, natural logarithm;
 *          0: f is 0 throughout
 *   out    [vert_count] in run->arena
 *
 * NUMERIC, MEMORY. */
otx_status otx_scale_solve(
    otx_run *run, const otx_direction *field, double limit, double **out);

/* The same in parts, for fields that are edited. */
typedef struct otx_scale_correction
{
    double *raw;  /* [vert_count] f without limit, up to a constant */
    double limit; /* as above */
    /* Restore the number of texels, before and after limiting; they stay when
     * a part is edited, so that the rest keeps its size. */
    double shift_before, shift_after;
} otx_scale_correction;

/* Solves for `raw` and the shifts; `raw` is made in run->arena. */
otx_status otx_scale_correct(
    otx_run *run, const otx_direction *field, double limit,
    otx_scale_correction *out);

/* Solves again for `raw` at the vertices of `effect` ([vert_count], 1 free);
 * all others keep theirs. */
otx_status otx_scale_edit(
    otx_run *run, const otx_direction *field, const uint8_t *effect,
    otx_scale_correction *correction);

/* f at a vertex. */
double otx_scale_value(const otx_scale_correction *correction, int32_t vertex);

/* A value that is held at a vertex. */
typedef struct otx_scale_lock
{
    int32_t vertex;
    double value;
} otx_scale_lock;

/* The harmonic function on the vertices of a level that has the locked values
 * [Ray09, sec. 2.2], clamped to [low, high]; for scale and material. Where a
 * component has no lock it is `otherwise`.
 *
 *   effect  [vert_count], 1 free; other vertices keep `values`; NULL: all free
 *   values  [vert_count], in and out
 *
 * ARGUMENT for a lock that is not finite or not there; NUMERIC, MEMORY. */
otx_status otx_scale_smooth(
    otx_run *run, const otx_connection *connection, const otx_scale_lock *locks,
    int32_t lock_count, double low, double high, double otherwise,
    const uint8_t *effect, double *values);

#endif

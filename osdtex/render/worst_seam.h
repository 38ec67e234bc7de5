/* worst_seam.h -- a close view of the place where seams show most. */
#ifndef OTX_RENDER_WORST_SEAM_H
#define OTX_RENDER_WORST_SEAM_H

#include "render/camera.h"
#include "render/scene.h"

/* "seam1" to "seam99", the worst first; 0 for any other name. */
int32_t otx_worst_seam_rank(const char *name);

/* How many places there are to look at, up to `most`, which is no more than
 * OTX_SEAM_PLACES_MAX; 0 of a model without texture or seam. CANCELLED, MEMORY.
 */
otx_status otx_worst_seam_count(
    otx_run *run, const otx_scene *scene, int32_t most, int32_t *out);

/* Looks at a place along its normal, from near enough that the picture is an
 * eighth of the model wide, and through what stands before it.
 *
 *   rank    1 .. OTX_SEAM_PLACES_MAX
 *   origin  what the scene's points are relative to, for what is told
 *   out     where places run out, the last of them
 *
 * ARGUMENT when the model has no texture or no seam; CANCELLED,
 * MEMORY. */
otx_status otx_worst_seam_camera(
    otx_run *run, const otx_scene *scene, int32_t rank, const double origin[3],
    otx_camera *out);

#endif

/* worst_seam.c -- a close view of the place where seams show most. */
#include "render/worst_seam.h"

#include "render/seam_place.h"

#include <stdlib.h>
#include <string.h>

/* Height of the picture, in cells. */
static const double PICTURE = 3.0;

/* Of the way to the place: in narrow corners other parts of the model are in
 * between. */
static const double CLIP = 0.75;

static const char STAGE[] = "render";

int32_t
otx_worst_seam_rank(const char *name)
{
    char *end;
    long rank;

    if (strncmp(name, "seam", 4) != 0 || name[4] < '1' || name[4] > '9')
        return 0;
    rank = strtol(name + 4, &end, 10);
    return *end == '\0' && rank <= OTX_SEAM_PLACES_MAX ? (int32_t)rank : 0;
}

/* The place along its normal, in a picture of that height. */
static otx_camera
view_of(const otx_seam_place *p, double height)
{
    const double distance = 0.5 * height / tan(0.5 * OTX_CAMERA_FOV);

    return (otx_camera){
        otx_vec3_add(p->point, otx_vec3_scale(distance, p->normal)), p->point,
        OTX_CAMERA_FOV, CLIP, OTX_UP_Y};
}

/* Says where it is, and how bad. */
static void
note_place(
    otx_run *run, int32_t rank, const otx_seam_place *p, const double origin[3])
{
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
        "seam%d is around (%.4g, %.4g, %.4g): %.3g units of seams, whose two "
        "sides differ by %.2f in the mean (1: black beside white)",
        (int)rank, p->point.x + origin[0], p->point.y + origin[1],
        p->point.z + origin[2], p->length, p->difference);
}

otx_status
otx_worst_seam_count(
    otx_run *run, const otx_scene *scene, int32_t most, int32_t *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_seam_places seams;

    *out = 0;
    OTX_TRY(otx_seam_places_find(run, run->scratch, scene, most, &seams));
    *out = seams.count;
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_worst_seam_camera(
    otx_run *run, const otx_scene *scene, int32_t rank, const double origin[3],
    otx_camera *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_seam_places seams;

    if (!scene->uvs || scene->texture_count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the model has no texture whose seams could be looked for");
    OTX_TRY(otx_seam_places_find(run, run->scratch, scene, rank, &seams));
    if (seams.count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            seams.edge_count == 0 ? "the model has no seam to look at"
                                  : "no seam of the model shows");
    note_place(run, rank, &seams.places[seams.count - 1], origin);
    *out = view_of(&seams.places[seams.count - 1], PICTURE * seams.cell);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

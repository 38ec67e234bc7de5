/* camera.h -- where a picture is taken from. */
#ifndef OTX_RENDER_CAMERA_H
#define OTX_RENDER_CAMERA_H

#include "base/status.h"
#include "math/vec.h"

typedef enum otx_view
{
    OTX_VIEW_THREE_QUARTER, /* the default: from the front right, above */
    OTX_VIEW_FRONT,         /* from +Z, or -Y where Z is up */
    OTX_VIEW_BACK,
    OTX_VIEW_LEFT, /* from -X */
    OTX_VIEW_RIGHT,
    OTX_VIEW_TOP, /* from above, the back up in the picture */
    OTX_VIEW_COUNT
} otx_view;

/* Which axis of the scene points up; X points right in both. */
typedef enum otx_up
{
    OTX_UP_Y,
    OTX_UP_Z,
    OTX_UP_COUNT
} otx_up;

typedef struct otx_camera
{
    otx_vec3 eye, target; /* scene units */
    double fov;           /* of the picture's height, radians, (0, pi) */
    double clip; /* [0, 1): what is nearer than this share of the way to the
                  * target is looked through */
    otx_up up;
} otx_camera;

/* Frame of a camera for one picture: pixel (x, y), y up from the bottom row,
 * is seen along `forward + (x - w/2) * right + (y - h/2) * up`. */
typedef struct otx_camera_frame
{
    otx_vec3 eye, forward;          /* forward is unit */
    otx_vec3 right, up;             /* of one pixel at distance 1 */
    double half_width, half_height; /* pixels */
    double near;                    /* depth from which things are seen */
} otx_camera_frame;

#define OTX_CAMERA_FOV (30.0 * OTX_PI / 180.0)

/* "three_quarter", "front", "back", "left", "right", "top". */
const char *otx_camera_view_name(otx_view view);
/* False when there is no view of that name. */
bool otx_camera_view_find(const char *name, otx_view *out);

/* Unit, from the model to the eye of a view that is turned by `turn` radians
 * counter-clockwise about what is up. */
otx_vec3 otx_camera_from(otx_view view, otx_up up, double turn);

/* Where up is, unit. */
otx_vec3 otx_camera_up(otx_up up);

/* Whether the camera can see at all: finite, eye apart from the target, field
 * of view in (0, pi). */
bool otx_camera_is_valid(const otx_camera *camera);

otx_camera_frame
otx_camera_aim(const otx_camera *camera, int32_t width, int32_t height);

/* Unit direction through picture position (x, y), in pixels. */
otx_vec3
otx_camera_direction(const otx_camera_frame *frame, double x, double y);

/* Where a point is in the picture, in pixels. False behind the eye. */
bool otx_camera_project(
    const otx_camera_frame *frame, otx_vec3 point, otx_vec2 *out);

#endif

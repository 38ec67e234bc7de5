/* camera.c -- views and pixel rays. */
#include "render/camera.h"

#include <string.h>

/* Directions from the model to the eye where Y is up, not unit. */
static const struct
{
    const char *name;
    otx_vec3 from;
} VIEWS[OTX_VIEW_COUNT] = {
    [OTX_VIEW_THREE_QUARTER] = {"three_quarter", {0.62, 0.42, 1.0}},
    [OTX_VIEW_FRONT] = {"front", {0.0, 0.0, 1.0}},
    [OTX_VIEW_BACK] = {"back", {0.0, 0.0, -1.0}},
    [OTX_VIEW_LEFT] = {"left", {-1.0, 0.0, 0.0}},
    [OTX_VIEW_RIGHT] = {"right", {1.0, 0.0, 0.0}},
    [OTX_VIEW_TOP] = {"top", {0.0, 1.0, 0.0}},
};

const char *
otx_camera_view_name(otx_view view)
{
    return VIEWS[view].name;
}

bool
otx_camera_view_find(const char *name, otx_view *out)
{
    for (int32_t i = 0; i < OTX_VIEW_COUNT; ++i)
        if (strcmp(VIEWS[i].name, name) == 0)
        {
            *out = (otx_view)i;
            return true;
        }
    return false;
}

otx_vec3
otx_camera_from(otx_view view, otx_up up, double turn)
{
    const otx_vec3 from = otx_vec3_unit(VIEWS[view].from);
    const otx_vec3 turned = {
        cos(turn) * from.x + sin(turn) * from.z, from.y,
        cos(turn) * from.z - sin(turn) * from.x};

    return up == OTX_UP_Z ? (otx_vec3){turned.x, -turned.z, turned.y} : turned;
}

otx_vec3
otx_camera_up(otx_up up)
{
    return up == OTX_UP_Z ? (otx_vec3){0.0, 0.0, 1.0}
                          : (otx_vec3){0.0, 1.0, 0.0};
}

static bool
is_finite(otx_vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

bool
otx_camera_is_valid(const otx_camera *camera)
{
    const otx_vec3 gaze = otx_vec3_sub(camera->target, camera->eye);

    return is_finite(camera->eye) && is_finite(camera->target) &&
           otx_vec3_length(gaze) > 0.0 && camera->fov > 0.0 &&
           camera->fov < OTX_PI;
}

otx_camera_frame
otx_camera_aim(const otx_camera *camera, int32_t width, int32_t height)
{
    const otx_vec3 gaze = otx_vec3_sub(camera->target, camera->eye);
    const otx_vec3 forward = otx_vec3_unit(gaze);
    const double pixel = 2.0 * tan(0.5 * camera->fov) / height;
    const otx_vec3 upward = otx_camera_up(camera->up);
    otx_vec3 right = otx_vec3_cross(forward, upward);

    /* Straight down the back is up in the picture, straight up the front is. */
    if (otx_vec3_length(right) < 1e-6)
        right = otx_vec3_cross(
            forward, otx_vec3_scale(
                         otx_vec3_dot(forward, upward),
                         otx_camera_from(OTX_VIEW_FRONT, camera->up, 0.0)));
    right = otx_vec3_unit(right);
    return (otx_camera_frame){
        camera->eye,
        forward,
        otx_vec3_scale(pixel, right),
        otx_vec3_scale(pixel, otx_vec3_cross(right, forward)),
        0.5 * width,
        0.5 * height,
        camera->clip * otx_vec3_length(gaze),
    };
}

otx_vec3
otx_camera_direction(const otx_camera_frame *frame, double x, double y)
{
    const otx_vec3 aside = otx_vec3_mix(
        x - frame->half_width, frame->right, y - frame->half_height, frame->up);

    return otx_vec3_unit(otx_vec3_add(frame->forward, aside));
}

bool
otx_camera_project(const otx_camera_frame *frame, otx_vec3 point, otx_vec2 *out)
{
    const otx_vec3 gaze = otx_vec3_sub(point, frame->eye);
    const double depth = otx_vec3_dot(gaze, frame->forward);
    const double pixel_sq = otx_vec3_dot(frame->up, frame->up);

    if (!(depth > 0.0))
        return false;
    *out = (otx_vec2){
        otx_vec3_dot(gaze, frame->right) / (depth * pixel_sq) +
            frame->half_width,
        otx_vec3_dot(gaze, frame->up) / (depth * pixel_sq) +
            frame->half_height};
    return true;
}

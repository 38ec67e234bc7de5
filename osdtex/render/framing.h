/* framing.h -- how near a view comes so that the model fills the picture. */
#ifndef OTX_RENDER_FRAMING_H
#define OTX_RENDER_FRAMING_H

#include "render/camera.h"
#include "render/scene.h"

typedef struct otx_framing
{
    otx_view view;
    otx_up up;
    double turn;   /* radians about what is up */
    double aspect; /* of the picture, width / height */
    bool orbit; /* held for every turn, so that frames of a turntable agree */
} otx_framing;

/* The nearest camera in the view's direction that sees all that is drawn, with
 * a little air: what is drawn takes 94 % of the width or of the height. A scene
 * that is a point or a line towards the eye is seen from a distance. */
otx_camera
otx_framing_camera(const otx_scene *scene, const otx_framing *framing);

#endif

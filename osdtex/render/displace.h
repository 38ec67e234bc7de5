/* displace.h -- a scene with the heights of its maps. */
#ifndef OTX_RENDER_DISPLACE_H
#define OTX_RENDER_DISPLACE_H

#include "render/scene.h"

/* Moves the vertices of `from` along their normals by the height that the maps
 * show there, the mean of what the faces around one do: nothing tears where
 * they differ. Between vertices nothing is displaced; the normals of the maps
 * show what is finer. Points live in run->arena, all else is borrowed.
 *
 * Without a map of heights the scene stays as it is, and a finding says so.
 * MEMORY. */
otx_status
otx_scene_displace(otx_run *run, const otx_scene *from, otx_scene *out);

#endif

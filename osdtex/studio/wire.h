/* wire.h -- arrays as the page reads them, in one block of bytes.
 *
 * A block is 16 int32 and arrays behind them in the order below, each from a
 * multiple of four bytes on, in the machine's own order of bytes, which the
 * page checks by the first number. wire.js takes it apart. */
#ifndef OTX_STUDIO_WIRE_H
#define OTX_STUDIO_WIRE_H

#include "studio/snapshot.h"

#include <stddef.h>

enum
{
    OTX_WIRE_MAGIC = 0x4f544558,
    OTX_WIRE_HEAD = 16
};

typedef struct otx_wire
{
    void *bytes; /* to be freed; NULL: memory is out */
    size_t count;
} otx_wire;

/* magic, serial of the surface, vertices, faces, corners, level; then
 * origin [3] f64, points [v * 3] f32 relative to it, normals [v * 3] f32,
 * face_first [f + 1] i32, face_verts [c] i32, face_cage [f] i32. */
otx_wire otx_wire_surface(const otx_snapshot *snapshot);

/* magic, serial, serial of the surface, faces, corners, patches, exemplars,
 * symmetry of the field; then uvs [c * 2] f32, face_patch [f] i32,
 * stretch [f] f32 (octaves, above 0 larger than asked for), directions [f * 3]
 * f32, scales at vertices [v] f32, exemplar of each face [f] u8. */
otx_wire otx_wire_mapping(const otx_snapshot *snapshot);

/* magic, serial, seams; then [n * 2]: corner as i32, difference as f32. */
otx_wire otx_wire_seams(const otx_snapshot *snapshot);

/* magic, width, height, wraps along x, along y; then [w * h * 4] u8, sRGB, top
 * row last. Pictures of more than `most` texels a side are halved until they
 * fit. */
otx_wire otx_wire_texture(const osdtex_exemplar *exemplar, int32_t most);

#endif

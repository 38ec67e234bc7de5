/* opensubdiv.h -- uniform refinement by OpenSubdiv's Far, for C.
 *
 * A thin shell: arrays in, arrays out, no exception comes through. The caller
 * has validated the mesh (see surface/cage.h): OpenSubdiv crashes on indices
 * out of range and swallows much else.
 *
 * After otx_osd_refine the object is constant, and all functions that take it
 * as const may be called from several threads at once. */
#ifndef OTX_BRIDGE_OPENSUBDIV_H
#define OTX_BRIDGE_OPENSUBDIV_H

#include "base/arena.h"

#ifdef __cplusplus
extern "C"
{
#endif

    typedef struct otx_osd otx_osd;

    typedef enum otx_osd_scheme
    {
        OTX_OSD_CATMARK,
        OTX_OSD_LOOP,
        OTX_OSD_BILINEAR
    } otx_osd_scheme;

    /* A validated mesh and all four of Sdc's options: none is left at
     * OpenSubdiv's default, of which one turns boundary faces into holes. */
    typedef struct otx_osd_mesh
    {
        otx_osd_scheme scheme;
        int32_t boundary; /* Sdc's VtxBoundaryInterpolation, 0 .. 2 */
        int32_t fvar;     /* Sdc's FVarLinearInterpolation, 0 .. 5 */
        bool crease_chaikin;
        bool triangles_smooth;
        int32_t vert_count, face_count;
        const int32_t *face_sizes; /* [face_count] */
        const int32_t *face_verts;
        int32_t crease_count;
        const int32_t *crease_verts; /* [crease_count * 2] */
        const float *crease_sharpness;
        int32_t corner_tag_count;
        const int32_t *corner_tag_verts;
        const float *corner_tag_sharpness;
        int32_t hole_count;
        const int32_t *holes; /* [hole_count], faces */
        int32_t uv_count;     /* 0: no face-varying channel */
        const int32_t *face_uvs;
    } otx_osd_mesh;

    typedef struct otx_osd_counts
    {
        int32_t faces, verts, edges, corners, uvs;
    } otx_osd_counts;

    /* One level's relations, filled by otx_osd_export_*: see surface/level.h.
     * What is NULL is left out; the parent must be at level 0, the children at
     * the last level. */
    typedef struct otx_osd_relations
    {
        const int32_t *face_first; /* [faces + 1], input: checked, not filled */
        int32_t *face_verts;
        int32_t *face_edges;
        int32_t *edge_verts;       /* [edges * 2] */
        int32_t *edge_faces;       /* [edges * 2] */
        int32_t *face_parent;      /* [faces] or NULL */
        int32_t *face_child_first; /* [faces + 1] or NULL */
        int32_t *face_child_vert;  /* [faces] or NULL */
        int32_t *edge_child_vert;  /* [edges] or NULL */
        uint8_t *face_hole;        /* [faces] */
        int32_t *face_uvs;         /* [corners] or NULL */
    } otx_osd_relations;

    /* Half-open range of elements. */
    typedef struct otx_osd_range
    {
        int32_t first, end;
    } otx_osd_range;

    /* Makes the base level. The object is destroyed when `arena` is released
     * past this point. MEMORY; TOPOLOGY when OpenSubdiv refuses the mesh all
     * the same; NUMERIC on an exception that is not bad_alloc. */
    otx_status
    otx_osd_create(otx_arena *arena, const otx_osd_mesh *mesh, otx_osd **out);

    /* Refines once and for all to `level` (1 .. 15), with full topology in the
     * last level, since the limit needs it. */
    otx_status otx_osd_refine(otx_osd *osd, int32_t level);

    otx_osd_counts otx_osd_counts_at(const otx_osd *osd, int32_t level);

    /* Copies relations of the faces or edges of a range. NUMERIC when
     * OpenSubdiv breaks a promise that surface/level.h is built on: children
     * contiguous in parent order, corners where face_first says, one or two
     * faces at an edge. */
    otx_status otx_osd_export_faces(
        const otx_osd *osd, int32_t level, otx_osd_range faces,
        const otx_osd_relations *out);
    otx_status otx_osd_export_edges(
        const otx_osd *osd, int32_t level, otx_osd_range edges,
        const otx_osd_relations *out);

    /* NUMERIC unless vertex v of `level` is vertex v of `level` + 1 for all v.
     */
    otx_status otx_osd_check_prefix(const otx_osd *osd, int32_t level);

    /* Interpolates positions (three floats a vertex) or UVs (two a value) from
     * `level` - 1 to `level`. */
    otx_status otx_osd_refine_points(
        const otx_osd *osd, int32_t level, const float *from, float *to);
    otx_status otx_osd_refine_uvs(
        const otx_osd *osd, int32_t level, const float *from, float *to);

    /* Positions and two tangents on the limit, from those of the last level.
     *
     *   from      [verts * 3]
     *   points    [verts * 3]
     *   tangents  [verts * 6], tan1 then tan2; neither unit nor orthogonal,
     * zero at a vertex without faces */
    otx_status otx_osd_limit_points(
        const otx_osd *osd, const float *from, float *points, float *tangents);
    otx_status
    otx_osd_limit_uvs(const otx_osd *osd, const float *from, float *uvs);

#ifdef __cplusplus
}
#endif
#endif

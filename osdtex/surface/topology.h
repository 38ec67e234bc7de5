/* topology.h -- edges of a polygon mesh, found from its faces.
 *
 * OpenSubdiv makes the edges of the levels itself; this is what the cage is
 * checked with before OpenSubdiv sees it, and the whole topology of a plain
 * mesh. */
#ifndef OTX_SURFACE_TOPOLOGY_H
#define OTX_SURFACE_TOPOLOGY_H

#include "base/arena.h"

/* Edges in the order of (smaller vertex, larger vertex). The corner k of a
 * face is where its half-edge to corner k + 1 starts. */
typedef struct otx_topology
{
    int32_t vert_count, face_count, corner_count, edge_count;
    const int32_t *face_first;  /* borrowed */
    const int32_t *face_verts;  /* borrowed */
    int32_t *edge_verts;        /* [edge_count * 2], smaller first */
    int32_t *edge_corner_first; /* [edge_count + 1] */
    int32_t *edge_corners;      /* [corner_count], of an edge, ascending */
    int32_t *corner_edge;       /* [corner_count], edge of the half-edge */
    int32_t *corner_face;       /* [corner_count] */
} otx_topology;

/* Finds the edges in time linear in the corners: two counting sorts by
 * vertex. Vertices must be in range and no face may repeat one.
 *
 *   arena    where the result and the temporaries go
 *
 * False when memory is out. */
bool otx_topology_build(
    otx_arena *arena, int32_t vert_count, int32_t face_count,
    const int32_t *face_first, const int32_t *face_verts, otx_topology *out);

/* The edge between `a` and `b`, -1 when there is none. */
int32_t
otx_topology_find_edge(const otx_topology *topology, int32_t a, int32_t b);

/* The faces around a vertex, before a walk has shown that they are one fan. */
typedef struct otx_topology_fan
{
    int32_t start;  /* corner, on the open side of an open fan; -1 no face */
    int32_t faces;  /* of the vertex */
    int32_t border; /* boundary half-edges that leave it */
} otx_topology_fan;

/* [vert_count] fans of a mesh with manifold edges; NULL when memory is out. */
otx_topology_fan *
otx_topology_fans(otx_arena *arena, const otx_topology *topology);

/* How many faces a walk around the vertex reaches from `start`; the vertex is
 * manifold when these are all it has. */
int32_t otx_topology_fan_size(const otx_topology *topology, int32_t start);

/* How many fans of faces there are around all vertices together: as many as
 * vertices with faces where the mesh is a manifold, more where parts only
 * touch. Of a mesh with manifold edges; -1 when memory is out. */
int32_t otx_topology_fan_count(otx_arena *arena, const otx_topology *topology);

/* The corner after and before `corner` in its face. */
static inline int32_t
otx_topology_next(const otx_topology *topology, int32_t corner)
{
    const int32_t face = topology->corner_face[corner];

    return corner + 1 == topology->face_first[face + 1]
               ? topology->face_first[face]
               : corner + 1;
}

static inline int32_t
otx_topology_previous(const otx_topology *topology, int32_t corner)
{
    const int32_t face = topology->corner_face[corner];

    return corner == topology->face_first[face]
               ? topology->face_first[face + 1] - 1
               : corner - 1;
}

/* How many half-edges lie on `edge`: 1 at a boundary, 2 inside. */
static inline int32_t
otx_topology_edge_size(const otx_topology *topology, int32_t edge)
{
    return topology->edge_corner_first[edge + 1] -
           topology->edge_corner_first[edge];
}

/* The half-edge across `corner`'s, -1 at a boundary. Of a manifold. */
static inline int32_t
otx_topology_twin(const otx_topology *topology, int32_t corner)
{
    const int32_t edge = topology->corner_edge[corner];
    const int32_t first = topology->edge_corner_first[edge];

    if (otx_topology_edge_size(topology, edge) != 2)
        return -1;
    return topology->edge_corners[first] == corner
               ? topology->edge_corners[first + 1]
               : topology->edge_corners[first];
}

#endif

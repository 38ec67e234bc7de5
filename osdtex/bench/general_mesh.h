/* general_mesh.h -- closed triangle meshes without a hierarchy, with as many
 * faces as those of which the paper gives times [Soler02, sec. 6]. */
#ifndef OTX_BENCH_GENERAL_MESH_H
#define OTX_BENCH_GENERAL_MESH_H

#include "surface/surface.h"

typedef enum bench_general_kind
{
    BENCH_GENERAL_BUNNY,       /* 2962 faces: round, with two ears */
    BENCH_GENERAL_PUMPKIN,     /* 10 000: ribbed */
    BENCH_GENERAL_TRICERATOPS, /* 5660: long, with three horns */
    BENCH_GENERAL_COUNT
} bench_general_kind;

const char *bench_general_mesh_name(bench_general_kind kind);

/* A plain mesh, in run->arena. */
otx_status
bench_general_mesh(otx_run *run, bench_general_kind kind, otx_cage *out);

#endif

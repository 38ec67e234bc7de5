/* map_job.h -- the whole job once, from a cage to a mapping. */
#ifndef OTX_BENCH_MAP_JOB_H
#define OTX_BENCH_MAP_JOB_H

#include "base/hash.h"
#include "bench/bench_row.h"
#include "bench/stopwatch.h"
#include "method/method.h"

/* Makes or reads a cage. */
typedef otx_status (*bench_map_cage)(
    otx_run *run, const bench_options *options, otx_cage *out);

typedef struct bench_map_job
{
    const bench_options *options;
    bench_map_cage cage;
    int32_t level;         /* of refinement; -1: as the leaf size asks */
    double leaf;           /* edge of a leaf face, texels */
    int32_t exemplar_size; /* pixels a side; 0: the file of the options */
    int32_t threads;
    bool paper; /* as published, mode=paper */
} bench_map_job;

typedef struct bench_map_result
{
    int32_t leaf_faces, patch_count;
    bench_time whole;    /* cage, exemplar, refinement, mapping */
    double refine;       /* wall seconds */
    otx_figures figures; /* of the mapping */
    double heap_bytes;   /* handed out at the peak */
    double resident_bytes;
    int32_t bare_faces; /* without a patch */
    int32_t flipped_faces;
    char hash[OTX_HASH_TEXT_BYTES]; /* of the UVs */
} bench_map_result;

otx_status bench_map_job_run(const bench_map_job *job, bench_map_result *out);

/* Wall seconds of a stage, NAN when the mapping had none of that name. */
double bench_map_job_stage(const bench_map_result *result, const char *name);

#endif

/* match_scene.h -- an exemplar and a collar to search for in it. */
#ifndef OTX_BENCH_MATCH_SCENE_H
#define OTX_BENCH_MATCH_SCENE_H

#include "match/match.h"

enum
{
    BENCH_ORIENTATIONS = 19,
    BENCH_MASK_TRIANGLES = 2 * 4 * 24
};

typedef struct bench_match_scene
{
    otx_run run;
    int32_t size; /* of the exemplar, tiling */
    otx_image image;
    otx_matcher *matcher;
    otx_mask_triangle triangles[BENCH_MASK_TRIANGLES];
    otx_mask mask; /* a square ring, textured from two places */
    double angles[BENCH_ORIENTATIONS];
} bench_match_scene;

otx_status
bench_match_scene_open(bench_match_scene *scene, int32_t size, int32_t threads);
void bench_match_scene_close(bench_match_scene *scene);

#endif

/* match_scene.c -- an exemplar and a collar to search for in it. */
#include "bench/match_scene.h"

#include "bench/patterns.h"
#include "bench/workspace.h"

/* A collar around an empty square: 24 quads on each side, `width` texels
 * thick, textured from two places of the exemplar at two angles. */
static void
fill_mask(otx_mask_triangle *triangles, double size, double width)
{
    static const double corners[2][3][2] = {
        {{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    int32_t count = 0;

    for (int32_t i = 0; i < BENCH_MASK_TRIANGLES; ++i)
    {
        const int32_t side = i / 48, k = i / 2 % 24;
        otx_mask_triangle *t = &triangles[count++];

        *t = (otx_mask_triangle){.from = NULL};
        for (int c = 0; c < 3; ++c)
        {
            const double *corner = corners[i % 2][c];
            const otx_vec2 p = {
                -0.5 * size + (size - width) * (k + corner[0]) / 24.0,
                -0.5 * size + width * corner[1]};

            t->flat[c] = otx_vec2_mul(otx_vec2_polar(0.5 * OTX_PI * side), p);
            t->source[c] = otx_vec2_add(
                otx_vec2_mul(otx_vec2_polar(side < 2 ? 0.3 : 2.2), t->flat[c]),
                (otx_vec2){1.3 * size, side < 2 ? 0.4 : size});
            t->weight[c] = 1.0f;
        }
    }
}

static otx_status
fill_scene(bench_match_scene *s)
{
    OTX_TRY(bench_patterns_blobs(&s->run, s->size, &s->image));
    fill_mask(s->triangles, 0.45 * s->size, 0.1 * s->size);
    s->mask = (otx_mask){s->triangles, BENCH_MASK_TRIANGLES};
    for (int a = 0; a < BENCH_ORIENTATIONS; ++a)
        s->angles[a] = 0.11 + 2.0 * OTX_PI * a / BENCH_ORIENTATIONS;
    return otx_matcher_create(
        &s->run, &s->image, true, true, 0.3, 0, &s->matcher);
}

otx_status
bench_match_scene_open(bench_match_scene *s, int32_t size, int32_t threads)
{
    otx_status status;

    *s = (bench_match_scene){.size = size};
    OTX_TRY(bench_workspace_open(&s->run, threads));
    status = fill_scene(s);
    if (status != OSDTEX_OK)
        bench_workspace_close(&s->run);
    return status;
}

void
bench_match_scene_close(bench_match_scene *s)
{
    bench_workspace_close(&s->run);
}

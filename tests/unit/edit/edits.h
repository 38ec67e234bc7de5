/* edits.h -- a small mapping by patches, to be edited. */
#ifndef OTX_TESTS_EDITS_H
#define OTX_TESTS_EDITS_H

#include "grid.h"
#include "unit/cluster/sheets.h"

#include "edit/apply.h"
#include "edit/area.h"
#include "edit/fields.h"
#include "edit/refit.h"
#include "mapping/mapping_check.h"

/* A torus in patches that follow a guide along y. */
typedef struct edits
{
    otx_run *run;
    otx_surface surface;
    const otx_level *leaf;
    otx_exemplar *exemplar;
    otx_guide guide;
    otx_map_request request;
    const otx_method *method;
    void *settings;
    otx_job job;
    otx_mapping mapping;
} edits;

static inline void
edits_paint(otx_exemplar *e)
{
    float *p = e->match.pixels;
    const double turn = 2.0 * OTX_PI / e->match.width;

    for (int32_t y = 0; y < e->match.height; ++y)
        for (int32_t x = 0; x < e->match.width; ++x, p += 3)
        {
            p[0] = (float)(50.0 + 40.0 * sin(turn * (5 * x + 2 * y)));
            p[1] = (float)(50.0 + 40.0 * sin(turn * (2 * x - 3 * y)));
            p[2] = (float)(0.5 * p[2]);
        }
}

static inline edits *
edits_open(void)
{
    otx_run *run = test_run_create();
    edits *e = OTX_ZNEW(run->arena, edits, 1);
    otx_vec3 *directions;

    e->run = run;
    e->surface = sheet_from_file(run, "models/cages/torus.obj", 2);
    e->leaf = otx_surface_leaf(&e->surface);
    e->exemplar = test_exemplar_create(run->arena, 48, 48, true, 4);
    edits_paint(e->exemplar);
    directions = OTX_NEW(run->arena, otx_vec3, e->leaf->face_count);
    for (int32_t f = 0; f < e->leaf->face_count; ++f)
        directions[f] = (otx_vec3){0.0, 1.0, 0.0};
    e->guide = (otx_guide){directions, 2, 0.0};
    e->request = (otx_map_request){
        .scale = sqrt(e->surface.area / 12.0),
        .first_face = -1,
        .guide = &e->guide};
    e->method = otx_method_find("hierarchical");
    e->settings = otx_arena_zalloc(run->arena, 1, e->method->settings_bytes);
    otx_option_defaults(
        e->method->options, e->method->option_count, e->settings);
    e->job = (otx_job){
        run, &e->surface, e->exemplar, 1, &e->request, e->settings, NULL};
    if (otx_method_map(e->method, &e->job, &e->mapping) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return e;
}

/* Whether a face has the same UVs and patch in both. */
static inline bool
edits_same(
    const edits *e, const otx_mapping *a, const otx_mapping *b, int32_t f)
{
    const size_t first = 2 * (size_t)e->leaf->face_first[f];
    const size_t end = 2 * (size_t)e->leaf->face_first[f + 1];

    return a->face_patch[f] == b->face_patch[f] &&
           memcmp(
               a->uvs + first, b->uvs + first,
               (end - first) * sizeof *a->uvs) == 0;
}

static inline void
edits_check(edits *e, const otx_mapping *m)
{
    if (otx_mapping_check(e->run, m, &e->surface, e->exemplar, 1, "edit") !=
        OSDTEX_OK)
        fail_msg("%s", test_last_message(e->run));
}

#endif

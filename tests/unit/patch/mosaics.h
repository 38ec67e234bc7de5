/* mosaics.h -- surfaces on their way to being covered, for tests of patches. */
#ifndef OTX_TESTS_MOSAICS_H
#define OTX_TESTS_MOSAICS_H

#include "grid.h"
#include "unit/cluster/sheets.h"

#include "patch/mosaic.h"
#include "patch/stitch.h"
#include "patch/turn.h"

/* A mosaic that has begun. */
static inline otx_mosaic *
mosaic_begin(otx_run *run, const char *cage, int32_t clusters)
{
    otx_mosaic *m = OTX_ZNEW(run->arena, otx_mosaic, 1);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    char path[128];

    snprintf(path, sizeof path, "models/cages/%s.obj", cage);
    *surface = sheet_from_file(run, path, 2);
    m->job = (otx_mosaic_job){
        .run = run,
        .surface = surface,
        .exemplars = test_exemplar_create(run->arena, 64, 64, true, 3),
        .exemplar_count = 1,
        .scale = sqrt(surface->area / 6.0),
        .first = {.face = -1},
        .settings =
            {.clusters = clusters,
             .keep = 16,
             .candidates = 1,
             .band = 0.2,
             .collar = 0.5,
             .coarse = -1,
             .edges = -1,
             .usage = -1},
    };
    m->job.texels = 64.0 / m->job.scale;
    assert_int_equal(otx_mosaic_begin(m, NULL), OSDTEX_OK);
    return m;
}

/* Fits all clusters as the method does; none may fail to fit. */
static inline void
mosaic_fit(otx_mosaic *m)
{
    otx_pqueue queue = otx_pqueue_make(m->job.run->scratch);
    otx_fit fits[OTX_TURN_NODES];
    int32_t count;

    assert_int_equal(otx_forest_settle(m, 0), OSDTEX_OK);
    otx_turn_push(m, &queue, 0, m->forest.count);
    assert_int_equal(otx_turn_next(m, &queue, fits, &count), OSDTEX_OK);
    while (count > 0)
    {
        assert_int_equal(otx_fit_find(m, fits, count), OSDTEX_OK);
        for (int32_t i = 0; i < count; ++i)
        {
            assert_true(otx_fit_commit(m, &fits[i]));
            otx_turn_wake(m, &queue, fits[i].node);
        }
        assert_int_equal(otx_turn_next(m, &queue, fits, &count), OSDTEX_OK);
    }
}

#endif

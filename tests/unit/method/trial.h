/* trial.h -- small surfaces covered with pieces. */
#ifndef OTX_TESTS_TRIAL_H
#define OTX_TESTS_TRIAL_H

#include "grid.h"
#include "unit/cluster/sheets.h"

#include "method/method.h"

typedef struct trial
{
    otx_run *run;
    otx_surface surface;
    otx_figures figures;
    otx_mapping mapping;
} trial;

static inline trial *
paste(
    const char *cage, int32_t level, double exemplars, const char *mode,
    int32_t threads)
{
    otx_run *run = test_run_create_with(NULL, threads);
    trial *t = OTX_ZNEW(run->arena, trial, 1);
    const otx_method *method = otx_method_find("lapped");
    void *settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    otx_exemplar *e = test_exemplar_create(run->arena, 64, 64, true, 3);
    otx_map_request request = {.first_face = -1};
    const otx_job job = {
        .run = run,
        .surface = &t->surface,
        .exemplars = e,
        .exemplar_count = 1,
        .request = &request,
        .settings = settings,
        .figures = &t->figures,
    };
    const otx_analysis isotropic = {.kind = OTX_ANALYSIS_ISOTROPIC};

    t->run = run;
    t->surface = sheet_from_file(run, cage, level);
    request.scale = sqrt(t->surface.area / exemplars);
    request.analysis = &isotropic;
    otx_option_defaults(method->options, method->option_count, settings);
    assert_int_equal(
        otx_option_set(
            run, method->options, method->option_count, settings, "mode", mode),
        OSDTEX_OK);
    if (otx_method_map(method, &job, &t->mapping) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return t;
}

#endif

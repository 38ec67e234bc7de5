/* cage_findings.h -- building cages that are wrong, and what is said of them.
 */
#ifndef OTX_TESTS_CAGE_FINDINGS_H
#define OTX_TESTS_CAGE_FINDINGS_H

#include "meshes.h"

/* Builds `in` with Catmull-Clark; on failure checks the status and that the
 * sentence holds `words`. */
static inline void
expect(
    otx_run *run, const otx_cage_input *in, otx_status status,
    const char *words)
{
    const otx_cage_options options = otx_cage_options_default();
    otx_cage cage;
    otx_status got;

    /* Like findings of an earlier call would fold into one. */
    otx_diagnostics_destroy(run->diagnostics);
    run->diagnostics = otx_diagnostics_create(run->allocator);
    got = otx_cage_build(run, in, &options, &cage);
    if (got != status || !strstr(test_last_message(run), words))
        fail_msg(
            "status %d, wanted %d with '%s': %s", got, status, words,
            test_last_message(run));
    if (status != OSDTEX_OK)
        assert_null(cage.points);
}

/* The finding that `back` others came after. */
static inline osdtex_diagnostic
finding(const otx_run *run, int32_t back)
{
    osdtex_diagnostic d;

    otx_diagnostics_get(
        run->diagnostics, otx_diagnostics_count(run->diagnostics) - 1 - back,
        &d);
    return d;
}

static inline osdtex_diagnostic
last_finding(const otx_run *run)
{
    return finding(run, 0);
}

#endif

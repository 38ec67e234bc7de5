/* heal_call.c -- a mapping whose seams are mended. */
#include "api/heal_call.h"

#include "heal/heal.h"

/* Which seams were mended, and what windows say of it. */
static void
say_gate(otx_figures *figures, const otx_heal_figures *healed)
{
    static const char *const NAMES[][2] = {
        {"healed.windows.seams_before", "healed.windows.seams"},
        {"healed.windows.around_before", "healed.windows.around"},
        {"healed.windows.all_before", "healed.windows.all"}};
    const double *const values[] = {
        healed->windows_on, healed->windows_around, healed->windows_all};

    otx_figures_count(figures, "healed.sections", "sections", healed->sections);
    otx_figures_count(figures, "healed.mended", "sections", healed->mended);
    otx_figures_real(
        figures, "healed.mended_length_share", "",
        healed->seam_length > 0.0 ? healed->mended_length / healed->seam_length
                                  : 0.0);
    otx_figures_real(
        figures, "healed.windows.exemplar", "sigma", healed->windows_itself);
    otx_figures_real(
        figures, "healed.windows.interior_p90", "sigma",
        healed->windows_interior_p90);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
            otx_figures_real(figures, NAMES[i][k], "sigma", values[i][k]);
}

otx_status
otx_heal_call(otx_run *run, double band, osdtex_mapping *handle)
{
    otx_heal_options options = otx_heal_options_default();
    otx_figures *figures = &handle->figures;
    otx_heal_figures healed;

    if (band == 0.0)
        return OSDTEX_OK;
    if (!(band == OSDTEX_HEAL_AUTO || (band > 0.0 && band <= 512.0)))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "heal", OTX_NOWHERE,
            "a band of {heal} is 0 to 512 texels wide, not %g", band);
    if (band > 0.0)
        options.band = band;
    options.gate = band == OSDTEX_HEAL_AUTO;
    handle->mapping.field = NULL; /* what was made before is made anew */
    otx_figures_stage(figures, "heal");
    OTX_TRY(otx_heal_run(
        run, &handle->mapping, handle->exemplars, &options,
        &handle->mapping.field, &healed));
    otx_figures_stage(figures, NULL);
    otx_figures_real(figures, "healed.band", "texels", options.band);
    otx_figures_count(figures, "healed.charts", "charts", healed.charts);
    otx_figures_count(figures, "healed.texels", "texels", healed.texels);
    otx_figures_real(
        figures, "healed.area_share", "",
        healed.area > 0.0 ? (double)healed.texels / healed.area : 0.0);
    if (options.gate)
        say_gate(figures, &healed);
    return OSDTEX_OK;
}

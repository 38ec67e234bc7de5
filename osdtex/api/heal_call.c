/* heal_call.c -- a mapping whose seams are mended. */
#include "api/heal_call.h"

#include "heal/heal.h"

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
    return OSDTEX_OK;
}

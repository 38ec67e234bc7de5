/* method_settings.c -- defaults, then what the caller says, then what is
 * automatic. The report tells the values that were used. */
#include "api/method_settings.h"

otx_status
otx_method_settings_read(
    otx_run *run, const otx_method *method, const osdtex_setting *settings,
    int32_t setting_count, const otx_exemplar *exemplar, const otx_cage *cage,
    const void **out)
{
    void *values = otx_arena_zalloc(run->arena, method->settings_bytes, 1);

    OTX_TRY(otx_run_ok(run));
    otx_option_defaults(method->options, method->option_count, values);
    for (int32_t i = 0; i < setting_count; ++i)
    {
        const osdtex_setting *s = &settings[i];

        if (!s->key || !s->value)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, "map", OTX_NOWHERE,
                "a setting without a key or a value");
        OTX_TRY(otx_option_set(
            run, method->options, method->option_count, values, s->key,
            s->value));
    }
    if (method->resolve)
        method->resolve(values, exemplar, cage);
    *out = values;
    return OSDTEX_OK;
}

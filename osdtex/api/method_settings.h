/* method_settings.h -- KEY=VALUE pairs to the settings of a method. */
#ifndef OTX_API_METHOD_SETTINGS_H
#define OTX_API_METHOD_SETTINGS_H

#include "method/method.h"

#include <osdtex/osdtex.h>

/* The defaults of `method` with the caller's settings over them, as they come
 * out for this exemplar and cage, in run->arena. ARGUMENT, MEMORY. */
otx_status otx_method_settings_read(
    otx_run *run, const otx_method *method, const osdtex_setting *settings,
    int32_t setting_count, const otx_exemplar *exemplar, const otx_cage *cage,
    const void **out);

#endif

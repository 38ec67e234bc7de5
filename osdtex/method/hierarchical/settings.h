/* settings.h -- what can be set of hierarchical pattern mapping. */
#ifndef OTX_METHOD_HIERARCHICAL_SETTINGS_H
#define OTX_METHOD_HIERARCHICAL_SETTINGS_H

#include "match/match.h"
#include "method/option.h"
#include "patch/patch_settings.h"

/* Those of the patches, and no more. */
typedef otx_patch_settings otx_hierarchical_settings;

extern const otx_option otx_hierarchical_options[];
enum
{
    OTX_HIERARCHICAL_OPTION_COUNT = 23
};

#endif

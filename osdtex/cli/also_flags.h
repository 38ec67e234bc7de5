/* also_flags.h -- the exemplars beside the first, as the flags name them. */
#ifndef OTX_CLI_ALSO_FLAGS_H
#define OTX_CLI_ALSO_FLAGS_H

#include "cli/flag.h"

enum
{
    OTX_ALSO_MAX = OSDTEX_EXEMPLARS_MAX - 1,
    OTX_ALSO_MATERIAL_BYTES = 256
};

typedef struct otx_also_flags
{
    int count;
    const char *files[OTX_ALSO_MAX];
    char materials[OTX_ALSO_MAX][OTX_ALSO_MATERIAL_BYTES]; /* "" none */
    double scale;                   /* of the first exemplar; 0 not given */
    osdtex_also list[OTX_ALSO_MAX]; /* what the library takes */
    osdtex_exemplar *exemplars[OTX_ALSO_MAX]; /* as read; NULL */
    osdtex_material *sets[OTX_ALSO_MAX]; /* of those that are folders; NULL */
} otx_also_flags;

/* FILE of "[MATERIAL=]FILE". */
const char *otx_also_flags_file(const char *text);

/* Takes --also and --scale apart. False after saying what is wrong. */
bool otx_also_flags_parse(const otx_flag_values *values, otx_also_flags *out);

/* Finds the materials in those that are folders: their files go into `inputs`.
 * Findings say what is wrong. */
osdtex_status otx_also_flags_find(
    osdtex_context *context, otx_flag_inputs *inputs, otx_also_flags *also);

/* Maps of the one at `k`; NULL none. */
const osdtex_material_info *
otx_also_flags_set(const otx_also_flags *also, int k);

/* Reads the files, and sets what the library takes. */
osdtex_status otx_also_flags_read(
    osdtex_context *context, const osdtex_exemplar_options *options,
    otx_also_flags *also);

void otx_also_flags_destroy(otx_also_flags *also);

#endif

/* material_flags.h -- the maps of a material that flags name or find. */
#ifndef OTX_CLI_MATERIAL_FLAGS_H
#define OTX_CLI_MATERIAL_FLAGS_H

#include "cli/flag.h"
#include "cli/session.h"

enum
{
    OTX_MATERIAL_TEXT_BYTES = 8192
};

/* Not to be moved: options point into it. Begin with {0}. */
typedef struct otx_material_flags
{
    osdtex_material *found;             /* by --material; NULL none */
    char text[OTX_MATERIAL_TEXT_BYTES]; /* of --map, taken apart */
    osdtex_companion maps[OSDTEX_MAP_KINDS];
    int count;
} otx_material_flags;

/* Finds the files and puts them into `options`; those of the maps go into
 * `values` as inputs, and so does the colour where no EXEMPLAR is given. Says
 * what is wrong.
 *
 *   operand  which one EXEMPLAR is, from 0 */
osdtex_status otx_material_flags_take(
    otx_session *session, otx_flag_values *values, int operand,
    osdtex_exemplar_options *options, otx_material_flags *out);

/* Bit k: there is a map of kind k. */
uint32_t otx_material_flags_kinds(const otx_material_flags *flags);

void otx_material_flags_destroy(otx_material_flags *flags);

#endif

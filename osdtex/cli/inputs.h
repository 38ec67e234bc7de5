/* inputs.h -- what the flags say about cages and exemplars. */
#ifndef OTX_CLI_INPUTS_H
#define OTX_CLI_INPUTS_H

#include "cli/flag.h"

/* False after saying what is wrong. */
bool otx_inputs_cage(const otx_flag_values *values, osdtex_cage_options *out);
bool otx_inputs_exemplar(
    const otx_flag_values *values, osdtex_exemplar_options *out);

/* The whole number of a flag; *out stays where it is not given. False after
 * saying what is wrong. */
bool otx_inputs_number(
    const otx_flag_values *values, otx_flag_id id, int64_t low, int64_t high,
    int64_t *out);

/* Whether a file begins like one of the pictures that are read. */
bool otx_inputs_is_picture(const char *path);
/* Whether it is no text and is not called .obj: perhaps a picture of another
 * kind. */
bool otx_inputs_is_binary(const char *path);

const char *otx_inputs_scheme_name(osdtex_scheme scheme);
const char *otx_inputs_boundary_name(osdtex_boundary boundary);
const char *otx_inputs_fvar_name(osdtex_fvar fvar);

/* Whether a file's first bytes hold a word. */
bool otx_inputs_holds(const char *path, const char *word);

#endif

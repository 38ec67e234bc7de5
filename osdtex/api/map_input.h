/* map_input.h -- what a user says about fields and the exemplar, checked. */
#ifndef OTX_API_MAP_INPUT_H
#define OTX_API_MAP_INPUT_H

#include "exemplar/exemplar.h"
#include "method/method.h"

#include <osdtex/osdtex.h>

/* Reads a file of constraints, and what the field is to follow instead of what
 * the file says; `*out` is NULL when both are. */
otx_status otx_map_input_constraints(
    otx_run *run, const char *path, const char *follow,
    const otx_constraint_set **out);

/* The constraints that a saved mapping holds, as JSON text. FORMAT, MEMORY. */
otx_status otx_map_input_parse(
    otx_run *run, const char *path, const char *json,
    const otx_constraint_set **out);

/* A set with constraints of the host after its own.
 *
 *   from   NULL: there is nothing yet
 *   items  [count], each as long as the size of the first says
 *
 * ARGUMENT (an array that is missing, a size that is not set). */
otx_status otx_map_input_add(
    otx_run *run, const otx_constraint_set *from,
    const osdtex_constraint *items, int32_t count, otx_constraint_set *out);

/* All that options say of constraints; `*out` is NULL when that is nothing. */
otx_status otx_map_input_options(
    otx_run *run, const osdtex_map_options *options,
    const otx_constraint_set **out);

/* What the user takes the exemplar for; `*out` is NULL when he says nothing.
 * ARGUMENT for a class that is not known, and for generators that span no
 * cell. */
otx_status otx_map_input_analysis(
    otx_run *run, const osdtex_map_options *options,
    const otx_exemplar *exemplar, const otx_analysis **out);

#endif

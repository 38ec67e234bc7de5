/* stack_measure.h -- figures of a stack, for the host that asked for them. */
#ifndef OTX_API_STACK_MEASURE_H
#define OTX_API_STACK_MEASURE_H

#include "api/call.h"
#include "stack/stack.h"

/* Fills in as many bytes as out->size says; NULL: nothing is done. MEMORY. */
otx_status otx_stack_measure(
    otx_call *call, const otx_stack *stack, const otx_stack_key *keys,
    osdtex_stack_figures *out);

#endif

/* start.h -- what the coarsest level begins with. */
#ifndef OTX_SYNTH_START_H
#define OTX_SYNTH_START_H

#include "synth/maker.h"

/* Puts matches and colours into the canvases of the coarsest level: those that
 * were given, or by chance; with several starts, of every chart the one that
 * came out best. */
otx_status otx_start_make(otx_maker *maker, int32_t level);

#endif

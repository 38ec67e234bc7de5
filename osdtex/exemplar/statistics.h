/* statistics.h -- how much a picture varies, and how fast. */
#ifndef OTX_EXEMPLAR_STATISTICS_H
#define OTX_EXEMPLAR_STATISTICS_H

#include "exemplar/exemplar.h"

/* Sets sigma and step of `match` and `lab`, which are of one size; of an
 * exemplar that has no pixels of them, nothing. MEMORY. */
otx_status otx_exemplar_measure(otx_run *run, otx_exemplar *e);

#endif

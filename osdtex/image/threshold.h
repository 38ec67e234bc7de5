/* threshold.h -- the value that parts values in two. */
#ifndef OTX_IMAGE_THRESHOLD_H
#define OTX_IMAGE_THRESHOLD_H

#include <stdint.h>

typedef struct otx_threshold
{
    double value;   /* one class is below it, the other is not */
    double clarity; /* share of the variance that the classes explain, 0 to 1;
                     * 0: all values are alike */
} otx_threshold;

/* The threshold that leaves the least variance within both classes, by a
 * histogram [Otsu79].
 *
 *   values  [count] finite, one or more */
otx_threshold otx_threshold_find(const float *values, int64_t count);

#endif

/* stack_file.h -- a stack as a file of several parts. */
#ifndef OTX_EXPORT_STACK_FILE_H
#define OTX_EXPORT_STACK_FILE_H

#include "exemplar/exemplar.h"
#include "file/atomic_file.h"

typedef struct otx_stack_page
{
    const otx_image *linear;
    const otx_image *maps; /* as the companions of `like`, where it has any */
    const uint8_t *mask;   /* [height * width] */
    double position;       /* along the axis, 0 to 1 */
} otx_stack_page;

/* Writes `path` of `set`: tiled, mip-mapped parts m000, m001, ... with the
 * slices, mask000, ... with their masks, and normal000, ... and so on with
 * their maps, each with its place in the attribute osdtex:position; colours and
 * kinds of maps are those of `like`. IO, NUMERIC, MEMORY. */
otx_status otx_stack_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_exemplar *like, const otx_stack_page *pages, int32_t count);

/* A mask as an 8-bit PNG of `set`, white in it. IO, MEMORY. */
otx_status otx_stack_file_write_mask(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const uint8_t *mask, int32_t width, int32_t height);

#endif

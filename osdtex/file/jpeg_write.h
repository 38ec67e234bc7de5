/* jpeg_write.h -- JPEG files through libjpeg. */
#ifndef OTX_FILE_JPEG_WRITE_H
#define OTX_FILE_JPEG_WRITE_H

#include "file/atomic_file.h"
#include "image/image.h"

/* Writes display-referred values as the file `path` of `set`, which the caller
 * commits: baseline, quality 95, colours as finely as lightness, no date. A
 * fourth channel is left out, since JPEG has no alpha.
 *
 *   image  3 or 4 channels, clamped to [0, 1]
 *
 * ARGUMENT, NUMERIC (a value is not finite), IO, MEMORY. */
otx_status otx_jpeg_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image);

#endif

/* tiff_write.h -- TIFF files through libtiff. */
#ifndef OTX_FILE_TIFF_WRITE_H
#define OTX_FILE_TIFF_WRITE_H

#include "file/atomic_file.h"
#include "image/image.h"

/* Writes values as the file `path` of `set`, which the caller commits: in
 * strips packed by Deflate, the directory before them, no date.
 *
 *   image  1, 3 or 4 channels (R, G, B, A with alpha not multiplied in)
 *   bits   8 or 16: integers, clamped to [0, 1]; 32: floats as they are
 *
 * ARGUMENT, NUMERIC (a value is not finite), IO, MEMORY. */
otx_status otx_tiff_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, int32_t bits);

#endif

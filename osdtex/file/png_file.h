/* png_file.h -- PNG files through libpng. */
#ifndef OTX_FILE_PNG_FILE_H
#define OTX_FILE_PNG_FILE_H

#include "file/atomic_file.h"
#include "file/picture.h"

/* Reads a PNG into `out`; called by otx_picture_read. */
otx_status otx_png_file_read(otx_run *run, const char *path, otx_picture *out);

/* Writes display-referred values as the file `path` of `set`, which the caller
 * commits. Values are rounded to integers; below 0 and above 1 they are
 * clamped. Tagged sRGB; no date, so the same pixels give the same bytes.
 *
 *   image  3 or 4 channels (R, G, B, A with alpha not multiplied in)
 *   bits   8 or 16
 *
 * ARGUMENT, NUMERIC (a value is not finite), IO, MEMORY. */
otx_status otx_png_file_write(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image, int32_t bits);

/* The same of numbers that are no colours: 16 bits, of 1, 3 or 4 channels, not
 * tagged. */
otx_status otx_png_file_write_data(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const otx_image *image);

#endif

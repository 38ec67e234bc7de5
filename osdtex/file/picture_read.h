/* picture_read.h -- reading a picture file of any format.
 *
 * The format is recognised by the first bytes, never by the extension. */
#ifndef OTX_FILE_PICTURE_READ_H
#define OTX_FILE_PICTURE_READ_H

#include "file/picture.h"

/* Reads EXR, PNG, TIFF or JPEG. Pixels and strings are in run->arena; nothing
 * is left there on failure.
 *
 * IO      the file does not open or read
 * FORMAT  not one of the four formats, damaged, or cut short
 * SUPPORT a kind of file that is not read (deep, CMYK, ...), or an EXR whose
 *         layers leave it unclear which is the picture
 * LIMIT   larger than OTX_IMAGE_MAX_SIDE or OTX_PICTURE_MAX_PIXELS
 * NUMERIC a pixel is not finite: the first is named
 * MEMORY  */
otx_status otx_picture_read(otx_run *run, const char *path, otx_picture *out);

/* The same, of an EXR the layer of this name; NULL: see exr_layer.h. Pictures
 * of other kinds have no layers, which is noted. ARGUMENT when there is no such
 * layer. */
otx_status otx_picture_read_layer(
    otx_run *run, const char *path, const char *layer, otx_picture *out);

#endif

/* tiff_file.h -- TIFF files through libtiff. */
#ifndef OTX_FILE_TIFF_FILE_H
#define OTX_FILE_TIFF_FILE_H

#include "file/picture.h"

/* Reads the first directory of a TIFF into `out`; called by
 * otx_picture_read. */
otx_status otx_tiff_file_read(otx_run *run, const char *path, otx_picture *out);

#endif

/* jpeg_file.h -- JPEG files through libjpeg. */
#ifndef OTX_FILE_JPEG_FILE_H
#define OTX_FILE_JPEG_FILE_H

#include "file/picture.h"

/* Reads a grey or colour JPEG into `out`; called by otx_picture_read. */
otx_status otx_jpeg_file_read(otx_run *run, const char *path, otx_picture *out);

#endif

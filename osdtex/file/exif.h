/* exif.h -- what EXIF says about which side of a picture is up, and about its
 * colours. */
#ifndef OTX_FILE_EXIF_H
#define OTX_FILE_EXIF_H

#include "base/run.h"

/* The orientation, 1 to 8, of EXIF as it stands in a file of its own (a TIFF
 * header and what follows); 1, as stored, where it says none or is damaged. */
int32_t otx_exif_orientation(const uint8_t *bytes, size_t count);

/* Whether it says that the colours are Adobe RGB (1998), as cameras do. */
bool otx_exif_says_adobe_rgb(const uint8_t *bytes, size_t count);

/* A warning that pixels are taken as stored, unless the orientation is 1:
 * renderers do not turn textures, viewers do.
 *
 *   what  "JPEG", ... */
void otx_exif_note_orientation(
    otx_run *run, const char *path, const char *what, int32_t orientation);

#endif

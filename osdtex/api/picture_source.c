/* picture_source.c -- member by member. */
#include "api/picture_source.h"

#include <string.h>

void
otx_picture_source_fill(const otx_picture *picture, otx_colour_source *out)
{
    out->interop_id = picture->interop_id;
    out->oiio_space = picture->oiio_space;
    out->has_chromaticities = picture->has_chromaticities;
    memcpy(
        out->chromaticities, picture->chromaticities,
        sizeof out->chromaticities);
    out->is_float = picture->is_float;
    out->icc = picture->icc;
    out->icc_bytes = picture->icc_bytes;
    out->icc_fault = picture->icc_fault;
    out->gamma = picture->gamma;
    out->says_srgb = picture->says_srgb;
    out->says_adobe_rgb = picture->says_adobe_rgb;
    out->is_gray = picture->is_gray;
}

const char *
otx_picture_source_type(const otx_picture *picture)
{
    if (picture->is_float)
        return picture->bits == 16   ? "half"
               : picture->bits == 32 ? "float"
                                     : "double";
    if (picture->bits <= 8)
        return "8-bit";
    return picture->bits <= 16 ? "16-bit" : "32-bit";
}

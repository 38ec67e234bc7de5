/* exemplar.h -- the picture of a material, in the two colour spaces it is
 * used in.
 *
 * Pixels are always copied from `linear` (scene-linear, what is written out);
 * decisions are always made on `match` (a bounded display-like space, embedded
 * so that Euclidean distance is meaningful). See docs/notes/colour.md. */
#ifndef OTX_IMAGE_EXEMPLAR_H
#define OTX_IMAGE_EXEMPLAR_H

#include "image/image.h"

typedef struct otx_exemplar
{
    otx_image linear; /* 3 or 4 channels (R, G, B[, A]) */
    otx_image match;  /* 3 channels, same size */
    otx_image lab;    /* 3 channels, CIELAB D65 of the display-like picture:
                       * what seams are measured in, whatever matches */
    bool wrap_x;      /* the picture tiles left to right */
    bool wrap_y;
    /* RMS distance of two random texels (sigma) and of horizontally or
     * vertically adjacent ones (step), in match space and in Lab. */
    double match_sigma, match_step;
    double lab_sigma, lab_step;
    /* What is recorded in the report and the EXR header. */
    const char *source_path;  /* as given */
    const char *source_hash;  /* of the file's bytes */
    const char *source_space; /* resolved OCIO colour space of the file */
    const char *linear_space; /* OCIO name of `linear` */
    const char *match_space;
    const char *interop_id; /* colorInteropID of linear_space, NULL unknown */
    bool has_chromaticities;
    float chromaticities[8]; /* of linear_space: R, G, B, W xy pairs */
} otx_exemplar;

#endif

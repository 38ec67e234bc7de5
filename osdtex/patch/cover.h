/* cover.h -- which patch each face shows, and at which UVs.
 *
 * The one thing that all stages are for. Patches are numbered in the order in
 * which they are fitted; the given ones come first. */
#ifndef OTX_PATCH_COVER_H
#define OTX_PATCH_COVER_H

#include "patch/mosaic_job.h"

/* Arrays over leaf faces and corners, in run->arena. */
typedef struct otx_cover
{
    int32_t *face_patch; /* [face_count] -1 until textured, and on holes */
    otx_vec2 *uvs;       /* [corner_count] texels, where textured */
    int32_t patch_count;
    uint8_t *patch_exemplar; /* of several: [2 face_count] by patch, fitted ones
                              * and those of unfolded faces; else NULL */
    double done_area;        /* of textured leaves */
    double total_area;
} otx_cover;

/* Nothing is textured. MEMORY. */
otx_status otx_cover_create(const otx_mosaic_job *job, otx_cover *out);

/* Index of the exemplar that a patch is from. */
int32_t otx_cover_exemplar(const otx_cover *cover, int32_t patch);

/* Hands it out: UVs in units of the picture, patches without numbers that
 * nothing shows. Shares patch_exemplar. MEMORY. */
otx_status otx_cover_write(
    const otx_mosaic_job *job, const otx_cover *cover, otx_mapping *out);

#endif

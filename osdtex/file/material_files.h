/* material_files.h -- the files of a material, told by their names.
 *
 * People hold sets of maps that are called after a material and what each map
 * is: NAME_Color, NAME_NormalGL, NAME_Roughness, with a resolution before or
 * behind. Names compare without case, and -, _, blanks and dots alike. The
 * table of words is in material_files.c and in docs/materials.md. */
#ifndef OTX_FILE_MATERIAL_FILES_H
#define OTX_FILE_MATERIAL_FILES_H

#include "base/run.h"

/* What a file of a set holds. Those that are packed hold three maps in their
 * red, green and blue. */
typedef enum otx_material_role
{
    OTX_MATERIAL_COLOR,
    OTX_MATERIAL_NORMAL,    /* y up, or it is not said */
    OTX_MATERIAL_NORMAL_DX, /* y down */
    OTX_MATERIAL_ROUGHNESS,
    OTX_MATERIAL_GLOSS, /* 1 less roughness */
    OTX_MATERIAL_HEIGHT,
    OTX_MATERIAL_METALNESS,
    OTX_MATERIAL_OCCLUSION,
    OTX_MATERIAL_PACKED, /* occlusion, roughness, metalness */
    OTX_MATERIAL_ROLE_COUNT
} otx_material_role;

typedef struct otx_material_files
{
    const char *paths[OTX_MATERIAL_ROLE_COUNT]; /* NULL none */
} otx_material_files;

/* What a file is called: a role, or OTX_MATERIAL_ROLE_COUNT.
 *
 *   name   without folder and extension
 *   rank   out: more is better, of two files of one role */
otx_material_role otx_material_files_role(const char *name, int32_t *rank);

/* Finds the pictures in a folder, or of a folder those whose names begin with
 * the last part of `text` (FOLDER/PREFIX, where the next letter is none that a
 * longer name would have). Paths live in run->arena.
 *
 * IO      there is no such folder
 * FORMAT  no colour among them, or two files that could be one map
 * MEMORY  */
otx_status otx_material_files_find(
    otx_run *run, const char *text, otx_material_files *out);

#endif

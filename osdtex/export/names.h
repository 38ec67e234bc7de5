/* names.h -- the files of a model, from the name that was asked for. */
#ifndef OTX_EXPORT_NAMES_H
#define OTX_EXPORT_NAMES_H

#include "base/run.h"

enum
{
    OTX_NAMES_TEXTURES = 4
};

/* Strings live in the arena they were made in. */
typedef struct otx_names
{
    const char *obj, *mtl, *exr; /* paths, in the folder of the OBJ */
    const char *mtl_name; /* without the folder, as the OBJ refers to it */
    const char *exr_name; /* as the MTL refers to it */
    const char *stem;     /* NAME, readable as one word */
    /* Of each exemplar: NAME.exr, or NAME_1.exr and so on. */
    int32_t texture_count;
    const char *textures[OTX_NAMES_TEXTURES]; /* paths */
    const char
        *texture_names[OTX_NAMES_TEXTURES]; /* as the MTL refers to them */
} otx_names;

/* Makes one word of a name that all readers take: `_` stands for what OBJ and
 * MTL readers split at, take for a comment or for an option (blanks, `#`, `\`,
 * a leading `-`), for control characters, and for what is not UTF-8. Whether
 * anything changed. */
bool otx_names_make_word(char *stem);

/* Derives NAME.mtl and NAME.exr from `path`, FOLDER/NAME.obj: derived names are
 * made one word, with a warning, and the OBJ's own is left as it is. ARGUMENT
 * when `path` does not end in ".obj" after a name, MEMORY. */
otx_status otx_names_derive(
    otx_run *run, otx_arena *arena, const char *path, otx_names *out);

/* Names the textures of `count` exemplars, up to OTX_NAMES_TEXTURES: NAME.exr,
 * or NAME_1.exr and so on, with `extension` (".exr", ".png"). MEMORY. */
otx_status otx_names_number(
    otx_run *run, otx_arena *arena, int32_t count, const char *extension,
    otx_names *names);

/* Index of a name in a list; -1 none. */
int32_t
otx_names_find(const char *const *list, int32_t count, const char *name);

#endif

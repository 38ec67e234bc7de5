/* saved_about.h -- what a saved mapping says besides its arrays.
 *
 * See docs/formats-mapping.md for the format. */
#ifndef OTX_API_SAVED_ABOUT_H
#define OTX_API_SAVED_ABOUT_H

#include "api/handle.h"

enum
{
    OTX_SAVED_FORMAT = 1,
    OTX_SAVED_SETTINGS_MAX = 128
};

/* One exemplar: its file, and how it was read. */
typedef struct otx_saved_exemplar
{
    const char *path, *hash;
    osdtex_exemplar_options options;
    otx_exemplar_cuts cuts; /* without the texels, which are an array */
    bool rearranged;        /* whether there are texels */
    int32_t width, height;  /* of what the mapping refers to */
    int32_t match_width, match_height;
    bool wrap_x, wrap_y;
    osdtex_companion maps[OSDTEX_MAP_KINDS]; /* [options.map_count], the other
                                              * maps of a material */
} otx_saved_exemplar;

/* A picture that is placed over the mapping. */
typedef struct otx_saved_picture
{
    const char *path, *hash; /* hash: NULL unknown */
    const char *from;        /* colour space, as it was resolved */
} otx_saved_picture;

/* Strings live in the arena that it was read into. */
typedef struct otx_saved_about
{
    const char *program; /* the version that wrote it */
    const char *cage_path, *cage_hash;
    const char *topology; /* hash of the cage's faces */
    osdtex_cage_options cage;
    int32_t level;
    int32_t exemplar_count;
    otx_saved_exemplar exemplars[OTX_EXEMPLARS_MAX];
    int32_t picture_count;
    const otx_saved_picture *pictures; /* [picture_count] */
    const char *method;
    int32_t setting_count;
    osdtex_setting settings[OTX_SAVED_SETTINGS_MAX];
    double scale;
    uint64_t seed;
    int32_t patch_count;
    int32_t layering;
    int32_t guide_symmetry; /* 0: no guide */
    double guide_angle;
    int32_t defect_count;
    const char *constraints; /* JSON text; NULL none */
} otx_saved_about;

/* The hash of a cage's faces: two cages with the same one can have the same
 * UVs. MEMORY. */
otx_status
otx_saved_topology(otx_run *run, const otx_cage *cage, const char **out);

/* As JSON text in run->scratch: the same text for the same mapping. ARGUMENT
 * where the cage or an exemplar is from no file, MEMORY. */
otx_status otx_saved_about_print(
    otx_run *run, const osdtex_mapping *mapping, const char **out);

/* The other way round; every value is checked, and text is copied to
 * run->arena. FORMAT, SUPPORT (a later format), MEMORY. */
otx_status otx_saved_about_parse(
    otx_run *run, const char *path, const char *text, otx_saved_about *out);

#endif

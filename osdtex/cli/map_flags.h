/* map_flags.h -- what osdtex map and osdtex bake are asked for: options, and
 * the names of what is written. */
#ifndef OTX_CLI_MAP_FLAGS_H
#define OTX_CLI_MAP_FLAGS_H

#include "cli/also_flags.h"
#include "cli/material_flags.h"
#include "cli/path_list.h"

enum
{
    OTX_MAP_PATH_BYTES = 4096
};

/* Not to be moved: options point into it. */
typedef struct otx_map_flags
{
    const otx_flag_values *values;
    osdtex_cage_options cage_options;
    osdtex_exemplar_options exemplar_options;
    osdtex_surface_options surface_options;
    osdtex_map_options map_options;
    otx_also_flags also;
    otx_material_flags material;
    osdtex_setting settings[OTX_FLAG_SETTINGS_MAX + 1];
    osdtex_bake_options bake_options;
    osdtex_render_options picture; /* of the preview */
    bool maps, bakes;              /* which files are asked for */
    char obj[OTX_MAP_PATH_BYTES], mtl[OTX_MAP_PATH_BYTES];
    /* With --pastes the exemplar, and its pieces. */
    char exrs[OSDTEX_EXEMPLARS_MAX][OTX_MAP_PATH_BYTES];
    int exr_count; /* 0 before a saved mapping has said */
    char cage_obj[OTX_MAP_PATH_BYTES], cage_mtl[OTX_MAP_PATH_BYTES];
    char usda[OTX_MAP_PATH_BYTES];       /* of --pastes; empty without */
    const char *preview, *report, *save; /* NULL none */
} otx_map_flags;

/* False after saying what is wrong. Borrows the values. */
bool otx_map_flags_parse(
    const otx_flag_values *values, bool bake_only, otx_map_flags *out);

/* The same of a command that writes nothing by itself: options only. */
bool
otx_map_flags_parse_mapping(const otx_flag_values *values, otx_map_flags *out);

/* Names the textures, of which a saved mapping knows how many there are. False
 * after saying what is wrong. */
bool otx_map_flags_name(otx_map_flags *request);

/* Adds the files that will be written. */
void otx_map_flags_outputs(const otx_map_flags *request, otx_path_list *out);

/* Whether all outputs are there and whole, of the job with this hash. */
bool otx_map_flags_is_done(
    const otx_map_flags *request, const char hash[OSDTEX_HASH_BYTES]);

#endif

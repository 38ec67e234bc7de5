/* bake_outputs.h -- the files of a bake, and whether they are all there. */
#ifndef OTX_CLI_BAKE_OUTPUTS_H
#define OTX_CLI_BAKE_OUTPUTS_H

#include "cli/path_list.h"

#include <osdtex/osdtex.h>

#include <stdbool.h>

/* What stands before the tiles' numbers in a comment of the cage. */
#define OTX_BAKE_OUTPUTS_TILES "UDIM tiles"

/* Whether every file of a bake is there and of the job with this hash. With
 * options->udim only the textures of that tile need be of this job: the others
 * are of tasks of their own.
 *
 *   cage       FOLDER/NAME_cage.obj; the others are beside it
 *   maps       bit k: the bake has maps of kind k
 *   type       of the textures; ANY stands for EXR */
bool otx_bake_outputs_are_done(
    const char *cage, const osdtex_bake_options *options, uint32_t maps,
    osdtex_texture_type type, const char hash[OSDTEX_HASH_BYTES]);

/* Adds the files that a bake writes: the texts, and those of the textures asked
 * for that are there already, since which tiles there will be is not known yet.
 *
 *   cage, maps, type  as above */
void otx_bake_outputs_list(
    const char *cage, const osdtex_bake_options *options, uint32_t maps,
    osdtex_texture_type type, otx_path_list *out);

/* Whether the name of another output may be that of a texture of the bake.
 *
 *   cage, maps, type  as above
 *   path                   NULL allowed */
bool otx_bake_outputs_may_be(
    const char *cage, const osdtex_bake_options *options, uint32_t maps,
    osdtex_texture_type type, const char *path);

#endif

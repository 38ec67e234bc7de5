/* osdtex.h -- texture subdivision surfaces from an exemplar image.
 *
 * This is the header to include; each subject has one of its own beside it.
 * The pipe, one call a stage:
 *
 *     osdtex_cage_read       the artist's cage, validated (cage.h)
 *     osdtex_exemplar_read   the picture of a material, colours resolved
 *                            (exemplar.h)
 *     osdtex_preflight       what the rest will come to, and what is wrong
 *                            with it, before it costs anything (preflight.h)
 *     osdtex_map             a mapping: the cage refined, and UVs into the
 *                            exemplar for every face (mapping.h)
 *     osdtex_mapping_write   OBJ + MTL + EXR that load in the DCC (mapping.h)
 *     osdtex_bake            the cage with textures on its UVs (bake.h)
 *     osdtex_textures_create the same textures in memory (textures.h)
 *     osdtex_report_create   how good it is, in figures (report.h)
 *     osdtex_seams_create    where its seams show most (seams.h)
 *     osdtex_render          a picture of the result (render.h)
 *
 * and beside it memory, threads and findings (context.h), the refined surface
 * for hosts that look at it (surface.h), directions that a texture follows
 * (field.h), the methods and their settings (method.h), tiled textures
 * (tiles.h), stacks (stack.h), the files of a material (material.h), pixels
 * (image.h) and what files depend on (files.h).
 *
 * Every call that can fail returns an osdtex_status; on failure *out is NULL,
 * the inputs are untouched, and the context holds diagnostics addressed to the
 * person who owns the file. Handles are immutable once returned; a context
 * serves one thread of control at a time. `*_create`, `*_read`, `*_refine`,
 * `osdtex_map` and `osdtex_render` return handles that the caller destroys;
 * `*_describe` lends what lives as long as the handle.
 *
 * Handles are counted: one that was made from others (a surface from its cage,
 * a mapping from its surface and exemplars, a model from its mapping) keeps
 * them, so handles and context may be destroyed in any order, and each as soon
 * as the caller needs it no more. What `*_describe` lends lives until the
 * caller has destroyed the handle itself. Destroying NULL is fine.
 *
 * Structs that open with `size` may grow at their end in later versions; get
 * one from its `*_default` or `*_none` function, which sets `size`. Hosts in
 * other languages call `*_init` with the bytes of the struct as they know it:
 * it gets the defaults, and what this library does not know is zeroed. Structs
 * that a `*_describe` lends may grow too; all others are final. NULL for
 * options means the defaults.
 *
 * Conventions: UV (0,0) is the lower-left corner of the picture, v up.
 * Positions are in scene units and are never rescaled. Angles are in radians.
 */
#ifndef OSDTEX_OSDTEX_H
#define OSDTEX_OSDTEX_H

#include <osdtex/bake.h>
#include <osdtex/cage.h>
#include <osdtex/colour.h>
#include <osdtex/common.h>
#include <osdtex/context.h>
#include <osdtex/exemplar.h>
#include <osdtex/field.h>
#include <osdtex/files.h>
#include <osdtex/image.h>
#include <osdtex/mapping.h>
#include <osdtex/material.h>
#include <osdtex/method.h>
#include <osdtex/preflight.h>
#include <osdtex/render.h>
#include <osdtex/report.h>
#include <osdtex/seams.h>
#include <osdtex/stack.h>
#include <osdtex/surface.h>
#include <osdtex/textures.h>
#include <osdtex/tiles.h>
#include <osdtex/version.h>

#endif

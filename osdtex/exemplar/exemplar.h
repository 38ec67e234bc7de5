/* exemplar.h -- the picture of a material, in the two colour spaces it is
 * used in.
 *
 * Pixels are always copied from `linear` (scene-linear, what is written out);
 * decisions are always made on `match` (a bounded display-like space, embedded
 * so that Euclidean distance is meaningful). See docs/notes/colour.md. */
#ifndef OTX_EXEMPLAR_EXEMPLAR_H
#define OTX_EXEMPLAR_EXEMPLAR_H

#include "colour/embedding.h"
#include "colour/receiver.h"
#include "exemplar/companions.h"
#include "image/image.h"
#include "image/tile_layout.h"

/* The pictures of a stack, of one size: slices from one end of its axis to the
 * other. */
typedef struct otx_exemplar_slices
{
    int32_t count;
    const otx_image *linear; /* [count] */
    const otx_image *lab;    /* [count] */
    /* [count] images of companions; NULL: those of the exemplar are all there
     * are. */
    const otx_image *maps;
} otx_exemplar_slices;

typedef struct otx_exemplar
{
    otx_image linear; /* 3 or 4 channels (R, G, B[, A]) */
    otx_image match;  /* 3 channels, same size unless made anew; it and `lab`
                       * are sizes only where `linear` alone was asked for */
    otx_image lab;    /* 3 channels, CIELAB D65 of the display-like picture:
                       * what seams are measured in, whatever matches */
    bool mixes_maps;  /* `match` holds more than colours, see match_maps.h */
    bool wrap_x;      /* the picture tiles left to right */
    bool wrap_y;
    /* RMS distance of two random texels (sigma) and of horizontally or
     * vertically adjacent ones (step), in match space and in Lab. */
    double match_sigma, match_step;
    double lab_sigma, lab_step;
    /* What is recorded in the report and the EXR header. */
    const char *source_path;  /* as given */
    const char *source_hash;  /* of the file's bytes */
    const char *source_space; /* resolved OCIO colour space of the file, or
                               * what else it says of its encoding */
    const char *linear_space; /* OCIO name of `linear` */
    const char *match_space;
    const char *interop_id; /* colorInteropID of linear_space, NULL unknown */
    bool has_chromaticities;
    float chromaticities[8];   /* of linear_space: R, G, B, W xy pairs */
    otx_embedding embedding;   /* of `match` */
    otx_receiver receiver;     /* for whom `linear` is written */
    otx_texture_type type;     /* and as which files */
    bool is_data;              /* no colours: files have no curve on it */
    otx_tile_layout tiles;     /* of a tiled texture; else `cell` is 0 */
    otx_companions companions; /* the other maps of its set */
    /* Of a stack, of which the pictures above are the slice in the middle;
     * NULL: there is no third axis. */
    const otx_exemplar_slices *slices;
} otx_exemplar;

typedef enum otx_exemplar_wrap
{
    OTX_EXEMPLAR_WRAP_AUTO, /* tested for each axis */
    OTX_EXEMPLAR_WRAP_NO,
    OTX_EXEMPLAR_WRAP_YES
} otx_exemplar_wrap;

enum
{
    OTX_EXEMPLAR_MIN_SIDE = 8,
    OTX_EXEMPLARS_MAX = 4 /* that a mapping takes from */
};

/* A decoded file and what the user said about it. Zero is a fine default for
 * all but `pixels`. */
typedef struct otx_exemplar_input
{
    otx_image
        pixels;    /* grey, grey + A, RGB or RGBA; left as it is, but where */
    bool may_take; /* `linear` may be made in its place: it lives as long */
    /* Colour is already multiplied by A, as in EXR (not in PNG). */
    bool alpha_is_premultiplied;
    otx_colour_source source; /* what the file and --from say of its colours */
    const char *hash;         /* of the file's bytes, NULL unknown */
    const char *to;           /* --to, NULL role scene_linear */
    otx_receiver receiver;    /* --for */
    otx_texture_type type;    /* of the files that are written */
    const char *match_space;  /* --match-space, NULL role color_picking */
    otx_embedding embedding;
    otx_exemplar_wrap wrap;
    bool linear_only; /* nothing is compared: it is all looked up by a mapping
                       * that is there; then `wrap` of AUTO is NO */
} otx_exemplar_input;

/* Builds all of an exemplar in run->arena and says each decision in a finding.
 *
 * Alpha: colour is converted unassociated, `linear` holds it associated
 * (multiplied by A, as EXR has it), and matching sees it over black.
 * Spaces that hold data pass unchanged.
 *
 * ARGUMENT (channels), LIMIT (smaller than OTX_EXEMPLAR_MIN_SIDE or larger
 * than an image may be), NUMERIC (a value that is not finite), COLOUR. */
otx_status otx_exemplar_build(
    otx_run *run, const otx_colour *colour, const otx_exemplar_input *input,
    otx_exemplar *out);

/* The same pictures to be compared at another size: `match` and `lab` are made
 * anew, filtered, in run->arena; `linear` is borrowed. LIMIT for a size that an
 * exemplar cannot have, MEMORY. */
otx_status otx_exemplar_resize(
    otx_run *run, const otx_exemplar *from, int32_t width, int32_t height,
    otx_exemplar *out);

/* The same with all its pictures made anew, in run->arena: `linear` and the
 * maps of its set, too. LIMIT, MEMORY. */
otx_status otx_exemplar_rescale(
    otx_run *run, const otx_exemplar *from, int32_t width, int32_t height,
    otx_exemplar *out);

/* The rectangle of width x height at (x, y) of `from`, in run->arena. Along
 * axes that are cut off it is tested whether it tiles. */
otx_status otx_exemplar_crop(
    otx_run *run, const otx_exemplar *from, int32_t x, int32_t y, int32_t width,
    int32_t height, otx_exemplar *out);

/* Arranges the texels of `from` anew, in run->arena: texel i of the result, of
 * the same size, is texels[i] of it. It tiles in both axes. */
otx_status otx_exemplar_rearrange(
    otx_run *run, const otx_exemplar *from, const int32_t *texels,
    otx_exemplar *out);

#endif

/* stack.h -- stacks: pictures that change along a material axis.
 *
 *     osdtex_stack_options options = osdtex_stack_options_default();
 *     const osdtex_exemplar *keys[2] = {spots, stripes};
 *
 *     options.slices = 8;
 *     osdtex_stack_write(context, keys, 2, &options, "fur.exr", NULL);
 *
 * makes the slices between pictures that tile: features of the one become those
 * of the next. Reading such a file gives an exemplar like any other, whose
 * third coordinate a `material` constraint says. */
#ifndef OSDTEX_STACK_H
#define OSDTEX_STACK_H

#include <osdtex/exemplar.h>

OSDTEX_BEGIN_DECLS

/* How the masks of features go from one picture to the next. */
typedef int32_t osdtex_morph;
enum
{
    OSDTEX_MORPH_AUTO = 0,   /* linear or advect: whose slices have the fewest
                              * crumbs */
    OSDTEX_MORPH_ADVECT = 1, /* features travel: networks, joints */
    OSDTEX_MORPH_RELAX = 2,  /* they travel and are blended */
    OSDTEX_MORPH_LINEAR = 3  /* their distances are blended: spots */
};

/* What a feature is, where no mask says it. */
typedef int32_t osdtex_feature;
enum
{
    OSDTEX_FEATURE_AUTO = 0,  /* what parts both pictures more clearly */
    OSDTEX_FEATURE_SPOTS = 1, /* what is darker or lighter than most */
    OSDTEX_FEATURE_JOINTS = 2 /* what is narrow besides */
};

enum
{
    OSDTEX_STACK_KEYS_MAX = 8,
    OSDTEX_STACK_SLICES_MAX = 64 /* between two keys, with both of them */
};

/* How good slices are, the worst of all; docs/notes/stack.md says how each is
 * measured and what it is blind to. */
typedef struct osdtex_stack_figures
{
    size_t size; /* of the struct as the host knows it */
    /* Of a slice's features and those of the texels that it is made of: what
     * both have, as a share of what either has. */
    double lookup;
    /* Contrast and sharpness, as shares of those of the pictures. */
    double contrast_least, contrast_most;
    double sharpness;
    /* Texels that change their side of the mask from a slice to the next, as
     * shares of the mean. */
    double flips_least, flips_most;
    double step;  /* Lab distance of neighbours: the most of the median */
    double still; /* the same in Lab, where no feature changes nearby */
    /* Lab distance of the colours inside and outside of features to those of
     * the pictures. */
    double colours;
} osdtex_stack_figures;

typedef struct osdtex_stack_options
{
    size_t size;
    int32_t slices; /* from a picture to the next, with both, or of one that
                     * varies: 2 .. 64 */
    int32_t width;  /* texels of the slices; 0: as the first picture has */
    osdtex_morph morph;
    osdtex_feature feature;
    /* [key_count] where features are, of the pictures' shapes: above one half,
     * on the mean of the channels. NULL, or NULL for one: they are found. */
    const osdtex_image *const *masks;
    uint64_t seed;
    /* Filled in, as many bytes as its size says; NULL: nothing is measured. */
    osdtex_stack_figures *figures;
    /* 1: slices of one picture that have its features and otherwise nothing in
     * the same place, to hide the period of a tile; then key_count is 1. */
    int32_t vary;
    int32_t reserved;
} osdtex_stack_options;

static inline osdtex_stack_options
osdtex_stack_options_default(void)
{
    osdtex_stack_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.slices = 8;
    options.seed = 1;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_stack_options_init(osdtex_stack_options *out, size_t bytes);

typedef struct osdtex_stack_info
{
    int32_t slice_count;
    int32_t width;
    int32_t height;
    osdtex_morph morph;     /* that was taken; of the first stretch */
    osdtex_feature feature; /* that was looked for */
    int32_t reserved;
    /* Texels that change their side of the mask from a slice to the next: the
     * most over the mean, the largest of all stretches. */
    double flips;
    double mask_share[OSDTEX_STACK_KEYS_MAX]; /* of the features of each key */
} osdtex_stack_info;

/* Makes a stack of `key_count` pictures in a row and writes it as an EXR of
 * several parts: m000, m001, ... with the slices, then mask000, ... with the
 * masks, and normal000, ... of each kind of map that any of the pictures has.
 * Beside NAME.exr lie the masks of the keys as NAME_mask1.png,
 * NAME_mask2.png, ..., to be looked at, changed and given as `masks`. On all
 * threads, and the same for any number of them.
 *
 *   keys  [key_count] 2 .. OSDTEX_STACK_KEYS_MAX, or 1 with options->vary; they
 *         tile in both axes
 *   out   what was made; NULL not wanted
 *
 * ARGUMENT (options), FORMAT (a picture that does not tile; a mask that is
 * empty, full or of another shape), LIMIT, IO, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_stack_write(
    osdtex_context *context, const osdtex_exemplar *const *keys,
    int32_t key_count, const osdtex_stack_options *options, const char *path,
    osdtex_stack_info *out);

/* Which maps the stack at `path` holds beside its colours: bit k, one of kind
 * k; 0 where it holds none, is no stack or cannot be read. */
OSDTEX_API uint32_t osdtex_stack_maps(const char *path);

OSDTEX_END_DECLS

#endif

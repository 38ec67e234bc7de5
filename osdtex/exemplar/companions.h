/* companions.h -- what else is known of a material, texel by texel.
 *
 * The maps of a set lie on the picture of an exemplar: what is done to its
 * texels is done to them. They are data, which no colour is made of. All are
 * interleaved in one image, so that a lookup finds all of them. See
 * docs/notes/materials.md. */
#ifndef OTX_EXEMPLAR_COMPANIONS_H
#define OTX_EXEMPLAR_COMPANIONS_H

#include "image/image.h"

#include <math.h>

typedef enum otx_companion_kind
{
    OTX_COMPANION_NORMAL,
    OTX_COMPANION_ROUGHNESS,
    OTX_COMPANION_HEIGHT,
    OTX_COMPANION_METALNESS,
    OTX_COMPANION_OCCLUSION,
    OTX_COMPANION_COUNT
} otx_companion_kind;

enum
{
    OTX_COMPANIONS_CHANNELS = 7 /* at most */
};

/* One map. */
typedef struct otx_companion
{
    bool is_there;
    int32_t first;         /* of its channels in the image: three of a normal */
    const char *path;      /* as given; NULL from memory */
    const char *layer;     /* of an EXR; NULL: as pictures are read */
    const char *hash;      /* of the file's bytes, NULL unknown */
    const char *type;      /* how numbers are stored: "8-bit", "half", ... */
    int32_t channel;       /* of the file's, that it was */
    bool y_down;           /* of normals, as the file has them: DirectX's */
    bool is_inverted;      /* it was 1 less what the file says: gloss */
    int32_t width, height; /* of the file */
} otx_companion;

typedef struct otx_companions
{
    /* As large as the exemplar's `linear`, or larger by a whole factor; no
     * pixels where there is no map. Normals are vectors x, y, z, not always of
     * length 1, y up; all others are numbers as the file has them. */
    otx_image image;
    otx_companion maps[OTX_COMPANION_COUNT];
    /* Heights in scene units are (value - height_middle) times the range: a
     * number of scene units, or where that is 0 OTX_COMPANIONS_RANGE of the
     * exemplar's width. */
    double height_range, height_middle;
    bool written_y_down; /* normals, as DirectX has them */
} otx_companions;

/* Share of the width that heights reach over where nobody says. */
#define OTX_COMPANIONS_RANGE 0.05

/* Scene units of a value: (value - middle) times range. */
typedef struct otx_companion_scale
{
    double range, middle;
} otx_companion_scale;

/*   width  scene units of the whole picture */
static inline otx_companion_scale
otx_companions_scale(const otx_companions *companions, double width)
{
    const double range = companions->height_range;

    return (otx_companion_scale){
        range > 0.0 ? range : OTX_COMPANIONS_RANGE * width,
        companions->height_middle};
}

/* A vector of any length as it is written: of length 1, (n + 1) / 2. */
static inline void
otx_companion_encode_normal(float n[3])
{
    const double sq =
        (double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2];
    const double scale = sq > 0.0 ? 0.5 / sqrt(sq) : 0.0;

    for (int k = 0; k < 3; ++k)
        n[k] = (float)(0.5 + scale * n[k]);
    if (!(sq > 0.0))
        n[2] = 1.0f;
}

/* A decoded file. */
typedef struct otx_companion_input
{
    otx_companion_kind kind;
    otx_image pixels; /* three channels or more */
    bool is_gray;     /* all of them are alike */
    bool is_float;
    int32_t bits;     /* of a stored channel */
    int32_t channel;  /* which one it is; of normals the first of three */
    bool y_down;      /* of normals: DirectX's */
    bool is_inverted; /* 1 less what the file says */
    const char *path, *layer, *hash, *type; /* copied */
} otx_companion_input;

static inline bool
otx_companions_are_there(const otx_companions *companions)
{
    return companions->image.pixels != NULL;
}

/* "normal", "roughness", "height", "metalness", "occlusion". */
const char *otx_companion_name(otx_companion_kind kind);

/* 3 of normals, else 1. */
static inline int32_t
otx_companion_channels(otx_companion_kind kind)
{
    return kind == OTX_COMPANION_NORMAL ? 3 : 1;
}

/* What is written where there is no such map: flat, half rough, no metal. */
void otx_companion_neutral(otx_companion_kind kind, float *values);

/* Interleaves maps of a picture of width x height texels, in run->arena.
 * Smaller ones are interpolated, as lookups would.
 *
 * FORMAT where a size is no whole factor of the picture's, a kind is there
 * twice, or what is called a normal map is none; LIMIT, MEMORY. */
otx_status otx_companions_build(
    otx_run *run, const otx_companion_input *inputs, int32_t count,
    int32_t width, int32_t height, bool wrap_x, bool wrap_y,
    otx_companions *out);

/* What otx_exemplar_crop does to the picture of `width` texels. */
otx_status otx_companions_crop(
    otx_run *run, const otx_companions *from, int32_t width,
    const int32_t rectangle[4], otx_companions *out);

/* What otx_exemplar_rearrange does to the picture of width x height texels. */
otx_status otx_companions_rearrange(
    otx_run *run, const otx_companions *from, int32_t width, int32_t height,
    const int32_t *texels, otx_companions *out);

#endif

/* picture.h -- a picture file as it comes from disk: float pixels, and what
 * the file says about their colours.
 *
 * No colour is converted here. Integers become [0, 1] by division by their
 * maximum; floats are as stored. picture_read.h reads one. See
 * docs/formats-images.md. */
#ifndef OTX_FILE_PICTURE_H
#define OTX_FILE_PICTURE_H

#include "image/image.h"

enum
{
    /* 8192 x 8192: one GiB of RGBA floats. */
    OTX_PICTURE_MAX_PIXELS = 1 << 26,
    OTX_PICTURE_MAX_ICC = 32 << 20 /* bytes; printers' profiles are a few MiB */
};

typedef enum otx_picture_kind
{
    OTX_PICTURE_EXR,
    OTX_PICTURE_PNG,
    OTX_PICTURE_TIFF,
    OTX_PICTURE_JPEG
} otx_picture_kind;

/* Pixel bounds, both ends included, y down as in the file. */
typedef struct otx_picture_window
{
    int32_t x_min, y_min, x_max, y_max;
} otx_picture_window;

typedef struct otx_picture
{
    otx_image image; /* 3 channels (R, G, B), or 4 with A; row 0 at the bottom;
                      * all values finite */
    otx_picture_kind kind;
    bool is_float; /* stored as half, float or double */
    int32_t bits;  /* of a stored channel: 1 to 64 */
    bool has_alpha;
    bool alpha_is_premultiplied; /* EXR, and TIFF that says so */
    bool is_gray;                /* one stored channel, given three times */
    /* Colour metadata found in the file; NULL, false and 0 where absent. */
    const char *interop_id;  /* EXR colorInteropID */
    const char *oiio_space;  /* EXR oiio:ColorSpace */
    const char *tiles;       /* EXR osdtex:tiles, see tile_layout.h */
    bool has_chromaticities; /* EXR, PNG cHRM */
    float chromaticities[8]; /* R, G, B, W as xy pairs */
    bool says_srgb;          /* PNG sRGB chunk */
    bool says_adobe_rgb;     /* Exif of PNG and JPEG */
    float gamma;             /* PNG gAMA, the encoding exponent */
    const uint8_t *icc;      /* PNG, TIFF, JPEG: the profile as it is there */
    size_t icc_bytes;
    const char *icc_fault; /* why it is not, though the file has one */
    /* EXR windows as stored; others: the whole picture, twice. `image` is
     * their intersection. */
    otx_picture_window data_window;
    otx_picture_window display_window;
    const char *layer; /* EXR layer the channels are from, NULL none */
    int32_t part;      /* EXR part, 0 for all others */
} otx_picture;

/* For the readers of one format: keeps a copy of an ICC profile. MEMORY. */
otx_status otx_picture_keep_icc(
    otx_run *run, const uint8_t *bytes, size_t size, otx_picture *out);

/* For the readers of one format: FORMAT or LIMIT unless the size is one that
 * is read. It is what the file claims, in full, so that no cast can hide it. */
otx_status otx_picture_check_size(
    otx_run *run, const char *path, int64_t width, int64_t height);

/* The same, and creates out->image. */
otx_status otx_picture_create(
    otx_run *run, const char *path, int64_t width, int64_t height,
    int32_t channels, otx_picture *out);

/* Row `y_down` counted from the top. */
static inline float *
otx_picture_row(const otx_picture *picture, int32_t y_down)
{
    return otx_image_at(&picture->image, 0, picture->image.height - 1 - y_down);
}

#endif

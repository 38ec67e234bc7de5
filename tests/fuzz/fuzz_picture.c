/* fuzz_picture.c -- PNG, TIFF, JPEG and EXR, as pictures and, where they are
 * small, as exemplars: what is taken has finite pixels. */
#include "fuzz.h"

#include <math.h>

enum
{
    EXEMPLAR_MAX = 64 * 64 /* texels, for the sake of speed */
};

static void
check_image(const osdtex_image_info *info)
{
    const int64_t count = (int64_t)info->width * info->height * info->channels;

    fuzz_check(info->width > 0 && info->height > 0 && info->channels > 0);
    for (int64_t i = 0; i < count; ++i)
        fuzz_check(isfinite(info->pixels[i]));
}

static void
check_exemplar(osdtex_context *context, const char *path)
{
    osdtex_exemplar *exemplar;
    const osdtex_status status =
        osdtex_exemplar_read(context, path, NULL, &exemplar);

    fuzz_judge(context, status, exemplar);
    if (status == OSDTEX_OK)
    {
        const osdtex_exemplar_info *info = osdtex_exemplar_describe(exemplar);
        const int64_t count =
            (int64_t)info->width * info->height * info->channels;

        for (int64_t i = 0; i < count; ++i)
            fuzz_check(isfinite(info->pixels[i]));
    }
    osdtex_exemplar_destroy(exemplar);
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* Colours are configured once: it takes longer than all the rest. */
    static osdtex_context *context;
    const char *path = fuzz_file("picture", data, size);
    osdtex_image *image;
    osdtex_status status;

    if (!context)
        context = fuzz_context();
    osdtex_diagnostic_clear(context);
    status = osdtex_image_read(context, path, &image);
    fuzz_judge(context, status, image);
    if (status == OSDTEX_OK)
    {
        const osdtex_image_info *info = osdtex_image_describe(image);

        check_image(info);
        if ((int64_t)info->width * info->height <= EXEMPLAR_MAX)
            check_exemplar(context, path);
    }
    osdtex_image_destroy(image);
    return 0;
}

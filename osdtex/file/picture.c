/* picture.c -- the rules for pictures of all formats. */
#include "file/picture.h"

#include <string.h>

otx_status
otx_picture_keep_icc(
    otx_run *run, const uint8_t *bytes, size_t size, otx_picture *out)
{
    uint8_t *copy;

    if (size > OTX_PICTURE_MAX_ICC)
    {
        out->icc_fault = "it is larger than 32 MiB";
        return OSDTEX_OK;
    }
    copy = OTX_NEW(run->arena, uint8_t, size > 0 ? size : 1);
    OTX_TRY(otx_run_ok(run));
    memcpy(copy, bytes, size);
    out->icc = copy;
    out->icc_bytes = size;
    return OSDTEX_OK;
}

otx_status
otx_picture_check_size(
    otx_run *run, const char *path, int64_t width, int64_t height)
{
    if (width < 1 || height < 1)
        return otx_fail(
            run, OSDTEX_ERROR_FORMAT, "picture", otx_where_file(path),
            "the picture has no pixels; write it again");
    if (width > OTX_IMAGE_MAX_SIDE || height > OTX_IMAGE_MAX_SIDE ||
        width * height > OTX_PICTURE_MAX_PIXELS)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, "picture", otx_where_file(path),
            "the picture claims %lld x %lld pixels, more than %d a side or %d "
            "million in all; crop it or reduce its size",
            (long long)width, (long long)height, OTX_IMAGE_MAX_SIDE,
            OTX_PICTURE_MAX_PIXELS >> 20);
    return OSDTEX_OK;
}

otx_status
otx_picture_create(
    otx_run *run, const char *path, int64_t width, int64_t height,
    int32_t channels, otx_picture *out)
{
    OTX_TRY(otx_picture_check_size(run, path, width, height));
    return otx_image_create(
        run, run->arena, (int32_t)width, (int32_t)height, channels,
        &out->image);
}

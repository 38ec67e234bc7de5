/* icc_profile.c -- checks first, then Little CMS in a context of its own. */
#include "colour/icc_profile.h"

#include <lcms2.h>
#include <stdio.h>
#include <string.h>

enum
{
    HEADER_BYTES = 128,
    TAG_BYTES = 12,
    TAGS_MAX = 100,               /* that Little CMS reads */
    PROFILE_MAX_BYTES = 32 << 20, /* printers' are a few MiB */
    BLOCK_TEXELS = 1024
};

struct otx_icc_profile
{
    cmsContext context;
    cmsHPROFILE device, xyz;
    cmsHTRANSFORM transform;
    bool is_gray;
    char said[OTX_ICC_REASON_BYTES]; /* by Little CMS: its first error */
};

/* ---- checks ---- */

static uint32_t
number_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 |
           (uint32_t)bytes[2] << 8 | bytes[3];
}

static bool
is_one_of(const uint8_t *bytes, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (memcmp(bytes, words[i], 4) == 0)
            return true;
    return false;
}

/* Every tag lies in the profile, behind the table. */
static bool
tags_are_inside(const uint8_t *bytes, uint32_t size)
{
    const uint32_t count = number_at(bytes + HEADER_BYTES);
    const uint64_t table = HEADER_BYTES + 4 + (uint64_t)count * TAG_BYTES;

    if (count == 0 || count > TAGS_MAX || table > size)
        return false;
    for (uint32_t i = 0; i < count; ++i)
    {
        const uint8_t *tag = bytes + HEADER_BYTES + 4 + (size_t)i * TAG_BYTES;
        const uint64_t at = number_at(tag + 4);
        const uint64_t length = number_at(tag + 8);

        if (at < table || length < 8 || at + length > size)
            return false;
    }
    return true;
}

/* NULL, or why these bytes are not handed to the library. */
static const char *
fault_of(const uint8_t *bytes, size_t size, bool is_gray)
{
    static const char *const classes[] = {"scnr", "mntr", "prtr", "spac"};
    static const char *const spaces[] = {"XYZ ", "Lab "};

    if (size < HEADER_BYTES + 4 || size > PROFILE_MAX_BYTES ||
        number_at(bytes) < HEADER_BYTES + 4 || number_at(bytes) > size)
        return "is cut short, or lies about its size";
    if (memcmp(bytes + 36, "acsp", 4) != 0 ||
        !tags_are_inside(bytes, number_at(bytes)))
        return "is damaged";
    if (!is_one_of(bytes + 12, classes, 4) || !is_one_of(bytes + 20, spaces, 2))
        return "is no profile of a device";
    if (memcmp(bytes + 16, "RGB ", 4) != 0 &&
        !(is_gray && memcmp(bytes + 16, "GRAY", 4) == 0))
        return memcmp(bytes + 16, "CMYK", 4) == 0
                   ? "is for CMYK, which the picture is not"
                   : "is for other channels than the picture has";
    return NULL;
}

/* ---- the library ---- */

/* Little CMS says what is wrong to a function that knows the context only. */
static void
keep_error(cmsContext context, cmsUInt32Number code, const char *text)
{
    otx_icc_profile *p = cmsGetContextUserData(context);

    (void)code;
    if (p && p->said[0] == '\0')
        snprintf(p->said, sizeof p->said, "%s", text);
}

static void
close_profile(void *object)
{
    otx_icc_profile *p = object;

    if (p->transform)
        cmsDeleteTransform(p->transform);
    if (p->xyz)
        cmsCloseProfile(p->xyz);
    if (p->device)
        cmsCloseProfile(p->device);
    if (p->context)
        cmsDeleteContext(p->context);
}

/* What may stand in a log, whatever the file says. */
static void
make_printable(char *text)
{
    for (char *c = text; *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

static bool
open_transform(otx_icc_profile *p)
{
    const cmsUInt32Number from = p->is_gray ? TYPE_GRAY_FLT : TYPE_RGB_FLT;

    p->xyz = cmsCreateXYZProfileTHR(p->context);
    if (!p->xyz)
        return false;
    /* No cache: threads share the transform. No optimisation: it would go by 16
     * bits and clip. */
    p->transform = cmsCreateTransformTHR(
        p->context, p->device, from, p->xyz, TYPE_XYZ_FLT,
        INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE);
    return p->transform != NULL;
}

otx_status
otx_icc_profile_open(
    otx_run *run, const uint8_t *bytes, size_t size, bool is_gray,
    otx_icc_profile **out, char name[OTX_ICC_NAME_BYTES],
    char reason[OTX_ICC_REASON_BYTES])
{
    const char *fault = fault_of(bytes, size, is_gray);
    otx_icc_profile *p;

    *out = NULL;
    name[0] = '\0';
    snprintf(reason, OTX_ICC_REASON_BYTES, "%s", fault ? fault : "");
    if (fault)
        return OSDTEX_OK;
    p = OTX_ZNEW(run->arena, otx_icc_profile, 1);
    if (!p || !otx_arena_defer(run->arena, close_profile, p))
        return otx_fail_memory(run, "colour");
    p->is_gray = memcmp(bytes + 16, "GRAY", 4) == 0;
    p->context = cmsCreateContext(NULL, p);
    if (!p->context)
        return otx_fail_memory(run, "colour");
    cmsSetLogErrorHandlerTHR(p->context, keep_error);
    p->device =
        cmsOpenProfileFromMemTHR(p->context, bytes, (cmsUInt32Number)size);
    if (p->device)
        cmsGetProfileInfoASCII(
            p->device, cmsInfoDescription, "en", "US", name,
            OTX_ICC_NAME_BYTES);
    name[OTX_ICC_NAME_BYTES - 1] = '\0';
    make_printable(name);
    if (p->device && open_transform(p))
        *out = p;
    else
        snprintf(
            reason, OTX_ICC_REASON_BYTES, "is damaged (%.100s)",
            p->said[0] ? p->said : "no reason given");
    make_printable(reason);
    return OSDTEX_OK;
}

void
otx_icc_profile_to_xyz(const otx_icc_profile *p, float *texels, int32_t count)
{
    float block[3 * BLOCK_TEXELS];

    for (int32_t first = 0; first < count; first += BLOCK_TEXELS)
    {
        const int32_t left = count - first;
        const int32_t n = left < BLOCK_TEXELS ? left : BLOCK_TEXELS;
        const int32_t channels = p->is_gray ? 1 : 3;
        float *at = texels + 3 * (size_t)first;

        for (int32_t i = 0; i < n; ++i)
            for (int32_t k = 0; k < channels; ++k)
                block[channels * i + k] = at[3 * i + k];
        cmsDoTransform(p->transform, block, at, (cmsUInt32Number)n);
    }
}

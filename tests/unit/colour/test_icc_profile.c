/* test_icc_profile.c -- profiles mean what Little CMS' own say they mean, and
 * broken ones are refused in words. */
#include "colour/icc_profile.h"
#include "support.h"

#include <lcms2.h>
#include <math.h>

enum
{
    PROFILE_BYTES = 1 << 16,
    GRID = 9
};

typedef struct bytes
{
    uint8_t data[PROFILE_BYTES];
    cmsUInt32Number count;
} bytes;

static void
save(cmsHPROFILE profile, bytes *out)
{
    out->count = PROFILE_BYTES;
    assert_true(cmsSaveProfileToMem(profile, out->data, &out->count));
    cmsCloseProfile(profile);
}

static cmsInt32Number
sample(const cmsUInt16Number in[], cmsUInt16Number out[], void *transform)
{
    cmsDoTransform(transform, in, out, 1);
    return TRUE;
}

/* sRGB by a table of Lab colours, as scanners and printers have them. */
static void
save_table(bytes *out)
{
    cmsHPROFILE srgb = cmsCreate_sRGBProfile();
    cmsHPROFILE lab = cmsCreateLab4Profile(NULL);
    cmsHTRANSFORM transform = cmsCreateTransform(
        srgb, TYPE_RGB_16, lab, TYPE_LabV2_16, INTENT_RELATIVE_COLORIMETRIC, 0);
    cmsHPROFILE profile = cmsCreateProfilePlaceholder(NULL);
    cmsPipeline *pipeline = cmsPipelineAlloc(NULL, 3, 3);
    cmsStage *table = cmsStageAllocCLut16bit(NULL, GRID, 3, 3, NULL);

    assert_true(cmsStageSampleCLut16bit(table, sample, transform, 0));
    assert_true(cmsPipelineInsertStage(pipeline, cmsAT_END, table));
    cmsSetProfileVersion(profile, 2.1);
    cmsSetDeviceClass(profile, cmsSigInputClass);
    cmsSetColorSpace(profile, cmsSigRgbData);
    cmsSetPCS(profile, cmsSigLabData);
    assert_true(cmsWriteTag(profile, cmsSigAToB0Tag, pipeline));
    cmsPipelineFree(pipeline);
    cmsDeleteTransform(transform);
    cmsCloseProfile(srgb);
    cmsCloseProfile(lab);
    save(profile, out);
}

static otx_icc_profile *
open_bytes(
    otx_run *run, const bytes *b, bool is_gray,
    char reason[OTX_ICC_REASON_BYTES])
{
    char name[OTX_ICC_NAME_BYTES];
    otx_icc_profile *profile;

    assert_int_equal(
        otx_icc_profile_open(
            run, b->data, b->count, is_gray, &profile, name, reason),
        OSDTEX_OK);
    return profile;
}

/* XYZ of sRGB under D50: white, and the red that every table of it has. */
static void
expect_srgb(const otx_icc_profile *profile, float tolerance)
{
    float texels[6] = {1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F};
    static const float wanted[6] = {
        0.9642F, 1.0F, 0.8249F, 0.4361F, 0.2225F, 0.0139F};

    otx_icc_profile_to_xyz(profile, texels, 2);
    for (int i = 0; i < 6; ++i)
        if (!(fabsf(texels[i] - wanted[i]) < tolerance))
            fail_msg("%d: %g is not %g", i, texels[i], wanted[i]);
}

static void
matrices_and_tables_mean_the_same(void **state)
{
    char reason[OTX_ICC_REASON_BYTES];
    otx_run *run = test_run_create();
    bytes *b = OTX_NEW(run->arena, bytes, 1);
    (void)state;

    save(cmsCreate_sRGBProfile(), b);
    expect_srgb(open_bytes(run, b, false, reason), 1e-3F);
    save_table(b);
    expect_srgb(open_bytes(run, b, false, reason), 5e-3F);
    test_run_destroy(run);
}

static void
grey_is_for_grey(void **state)
{
    const cmsCIExyY d50 = {0.3457, 0.3585, 1.0};
    cmsToneCurve *curve = cmsBuildGamma(NULL, 2.0);
    char reason[OTX_ICC_REASON_BYTES];
    float texel[3] = {0.5F, 0.5F, 0.5F};
    otx_run *run = test_run_create();
    bytes *b = OTX_NEW(run->arena, bytes, 1);
    (void)state;

    save(cmsCreateGrayProfile(&d50, curve), b);
    cmsFreeToneCurve(curve);
    assert_null(open_bytes(run, b, false, reason));
    assert_non_null(strstr(reason, "other channels"));
    otx_icc_profile_to_xyz(open_bytes(run, b, true, reason), texel, 1);
    assert_true(fabsf(texel[1] - 0.25F) < 1e-3F);
    test_run_destroy(run);
}

/* Whatever a byte becomes, a profile opens or is refused in words; what opens
 * can be used. Sanitizers and Valgrind look on. */
static void
damage_is_refused_in_words(void **state)
{
    bytes *b[2], *broken;
    otx_run *keep = test_run_create();
    (void)state;

    broken = OTX_ZNEW(keep->arena, bytes, 1);
    for (int k = 0; k < 2; ++k)
        b[k] = OTX_ZNEW(keep->arena, bytes, 1);
    save(cmsCreate_sRGBProfile(), b[0]);
    save_table(b[1]);
    for (uint32_t i = 0; i < 3000; ++i)
    {
        const bytes *from = b[i % 2];
        const uint32_t random = (i * 2654435761U) >> 8;
        const uint32_t header = i % 3 ? 512 : from->count;
        char reason[OTX_ICC_REASON_BYTES];
        float texel[3] = {0.2F, 0.4F, 0.6F};
        otx_run *run = test_run_create();
        otx_icc_profile *profile;

        memcpy(broken, from, sizeof *broken);
        for (uint32_t n = 0; n <= i % 4; ++n)
            broken->data[(random + n * 7919) % header] =
                (uint8_t)(random >> (n * 5));
        if (i % 5 == 0)
            broken->count = random % (from->count + 1);
        profile = open_bytes(run, broken, i % 7 == 0, reason);
        if (profile)
            otx_icc_profile_to_xyz(profile, texel, 1);
        else
            assert_true(reason[0] != '\0');
        test_run_destroy(run);
    }
    test_run_destroy(keep);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrices_and_tables_mean_the_same),
        cmocka_unit_test(grey_is_for_grey),
        cmocka_unit_test(damage_is_refused_in_words),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_primaries.c -- matrices of RGB spaces. */
#include "colour/primaries.h"
#include "support.h"

#include <math.h>

static const float rec709[8] = {
    0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
static const float ap0[8] = {
    0.7347F, 0.2653F, 0.0F, 1.0F, 0.0001F, -0.0770F, 0.32168F, 0.33767F};

/* Published Bradford matrix of linear Rec.709 to ACES2065-1. */
static void
test_rec709(void **state)
{
    static const otx_primaries_matrix known = {
        {{0.4396328, 0.3829887, 0.1773785},
         {0.0897764, 0.8134395, 0.0967841},
         {0.0175412, 0.1115465, 0.8709123}}};
    otx_primaries_matrix m;
    (void)state;

    assert_true(otx_primaries_to_aces(rec709, &m));
    assert_true(otx_primaries_difference(m, known) < 2e-5);
}

static void
test_aces_is_identity(void **state)
{
    static const otx_primaries_matrix one = {
        {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    otx_primaries_matrix m;
    float xy[8];
    (void)state;

    assert_true(otx_primaries_to_aces(ap0, &m));
    assert_true(otx_primaries_difference(m, one) < 1e-6);
    assert_true(otx_primaries_from_aces(&m, xy));
    for (int i = 0; i < 8; ++i)
        assert_true(fabsf(xy[i] - ap0[i]) < 1e-5F);
}

/* Chromaticities after adaptation are another description of the same. */
static void
test_round_trip(void **state)
{
    otx_primaries_matrix a;
    otx_primaries_matrix b;
    float xy[8];
    (void)state;

    assert_true(otx_primaries_to_aces(rec709, &a));
    assert_true(otx_primaries_from_aces(&a, xy));
    assert_true(otx_primaries_to_aces(xy, &b));
    assert_true(otx_primaries_difference(a, b) < 1e-5);
}

static void
test_nonsense(void **state)
{
    static const float bad[][8] = {
        {0},
        {0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F, 0.3F},
        {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3F, 0.0F},
        {NAN, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3F, 0.3F},
        {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, NAN, NAN},
    };
    otx_primaries_matrix m;
    (void)state;

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        assert_false(otx_primaries_to_aces(bad[i], &m));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rec709),
        cmocka_unit_test(test_aces_is_identity),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_nonsense),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

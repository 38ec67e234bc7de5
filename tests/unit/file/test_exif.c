/* test_exif.c -- the orientation in both byte orders, and damage. */
#include "file/exif.h"
#include "support.h"

#include <string.h>

/* Two entries: a width, and the orientation. */
static const uint8_t LITTLE[] = {
    'I',  'I',  42, 0, 8, 0, 0, 0, 2,  0,                  /* header, count */
    0x00, 0x01, 3,  0, 1, 0, 0, 0, 40, 0, 0, 0,            /* width */
    0x12, 0x01, 3,  0, 1, 0, 0, 0, 6,  0, 0, 0, 0, 0, 0, 0 /* orientation */
};
static const uint8_t BIG[] = {
    'M',  'M',  0, 42, 0, 0, 0, 8, 0, 1,                  /* header, count */
    0x01, 0x12, 0, 3,  0, 0, 0, 1, 0, 8, 0, 0, 0, 0, 0, 0 /* orientation */
};

static void
both_orders_are_read(void **state)
{
    (void)state;
    assert_int_equal(otx_exif_orientation(LITTLE, sizeof LITTLE), 6);
    assert_int_equal(otx_exif_orientation(BIG, sizeof BIG), 8);
}

static void
damage_says_nothing(void **state)
{
    uint8_t bytes[sizeof LITTLE];

    (void)state;
    /* A copy of each length, so that a sanitizer sees what is read. */
    for (size_t length = 0; length < sizeof LITTLE; ++length)
    {
        uint8_t *prefix = malloc(length + 1);
        int32_t found;

        memcpy(prefix, LITTLE, length);
        found = otx_exif_orientation(prefix, length);
        assert_true(found == 1 || (found == 6 && length >= 32));
        free(prefix);
    }
    for (size_t at = 0; at < sizeof LITTLE; ++at)
        for (int value = 0; value < 256; ++value)
        {
            int32_t found;

            memcpy(bytes, LITTLE, sizeof bytes);
            bytes[at] = (uint8_t)value;
            found = otx_exif_orientation(bytes, sizeof bytes);
            assert_true(found >= 1 && found <= 8);
        }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_orders_are_read),
        cmocka_unit_test(damage_says_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* few_values.c -- each value of a row once. */
#include "colour/few_values.h"

#include <string.h>

enum
{
    VALUES = 256
};

/* The values of a row, each in the place of the integer nearest to it. */
typedef struct table
{
    bool is_there[VALUES];
    float values[VALUES];
    float texels[VALUES * 3]; /* each in all channels */
} table;

/* The place of a value; -1 beyond 0 to 1, and of NaN. */
static inline int32_t
place_of(float value)
{
    return value >= 0.0f && value <= 1.0f
               ? (int32_t)(value * (float)(VALUES - 1) + 0.5f)
               : -1;
}

/* False where two values have one place, of which one is no integer of 8 bits,
 * or where one has none. */
static bool
list_values(const float *pixels, int64_t count, int32_t channels, table *out)
{
    memset(out, 0, sizeof *out);
    for (int64_t i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c)
        {
            const float value = pixels[i * channels + c];
            const int32_t place = place_of(value);

            if (place < 0 ||
                (out->is_there[place] &&
                 memcmp(&out->values[place], &value, sizeof value) != 0))
                return false;
            out->is_there[place] = true;
            out->values[place] = value;
        }
    for (int32_t i = 0; i < VALUES; ++i)
        for (int c = 0; c < 3; ++c)
            out->texels[3 * i + c] = out->values[i];
    return true;
}

otx_status
otx_few_values_apply(
    const otx_ocio_conversion *conversion, float *pixels, int64_t count,
    int32_t channels, char *message)
{
    table t;

    if (!list_values(pixels, count, channels, &t))
        return otx_ocio_conversion_apply(
            conversion, pixels, count, channels, message);
    OTX_TRY(
        otx_ocio_conversion_apply(conversion, t.texels, VALUES, 3, message));
    for (int64_t i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c)
        {
            float *value = &pixels[i * channels + c];

            *value = t.texels[3 * place_of(*value) + c];
        }
    return OSDTEX_OK;
}

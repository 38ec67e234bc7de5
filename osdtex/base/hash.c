/* hash.c -- XXH3-128 of the xxhash library, printed in canonical order. */
#include "base/hash.h"

#include <xxhash.h>

void
otx_hash_text(const void *data, size_t bytes, char text[OTX_HASH_TEXT_BYTES])
{
    static const char digits[] = "0123456789abcdef";
    XXH128_canonical_t canonical;

    XXH128_canonicalFromHash(&canonical, XXH3_128bits(data, bytes));
    for (int i = 0; i < 16; ++i)
    {
        text[2 * i] = digits[canonical.digest[i] >> 4];
        text[2 * i + 1] = digits[canonical.digest[i] & 15];
    }
    text[32] = '\0';
}

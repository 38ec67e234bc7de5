/* hash.c -- XXH3-128 of the xxhash library, printed in canonical order. */
#include "base/hash.h"

#include <stdio.h>
#include <sys/stat.h>
#include <xxhash.h>

static void
print(XXH128_hash_t hash, char text[OTX_HASH_TEXT_BYTES])
{
    static const char digits[] = "0123456789abcdef";
    XXH128_canonical_t canonical;

    XXH128_canonicalFromHash(&canonical, hash);
    for (int i = 0; i < 16; ++i)
    {
        text[2 * i] = digits[canonical.digest[i] >> 4];
        text[2 * i + 1] = digits[canonical.digest[i] & 15];
    }
    text[32] = '\0';
}

void
otx_hash_text(const void *data, size_t bytes, char text[OTX_HASH_TEXT_BYTES])
{
    print(XXH3_128bits(data, bytes), text);
}

static bool
hash_stream(FILE *file, XXH3_state_t *state, char text[OTX_HASH_TEXT_BYTES])
{
    char buffer[16384];
    size_t bytes;

    XXH3_128bits_reset(state);
    while ((bytes = fread(buffer, 1, sizeof buffer, file)) > 0)
        XXH3_128bits_update(state, buffer, bytes);
    if (ferror(file))
        return false;
    print(XXH3_128bits_digest(state), text);
    return true;
}

bool
otx_hash_file(const char *path, char text[OTX_HASH_TEXT_BYTES])
{
    struct stat status;
    XXH3_state_t *state;
    FILE *file;
    bool done = false;

    text[0] = '\0';
    /* A pipe would keep us waiting for a second writer. */
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode))
        return false;
    file = fopen(path, "rb");
    if (!file)
        return false;
    state = XXH3_createState();
    if (state)
        done = hash_stream(file, state, text);
    XXH3_freeState(state);
    fclose(file);
    return done;
}

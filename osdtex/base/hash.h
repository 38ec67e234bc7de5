/* hash.h -- content hashes for reports and for "is it up to date" tests. */
#ifndef OTX_BASE_HASH_H
#define OTX_BASE_HASH_H

#include <stdbool.h>
#include <stddef.h>

enum
{
    OTX_HASH_TEXT_BYTES = 33 /* 128 bits in hexadecimal, and the NUL */
};

/* XXH3-128 of `bytes` bytes as lower-case hexadecimal. */
void
otx_hash_text(const void *data, size_t bytes, char text[OTX_HASH_TEXT_BYTES]);

/* The same of a whole file, read in pieces. False when `path` is no plain file
 * or cannot be read: then `text` is "". */
bool otx_hash_file(const char *path, char text[OTX_HASH_TEXT_BYTES]);

/* Slots of a table for so many items: a power of two that leaves it at most
 * half full. */
static inline size_t
otx_hash_table_size(size_t count)
{
    size_t size = 16;

    while (size < 2 * count)
        size *= 2;
    return size;
}

#endif

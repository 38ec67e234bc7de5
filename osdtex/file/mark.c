/* mark.c -- writing marks, sealing files, finding both again. */
#include "file/mark.h"

#include <errno.h>
#include <fcntl.h>
#include <libdeflate.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

enum
{
    DIGITS = OTX_HASH_TEXT_BYTES - 1,
    CHECKSUM_BYTES = 4,
    HEAD_BYTES = 1 << 18, /* of a file, where its mark is */
    PIECE_BYTES = 1 << 16
};

static const char OPENING[] = "osdtex ";
static const char JOB[] = "job ";
static const char OF[] = "of ";
static const char SEAL[] = "seal ";
static const char ZEROS[] = "00000000000000000000000000000000";

static bool
is_plain(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
}

void
otx_mark_set_source(otx_mark *mark, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const size_t room = OTX_MARK_SOURCE_BYTES - 10; /* and "_", eight digits */
    bool changed = strlen(name) > room;
    char hash[OTX_HASH_TEXT_BYTES];
    char *to = mark->source;

    for (size_t i = 0; name[i] && i < room; ++i)
    {
        const bool fits =
            is_plain(name[i]) && !(name[i] == '-' && i > 0 && to[-1] == '-');

        *to++ = fits ? name[i] : '_';
        changed |= !fits;
    }
    otx_hash_text(name, strlen(name), hash);
    *to = '\0';
    if (changed)
        sprintf(to, "_%.8s", hash);
}

void
otx_mark_print(const otx_mark *mark, char text[OTX_MARK_BYTES])
{
    text[0] = '\0';
    if (!mark)
        return;
    snprintf(
        text, OTX_MARK_BYTES, "%s%s%s%s%s%s%s%s%s", OPENING,
        mark->job[0] ? JOB : "", mark->job, mark->job[0] ? " " : "",
        mark->source[0] ? OF : "", mark->source, mark->source[0] ? " " : "",
        SEAL, ZEROS);
}

/* ---- finding --------------------------------------------------------------
 */

static bool
is_hash(const char *text, const char *end)
{
    return end - text >= DIGITS && strspn(text, "0123456789abcdef") >= DIGITS;
}

/* Takes a mark apart that begins at `text`; false when it is none. Sets *seal
 * to where the digits of its seal are, NULL none. */
static bool
parse(const char *text, const char *end, otx_mark *mark, const char **seal)
{
    *mark = (otx_mark){0};
    *seal = NULL;
    text += strlen(OPENING);
    if (strncmp(text, JOB, strlen(JOB)) == 0)
    {
        text += strlen(JOB);
        if (!is_hash(text, end))
            return false;
        memcpy(mark->job, text, DIGITS);
        text += DIGITS;
        text += *text == ' ';
    }
    if (strncmp(text, OF, strlen(OF)) == 0)
    {
        const char *name = text + strlen(OF);
        size_t length = 0;

        while (is_plain(name[length]))
            ++length;
        if (length == 0 || length >= OTX_MARK_SOURCE_BYTES)
            return false;
        memcpy(mark->source, name, length);
        text = name + length;
        text += *text == ' ';
    }
    if (strncmp(text, SEAL, strlen(SEAL)) == 0 &&
        is_hash(text + strlen(SEAL), end))
        *seal = text + strlen(SEAL);
    return mark->job[0] || *seal;
}

/* The mark in the head of a file, whose seal stands at byte *at (0: none). */
static bool
find(int fd, otx_mark *mark, off_t *at)
{
    char *head = malloc(HEAD_BYTES + 1);
    const ssize_t size = head ? pread(fd, head, HEAD_BYTES, 0) : -1;
    const char *end = head + (size > 0 ? size : 0), *seal = NULL;
    const char *found = head;
    bool known = false;

    *at = 0;
    if (size > 0)
        head[size] = '\0';
    while (size > 0 && !known &&
           (found =
                memmem(found, (size_t)(end - found), OPENING, strlen(OPENING))))
    {
        known = parse(found, end, mark, &seal);
        found += strlen(OPENING);
    }
    if (known && seal)
        *at = seal - head;
    free(head);
    return known;
}

/* A PNG has checksums: that of the chunk with the mark follows the seal. */
static bool
is_png(int fd)
{
    char head[4];

    return pread(fd, head, sizeof head, 0) == sizeof head &&
           memcmp(head, "\x89PNG", sizeof head) == 0;
}

/* Zeros for the part of a piece that is in the seal, `length` bytes. */
static void
blank(char *piece, off_t first, size_t bytes, off_t seal, int length)
{
    for (off_t i = seal; i < seal + length; ++i)
        if (i >= first && i < first + (off_t)bytes)
            piece[i - first] = '0';
}

/* Sets the checksum of the chunk that ends with the seal at `seal`. */
static bool
mend_png(int fd, off_t seal)
{
    uint8_t head[8], chunk[2 * OTX_MARK_BYTES], sum[CHECKSUM_BYTES];
    uint32_t length, crc;

    for (off_t at = 8; at < seal; at += 12 + (off_t)length)
    {
        if (pread(fd, head, sizeof head, at) != sizeof head)
            return false;
        length = (uint32_t)head[0] << 24 | (uint32_t)head[1] << 16 |
                 (uint32_t)head[2] << 8 | head[3];
        if (at + 8 + (off_t)length != seal + DIGITS)
            continue;
        if (length + 4 > sizeof chunk ||
            pread(fd, chunk, length + 4, at + 4) != (ssize_t)length + 4)
            return false;
        crc = libdeflate_crc32(0, chunk, length + 4);
        for (int i = 0; i < CHECKSUM_BYTES; ++i)
            sum[i] = (uint8_t)(crc >> (24 - 8 * i));
        return pwrite(fd, sum, CHECKSUM_BYTES, seal + DIGITS) == CHECKSUM_BYTES;
    }
    return false;
}

/* The hash of a file with zeros in its seal. */
static int
hash_unsealed(int fd, off_t seal, char text[OTX_HASH_TEXT_BYTES])
{
    XXH3_state_t *state = XXH3_createState();
    char *piece = malloc(PIECE_BYTES);
    const int length = DIGITS + (is_png(fd) ? CHECKSUM_BYTES : 0);
    XXH128_canonical_t digest;
    ssize_t bytes = 0;
    int error = state && piece ? 0 : ENOMEM;

    if (error == 0)
        XXH3_128bits_reset(state);
    for (off_t at = 0; error == 0; at += bytes)
    {
        bytes = pread(fd, piece, PIECE_BYTES, at);
        if (bytes <= 0)
            break;
        blank(piece, at, (size_t)bytes, seal, length);
        XXH3_128bits_update(state, piece, (size_t)bytes);
    }
    if (bytes < 0)
        error = errno;
    if (error == 0)
    {
        XXH128_canonicalFromHash(&digest, XXH3_128bits_digest(state));
        for (int i = 0; i < 16; ++i)
            sprintf(text + 2 * i, "%02x", digest.digest[i]);
    }
    XXH3_freeState(state);
    free(piece);
    return error;
}

int
otx_mark_seal(const char *path)
{
    const int fd = open(path, O_RDWR | O_CLOEXEC);
    char text[OTX_HASH_TEXT_BYTES];
    otx_mark mark;
    off_t seal;
    int error = 0;

    if (fd < 0)
        return errno;
    if (find(fd, &mark, &seal) && seal > 0)
    {
        error = hash_unsealed(fd, seal, text);
        errno = 0;
        if (error == 0 && pwrite(fd, text, DIGITS, seal) != DIGITS)
            error = errno ? errno : ENOSPC;
        if (error == 0 && is_png(fd) && !mend_png(fd, seal))
            error = EIO;
    }
    if (close(fd) != 0 && error == 0)
        error = errno;
    return error;
}

bool
otx_mark_read(const char *path, bool check_seal, otx_mark_found *out)
{
    char now[OTX_HASH_TEXT_BYTES], then[DIGITS];
    struct stat info;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    off_t seal = 0;
    bool found;

    *out = (otx_mark_found){0};
    found = fd >= 0 && fstat(fd, &info) == 0 && S_ISREG(info.st_mode) &&
            find(fd, &out->mark, &seal);
    out->has_seal = seal > 0;
    if (out->has_seal && check_seal)
        out->is_whole = hash_unsealed(fd, seal, now) == 0 &&
                        pread(fd, then, DIGITS, seal) == DIGITS &&
                        memcmp(now, then, DIGITS) == 0;
    if (fd >= 0)
        close(fd);
    return found;
}

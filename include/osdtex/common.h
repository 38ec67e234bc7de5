/* common.h -- what all headers share: statuses, elements of a mesh, hashes.
 *
 *     osdtex_status status = osdtex_cage_read(context, path, NULL, &cage);
 *
 *     if (status != OSDTEX_OK)
 *         fprintf(stderr, "%s: %s\n", osdtex_status_name(status),
 *                 osdtex_context_error(context)->message);
 *
 * A status says whose fault it is, which is what a program decides by; what to
 * do about it is in the sentence of the context, for people. Nothing here needs
 * a context, allocates, or fails; all of it may be called from any thread. */
#ifndef OSDTEX_COMMON_H
#define OSDTEX_COMMON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) || !defined(__GNUC__)
#define OSDTEX_API
#else
#define OSDTEX_API __attribute__((visibility("default")))
#endif

/* What C and C++ write differently: linkage, and a struct of zeros without a
 * warning. */
/* clang-format off */
#ifdef __cplusplus
#define OSDTEX_BEGIN_DECLS extern "C" {
#define OSDTEX_END_DECLS }
#define OSDTEX_ZERO {}
#else
#define OSDTEX_BEGIN_DECLS
#define OSDTEX_END_DECLS
#define OSDTEX_ZERO {0}
#endif
/* clang-format on */

OSDTEX_BEGIN_DECLS

/* Elements of a mesh: vertices, faces, corners. -1 means none. */
typedef int32_t osdtex_index;

/* 0 is success; failures are negative and named by whose fault they are. */
typedef int32_t osdtex_status;
enum
{
    OSDTEX_OK = 0,
    OSDTEX_ERROR_ARGUMENT = -1,  /* the caller's */
    OSDTEX_ERROR_FORMAT = -2,    /* the file's bytes */
    OSDTEX_ERROR_TOPOLOGY = -3,  /* the file's mesh */
    OSDTEX_ERROR_LIMIT = -4,     /* a stated limit would be exceeded */
    OSDTEX_ERROR_NUMERIC = -5,   /* a value is not finite, a solve failed */
    OSDTEX_ERROR_IO = -6,        /* open, read, write, rename, disk full */
    OSDTEX_ERROR_MEMORY = -7,    /* an allocation failed */
    OSDTEX_ERROR_CANCELLED = -8, /* the progress callback said stop */
    OSDTEX_ERROR_SUPPORT = -9,   /* valid, and not supported */
    OSDTEX_ERROR_COLOUR = -10,   /* the colour configuration's */
    OSDTEX_ERROR_INTERNAL = -11  /* ours: a check of osdtex's own failed */
};

/* "OK", "ARGUMENT", …; "UNKNOWN" for a code that is none of ours. Static. */
OSDTEX_API const char *osdtex_status_name(osdtex_status status);

enum
{
    OSDTEX_HASH_BYTES = 33 /* 128 bits in hexadecimal, and the NUL */
};

/* Hash of `bytes` bytes, as reports give it for files (XXH3-128).
 *
 *   data  [bytes]; NULL where bytes is 0
 *   text  gets hexadecimal digits and a NUL */
OSDTEX_API void
osdtex_hash(const void *data, size_t bytes, char text[OSDTEX_HASH_BYTES]);

OSDTEX_END_DECLS

#endif

/* osdtex.h -- texture subdivision surfaces from an exemplar image.
 *
 * The pipe, one call a stage:
 *
 *     osdtex_cage_read      the artist's cage, validated
 *     osdtex_surface_refine its subdivision hierarchy down to the limit
 *     osdtex_exemplar_read  the picture of a material, colours resolved
 *     osdtex_map            a mapping: UVs into the exemplar for every face
 *     osdtex_mapping_write  OBJ + MTL + EXR that load in the DCC
 *     osdtex_render         a picture of the result
 *
 * Every call that can fail returns an osdtex_status; on failure *out is NULL,
 * the inputs are untouched, and the context holds diagnostics addressed to the
 * person who owns the file. Handles are immutable once returned; a context
 * serves one thread of control at a time. `*_create`, `*_read`, `*_refine` and
 * `osdtex_map` return handles that the caller destroys; getters borrow.
 *
 * Conventions: UV (0,0) is the lower-left corner of the picture, v up.
 * Positions are in scene units and are never rescaled. Angles are in radians.
 */
#ifndef OSDTEX_OSDTEX_H
#define OSDTEX_OSDTEX_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) || !defined(__GNUC__)
#define OSDTEX_API
#else
#define OSDTEX_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C"
{
#endif

#define OSDTEX_VERSION_MAJOR 0
#define OSDTEX_VERSION_MINOR 1
#define OSDTEX_VERSION_PATCH 0

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
        OSDTEX_ERROR_COLOUR = -10    /* the colour configuration's */
    };

    typedef int32_t osdtex_severity;
    enum
    {
        OSDTEX_SEVERITY_INFO = 0, /* a decision the user may want to know */
        OSDTEX_SEVERITY_WARNING = 1,
        OSDTEX_SEVERITY_ERROR = 2
    };

    /* One finding. Like findings are folded: `count` says how many, the place
     * is that of the first. Strings live as long as the context. */
    typedef struct osdtex_diagnostic
    {
        osdtex_severity severity;
        osdtex_status status; /* OSDTEX_OK unless severity is ERROR */
        const char *stage;    /* "cage", "colour", "map", … */
        const char *file;     /* NULL where no file is concerned */
        int64_t line;         /* 1-based, 0 none */
        osdtex_index face;    /* 0-based, -1 none */
        osdtex_index vertex;  /* 0-based, -1 none */
        int64_t count;        /* 1 or more */
        const char *message;  /* one sentence */
    } osdtex_diagnostic;

    typedef struct osdtex_context osdtex_context;
    typedef struct osdtex_cage osdtex_cage;
    typedef struct osdtex_surface osdtex_surface;
    typedef struct osdtex_exemplar osdtex_exemplar;
    typedef struct osdtex_mapping osdtex_mapping;
    typedef struct osdtex_image osdtex_image;

#ifdef __cplusplus
}
#endif
#endif

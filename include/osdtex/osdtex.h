/* osdtex.h -- texture subdivision surfaces from an exemplar image.
 *
 * The pipe, one call a stage:
 *
 *     osdtex_cage_read      the artist's cage, validated
 *     osdtex_surface_refine its subdivision hierarchy down to the limit
 *     osdtex_exemplar_read  the picture of a material, colours resolved
 *     osdtex_map            a mapping: UVs into the exemplar for every face
 *     osdtex_mapping_write  OBJ + MTL + EXR that load in the DCC
 *     osdtex_bake           the cage with textures on its UVs
 *     osdtex_render         a picture of the result
 *
 * Every call that can fail returns an osdtex_status; on failure *out is NULL,
 * the inputs are untouched, and the context holds diagnostics addressed to the
 * person who owns the file. Handles are immutable once returned; a context
 * serves one thread of control at a time. `*_create`, `*_read`, `*_refine`,
 * `osdtex_map` and `osdtex_render` return handles that the caller destroys;
 * `*_describe` lends what lives as long as the handle.
 *
 * A handle borrows those it was made from (a surface its cage, a mapping its
 * surface and exemplar, a model its mapping): destroy it before them, and the
 * context last. Destroying NULL is fine.
 *
 * Structs that open with `size` may grow at their end in later versions; get
 * one from its `*_default` or `*_none` function, which sets `size`. Structs
 * that a `*_describe` lends may grow too; all others are final. NULL for
 * options means the defaults.
 *
 * Conventions: UV (0,0) is the lower-left corner of the picture, v up.
 * Positions are in scene units and are never rescaled. Angles are in radians.
 */
#ifndef OSDTEX_OSDTEX_H
#define OSDTEX_OSDTEX_H

#include <stdbool.h>
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
     * is that of the first. Strings live until osdtex_diagnostic_clear or the
     * end of the context. */
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
    typedef struct osdtex_model osdtex_model;
    typedef struct osdtex_field osdtex_field;
    typedef struct osdtex_image osdtex_image;

    /* "0.1.0", of the library that is running. */
    OSDTEX_API const char *osdtex_version(void);

    /* "OK", "ARGUMENT", …; "UNKNOWN" for a code that is none of ours. */
    OSDTEX_API const char *osdtex_status_name(osdtex_status status);

    enum
    {
        OSDTEX_HASH_BYTES = 33 /* 128 bits in hexadecimal, and the NUL */
    };

    /* Hash of `bytes` bytes, as reports give it for files (XXH3-128). */
    OSDTEX_API void
    osdtex_hash(const void *data, size_t bytes, char text[OSDTEX_HASH_BYTES]);

    /* ------------------------------------------------------------------ */
    /* Context: memory, threads, colour, and where findings go.            */

    typedef struct osdtex_context_options
    {
        size_t size;
        /* Allocation hooks, called from several threads. `alloc` returns NULL
         * on failure, `release` gets the size back. NULL: malloc and free. */
        void *(*alloc)(void *user, size_t bytes);
        void (*release)(void *user, void *block, size_t bytes);
        void *alloc_user;
        size_t memory_limit; /* bytes, 0 none */
        /* Says how far `stage` has come, in [0, 1]; false cancels. Called from
         * the thread that made the call. NULL none. */
        bool (*progress)(void *user, const char *stage, double fraction);
        void *progress_user;
        /* Called for each new finding, not for its repeats. NULL none. */
        void (*log)(void *user, const osdtex_diagnostic *finding);
        void *log_user;
        /* OpenColorIO configuration file; NULL: $OCIO, else the one built in.
         * Opened when the first colour is met. */
        const char *colorconfig;
        int32_t threads; /* 0: the cores of the machine */
        int32_t reserved;
    } osdtex_context_options;

    static inline osdtex_context_options osdtex_context_options_default(void)
    {
        osdtex_context_options options = {
            sizeof(osdtex_context_options),
            NULL,
            NULL,
            NULL,
            0,
            NULL,
            NULL,
            NULL,
            NULL,
            NULL,
            0,
            0};

        return options;
    }

    /* ARGUMENT (threads below 0 or above 256), MEMORY. */
    OSDTEX_API osdtex_status osdtex_context_create(
        const osdtex_context_options *options, osdtex_context **out);
    OSDTEX_API void osdtex_context_destroy(osdtex_context *context);

    /* Findings in the order of their first occurrence. */
    OSDTEX_API int32_t osdtex_diagnostic_count(const osdtex_context *context);
    /* ARGUMENT when there is no finding `index`. */
    OSDTEX_API osdtex_status osdtex_diagnostic_get(
        const osdtex_context *context, int32_t index, osdtex_diagnostic *out);
    /* Forgets all findings: like ones are folded until then. MEMORY. */
    OSDTEX_API osdtex_status osdtex_diagnostic_clear(osdtex_context *context);

    /* ------------------------------------------------------------------ */
    /* Cage: the artist's control mesh, validated.                         */

    typedef int32_t osdtex_scheme;
    enum
    {
        OSDTEX_SCHEME_CATMARK = 0,
        OSDTEX_SCHEME_LOOP = 1, /* triangles only */
        OSDTEX_SCHEME_BILINEAR = 2,
        OSDTEX_SCHEME_NONE = 3 /* a plain mesh of triangles or polygons: its
                                * own vertices and faces get UVs, positions
                                * stay as they are; the level is 0 */
    };

    /* What the file's tag says, else USD's default. */
    enum
    {
        OSDTEX_UNSET = -1
    };

    /* What happens at the rim, in USD's words. */
    typedef int32_t osdtex_boundary;
    enum
    {
        OSDTEX_BOUNDARY_NONE = 0,
        OSDTEX_BOUNDARY_EDGE_ONLY = 1,
        OSDTEX_BOUNDARY_EDGE_AND_CORNER = 2 /* USD's default */
    };

    /* How the cage's UVs are smoothed, in USD's words. */
    typedef int32_t osdtex_fvar;
    enum
    {
        OSDTEX_FVAR_NONE = 0,
        OSDTEX_FVAR_CORNERS_ONLY = 1,
        OSDTEX_FVAR_CORNERS_PLUS1 = 2, /* USD's default */
        OSDTEX_FVAR_CORNERS_PLUS2 = 3,
        OSDTEX_FVAR_BOUNDARIES = 4,
        OSDTEX_FVAR_ALL = 5
    };

    typedef struct osdtex_cage_options
    {
        size_t size;
        osdtex_scheme scheme;
        osdtex_boundary boundary; /* OSDTEX_UNSET: the file's */
        osdtex_fvar fvar;         /* OSDTEX_UNSET: the file's */
        int32_t reserved;
    } osdtex_cage_options;

    static inline osdtex_cage_options osdtex_cage_options_default(void)
    {
        osdtex_cage_options options = {
            sizeof(osdtex_cage_options), OSDTEX_SCHEME_CATMARK, OSDTEX_UNSET,
            OSDTEX_UNSET, 0};

        return options;
    }

    /* A cage as arrays. They are copied. */
    typedef struct osdtex_cage_arrays
    {
        size_t size;
        osdtex_index vert_count;
        osdtex_index face_count;
        const float *points;            /* [vert_count * 3], scene units */
        const osdtex_index *face_sizes; /* [face_count], 3 or more */
        const osdtex_index *face_verts; /* [sum of face_sizes], 0-based,
                                         * counter-clockwise outside */
        osdtex_index uv_count;
        osdtex_index crease_count;
        const float *uvs;                 /* [uv_count * 2]; NULL none */
        const osdtex_index *face_uvs;     /* [sum of face_sizes]; NULL none */
        const osdtex_index *crease_verts; /* [crease_count * 2] */
        const float *crease_sharpness;    /* [crease_count], 10 is infinite */
        osdtex_index corner_count;
        osdtex_index hole_count;
        const osdtex_index *corner_verts; /* [corner_count] */
        const float *corner_sharpness;    /* [corner_count] */
        const osdtex_index *hole_faces;   /* [hole_count] */
    } osdtex_cage_arrays;

    static inline osdtex_cage_arrays osdtex_cage_arrays_none(void)
    {
        osdtex_cage_arrays arrays = {
            sizeof(osdtex_cage_arrays),
            0,
            0,
            NULL,
            NULL,
            NULL,
            0,
            0,
            NULL,
            NULL,
            NULL,
            NULL,
            0,
            0,
            NULL,
            NULL,
            NULL};

        return arrays;
    }

    typedef struct osdtex_cage_info
    {
        const char *path; /* as given, NULL when made from arrays */
        const char *hash; /* of the file's bytes, NULL when made from arrays */
        osdtex_scheme scheme;
        osdtex_boundary boundary; /* as resolved */
        osdtex_fvar fvar;         /* as resolved */
        osdtex_index vert_count;
        osdtex_index face_count;
        osdtex_index edge_count;
        osdtex_index uv_count; /* 0: the cage has no UVs */
        osdtex_index crease_count;
        osdtex_index corner_count; /* sharp vertices */
        osdtex_index hole_count;
        osdtex_index triangle_count;
        osdtex_index quad_count;
        osdtex_index component_count;
        osdtex_index boundary_edge_count;
        osdtex_index material_count;
        osdtex_index group_count;
        float lower[3]; /* of the bounding box, scene units */
        float upper[3];
        double diagonal;         /* of the bounding box */
        double mean_edge_length; /* scene units */
        double default_scale;    /* what a scale of 0 means: diagonal / 5 */
    } osdtex_cage_info;

    /* Reads an OBJ. FORMAT, TOPOLOGY, LIMIT, NUMERIC, IO, MEMORY. */
    OSDTEX_API osdtex_status osdtex_cage_read(
        osdtex_context *context, const char *path,
        const osdtex_cage_options *options, osdtex_cage **out);
    /* ARGUMENT, and as osdtex_cage_read but for IO. */
    OSDTEX_API osdtex_status osdtex_cage_create(
        osdtex_context *context, const osdtex_cage_arrays *arrays,
        const osdtex_cage_options *options, osdtex_cage **out);
    OSDTEX_API const osdtex_cage_info *
    osdtex_cage_describe(const osdtex_cage *cage);
    OSDTEX_API void osdtex_cage_destroy(osdtex_cage *cage);

    /* ------------------------------------------------------------------ */
    /* Surface: the subdivision hierarchy and the limit of its leaves.     */

    enum
    {
        OSDTEX_LEVEL_AUTO = -1,
        OSDTEX_LEVEL_MAX = 10
    };

    typedef struct osdtex_surface_options
    {
        size_t size;
        int32_t level; /* 0 .. OSDTEX_LEVEL_MAX, or OSDTEX_LEVEL_AUTO */
        int32_t reserved;
        /* Scene units that leaf edges are to come to, for OSDTEX_LEVEL_AUTO:
         * see osdtex_exemplar_leaf_edge. */
        double leaf_edge;
    } osdtex_surface_options;

    static inline osdtex_surface_options osdtex_surface_options_default(void)
    {
        osdtex_surface_options options = {
            sizeof(osdtex_surface_options), OSDTEX_LEVEL_AUTO, 0, 0.0};

        return options;
    }

    /* The leaf level, on the limit surface. Leaf faces are in the order of the
     * cage's faces; the cage's vertices come first. */
    typedef struct osdtex_surface_info
    {
        int32_t level; /* refinement steps */
        osdtex_index vert_count;
        osdtex_index face_count;
        osdtex_index corner_count;
        const float *points;            /* [vert_count * 3], scene units */
        const float *normals;           /* [vert_count * 3], unit */
        const float *tangents;          /* [vert_count * 6], unit pairs */
        const osdtex_index *face_first; /* [face_count + 1], into corners */
        const osdtex_index *face_verts; /* [corner_count] */
        const osdtex_index *face_cage;  /* [face_count], face of the cage */
        const uint8_t *face_hole;       /* [face_count], 1 hole; NULL none */
        const float *uvs;               /* the cage's, [uv_count * 2] */
        const osdtex_index *face_uvs;   /* [corner_count], NULL none */
        osdtex_index uv_count;
        osdtex_index reserved;
        double area;             /* scene units squared, without holes */
        double mean_edge_length; /* scene units */
    } osdtex_surface_info;

    /* ARGUMENT, LIMIT (predicted memory over the context's, too many
     * elements), MEMORY, CANCELLED. */
    OSDTEX_API osdtex_status osdtex_surface_refine(
        osdtex_context *context, const osdtex_cage *cage,
        const osdtex_surface_options *options, osdtex_surface **out);
    OSDTEX_API const osdtex_surface_info *
    osdtex_surface_describe(const osdtex_surface *surface);
    OSDTEX_API void osdtex_surface_destroy(osdtex_surface *surface);

    /* ------------------------------------------------------------------ */
    /* Image: float pixels.                                                */

    typedef struct osdtex_image_info
    {
        int32_t width;
        int32_t height;
        int32_t channels; /* interleaved: grey, grey + A, RGB, RGBA */
        int32_t reserved;
        const float *pixels; /* [height * width * channels], bottom row first,
                              * colour multiplied by A */
    } osdtex_image_info;

    /* Copies `pixels`, laid out as in osdtex_image_info. ARGUMENT, LIMIT,
     * MEMORY. */
    OSDTEX_API osdtex_status osdtex_image_create(
        osdtex_context *context, int32_t width, int32_t height,
        int32_t channels, const float *pixels, osdtex_image **out);
    OSDTEX_API const osdtex_image_info *
    osdtex_image_describe(const osdtex_image *image);
    /* Reads EXR, PNG, TIFF or JPEG, told by content: values as they are in the
     * file (integers over their maximum), no colour converted. FORMAT, SUPPORT,
     * LIMIT, NUMERIC (a pixel that is not finite), IO, MEMORY. */
    OSDTEX_API osdtex_status osdtex_image_read(
        osdtex_context *context, const char *path, osdtex_image **out);
    /* Writes scene-linear pixels: NAME.exr as they are, NAME.png for the eye,
     * through the sRGB space of the colour configuration. ARGUMENT (another
     * extension), IO, COLOUR, MEMORY. */
    OSDTEX_API osdtex_status osdtex_image_write(
        osdtex_context *context, const osdtex_image *image, const char *path);
    OSDTEX_API void osdtex_image_destroy(osdtex_image *image);

    /* ------------------------------------------------------------------ */
    /* Exemplar: the picture of a material, its colours resolved.          */

    /* In what colours are compared. */
    typedef int32_t osdtex_embedding;
    enum
    {
        OSDTEX_EMBEDDING_HSV_CONE = 0,
        OSDTEX_EMBEDDING_HSV_CYLINDER = 1,
        OSDTEX_EMBEDDING_LAB = 2,
        OSDTEX_EMBEDDING_RGB = 3
    };

    /* Whether the picture continues across its own border. */
    typedef int32_t osdtex_wrap;
    enum
    {
        OSDTEX_WRAP_AUTO = 0, /* tested, for each axis */
        OSDTEX_WRAP_NO = 1,
        OSDTEX_WRAP_YES = 2
    };

    /* What becomes of a picture that does not tile. UVs refer to the picture
     * that is made, so maps that lie on the file's pixels no longer fit: by
     * default it is kept. */
    typedef int32_t osdtex_tileable;
    enum
    {
        OSDTEX_TILEABLE_AUTO = 0, /* made to, where that is judged good */
        OSDTEX_TILEABLE_KEEP = 1, /* stays; patches keep inside it */
        OSDTEX_TILEABLE_MAKE = 2  /* made to: windows of the picture are sewn
                                   * over the line where its borders meet */
    };

    typedef struct osdtex_exemplar_options
    {
        size_t size;
        /* Colour spaces by name, alias or role; NULL: by the stated rules. */
        const char *from;        /* of the file */
        const char *to;          /* of what is written; role scene_linear */
        const char *match_space; /* in which colours are compared */
        osdtex_embedding embedding;
        osdtex_wrap wrap;
        osdtex_tileable tileable;
        int32_t reserved;
    } osdtex_exemplar_options;

    static inline osdtex_exemplar_options osdtex_exemplar_options_default(void)
    {
        osdtex_exemplar_options options = {
            sizeof(osdtex_exemplar_options),
            NULL,
            NULL,
            NULL,
            OSDTEX_EMBEDDING_HSV_CONE,
            OSDTEX_WRAP_AUTO,
            OSDTEX_TILEABLE_KEEP,
            0};

        return options;
    }

    typedef struct osdtex_exemplar_info
    {
        const char *path;         /* as given, NULL when made from an image */
        const char *hash;         /* of the file's bytes, NULL likewise */
        const char *type;         /* "8-bit", "half", …; NULL likewise */
        const char *source_space; /* as resolved */
        const char *linear_space;
        const char *match_space;
        const char *embedding;
        int32_t width;
        int32_t height;
        int32_t channels; /* of `pixels`: 3 or 4 */
        int32_t wrap_x;   /* 1: tiles left to right */
        int32_t wrap_y;
        int32_t made_tileable; /* 1: the pixels are not those of the file */
        const float *pixels;   /* in linear_space, bottom row first */
        int32_t source_width;  /* of the picture whose width a scale means:
                                * as read, before it was cropped to be made to
                                * tile, or the one tiles were made of */
        int32_t tile_size;     /* texels; 0: this is no tiled texture */
    } osdtex_exemplar_info;

    /* Reads EXR, PNG, TIFF or JPEG, told by content. FORMAT, SUPPORT, LIMIT,
     * NUMERIC (a pixel that is not finite), COLOUR, IO, MEMORY. */
    OSDTEX_API osdtex_status osdtex_exemplar_read(
        osdtex_context *context, const char *path,
        const osdtex_exemplar_options *options, osdtex_exemplar **out);
    /* The same from pixels, which are scene-linear unless `from` says else. */
    OSDTEX_API osdtex_status osdtex_exemplar_create(
        osdtex_context *context, const osdtex_image *image,
        const osdtex_exemplar_options *options, osdtex_exemplar **out);
    OSDTEX_API const osdtex_exemplar_info *
    osdtex_exemplar_describe(const osdtex_exemplar *exemplar);

    /* Length of leaf edges, in scene units, that suits the exemplar when its
     * width covers `scale` scene units: 14 texels, but a 48th of the shorter
     * side at most and a 128th at least. Seams run along leaf edges. */
    OSDTEX_API double
    osdtex_exemplar_leaf_edge(const osdtex_exemplar *exemplar, double scale);

    /* Whether an exemplar has a direction, or a lattice. */
    typedef struct osdtex_exemplar_structure
    {
        const char *name; /* "isotropic", "directional", "weak-lattice",
                           * "lattice" */
        int32_t symmetry; /* turns by 360 / symmetry degrees look the same: 1,
                           * 2, 4; 0: all turns do */
        int32_t reserved;
        double angle;         /* of its direction, radians */
        double generators[4]; /* of a lattice, texels; else 0 */
        double coherence;     /* of direction, 0 .. 1 */
        double regularity;    /* of the lattice that fits best, 0 .. 1 */
    } osdtex_exemplar_structure;

    /* ARGUMENT, MEMORY. */
    OSDTEX_API osdtex_status osdtex_exemplar_analyse(
        osdtex_context *context, const osdtex_exemplar *exemplar,
        osdtex_exemplar_structure *out);
    OSDTEX_API void osdtex_exemplar_destroy(osdtex_exemplar *exemplar);

    /* ------------------------------------------------------------------ */
    /* Field: which way a texture is to run, and how large it is to be.    */

    typedef struct osdtex_field_options
    {
        size_t size;
        const char *constraints; /* a file, JSON or CSV; NULL none */
        /* "smooth", "up", "edges" (the cage's edge loops), "curvature" (least
         * bending) or an axis "X,Y,Z": what the field follows where no
         * constraint says otherwise. NULL: what the file says, else smooth. */
        const char *follow;
        int32_t symmetry; /* 1 arrow, 2 line, 4 cross; 0: the file's, else 2 */
        int32_t whole_table; /* 1: a CSV needs a line for each of the cage's
                              * faces; 0: what it leaves out is free */
        /* How far the texture's size may give way so that rows can follow the
         * curvature, in octaves; 0: not at all. */
        double octaves;
    } osdtex_field_options;

    static inline osdtex_field_options osdtex_field_options_default(void)
    {
        osdtex_field_options options = {
            sizeof(osdtex_field_options), NULL, NULL, 0, 0, 0.0};

        return options;
    }

    /* Where a field has no direction: going round the vertex it turns by 2 pi
     * times the index. */
    typedef struct osdtex_singularity
    {
        osdtex_index vertex; /* of the surface */
        float point[3];
        double index; /* a multiple of 1 / symmetry, not 0 */
    } osdtex_singularity;

    /* On the leaf level of the surface. */
    typedef struct osdtex_field_info
    {
        int32_t symmetry;
        osdtex_index face_count;
        osdtex_index vert_count;
        osdtex_index singularity_count;
        const float *directions; /* [face_count * 3] one of the equal ones,
                                  * unit, along the face; 0 on holes */
        const float *scales;     /* [vert_count] factor on the texture's size */
        const float *materials;  /* [vert_count] 0 .. 1 */
        const osdtex_singularity *singularities; /* [singularity_count] */
        double scale_min;
        double scale_max;
    } osdtex_field_info;

    /* What is asked of the faces below a face of the cage, or around a point.
     */
    typedef struct osdtex_constraint
    {
        size_t size;
        osdtex_index face; /* of the cage; -1: at the point */
        int32_t has_material;
        double point[3];     /* scene units */
        double radius;       /* around it; the nearest face is held at least */
        double direction[3]; /* scene axes; 0: not asked */
        double scale;        /* factor on the size, 1/16 .. 16; 0: not asked */
        double material;     /* 0 .. 1 */
    } osdtex_constraint;

    static inline osdtex_constraint osdtex_constraint_none(void)
    {
        osdtex_constraint constraint = {
            sizeof(osdtex_constraint), -1,  0,  {0.0, 0.0, 0.0}, 0.0,
            {0.0, 0.0, 0.0},           0.0, 0.0};

        return constraint;
    }

    /* ARGUMENT (a constraint that cannot be held, with its number), FORMAT,
     * IO, NUMERIC, MEMORY, CANCELLED. */
    OSDTEX_API osdtex_status osdtex_field_create(
        osdtex_context *context, const osdtex_surface *surface,
        const osdtex_field_options *options, osdtex_field **out);
    /* The field with one constraint more, which changes it nowhere but within
     * `reach` scene units along the surface. The old field stays as it is and
     * may be destroyed first. As osdtex_field_create. */
    OSDTEX_API osdtex_status osdtex_field_edit(
        osdtex_context *context, const osdtex_field *field,
        const osdtex_constraint *constraint, double reach, osdtex_field **out);
    OSDTEX_API const osdtex_field_info *
    osdtex_field_describe(const osdtex_field *field);
    /* Writes a line for each face of `level` of the surface, 0 the cage's: its
     * direction, scale and material, as constraints take them. ARGUMENT, IO,
     * MEMORY. */
    OSDTEX_API osdtex_status osdtex_field_write(
        osdtex_context *context, const osdtex_field *field, int32_t level,
        const char *path);
    OSDTEX_API void osdtex_field_destroy(osdtex_field *field);

    /* ------------------------------------------------------------------ */
    /* Methods and their settings.                                         */

    typedef struct osdtex_method_info
    {
        const char *name;
        const char *summary; /* one sentence */
        const char *source;  /* the paper */
        int32_t option_count;
        int32_t reserved;
    } osdtex_method_info;

    typedef int32_t osdtex_option_kind;
    enum
    {
        OSDTEX_OPTION_REAL = 0,
        OSDTEX_OPTION_INTEGER = 1,
        OSDTEX_OPTION_CHOICE = 2,
        OSDTEX_OPTION_SWITCH = 3 /* on | off */
    };

    typedef struct osdtex_option_info
    {
        const char *name;
        const char *help;           /* one sentence, with the unit */
        const char *const *choices; /* NULL-terminated; CHOICE only */
        double minimum;             /* REAL and INTEGER; inclusive */
        double maximum;
        char fallback[64]; /* the default, as osdtex_setting takes it */
        osdtex_option_kind kind;
        int32_t reserved;
    } osdtex_option_info;

    OSDTEX_API int32_t osdtex_method_count(void);
    /* ARGUMENT when there is no such method, or it has no such option. */
    OSDTEX_API osdtex_status
    osdtex_method_get(int32_t method, osdtex_method_info *out);
    OSDTEX_API osdtex_status
    osdtex_option_get(int32_t method, int32_t option, osdtex_option_info *out);

    /* ------------------------------------------------------------------ */
    /* Mapping: UVs into the exemplar for every leaf face.                 */

    typedef struct osdtex_setting
    {
        const char *key;
        const char *value;
    } osdtex_setting;

    enum
    {
        OSDTEX_EXEMPLARS_MAX = 4 /* of a mapping */
    };

    /* One more exemplar of a mapping. */
    typedef struct osdtex_also
    {
        const osdtex_exemplar *exemplar; /* borrowed as the first is */
        const char *material; /* of the cage: its faces show it; NULL none */
        double scale; /* width in scene units; 0: as many texels to a unit as
                       * the first has */
    } osdtex_also;

    typedef struct osdtex_map_options
    {
        size_t size;
        const char *method; /* NULL: the first of the table; "auto": by the
                             * exemplar */
        const osdtex_setting *settings; /* [setting_count], later ones win */
        int32_t setting_count;
        osdtex_index first_face; /* of the cage: where to begin; -1 free */
        double first_u;          /* UV that the first patch's middle gets */
        double first_v;
        double first_angle; /* radians, counter-clockwise in the picture */
        double scale;       /* width of the exemplar in scene units; 0:
                             * osdtex_cage_info.default_scale */
        uint64_t seed;
        /* A file of constraints on direction, scale and exemplars, JSON or
         * CSV; NULL none. */
        const char *constraints;
        /* "isotropic", "directional", "weak-lattice" or "lattice"; NULL: the
         * exemplar is analysed. */
        const char *exemplar_class;
        /* Two vectors, in texels, by which the exemplar repeats; all 0:
         * analysed. */
        double generators[4];
        /* What the field follows, as for osdtex_field_options; NULL: what the
         * file of constraints says, else nothing. */
        const char *follow;
        /* Up to three exemplars more, for methods that mix them. Which a face
         * shows is said by its material, by a mask, by a table or by the
         * constraints (docs/notes/mask.md); the first exemplar goes
         * wherever nothing is said. */
        const osdtex_also *also; /* [also_count] */
        int32_t also_count;
        int32_t reserved;
        /* A picture on the cage's UVs: black asks for the first exemplar, red,
         * green and blue for the second to fourth. It fills the unit square;
         * UVs beyond it need a picture for each UDIM tile that a face lies in,
         * and a name that holds <UDIM> for 1001 and on, or <UVTILE> for u1_v1:
         * "mask.<UDIM>.exr". They are read one after the other. NULL none. */
        const char *mask;
        /* [face_count of the cage] 0 the first exemplar, 1 the second, and so
         * on; NULL none. */
        const uint8_t *face_exemplars;
    } osdtex_map_options;

    static inline osdtex_map_options osdtex_map_options_default(void)
    {
        osdtex_map_options options = {
            sizeof(osdtex_map_options),
            NULL,
            NULL,
            0,
            -1,
            0.5,
            0.5,
            0.0,
            0.0,
            1,
            NULL,
            NULL,
            {0.0, 0.0, 0.0, 0.0},
            NULL,
            NULL,
            0,
            0,
            NULL,
            NULL};

        return options;
    }

    typedef struct osdtex_mapping_info
    {
        const char *method;
        double scale;                   /* as resolved */
        osdtex_index face_count;        /* of the surface */
        osdtex_index corner_count;      /* of the surface */
        const float *uvs;               /* [corner_count * 2] */
        const osdtex_index *face_patch; /* [face_count], -1 on holes */
        osdtex_index patch_count;
        int32_t exemplar_count;        /* 1 unless there are more */
        const uint8_t *patch_exemplar; /* [patch_count] which one each patch is
                                        * from, 0 the first; NULL: all are */
    } osdtex_mapping_info;

    /* ARGUMENT (with near names), LIMIT, NUMERIC, MEMORY, CANCELLED; of several
     * exemplars also FORMAT and IO (of a mask) and SUPPORT (a method that takes
     * one). */
    OSDTEX_API osdtex_status osdtex_map(
        osdtex_context *context, const osdtex_surface *surface,
        const osdtex_exemplar *exemplar, const osdtex_map_options *options,
        osdtex_mapping **out);
    OSDTEX_API const osdtex_mapping_info *
    osdtex_mapping_describe(const osdtex_mapping *mapping);

    typedef struct osdtex_write_options
    {
        size_t size;
        const char *const *comments; /* [comment_count] lines for OBJ, MTL */
        int32_t comment_count;
        int32_t without_image; /* 1: neither write nor replace the EXR */
    } osdtex_write_options;

    static inline osdtex_write_options osdtex_write_options_default(void)
    {
        osdtex_write_options options = {
            sizeof(osdtex_write_options), NULL, 0, 0};

        return options;
    }

    /* Writes NAME.obj (`path`), NAME.mtl and NAME.exr, all or none of them. Of
     * several exemplars NAME_1.exr, NAME_2.exr and so on, each with materials
     * of its own.
     * ARGUMENT, IO, LIMIT, MEMORY, CANCELLED. */
    OSDTEX_API osdtex_status osdtex_mapping_write(
        osdtex_context *context, const osdtex_mapping *mapping,
        const char *path, const osdtex_write_options *options);

    /* Onto which texture coordinates a mapping is baked. */
    typedef int32_t osdtex_bake_uvs;
    enum
    {
        OSDTEX_BAKE_UVS_AUTO = 0, /* the cage's where it has UVs */
        OSDTEX_BAKE_UVS_OWN = 1,  /* the cage's, on UDIM tiles */
        OSDTEX_BAKE_UVS_ATLAS = 2 /* a block for every face of the cage */
    };

    /* What is baked besides the colour, as 32-bit NAME_patch.<UDIM>.exr and so
     * on: values at the texel's centre, never averaged; blue is 1 on the
     * surface and 0 beyond. */
    enum
    {
        OSDTEX_BAKE_PATCH = 1,   /* number of the patch, face of the cage */
        OSDTEX_BAKE_UV = 2,      /* UV in the exemplar */
        OSDTEX_BAKE_STRETCH = 4, /* L2 stretch, ratio of the axes; 1 is none */
        OSDTEX_BAKE_SEAM = 8     /* 1 where patches meet */
    };

    typedef struct osdtex_bake_options
    {
        size_t size;
        const char *const *comments; /* [comment_count] lines for the texts */
        int32_t comment_count;
        osdtex_bake_uvs uvs;
        int32_t resolution;     /* texels of a tile's side, up to 32768 */
        int32_t margin;         /* texels continued beyond the rims of charts;
                                 * 0 chooses */
        double texels_per_unit; /* of an atlas; 0: what fills one tile */
        double seam_blend;      /* texels over which patches are blended */
        uint32_t extras;        /* OSDTEX_BAKE_PATCH | … */
        int32_t preview_png;    /* 1: also NAME.<UDIM>.png, at most 1024 texels
                                 * a side, and NAME_preview.mtl */
        const char *texture_comment; /* for the headers of textures; NULL */
        /* Not NULL: with the bake, what osdtex_mapping_write() writes. */
        const osdtex_write_options *mesh;
        int32_t udim; /* bake this tile only; 0 all */
        int32_t reserved;
    } osdtex_bake_options;

    static inline osdtex_bake_options osdtex_bake_options_default(void)
    {
        osdtex_bake_options options = {
            sizeof(osdtex_bake_options),
            NULL,
            0,
            OSDTEX_BAKE_UVS_AUTO,
            4096,
            0,
            0.0,
            0.0,
            0,
            0,
            NULL,
            NULL,
            0,
            0};

        return options;
    }

    /* Bakes a mapping into textures of the cage: NAME_cage.obj and
     * NAME_cage.mtl, NAME.<UDIM>.exr (1001 for the unit square), NAME.usda and
     * NAME.mtlx, all or none of them. `path` is FOLDER/NAME.obj; that file
     * itself is written only where options->mesh asks for it. ARGUMENT (no such
     * tile), IO, LIMIT (UVs outside of UDIM), MEMORY, CANCELLED. */
    OSDTEX_API osdtex_status osdtex_bake(
        osdtex_context *context, const osdtex_mapping *mapping,
        const char *path, const osdtex_bake_options *options);

    /* Writes what was done as JSON: inputs with hashes, options and colour
     * decisions as resolved, patches, seams, distortion, times since the
     * context was created, findings. IO, MEMORY. */
    OSDTEX_API osdtex_status osdtex_report_write(
        osdtex_context *context, const osdtex_mapping *mapping,
        const char *path);
    OSDTEX_API void osdtex_mapping_destroy(osdtex_mapping *mapping);

    /* ------------------------------------------------------------------ */
    /* Tiled textures: what the method "tile" maps.                        */

    /* A segment of the picture that a boundary of the tiles shows. Texels from
     * the lower left corner, radians. */
    typedef struct osdtex_tiles_edge
    {
        double x, y; /* its middle */
        double angle;
        double length; /* 0: as long as a tile's side */
    } osdtex_tiles_edge;

    typedef struct osdtex_tiles_options
    {
        size_t size;
        int32_t boundaries; /* 1 .. 3, (2n)^4 tiles; oriented: of rows and of
                             * columns each, (4n)^4 tiles */
        int32_t corners;    /* kinds of vertices, 1 .. 4; n^4 times the tiles */
        int32_t tile_size;  /* texels, a power of two; 0: by the picture */
        int32_t gutter;     /* texels of that on each side, a power of two */
        int32_t oriented;   /* 1: nothing is turned by 90 degrees */
        int32_t edge_count;
        const osdtex_tiles_edge *edges; /* [edge_count], of the first
                                         * boundaries; the others are chosen */
        int32_t has_corner;
        int32_t background[4]; /* x0, y0, x1, y1: insides of tiles come from
                                * these texels; all 0: from anywhere */
        int32_t ramp;    /* 1: cross-fades as published instead of cuts, for
                          * comparison; such tiles jump at vertices */
        double corner_x; /* texels; middle of the first kind of vertex */
        double corner_y;
        uint64_t seed;
        /* The settings with which `surface` will be mapped. */
        const osdtex_setting *settings;
        int32_t setting_count;
        int32_t reserved2;
        double scale; /* as for osdtex_map */
    } osdtex_tiles_options;

    static inline osdtex_tiles_options osdtex_tiles_options_default(void)
    {
        osdtex_tiles_options options = {
            sizeof(osdtex_tiles_options),
            1,
            1,
            0,
            4,
            0,
            0,
            NULL,
            0,
            {0, 0, 0, 0},
            0,
            0.0,
            0.0,
            1,
            NULL,
            0,
            0,
            0.0};

        return options;
    }

    typedef struct osdtex_tiles_info
    {
        int32_t tile_count;
        int32_t tile_size;
        int32_t width; /* of the picture */
        int32_t height;
        /* Mean CIELAB distance along the cuts of vertices, edges and insides,
         * and of two random texels. */
        double corner_cut;
        double edge_cut;
        double inner_cut;
        double random_pair;
        /* How far windows of 16 texels around vertices, and inside tiles, are
         * from the nearest piece of the exemplar: median, relative to a random
         * pair. Negative where they were not looked up: a set for one mesh has
         * not the tiles for it, and pictures or tiles may be too small. */
        double vertex_window;
        double inner_window;
    } osdtex_tiles_info;

    /* Makes a tiled texture from `exemplar` and writes it as an EXR that
     * osdtex_exemplar_read takes back.
     *
     *   surface  only the tiles that mapping it with this seed, scale and
     *            settings needs; NULL: all
     *   out      what was made; NULL not wanted
     *
     * ARGUMENT (options, a picture that is too small), LIMIT, IO, MEMORY,
     * CANCELLED. */
    OSDTEX_API osdtex_status osdtex_tiles_write(
        osdtex_context *context, const osdtex_exemplar *exemplar,
        const osdtex_surface *surface, const osdtex_tiles_options *options,
        const char *path, osdtex_tiles_info *out);

    /* ------------------------------------------------------------------ */
    /* Pictures of the result.                                             */

    /* Something to look at: a written OBJ with its MTL and textures. FORMAT,
     * LIMIT, NUMERIC, COLOUR, IO, MEMORY. A texture that cannot be read is a
     * warning. */
    OSDTEX_API osdtex_status osdtex_model_read(
        osdtex_context *context, const char *path, osdtex_model **out);
    /* The same from a mapping, which it borrows. */
    OSDTEX_API osdtex_status osdtex_model_create(
        osdtex_context *context, const osdtex_mapping *mapping,
        osdtex_model **out);
    /* The surface of a field, which it borrows, to be shown as "field" or
     * "singularities". */
    OSDTEX_API osdtex_status osdtex_model_create_field(
        osdtex_context *context, const osdtex_field *field, osdtex_model **out);
    /* A field to be shown on a model that was read, which borrows it: that of
     * the same OBJ read as a cage of scheme none, on level 0. ARGUMENT where
     * the field's surface has other faces than the model. */
    OSDTEX_API osdtex_status osdtex_model_add_field(
        osdtex_context *context, osdtex_model *model,
        const osdtex_field *field);
    OSDTEX_API void osdtex_model_destroy(osdtex_model *model);

    typedef struct osdtex_render_options
    {
        size_t size;
        int32_t width;
        int32_t height;
        int32_t samples;  /* to a pixel's side: n * n, 1 .. 16 */
        int32_t unlit;    /* 1: the colours as they are */
        const char *show; /* "texture", "patches", "stretch", "seams", "uv",
                           * "normals", "flat", "field", "singularities",
                           * "cells"; NULL: texture */
        const char *view; /* "three_quarter", "front", "back", "left", "right",
                           * "top"; "seam1" to "seam99": close to the places
                           * where seams show, the worst first; NULL:
                           * three_quarter */
        double turn;      /* of the view, radians about Y */
        /* Where the eye is instead of `view`; fov 0: not used. */
        double eye[3];
        double target[3];
        double fov;          /* of the picture's height, radians */
        int32_t transparent; /* 1: alpha 0 around the model */
        int32_t reserved;
    } osdtex_render_options;

    static inline osdtex_render_options osdtex_render_options_default(void)
    {
        osdtex_render_options options = {
            sizeof(osdtex_render_options),
            1280,
            720,
            4,
            0,
            NULL,
            NULL,
            0.0,
            {0.0, 0.0, 0.0},
            {0.0, 0.0, 0.0},
            0.0,
            0,
            0};

        return options;
    }

    /* Renders into an RGBA image, scene-linear. ARGUMENT, NUMERIC, MEMORY,
     * CANCELLED. */
    OSDTEX_API osdtex_status osdtex_render(
        osdtex_context *context, const osdtex_model *model,
        const osdtex_render_options *options, osdtex_image **out);

#ifdef __cplusplus
}
#endif
#endif

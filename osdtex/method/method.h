/* method.h -- the one table of methods and the call that runs one.
 *
 * A method is a const row: name, source, settings, and `map`. The driver
 * checks the request, runs it, and finishes the mapping. Deleting a method's
 * folder and its row leaves everything else compiling. */
#ifndef OTX_METHOD_METHOD_H
#define OTX_METHOD_METHOD_H

#include "analysis/analysis.h"
#include "exemplar/exemplar.h"
#include "mapping/mapping.h"
#include "method/guide.h"
#include "method/option.h"
#include "surface/surface.h"

enum
{
    OTX_STAGE_MAX = 16
};

/* What a run did, for the report. Times are wall seconds. */
typedef struct otx_map_stats
{
    int32_t stage_count;
    struct
    {
        const char *name;
        double seconds;
    } stages[OTX_STAGE_MAX];
    int32_t fit_count;                  /* searches made */
    int32_t split_count;                /* clusters given to their children */
    int32_t patches[OTX_LEVEL_MAX + 2]; /* fitted, by hierarchy level; [0] is
                                         * what was grown above the cage */
    double threshold;                   /* tau as resolved, 1 = random pair */
    double fit_error_mean;              /* of accepted fits, same unit */
    double cut_before, cut_after;       /* seam energy; 0 when not cut */
    double relax_before, relax_after;
    /* What each exemplar was taken for; NULL where it was not looked at. */
    const char *classes[OTX_EXEMPLARS_MAX];
    /* Of periodic coordinates; lattice_faces 0: the method has none. */
    int32_t lattice_faces;  /* that were solved on */
    int32_t singular_faces; /* of them that hold a dislocation */
    int32_t singular_rings; /* of faces round a vertex, by both criteria */
    int32_t cancelled;      /* dislocations that were made to vanish */
    double clean_share;     /* of the area, over a cell from any */
    double filled_share;    /* of the area, covered by patches */
    int32_t blended_faces;  /* that show the mean of several lookups */
    double blended_share;   /* of the area, theirs */
    double gradient_error;  /* RMS of the steps' departure from the field's
                             * gradient, relative to it */
} otx_map_stats;

/* Ends the stage that is running and starts the next; NULL only ends. */
void otx_map_stats_stage(otx_map_stats *stats, const char *name);

/* What every method is asked, whatever its settings. */
typedef struct otx_map_request
{
    double scale; /* width of the exemplar in scene units, > 0 */
    /* The user's first patch; face -1 none. */
    int32_t first_face;      /* of the cage */
    otx_vec2 first_position; /* UV that its middle lands on */
    double first_angle;      /* radians */
    /* What the exemplar is taken for; NULL: it is analysed where needed. */
    const otx_analysis *analysis;
    const otx_constraint_set *constraints; /* on fields; NULL none */
    const otx_guide *guide; /* that patches follow; NULL: the method's choice */
    /* Several exemplars: how many, and which each leaf face is to show; NULL:
     * the first throughout. Methods are then given them as an array. */
    int32_t exemplar_count;
    const uint8_t *demand; /* [leaf face_count] */
} otx_map_request;

/* What is textured before a method begins. */
typedef struct otx_method_given
{
    const int32_t *face_patch; /* [leaf face_count], -1 to be covered */
    int32_t patch_count;
    const otx_vec2 *uvs; /* [leaf corner_count] texels; corners that share
                          * vertex and patch are equal */
    double reach;        /* texels from a seam within which they may be moved */
} otx_method_given;

typedef struct otx_method
{
    const char *name;
    const char *summary; /* one sentence */
    const char *source;  /* the paper */
    const otx_option *options;
    int32_t option_count;
    size_t settings_bytes;
    bool mixes;  /* several exemplars */
    bool begins; /* with the user's first patch */
    /* Replaces automatic settings by what they come to for an exemplar; they
     * stay as they are when called again. NULL: none are. */
    void (*resolve)(void *settings, const otx_exemplar *exemplar);
    otx_status (*map)(
        otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
        const otx_map_request *request, const void *settings, otx_mapping *out,
        otx_map_stats *stats);
    /* Covers what is not given and joins it to what is; NULL when the method
     * cannot. Stages are added to `stats`. */
    otx_status (*fill)(
        otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
        const otx_map_request *request, const void *settings,
        const otx_method_given *given, otx_mapping *out, otx_map_stats *stats);
} otx_method;

int32_t otx_method_count(void);
const otx_method *otx_method_at(int32_t index);
/* NULL when there is none of that name. */
const otx_method *otx_method_find(const char *name);

/* The method for an exemplar and a surface: material for lattices that the
 * surface has room for, else patches. Says why in one finding. */
otx_status otx_method_choose(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const otx_method **out);

/* Covers what is not given by the first method of the table that can, with
 * its defaults. SUPPORT when none can. */
otx_status otx_method_fill(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const otx_map_request *request, const otx_method_given *given,
    otx_mapping *out, otx_map_stats *stats);

/* Runs `method`. The mapping lives in run->arena and borrows the surface. */
otx_status otx_method_map(
    otx_run *run, const otx_method *method, const otx_surface *surface,
    const otx_exemplar *exemplar, const otx_map_request *request,
    const void *settings, otx_mapping *out, otx_map_stats *stats);

#endif

/* method.h -- the one table of methods and the call that runs one.
 *
 * A method is a const row: name, source, settings, whether it suits a job, and
 * `map`. The driver checks the job, runs it, and checks what came out
 * (mapping/mapping_check.h). Deleting a method's folder and its row leaves
 * everything else compiling. How to add one: docs/contributing.md. */
#ifndef OTX_METHOD_METHOD_H
#define OTX_METHOD_METHOD_H

#include "analysis/analysis.h"
#include "exemplar/exemplar.h"
#include "mapping/figure.h"
#include "mapping/mapping.h"
#include "method/guide.h"
#include "method/option.h"
#include "patch/given.h"
#include "surface/surface.h"

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
    /* Which of several exemplars each leaf face is to show, [leaf face_count];
     * NULL: there is one. */
    const uint8_t *demand;
} otx_map_request;

/* What a method is given. All of it is the caller's and outlives the mapping.
 */
typedef struct otx_job
{
    otx_run *run;
    const otx_surface *surface;
    const otx_exemplar *exemplars; /* [exemplar_count] */
    int32_t exemplar_count;        /* 1, or more with request->demand */
    const otx_map_request *request;
    const void *settings; /* the method's own struct, checked and resolved */
    otx_figures *figures; /* that the method adds its own to; NULL none */
} otx_job;

/* How well a method suits a job. */
typedef struct otx_suitability
{
    double score;  /* 0: not at all; the highest is taken */
    char why[240]; /* for the user, without a full stop; "" when the job has
                    * nothing to do with the method */
} otx_suitability;

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
    /* Replaces automatic settings by what they come to for an exemplar and a
     * cage; they stay as they are when called again. NULL: none are. */
    void (*resolve)(
        void *settings, const otx_exemplar *exemplar, const otx_cage *cage);
    /* Whether `auto` is to take it, before settings are read: job->settings is
     * NULL. Says no by a score of 0; fails only as `map` may. NULL: never. */
    otx_status (*applicable)(const otx_job *job, otx_suitability *out);
    /* Covers the surface, in job->run->arena. What it returns must pass
     * otx_mapping_check. */
    otx_status (*map)(const otx_job *job, otx_mapping *out);
    /* Covers what is not given and joins it to what is; NULL when the method
     * cannot. */
    otx_status (*fill)(
        const otx_job *job, const otx_patch_given *given, otx_mapping *out);
    /* Of methods that lay tiles: the names of the tiles that `map` would lay
     * of a tiled texture of this layout, in job->run->arena; -1 none. NULL. */
    otx_status (*tiles)(
        const otx_job *job, const otx_tile_layout *layout, int32_t **names,
        int32_t *count);
} otx_method;

int32_t otx_method_count(void);
const otx_method *otx_method_at(int32_t index);
/* NULL when there is none of that name. */
const otx_method *otx_method_find(const char *name);

/* The first method of the table that lays tiles; NULL when none does. */
const otx_method *otx_method_for_tiles(void);

/* The method that suits a job best, of those that can take as many exemplars;
 * the first in the table of equals. Says why in one finding, and why others
 * that had a reason were not taken. job->settings is not looked at. */
otx_status otx_method_choose(const otx_job *job, const otx_method **out);

/* Whether this build has a method for otx_method_fill. */
bool otx_method_can_fill(void);

/* Covers what is not given by the first method of the table that can, with
 * its defaults instead of job->settings. SUPPORT when none can. */
otx_status otx_method_fill(
    const otx_job *job, const otx_patch_given *given, otx_mapping *out);

/* Covers the surface by the same method with its automatic settings, for one
 * that goes on from patches. SUPPORT likewise, and as its `map`. */
otx_status otx_method_patches(const otx_job *job, otx_mapping *out);

/* Runs `method`. The mapping lives in run->arena and borrows the surface.
 * job->figures are begun anew. INTERNAL when what the method returned is no
 * mapping; else ARGUMENT, LIMIT, TOPOLOGY, SUPPORT, and what the method says.
 */
otx_status
otx_method_map(const otx_method *method, const otx_job *job, otx_mapping *out);

#endif

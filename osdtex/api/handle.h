/* handle.h -- what is inside the opaque handles.
 *
 * Every handle lives in an arena of its own, with all that belongs to it;
 * destroying the handle is destroying the arena. */
#ifndef OTX_API_HANDLE_H
#define OTX_API_HANDLE_H

#include "exemplar/exemplar.h"
#include "method/method.h"
#include "render/scene.h"

#include <osdtex/osdtex.h>

struct osdtex_cage
{
    otx_arena *arena;
    otx_cage cage;
    double weld; /* as it was asked for */
    osdtex_cage_info info;
};

struct osdtex_surface
{
    otx_arena *arena;
    const osdtex_cage *cage;
    otx_surface surface;
    osdtex_surface_info info;
};

struct osdtex_image
{
    otx_arena *arena;
    otx_image image;
    osdtex_image_info info;
};

/* How the picture of an exemplar came out of its file: enough to do it again,
 * and to do the same to other pictures of the same size. */
typedef struct otx_exemplar_cuts
{
    osdtex_wrap wrap;  /* as it was asked for */
    const char *layer; /* likewise; NULL */
    int32_t file_width, file_height;
    /* The rectangle that was kept, and which texel of it each texel is; NULL:
     * the picture is the rectangle as it is. */
    int32_t x, y, width, height;
    const int32_t *texels; /* [width * height] */
} otx_exemplar_cuts;

struct osdtex_exemplar
{
    otx_arena *arena;
    otx_exemplar exemplar;
    otx_exemplar_cuts cuts;
    osdtex_exemplar_info info;
};

struct osdtex_mapping
{
    otx_arena *arena;
    const osdtex_surface *surface;
    const osdtex_exemplar *exemplar; /* the first */
    const osdtex_exemplar *sources[OTX_EXEMPLARS_MAX];
    int32_t source_count;
    /* [source_count] what the mapping is made of and measured by: those of the
     * sources, compared at as many texels to a unit. */
    const otx_exemplar *exemplars;
    otx_mapping mapping;
    otx_figures figures;
    /* What was asked, as resolved. */
    const otx_method *method;
    const void *settings;
    otx_map_request request;
    uint64_t seed;
    const char *saved_path; /* the file that it was read from; NULL: it was
                             * made here, and `figures` say how */
    /* [vert_count * 3] of the cage: the points that it was made for, where its
     * surface has others; NULL: it has these. */
    const float *made_for;
    /* Of an edited mapping: that of the mapping which the edits began with, and
     * which holds exemplars and settings; NULL: its own does. */
    otx_arena *base;
    osdtex_mapping_info info;
};

struct osdtex_field
{
    otx_arena *arena;
    const osdtex_surface *surface;
    otx_connection connection; /* of the leaf level */
    otx_constraint_set set;    /* its items grow with edits */
    otx_direction_request request;
    otx_direction direction;
    otx_scale_correction correction;
    double *asked_scale; /* [vert_count] -ln of what constraints ask */
    double *material;    /* [vert_count] */
    otx_guide guide;     /* to be shown */
    osdtex_field_info info;
};

struct osdtex_model
{
    otx_arena *arena;
    otx_scene scene;
    double origin[3]; /* what the scene's points are relative to */
    /* A field to show; NULL none. */
    const otx_surface *surface;
    const otx_guide *guide;
    const otx_cell_map *lattice;
    const osdtex_mapping *mapping; /* that it shows; NULL none */
};

#endif

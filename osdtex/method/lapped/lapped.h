/* lapped.h -- what the parts of lapped textures hand to each other
 * [Praun00].
 *
 * A texture patch is a piece of the exemplar, cut out by a mask. A chart is a
 * piece of the surface laid out over it: a paste. Later pastes lie over
 * earlier ones. Positions in a chart are in texels about the middle of its
 * texture patch. See docs/notes/lapped.md. */
#ifndef OTX_METHOD_LAPPED_LAPPED_H
#define OTX_METHOD_LAPPED_LAPPED_H

#include "analysis/feature.h"
#include "field/connection.h"
#include "method/lapped/samples.h"
#include "method/method.h"

typedef enum otx_lapped_mode
{
    OTX_LAPPED_AUTO,
    OTX_LAPPED_SPLOTCH, /* pieces that are cut where they differ least */
    OTX_LAPPED_CLUMPS,  /* whole features over one another by chance: leaves */
    OTX_LAPPED_PACKING, /* whole features beside one another: stones */
    OTX_LAPPED_ORDERED, /* whole features, upper ones over lower ones: scales */
    OTX_LAPPED_PAPER    /* as published: ramps, places by chance */
} otx_lapped_mode;

/* A sample counts as covered from this alpha on. */
static const double OTX_LAPPED_COVERED = 0.995;

enum
{
    OTX_LAPPED_CORNERS = 1024 /* of a face, at most */
};

typedef struct otx_lapped_settings
{
    double radius;  /* of texture patches, texels; 0 automatic */
    double feather; /* texels; negative: automatic */
    int32_t mode;
    int32_t outline; /* otx_lapped_outline */
} otx_lapped_settings;

/* A piece of the surface laid out in the plane. Corners of its faces are in
 * the order of the leaf's. */
typedef struct otx_lapped_chart
{
    int32_t face_count, vert_count;
    int32_t *faces;   /* [face_count] leaf faces; the seed's first */
    int32_t *first;   /* [face_count + 1] into corners */
    int32_t *corners; /* chart vertices */
    int32_t *verts;   /* [vert_count] leaf vertices */
    otx_vec2 *flat;   /* [vert_count] texels about the patch's middle */
    otx_vec3 *rights; /* [face_count] what is to lie along the picture's u */
    float *rim;       /* [vert_count] 0 at a border that cuts the patch off,
                       * 1 away from it */
} otx_lapped_chart;

/* Below all features. */
static const double OTX_LAPPED_BENEATH = -1e30;

/* Something that a paste shows. */
typedef struct otx_lapped_piece
{
    otx_vec2 middle; /* in the chart's plane */
    otx_radial *cut; /* what is seen, texels about the middle */
    double height;   /* higher ones lie over lower ones, else later ones
                      * over earlier ones */
} otx_lapped_piece;

typedef struct otx_lapped_paste
{
    otx_lapped_chart chart;
    otx_vec2 centre; /* of the texture patch in the exemplar, texels */
    double size;     /* of what it shows: 1 as large as the exemplar has it */
    otx_lapped_piece *pieces;
    int32_t piece_count;
} otx_lapped_paste;

typedef enum otx_lapped_outline
{
    OTX_LAPPED_OUTLINE_SPLOTCH,
    OTX_LAPPED_OUTLINE_CIRCLE
} otx_lapped_outline;

/* Where slots of faces and vertices lie while a chart grows. */
typedef struct otx_lapped_space
{
    int32_t *face_slot; /* [leaf face_count] chart face or -1 */
    int32_t *vert_slot; /* [leaf vert_count] chart vertex or -1 */
} otx_lapped_space;

/* What a thread that makes a paste has to itself. */
typedef struct otx_lapped_room
{
    otx_lapped_space *space;
    otx_arena *arena;
    const otx_worker *worker; /* asked whether to stop; NULL */
} otx_lapped_room;

typedef struct otx_lapped
{
    const otx_job *job;
    otx_run *run;
    const otx_surface *surface;
    const otx_level *leaf;
    const otx_exemplar *exemplar;
    otx_connection connection;
    otx_guide guide; /* without directions: those of seeds are carried on */
    otx_lapped_settings settings;
    otx_features features;    /* none: pieces are splotches */
    otx_radial *feature_cuts; /* [features.count] */
    double texels;            /* per scene unit */
    otx_samples samples;
    otx_lapped_paste *pastes; /* [paste_count], bottom first */
    int32_t paste_count;
    int32_t paste_capacity;
} otx_lapped;

/* Where a paste begins. */
typedef struct otx_lapped_seed
{
    int32_t face;
    otx_sample_place place; /* on it */
    otx_vec2 heading; /* S in the frame of the face, where no guide says */
} otx_lapped_seed;

/* Where a sample of a leaf face is on the surface. */
otx_vec3 otx_lapped_point(const otx_lapped *l, const otx_sample_place *sample);

/* Grows a chart from a seed until all within `reach` texels lies inside it, and
 * lays it out along the field [Praun00, sec. 3.3, 3.4]. In room->arena. MEMORY,
 * without a finding; CANCELLED. */
otx_status otx_lapped_unfold(
    const otx_lapped *l, const otx_lapped_room *room,
    const otx_lapped_seed *seed, double reach, otx_lapped_chart *out);

/* Makes chart->rim: the border cuts the patch off where it runs inside of the
 * outline, unless the surface ends there. MEMORY, without a finding. */
otx_status otx_lapped_rim(
    const otx_lapped *l, const otx_lapped_room *room, const otx_radial *outline,
    otx_lapped_chart *chart);

/* Texels per scene unit at a leaf face. */
static inline double
otx_lapped_texels(const otx_lapped *l, int32_t face)
{
    const int32_t first = l->leaf->face_first[face];

    return l->texels * otx_surface_density(
                           l->surface, l->leaf->face_verts + first,
                           otx_level_face_size(l->leaf, face));
}

/* A triangle of a chart's face in the plane, and its samples. */
typedef struct otx_lapped_facet
{
    otx_vec2 origin, x, y;
    const otx_vec2 *lattice; /* [count] shares of x and y */
    int32_t count;
    int64_t first; /* of its samples among all */
} otx_lapped_facet;

otx_lapped_facet otx_lapped_facet_at(
    const otx_lapped *l, const otx_lapped_chart *chart, int32_t slot,
    int32_t index);

static inline otx_vec2
otx_lapped_place(const otx_lapped_facet *facet, int32_t sample)
{
    const otx_vec2 w = facet->lattice[sample];

    return (otx_vec2){
        facet->origin.x + w.x * facet->x.x + w.y * facet->y.x,
        facet->origin.y + w.x * facet->x.y + w.y * facet->y.y};
}

/* Leaves out faces of which nothing is nearer to the middle than `reach`; the
 * seed's stays. MEMORY, without a finding. */
otx_status
otx_lapped_trim(otx_arena *arena, double reach, otx_lapped_chart *chart);

/* A copy in memory of its own size. MEMORY, without a finding. */
otx_status otx_lapped_keep(
    otx_arena *arena, const otx_lapped_chart *from, otx_lapped_chart *out);

/* What the pieces of a paste leave of it at a place of its plane. */
double otx_lapped_alpha(const otx_lapped_paste *paste, otx_vec2 at);

/* Marks the samples that a paste covers, and keeps what it shows there. Returns
 * how many it is the first to cover. */
int64_t otx_lapped_mark(
    const otx_lapped *l, const otx_lapped_paste *paste, otx_samples *samples);

/* Lays pieces down until every sample is covered. */
otx_status otx_lapped_paste_all(otx_lapped *l);

/* Makes the mapping of all pastes, without what nobody sees. */
otx_status otx_lapped_compose(const otx_lapped *l, otx_mapping *out);

#endif

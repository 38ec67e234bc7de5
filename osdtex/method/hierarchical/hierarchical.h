/* hierarchical.h -- state of one run of hierarchical pattern mapping.
 *
 * [Soler02] Soler, Cani, Angelidis: Hierarchical Pattern Mapping. SIGGRAPH.
 *
 * The surface is covered by patches, coarse to fine. A patch starts as a
 * cluster; it is flattened with its collar, looked up in the exemplar so that
 * it continues what its neighbours show, and given UVs; a cluster that is not
 * flat or fits nowhere is split. See docs/notes/hierarchical.md. */
#ifndef OTX_METHOD_HIERARCHICAL_H
#define OTX_METHOD_HIERARCHICAL_H

#include "base/pqueue.h"
#include "flatten/chart.h"
#include "match/match.h"
#include "method/method.h"
#include "relax/cut.h"

typedef enum otx_hierarchical_mode
{
    OTX_HIERARCHICAL_BEST,
    OTX_HIERARCHICAL_PAPER
} otx_hierarchical_mode;

enum
{
    OTX_HIERARCHICAL_AUTO = 0, /* of every CHOICE that has it */
    OTX_HIERARCHICAL_GROWN = 1,
    OTX_HIERARCHICAL_SUBDIVISION = 2,
    OTX_HIERARCHICAL_OFF = 1,
    OTX_HIERARCHICAL_ON = 2,
    OTX_HIERARCHICAL_JOINT = 1,
    OTX_HIERARCHICAL_RECURSIVE = 2,
    OTX_HIERARCHICAL_RELAX_OFF = 1,
    OTX_HIERARCHICAL_RELAX_LOOP = 2,
    OTX_HIERARCHICAL_RELAX_GLOBAL = 3
};

/* Meaning, range and default of each: the table in settings.c. */
typedef struct otx_hierarchical_settings
{
    int32_t mode;
    int32_t clusters;
    double patch;
    int32_t flatten;
    double flatness;
    int32_t angles;
    double drift;         /* degrees */
    int32_t continuation; /* 0 avoid, 1 allow */
    int32_t coarse;       /* -1 auto */
    int32_t keep;
    int32_t candidates;
    double band;
    double collar;
    double edges; /* -1 auto */
    double tau;   /* 0 auto */
    double usage;
    int32_t cut;
    int32_t sweeps;
    int32_t relax;
    int32_t relax_rounds;
    double stiffness;
    int32_t guide;
    double transition; /* texels, -1 auto */
} otx_hierarchical_settings;

extern const otx_option otx_hierarchical_options[];
enum
{
    OTX_HIERARCHICAL_OPTION_COUNT = 23
};

/* Replaces every "auto" by what it means for this mode and exemplar. */
void otx_hierarchical_resolve(
    otx_hierarchical_settings *settings, const otx_exemplar *exemplar);

/* Makes settings that were resolved for `first` those of another exemplar: what
 * is as it comes out for the first by itself becomes so for this one. */
void otx_hierarchical_adapt(
    otx_hierarchical_settings *settings, const otx_exemplar *first,
    const otx_exemplar *exemplar);

/* A cluster on its way to becoming a patch. */
typedef struct otx_node
{
    otx_cluster cluster;
    int32_t supply;  /* that it takes from */
    int32_t depth;   /* 0 for the clusters that the run starts with */
    int32_t *leaves; /* [leaf_count] ascending */
    int32_t leaf_count;
    double border;    /* length of its outline inside the surface, texels */
    double textured;  /* of that, beside textured faces */
    int32_t patch;    /* -1 until fitted */
    bool retired;     /* split: its children have its leaves */
    int32_t wave;     /* the last in which it or a neighbour was fitted */
    otx_arena *arena; /* of the chart; NULL until flattened */
    otx_chart chart;
    otx_match placed; /* where the chart lies in the exemplar */
} otx_node;

/* An exemplar, and what is made for it. */
typedef struct otx_supply
{
    const otx_exemplar *exemplar;
    otx_hierarchical_settings settings; /* resolved for it */
    otx_matcher *matcher;
    const otx_guide *guide; /* that its patches follow; NULL none */
    float *usage;           /* see otx_match_query */
    double area;            /* of the leaves that are asked for it */
} otx_supply;

/* One run. Arrays over leaf faces and corners. */
typedef struct otx_mapper
{
    otx_run *run;
    const otx_surface *surface;
    const otx_exemplar *exemplars; /* [supply_count] */
    const otx_map_request *request;
    const otx_method_given *given;      /* NULL none */
    otx_hierarchical_settings settings; /* those of the first exemplar */
    otx_map_stats *stats;
    double texels; /* per scene unit */
    otx_dual leaves;
    otx_dual duals[OTX_LEVEL_MAX + 1]; /* of levels, where made */
    otx_supply supplies[OTX_EXEMPLARS_MAX];
    int32_t supply_count;
    double edge_unit; /* by which edges are weighed in the match; 0 not */
    otx_chart_space *spaces; /* [threads] */

    otx_node *nodes;
    int32_t node_count, node_capacity;
    int32_t *leaf_node;  /* the node that has the leaf now, -1 on holes */
    int32_t *face_patch; /* -1 until textured */
    otx_vec2 *uvs;       /* [leaf corner_count] texels, where textured */
    int32_t patch_count;
    int32_t *patch_node; /* [leaf face_count] */
    otx_offer *offers;   /* [patch_count] */
    int32_t wave_count;  /* so far */
    double done_area;    /* of textured leaves */
    double total_area;

    /* Of several exemplars; else NULL. */
    uint8_t *patch_exemplar; /* [2 leaf face_count] by patch: fitted ones, and
                              * those of unfolded faces */
    double *away;      /* [leaf face_count] texels from where the demand ends,
                        * INFINITY beyond `transition` */
    double transition; /* texels from there within which seams may run */
} otx_mapper;

enum
{
    OTX_USAGE_CELLS = 16, /* a side */
    OTX_WAVE_NODES = 16   /* fitted at the same time, at most */
};

/* supply.c: the exemplars of a run, each with what it needs. */
otx_status otx_supply_prepare(otx_mapper *m);
/* Index of the one that a leaf face is asked for. */
int32_t otx_supply_wanted(const otx_mapper *m, int32_t face);
const otx_supply *otx_supply_of(const otx_mapper *m, const otx_node *node);
int32_t otx_supply_of_patch(const otx_mapper *m, int32_t patch);
/* Whether all leaves of a node are asked for the one that it takes from. */
bool otx_supply_is_pure(const otx_mapper *m, const otx_node *node);
/* Whether a node reaches into the band around where the demand ends. */
bool otx_supply_meets(const otx_mapper *m, const otx_node *node);
/* What it costs in the cut that a node shows a leaf face; negative when it may
 * not. */
float otx_supply_cost(const otx_mapper *m, const otx_node *node, int32_t face);
/* out[supply_count]: what asks for each, in faces of `level`, or of the leaf
 * level where faces of that are divided. */
otx_status otx_supply_regions(otx_mapper *m, int32_t level, otx_cluster *out);

/* first.c: the user's first patch, which is said of a face of the cage. */
/* The node that has that face; -1 none. */
int32_t otx_first_node(const otx_mapper *m);
/* Whether a node is to become it: it has of the face, and nothing is textured.
 */
bool otx_first_is(const otx_mapper *m, const otx_node *node);
/* Whether a leaf is of that face and of that patch, which keeps it. */
bool otx_first_holds(const otx_mapper *m, int32_t leaf);
/* Of what the chart of that patch has of the face. */
otx_vec2 otx_first_middle(const otx_mapper *m, const otx_chart *chart);
/* Direction in the chart of the face's first edge, from its corner 0 to its
 * corner 1; 0 when the chart does not reach both. */
double otx_first_heading(const otx_mapper *m, const otx_chart *chart);
/* The constraints with the direction of the first patch among them, so that a
 * field which patches follow has it too: where the patch shows exemplar k and
 * they say nothing of its face.
 *
 *   angle  of the exemplar, as of otx_guide
 *   out    the request's own or a copy in run->arena; NULL none */
otx_status otx_first_constrain(
    otx_run *run, const otx_surface *surface, const otx_map_request *request,
    int32_t k, double angle, const otx_constraint_set **out);

/* nodes.c: clusters to start with, charts, splitting. */
otx_status otx_nodes_start(otx_mapper *m);
/* Clusters of the size of a patch of `supply` inside `region`, of dual's
 * level. */
otx_status otx_nodes_grow(
    const otx_mapper *m, const otx_supply *supply, const otx_dual *dual,
    const otx_cluster *region, otx_cluster_list *out);
/* Flattens the nodes [first, end), in parallel. */
otx_status otx_nodes_flatten(otx_mapper *m, int32_t first, int32_t end);
/* Whether the node is small and flat enough to be mapped as one patch. */
bool otx_nodes_is_flat(const otx_mapper *m, const otx_node *node);
/* Size of a node, and the widths around it that depend on it, texels. */
double otx_nodes_size(const otx_mapper *m, const otx_node *node);
/* Of the mask at full weight. */
double otx_nodes_band(const otx_mapper *m, const otx_node *node);
/* Of what the chart covers and the cut may take over; the band without cut. */
double otx_nodes_collar(const otx_mapper *m, const otx_node *node);
/* Length of a leaf edge, texels. */
double otx_nodes_edge_length(const otx_mapper *m, int32_t edge);
/* Frees all charts; nodes and charts are gone afterwards. */
void otx_nodes_free(otx_mapper *m);
/* The same when the run's arena dies before that. False when memory is out. */
bool otx_nodes_defer(otx_mapper *m);
/* False when the node is a single leaf face. */
bool otx_nodes_can_split(const otx_mapper *m, const otx_node *node);
/* Retires a node and appends its children, unflattened. */
otx_status otx_nodes_split(otx_mapper *m, int32_t node);

/* Where a node is to be put. */
typedef struct otx_fit
{
    int32_t node;
    bool found;    /* false: it fits nowhere */
    bool searched; /* it had something to match */
    otx_match placed;
} otx_fit;

/* fit.c: looks nodes up in the exemplar, each as if it were alone. With
 * relax=loop their charts are bent; else only `fits` changes.
 *
 *   fits   [count] the nodes in, what was found out
 *   count  >= 1 */
otx_status otx_fit_find(const otx_mapper *m, otx_fit *fits, int32_t count);
/* Makes a patch of a node. False when the error is above tau and the node can
 * be split, or when it fits nowhere. */
bool otx_fit_commit(otx_mapper *m, const otx_fit *fit);

/* wave.c: takes nodes from the queue that may be fitted at the same time.
 *
 *   key    of a node in the queue, the least first
 *   fits   [OTX_WAVE_NODES] the nodes
 *   count  0 when the queue is empty */
double otx_wave_key(const otx_mapper *m, int32_t node);
otx_status
otx_wave_next(otx_mapper *m, otx_pqueue *queue, otx_fit *fits, int32_t *count);

/* given.c: takes over what is textured already. */
void otx_given_take(otx_mapper *m);
/* Clusters of what is not. */
otx_status otx_given_clusters(otx_mapper *m, otx_cluster_list *out);
/* The offers of the given patches, the first of all. */
otx_status otx_given_offers(otx_mapper *m);

/* follow.c: patches that follow the request's guide. Angles are radians. */
enum
{
    OTX_FOLLOW_ANGLES = 13
};
/* Orientations at which a node follows it, into angles[OTX_FOLLOW_ANGLES]; how
 * many there are.
 *
 *   continuing  that which continues the neighbours; NAN none */
int32_t otx_follow_angles(
    const otx_mapper *m, const otx_node *node, double continuing,
    double *angles);
/* Whether a node laid so follows closely enough; true without a guide. */
bool otx_follow_allows(const otx_mapper *m, const otx_node *node, double angle);
/* Between the guide and what a placed node shows on face `i` of its chart. */
double
otx_follow_deviation(const otx_mapper *m, const otx_node *node, int32_t i);

/* straighten.c: sets right triangles without area that came out reversed, as
 * far as no other face suffers. */
otx_status otx_straighten(otx_mapper *m);

/* unfold.c: gives each face with area that is reversed, or has a corner that
 * is, its own shape and a patch of its own. */
void otx_unfold(otx_mapper *m);

/* band.c: cuts a mask triangle where it leaves the band.
 *
 *   reach  of its corners, in the unit of limit
 *   out    what is left, 0 to 2 triangles; the count is returned */
int32_t otx_band_clip(
    const otx_mask_triangle *triangle, const double reach[3], double limit,
    otx_mask_triangle out[2]);
/* Leaves out of a mask the triangles that are not within `sight` of `middle`
 * along both axes; the others keep their order. */
void otx_band_keep_near(
    otx_mask_triangle *triangles, int32_t *count, otx_vec2 middle,
    double sight);

/* continuation.c: the rotation by which the mask's charts of the same exemplar
 * lie in it now, weighted by area: the orientation that continues them. */
double otx_continuation_angle(const otx_mask *mask);
/* The whole placement, error 0. False when there is nothing to continue, or one
 * of the points would leave an exemplar that does not tile. */
bool otx_continuation_place(
    const otx_supply *supply, const otx_mask *mask, const otx_vec2 *points,
    int32_t count, otx_match *out);
/* The same with its error; false, too, where the mask covers no texel. */
bool otx_continuation_match(
    const otx_supply *supply, const otx_mask *mask, const otx_vec2 *points,
    int32_t count, otx_match *out);

/* loop.c: relaxes the placements of an unfitted node and bends its chart by
 * the best one.
 *
 *   count  of placed, at least 1
 *   space, scratch  of the thread
 *   best   with the error that is left along the border; may be &placed[0]
 *
 * MEMORY, without a finding. */
otx_status otx_loop_relax(
    const otx_mapper *m, int32_t node, const otx_match *placed, int32_t count,
    otx_chart_space *space, otx_arena *scratch, otx_match *best);

/* offer.c: what patches can show, and the cut that chooses. */
/* Makes the offer of every patch. */
otx_status otx_offers_make(otx_mapper *m);
/* Re-assigns faces between all offers, and takes their UVs over. */
otx_status otx_offers_cut(otx_mapper *m, otx_cut_stats *stats);

/* assemble.c: cut, relaxation, and the mapping that is handed out. */
otx_status otx_assemble(otx_mapper *m, otx_mapping *out);

#endif

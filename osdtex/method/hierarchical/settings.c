/* settings.c -- what can be set, and what "auto" comes to.
 *
 * `mode=paper` is the method as published: subdivision patches from the cage
 * down, recursive flattening, one candidate, search at full resolution,
 * relaxation of each patch as it is placed. `mode=best` starts from clusters
 * that are as large as the exemplar allows, and mends the seams afterwards. */
#include "method/hierarchical/settings.h"

#define FIELD(member) offsetof(otx_hierarchical_settings, member)

static const char *const MODES[] = {"best", "paper", NULL};
static const char *const CLUSTERS[] = {"auto", "grown", "subdivision", NULL};
static const char *const FLATTEN[] = {"auto", "joint", "recursive", NULL};
static const char *const CONTINUATION[] = {"avoid", "allow", NULL};
static const char *const AUTO_OFF_ON[] = {"auto", "off", "on", NULL};
static const char *const GUIDE[] = {"auto", "off", NULL};
static const char *const RELAX[] = {"auto", "off", "loop", "global", NULL};

const otx_option otx_hierarchical_options[] = {
    {"mode", OTX_OPTION_CHOICE, FIELD(mode), 0, 0, 0, MODES,
     "best: large patches, cut and relaxed together; paper: the method as "
     "published, patch by patch"},
    {"clusters", OTX_OPTION_CHOICE, FIELD(clusters), 0, 0, 0, CLUSTERS,
     "What patches start from: clusters grown over the hierarchy, or the "
     "faces of the cage and their subdivision; auto follows mode, and grows "
     "them on plain meshes"},
    {"patch", OTX_OPTION_REAL, FIELD(patch), 0, 4096, 0, NULL,
     "Diameter that grown clusters aim for, in texels; 0 follows the "
     "exemplar"},
    {"flatten", OTX_OPTION_CHOICE, FIELD(flatten), 0, 0, 0, FLATTEN,
     "joint: patch and collar as rigid as possible; recursive: the paper's "
     "barycentric control polygons; auto follows mode"},
    {"flatness", OTX_OPTION_REAL, FIELD(flatness), 0, 4, 0, NULL,
     "RMS stretch above which a cluster is split before it is mapped, of "
     "recursive flattening 1 + E_flat; 1 is isometric, 0 follows mode (best "
     "1.2, paper 1.12)"},
    {"angles", OTX_OPTION_INTEGER, FIELD(angles), 0, 360, 0, NULL,
     "Orientations tried for each patch; 0: 9 for a drift of less than 90, "
     "else 19"},
    {"drift", OTX_OPTION_REAL, FIELD(drift), 0, 180, 0, NULL,
     "Degrees by which a patch may be turned against those that it continues, "
     "so that the first one's direction spreads; 180 any, 0 follows mode (best "
     "25, paper 180)"},
    {"continuation", OTX_OPTION_CHOICE, FIELD(continuation), 0, 0, 0,
     CONTINUATION,
     "allow: a patch may continue its neighbour's chart exactly, which shows "
     "no seam and repeats a tiling exemplar; avoid: orientations are drawn at "
     "random, within drift none that continues it"},
    {"coarse", OTX_OPTION_INTEGER, FIELD(coarse), -1, 6, -1, NULL,
     "Halvings of the exemplar for the exhaustive search; -1 chooses about "
     "64 texels (paper: 0)"},
    {"keep", OTX_OPTION_INTEGER, FIELD(keep), 1, OTX_MATCH_MAX_KEEP, 16, NULL,
     "Matches of the coarse search that are refined at full resolution"},
    {"candidates", OTX_OPTION_INTEGER, FIELD(candidates), 1, 16, 1, NULL,
     "Placements of a patch that are compared after refinement, and after "
     "relax=loop"},
    {"band", OTX_OPTION_REAL, FIELD(band), 0.02, 1, 0.2, NULL,
     "Width of the mask as a share of the patch's size"},
    {"collar", OTX_OPTION_REAL, FIELD(collar), 0, 2, 0.5, NULL,
     "Width around a patch that it may take over in the cut, as a share of "
     "its size"},
    {"edges", OTX_OPTION_REAL, FIELD(edges), -1, 4, -1, NULL,
     "Weight of edges beside colour where matches are looked up, so that "
     "structure continues as well; -1 follows mode (best 0.7, paper 0)"},
    {"tau", OTX_OPTION_REAL, FIELD(tau), 0, 100, 0, NULL,
     "Fitting error above which a patch is split, in units of two random "
     "texels' difference; 0 chooses by the exemplar's contrast"},
    {"usage", OTX_OPTION_REAL, FIELD(usage), -1, 10, -1, NULL,
     "Penalty for parts of the exemplar that were used before, against "
     "motifs that recur; -1 follows mode (best 0.5, paper 0)"},
    {"cut", OTX_OPTION_CHOICE, FIELD(cut), 0, 0, 0, AUTO_OFF_ON,
     "Move the borders between patches to where their textures agree; auto "
     "follows mode"},
    {"sweeps", OTX_OPTION_INTEGER, FIELD(sweeps), 1, 10, 3, NULL,
     "Rounds of the cut over all patches"},
    {"relax", OTX_OPTION_CHOICE, FIELD(relax), 0, 0, 0, RELAX,
     "loop: each patch's border as it is placed; global: all patches together "
     "at the end; auto follows mode"},
    {"relax-rounds", OTX_OPTION_INTEGER, FIELD(relax_rounds), 1, 100, 12, NULL,
     "Rounds of the global relaxation"},
    {"stiffness", OTX_OPTION_REAL, FIELD(stiffness), 1e-3, 100, 0.3, NULL,
     "How strongly the global relaxation resists stretch, against colour "
     "difference across seams"},
    {"guide", OTX_OPTION_CHOICE, FIELD(guide), 0, 0, 0, GUIDE,
     "auto: patches of an exemplar that has a direction follow a direction "
     "field on the surface, in mode best; off: none do"},
    {"transition", OTX_OPTION_REAL, FIELD(transition), -1, 4096, -1, NULL,
     "Of several exemplars: texels on either side of where one is asked for "
     "beside another, within which the seam between them may run; beyond, "
     "everything is as asked for; -1: an eighth of the first exemplar's "
     "shorter side"},
};

_Static_assert(
    sizeof otx_hierarchical_options / sizeof otx_hierarchical_options[0] ==
        OTX_HIERARCHICAL_OPTION_COUNT,
    "the header says how long the table is");

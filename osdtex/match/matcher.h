/* matcher.h -- inside of the matcher: its pyramid, and which placements keep
 * a patch inside an exemplar that does not tile. */
#ifndef OTX_MATCH_MATCHER_H
#define OTX_MATCH_MATCHER_H

#include "match/mask.h"
#include "match/plane.h"

enum
{
    OTX_MATCHER_MAX_LEVELS = 12
};

struct otx_matcher
{
    int32_t width;
    int32_t height;
    bool wrap_x;
    bool wrap_y;
    double sigma;
    double mean[OTX_PLANE_LANES]; /* that all planes have subtracted */
    int32_t finest_level;         /* first with spectra */
    int32_t level_count;
    otx_vec2 overhang; /* texels by which a mask may reach over the rim; 0
                        * along axes that tile */
    otx_plane planes[OTX_MATCHER_MAX_LEVELS];
};

/* Where colours of a mask triangle are read, that is compared with `plane`. */
static inline const otx_plane *
otx_matcher_source(const otx_matcher *from, const otx_plane *plane)
{
    if (!from)
        return plane;
    return &from->planes
                [plane->level < from->level_count ? plane->level
                                                  : from->level_count - 1];
}

/* Closed intervals of valid shifts, texels; infinite along axes that tile,
 * empty (low > high) where nothing fits. */
typedef otx_mask_box otx_matcher_range;

otx_matcher_range otx_matcher_shifts(
    const otx_matcher *matcher, const otx_mask *mask,
    const otx_match_query *query, double angle);

static inline bool
otx_matcher_allows(const otx_matcher_range *range, otx_vec2 shift)
{
    return shift.x >= range->low.x && shift.x <= range->high.x &&
           shift.y >= range->low.y && shift.y <= range->high.y;
}

/* Row or column of the usage grid that texel coordinate `x` falls in. */
static inline int32_t
otx_matcher_usage_cell(double x, int32_t size, bool wrap, int32_t cells)
{
    const int32_t cell =
        (int32_t)(otx_plane_wrap(x, size, wrap) / size * cells);

    return cell < cells ? cell : cells - 1;
}

/* The same squared error as otx_matcher_score, mean per unit of weight, not
 * divided by sigma; INFINITY when the mask covers no texel. */
double otx_matcher_square(
    const otx_matcher *matcher, const otx_mask *mask,
    const otx_match *placement);

#endif

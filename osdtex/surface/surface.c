/* surface.c -- a cage, its levels, and the limit of the finest one.
 *
 * What a level costs is known before it is made: element counts follow from
 * the cage's, and the bytes of OpenSubdiv's tables were fitted to what it
 * allocates (docs/notes/surface.md). So a job that would not fit is refused at
 * once instead of after minutes. */
#include "surface/surface.h"

#include "surface/limit.h"
#include "surface/plain.h"
#include "surface/refine.h"

#include <math.h>

#define STAGE "refine"

/* Element counts as double: a level that no index can number must not wrap. */
typedef struct counts
{
    double faces, verts, edges, corners;
} counts;

static counts
count_level(const otx_cage *cage, int32_t level)
{
    counts n = {
        cage->face_count, (double)cage->vert_count + cage->split_count,
        cage->edge_count, cage->corner_count};

    for (int32_t l = 0; l < level; ++l)
    {
        if (cage->scheme == OTX_SCHEME_LOOP)
        {
            n.verts += n.edges;
            n.edges = 2.0 * n.edges + 3.0 * n.faces;
            n.faces *= 4.0;
            n.corners = 3.0 * n.faces;
        }
        else
        {
            n.verts += n.edges + n.faces;
            n.edges = 2.0 * n.edges + n.corners;
            n.faces = n.corners;
            n.corners = 4.0 * n.faces;
        }
    }
    return n;
}

/* Bytes of otx_level's arrays, children included. */
static double
level_bytes(counts n)
{
    return 8.0 * n.corners + 20.0 * n.edges + 21.0 * n.faces;
}

/* Bytes of what is kept and used at the last level besides: points, normals,
 * tangents, two turns of refined points, UVs and their turns. */
static double
leaf_bytes(const otx_cage *cage, counts n)
{
    const double uvs =
        cage->uv_count > 0 ? 4.0 * n.corners + 24.0 * n.verts : 0.0;

    return (12.0 + 12.0 + 24.0 + 16.0) * n.verts + uvs;
}

/* Bytes of OpenSubdiv's tables of a level with full topology: relations both
 * ways, tags, and child indices. */
static double
osd_bytes(const otx_cage *cage, counts n)
{
    const double uvs = cage->uv_count > 0 ? 8.0 * n.corners : 0.0;

    return 12.0 * n.corners + 44.0 * n.edges + 40.0 * n.verts + 24.0 * n.faces +
           uvs;
}

static double
predict_bytes(const otx_cage *cage, int32_t level)
{
    const bool plain = cage->scheme == OTX_SCHEME_NONE;
    const int32_t kept = plain ? 0 : level;
    const int32_t depth = plain ? 0 : level > 0 ? level : 1;
    double bytes = leaf_bytes(cage, count_level(cage, depth));

    for (int32_t l = 0; l <= kept; ++l)
        bytes += level_bytes(count_level(cage, l));
    for (int32_t l = 0; !plain && l <= depth; ++l)
        bytes += osd_bytes(cage, count_level(cage, l));
    return bytes;
}

double
otx_surface_face_count(const otx_cage *cage, int32_t level)
{
    return count_level(cage, cage->scheme == OTX_SCHEME_NONE ? 0 : level).faces;
}

size_t
otx_surface_bytes(const otx_cage *cage, int32_t level)
{
    const double bytes = predict_bytes(cage, level);

    return bytes < (double)SIZE_MAX ? (size_t)bytes : SIZE_MAX;
}

/* Whether the elements of a level can be numbered and its bytes spent. */
static bool
fits(const otx_cage *cage, int32_t level, size_t memory_limit)
{
    const bool plain = cage->scheme == OTX_SCHEME_NONE;
    const counts n = count_level(cage, plain ? 0 : level > 0 ? level : 1);

    /* Pairs and tangents are indexed in 32 bits. */
    if (2.0 * n.edges > INT32_MAX || n.verts + n.corners > INT32_MAX ||
        2.0 * n.verts > INT32_MAX)
        return false;
    return memory_limit == 0 ||
           predict_bytes(cage, level) <= (double)memory_limit;
}

otx_status
otx_surface_check_level(
    otx_run *run, const otx_cage *cage, int32_t level, size_t memory_limit)
{
    const double gib = 1024.0 * 1024.0 * 1024.0;
    otx_where where = OTX_NOWHERE;
    int32_t best = level - 1;

    where.file = cage->path;
    if (level < 0 || level > OTX_LEVEL_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "level %d does not exist; it goes from 0 to %d", level,
            OTX_LEVEL_MAX);
    if (cage->scheme == OTX_SCHEME_NONE && level != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "a plain mesh is not subdivided, so its level is 0 and not %d; to "
            "subdivide it use {scheme} catmark, loop or bilinear",
            level);
    if (fits(cage, level, memory_limit))
        return OSDTEX_OK;
    while (best >= 0 && !fits(cage, best, memory_limit))
        --best;
    if (best < 0)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, where,
            "the cage alone needs about %.2f GiB; raise {memory-limit}",
            predict_bytes(cage, 0) / gib);
    return otx_fail(
        run, OSDTEX_ERROR_LIMIT, STAGE, where,
        "level %d has %.0f faces and needs about %.1f GiB, over the limit; "
        "use {level} %d or raise {memory-limit}",
        level, count_level(cage, level).faces, predict_bytes(cage, level) / gib,
        best);
}

/* With no boundary rule, OpenSubdiv makes holes of all faces at a boundary. */
static otx_status
check_holes(otx_run *run, const otx_cage *cage, const otx_level *level)
{
    otx_where where = OTX_NOWHERE;

    where.file = cage->path;
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        if (!level->face_hole[f])
            return OSDTEX_OK;
    }
    return otx_fail(
        run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
        "the boundary rule none makes every face a hole; use {boundary} "
        "edgeAndCorner");
}

/* Debug builds look at every result; release builds trust the tests. */
#ifdef NDEBUG
static const bool validate_always = false;
#else
static const bool validate_always = true;
#endif

static otx_status
finish(otx_run *run, otx_surface *surface, float *tangents)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    float *normals = OTX_NEW(run->arena, float, 3 * (size_t)leaf->vert_count);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_progress(run, STAGE, 0.9));
    OTX_TRY(otx_limit_frames(run, leaf, surface->points, tangents, normals));
    surface->normals = normals;
    OTX_TRY(otx_limit_measure(
        run, leaf, surface->points, &surface->area,
        &surface->mean_edge_length));
    if (validate_always)
        OTX_TRY(otx_surface_validate(run, surface));
    return otx_progress(run, STAGE, 1.0);
}

otx_status
otx_surface_refine(
    otx_run *run, const otx_cage *cage, int32_t level, size_t memory_limit,
    otx_surface *out)
{
    const bool plain = cage->scheme == OTX_SCHEME_NONE;
    otx_surface surface = {0};
    float *tangents;

    *out = (otx_surface){0};
    OTX_TRY(otx_surface_check_level(run, cage, level, memory_limit));
    OTX_TRY(otx_progress(run, STAGE, 0.0));
    OTX_TRY(
        plain ? otx_plain_cage(run, cage, &surface, &tangents)
              : otx_refine_cage(run, cage, level, &surface, &tangents));
    OTX_TRY(check_holes(run, cage, &surface.levels[0]));
    OTX_TRY(finish(run, &surface, tangents));
    *out = surface;
    return OSDTEX_OK;
}

int32_t
otx_surface_level_for(const otx_cage *cage, double length)
{
    double edge = cage->mean_edge_length;
    int32_t level = 0;

    if (cage->scheme == OTX_SCHEME_NONE)
        return 0;
    while (level < OTX_LEVEL_MAX && edge > M_SQRT2 * length)
    {
        edge *= 0.5;
        ++level;
    }
    if (level == 0 && cage->scheme != OTX_SCHEME_LOOP)
    {
        for (int32_t f = 0; f < cage->face_count; ++f)
        {
            if (cage->face_first[f + 1] - cage->face_first[f] != 4)
                return 1;
        }
    }
    return level;
}

void
otx_surface_leaves(
    const otx_surface *surface, int32_t level, int32_t face, int32_t *first,
    int32_t *end)
{
    *first = face;
    *end = face + 1;
    for (int32_t l = level; l < surface->level_count - 1; ++l)
    {
        *first = surface->levels[l].face_child_first[*first];
        *end = surface->levels[l].face_child_first[*end];
    }
}

/* refine.c -- the levels and the limit of a cage, through OpenSubdiv.
 *
 * OpenSubdiv refines on one thread. What follows it is independent: the
 * positions down the levels to the limit, the UVs likewise, and the copies of
 * the relations. The pool takes the two long chains first and fills the rest
 * of its threads with copies, cut into ranges.
 *
 * The limit of an n-gon's vertex is defined only after one refinement, so a
 * surface of level 0 refines once all the same and keeps the vertices that
 * come from vertices: they are the first ones. */
#include "surface/refine.h"

#include "bridge/opensubdiv.h"
#include "surface/pinch.h"

#include <string.h>

#define STAGE "refine"

enum
{
    RANGE = 32768 /* elements of one copy task */
};

typedef enum task_kind
{
    TASK_POINTS,
    TASK_UVS,
    TASK_PREFIX,
    TASK_FACES,
    TASK_EDGES
} task_kind;

typedef struct task
{
    task_kind kind;
    int32_t level;
    otx_osd_range range;
} task;

typedef struct refinement
{
    const otx_cage *cage; /* parted at its pinch vertices */
    const otx_osd *osd;
    int32_t level; /* asked for */
    int32_t depth; /* refined to: the level, and at least 1 */
    otx_osd_counts counts[OTX_LEVEL_MAX + 1];
    otx_osd_relations relations[OTX_LEVEL_MAX + 1];
    int32_t *face_cage[OTX_LEVEL_MAX + 1];
    /* Of the depth: three floats a vertex and two a value, refined there and
     * one level above, by turns; then on the limit. */
    float *point_turns[2];
    float *uv_turns[2];
    float *points;
    float *tangents;
    float *uvs;
    task *tasks;
    int64_t task_count;
} refinement;

/* The buffer of a level: that of the depth is the first. */
static int32_t
turn_of(const refinement *r, int32_t level)
{
    return (r->depth - level) & 1;
}

static otx_status
eval_points(const refinement *r, const otx_worker *worker)
{
    const float *from = r->cage->points;

    for (int32_t level = 1; level <= r->depth; ++level)
    {
        float *to = r->point_turns[turn_of(r, level)];

        OTX_TRY(otx_worker_look(worker));
        OTX_TRY(otx_osd_refine_points(r->osd, level, from, to));
        from = to;
    }
    OTX_TRY(otx_worker_look(worker));
    return otx_osd_limit_points(r->osd, from, r->points, r->tangents);
}

static otx_status
eval_uvs(const refinement *r, const otx_worker *worker)
{
    const float *from = r->cage->uvs;

    for (int32_t level = 1; level <= r->depth; ++level)
    {
        float *to = r->uv_turns[turn_of(r, level)];

        OTX_TRY(otx_worker_look(worker));
        OTX_TRY(otx_osd_refine_uvs(r->osd, level, from, to));
        from = to;
    }
    return otx_osd_limit_uvs(r->osd, from, r->uvs);
}

static otx_status
run_task(void *context, int64_t index, otx_worker *worker)
{
    const refinement *r = context;
    const task *t = &r->tasks[index];
    const otx_osd_relations *relations = &r->relations[t->level];

    switch (t->kind)
    {
    case TASK_POINTS:
        return eval_points(r, worker);
    case TASK_UVS:
        return eval_uvs(r, worker);
    case TASK_PREFIX:
        return otx_osd_check_prefix(r->osd, t->level);
    case TASK_FACES:
        return otx_osd_export_faces(r->osd, t->level, t->range, relations);
    default:
        return otx_osd_export_edges(r->osd, t->level, t->range, relations);
    }
}

static void
add_ranges(refinement *r, task_kind kind, int32_t level, int32_t count)
{
    for (int32_t first = 0; first < count;)
    {
        const int32_t end = count - first > RANGE ? first + RANGE : count;

        r->tasks[r->task_count++] = (task){kind, level, {first, end}};
        first = end;
    }
}

/* Long tasks first, so that no thread is left with one at the end. */
static bool
list_tasks(otx_arena *scratch, refinement *r)
{
    int64_t capacity = 2;

    for (int32_t l = 0; l <= r->depth; ++l)
        capacity += 3 + r->counts[l].faces / RANGE + r->counts[l].edges / RANGE;
    r->tasks = OTX_NEW(scratch, task, capacity);
    if (!r->tasks)
        return false;
    r->tasks[r->task_count++] = (task){TASK_POINTS, 0, {0, 0}};
    if (r->cage->uv_count > 0)
        r->tasks[r->task_count++] = (task){TASK_UVS, 0, {0, 0}};
    for (int32_t l = r->level; l >= 0; --l)
    {
        add_ranges(r, TASK_FACES, l, r->counts[l].faces);
        add_ranges(r, TASK_EDGES, l, r->counts[l].edges);
    }
    for (int32_t l = 0; l < r->depth; ++l)
        r->tasks[r->task_count++] = (task){TASK_PREFIX, l, {0, 0}};
    return true;
}

/* Corners of a level: the cage's own, then all of one size. */
static const int32_t *
face_offsets(otx_arena *arena, const refinement *r, int32_t level)
{
    const int32_t size = r->cage->scheme == OTX_SCHEME_LOOP ? 3 : 4;
    const int32_t count = r->counts[level].faces;
    int32_t *first;

    if (level == 0)
        return r->cage->face_first;
    first = OTX_NEW(arena, int32_t, (size_t)count + 1);
    for (int32_t f = 0; first && f <= count; ++f)
        first[f] = f * size;
    return first;
}

/* Arrays for the relations of one level.
 *
 *   is_leaf  the last level: no children, and UVs when the cage has them */
static bool
allocate_level(otx_arena *arena, refinement *r, int32_t level, bool is_leaf)
{
    const otx_osd_counts n = r->counts[level];
    otx_osd_relations *to = &r->relations[level];
    const bool has_uvs = is_leaf && r->cage->uv_count > 0;

    *to = (otx_osd_relations){
        .face_first = face_offsets(arena, r, level),
        .face_verts = OTX_NEW(arena, int32_t, n.corners),
        .face_edges = OTX_NEW(arena, int32_t, n.corners),
        .edge_verts = OTX_NEW(arena, int32_t, 2 * (size_t)n.edges),
        .edge_faces = OTX_NEW(arena, int32_t, 2 * (size_t)n.edges),
        .face_hole = OTX_NEW(arena, uint8_t, n.faces)};
    r->face_cage[level] = OTX_NEW(arena, int32_t, n.faces);
    if (level > 0)
        to->face_parent = OTX_NEW(arena, int32_t, n.faces);
    if (!is_leaf)
    {
        to->face_child_first = OTX_NEW(arena, int32_t, (size_t)n.faces + 1);
        to->face_child_vert = OTX_NEW(arena, int32_t, n.faces);
        to->edge_child_vert = OTX_NEW(arena, int32_t, n.edges);
    }
    if (has_uvs)
        to->face_uvs = OTX_NEW(arena, int32_t, n.corners);
    return to->face_first && to->face_verts && to->face_edges &&
           to->edge_verts && to->edge_faces && to->face_hole &&
           r->face_cage[level] && (level == 0 || to->face_parent) &&
           (is_leaf || (to->face_child_first && to->face_child_vert &&
                        to->edge_child_vert)) &&
           (!has_uvs || to->face_uvs);
}

/* Buffers of the evaluation. What a deeper refinement than asked for yields
 * is a temporary. */
static bool
allocate_values(otx_run *run, refinement *r)
{
    const otx_osd_counts *n = &r->counts[r->depth];
    otx_arena *kept = r->depth == r->level ? run->arena : run->scratch;

    r->points = OTX_NEW(kept, float, 3 * (size_t)n->verts);
    r->tangents = OTX_NEW(kept, float, 6 * (size_t)n->verts);
    r->uvs = OTX_NEW(kept, float, 2 * (size_t)n->uvs);
    for (int32_t i = 0; i < 2; ++i)
    {
        r->point_turns[i] =
            OTX_NEW(run->scratch, float, 3 * (size_t)n[-i].verts);
        r->uv_turns[i] = OTX_NEW(run->scratch, float, 2 * (size_t)n[-i].uvs);
    }
    return r->points && r->tangents && r->uvs && r->point_turns[0] &&
           r->point_turns[1] && r->uv_turns[0] && r->uv_turns[1];
}

static bool
allocate(otx_run *run, refinement *r)
{
    for (int32_t l = 0; l <= r->level; ++l)
    {
        if (!allocate_level(run->arena, r, l, l == r->level))
            return false;
    }
    return allocate_values(run, r);
}

/* A face's ancestor in the cage. */
static void
fill_ancestors(const refinement *r)
{
    for (int32_t f = 0; f < r->counts[0].faces; ++f)
        r->face_cage[0][f] = f;
    for (int32_t l = 1; l <= r->level; ++l)
    {
        for (int32_t f = 0; f < r->counts[l].faces; ++f)
            r->face_cage[l][f] =
                r->face_cage[l - 1][r->relations[l].face_parent[f]];
    }
}

/* Limit values of the cage's UVs, from those of level 1: the corner of a child
 * at the parent's vertex has the parent's value there.
 *
 *   child  relations of level 1
 *   uvs    [cage->uv_count * 2], filled where a corner refers */
static void
gather_uvs(const refinement *r, const otx_osd_relations *child, float *uvs)
{
    const int32_t face_count = r->counts[1].faces;

    for (int32_t c = 0; c < face_count; ++c)
    {
        const int32_t parent = child->face_parent[c];
        const int32_t first = r->cage->face_first[parent];
        const int32_t end = r->cage->face_first[parent + 1];

        for (int32_t i = child->face_first[c]; i < child->face_first[c + 1];
             ++i)
        {
            for (int32_t k = first; k < end; ++k)
            {
                if (r->cage->face_verts[k] == child->face_verts[i])
                    memcpy(
                        uvs + 2 * (size_t)r->cage->face_uvs[k],
                        r->uvs + 2 * (size_t)child->face_uvs[i],
                        2 * sizeof *uvs);
            }
        }
    }
}

/* Keeps of level 1 what belongs to level 0. */
static otx_status
keep_level_0(otx_run *run, refinement *r)
{
    const size_t verts = (size_t)r->cage->vert_count;
    const size_t uv_count = (size_t)r->cage->uv_count;
    const otx_osd_range all = {0, r->counts[1].faces};
    float *points = OTX_NEW(run->arena, float, 3 * verts);
    float *tangents = OTX_NEW(run->arena, float, 6 * verts);
    float *uvs = OTX_ZNEW(run->arena, float, 2 * uv_count);

    if (!points || !tangents || !uvs)
        return OSDTEX_ERROR_MEMORY;
    memcpy(points, r->points, 3 * verts * sizeof *points);
    memcpy(tangents, r->tangents, 6 * verts * sizeof *tangents);
    if (uv_count > 0)
    {
        if (!allocate_level(run->scratch, r, 1, true))
            return OSDTEX_ERROR_MEMORY;
        OTX_TRY(otx_osd_export_faces(r->osd, 1, all, &r->relations[1]));
        gather_uvs(r, &r->relations[1], uvs);
    }
    r->points = points;
    r->tangents = tangents;
    r->uvs = uvs;
    return OSDTEX_OK;
}

/* A vertex without faces stays where the artist put it. */
static void
pin_isolated(const refinement *r, uint8_t *used)
{
    for (int32_t i = 0; i < r->cage->corner_count; ++i)
        used[r->cage->face_verts[i]] = 1;
    for (int32_t v = 0; v < r->cage->vert_count; ++v)
    {
        const size_t at = 3 * (size_t)v;

        if (used[v])
            continue;
        memcpy(r->points + at, r->cage->points + at, 3 * sizeof *r->points);
        memset(r->tangents + 2 * at, 0, 6 * sizeof *r->tangents);
    }
}

/*   cage  as it came, pinch vertices and all */
static otx_status
publish(
    otx_run *run, const refinement *r, const otx_cage *cage, otx_surface *out)
{
    otx_level *levels = OTX_NEW(run->arena, otx_level, r->level + 1);
    const bool own_uvs = r->level > 0;

    if (!levels)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t l = 0; l <= r->level; ++l)
    {
        const otx_osd_relations *from = &r->relations[l];

        levels[l] = (otx_level){
            .face_count = r->counts[l].faces,
            .vert_count = r->counts[l].verts,
            .edge_count = r->counts[l].edges,
            .corner_count = r->counts[l].corners,
            .face_first = from->face_first,
            .face_verts = from->face_verts,
            .face_edges = from->face_edges,
            .edge_verts = from->edge_verts,
            .edge_faces = from->edge_faces,
            .face_parent = from->face_parent,
            .face_child_first = from->face_child_first,
            .face_child_vert = from->face_child_vert,
            .edge_child_vert = from->edge_child_vert,
            .face_hole = from->face_hole,
            .face_cage = r->face_cage[l]};
    }
    *out = (otx_surface){
        .cage = cage,
        .level_count = r->level + 1,
        .levels = levels,
        .points = r->points,
        .tangents = r->tangents,
        .uv_count = own_uvs ? r->counts[r->level].uvs : r->cage->uv_count,
        .uvs = r->uvs,
        .face_uvs =
            own_uvs ? r->relations[r->level].face_uvs : r->cage->face_uvs};
    return OSDTEX_OK;
}

/* The cage as the bridge wants it; false when memory is out. */
static bool
describe(otx_arena *scratch, const otx_cage *cage, otx_osd_mesh *out)
{
    int32_t *sizes = OTX_NEW(scratch, int32_t, cage->face_count);
    int32_t *holes = OTX_NEW(scratch, int32_t, cage->face_count);
    int32_t hole_count = 0;

    if (!sizes || !holes)
        return false;
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        sizes[f] = cage->face_first[f + 1] - cage->face_first[f];
        if (cage->face_hole[f])
            holes[hole_count++] = f;
    }
    *out = (otx_osd_mesh){
        .scheme = cage->scheme == OTX_SCHEME_LOOP       ? OTX_OSD_LOOP
                  : cage->scheme == OTX_SCHEME_BILINEAR ? OTX_OSD_BILINEAR
                                                        : OTX_OSD_CATMARK,
        .boundary = (int32_t)cage->boundary,
        .fvar = (int32_t)cage->fvar,
        .crease_chaikin = cage->crease_chaikin,
        .triangles_smooth = cage->triangles_smooth,
        .vert_count = cage->vert_count,
        .face_count = cage->face_count,
        .face_sizes = sizes,
        .face_verts = cage->face_verts,
        .crease_count = cage->crease_count,
        .crease_verts = cage->crease_verts,
        .crease_sharpness = cage->crease_sharpness,
        .corner_tag_count = cage->corner_tag_count,
        .corner_tag_verts = cage->corner_tag_verts,
        .corner_tag_sharpness = cage->corner_tag_sharpness,
        .hole_count = hole_count,
        .holes = holes,
        .uv_count = cage->uv_count,
        .face_uvs = cage->face_uvs};
    return true;
}

static otx_status
refine_topology(otx_run *run, refinement *r)
{
    otx_osd_mesh mesh;
    otx_osd *osd;

    if (!describe(run->scratch, r->cage, &mesh))
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(otx_osd_create(run->scratch, &mesh, &osd));
    OTX_TRY(otx_progress(run, STAGE, 0.1));
    OTX_TRY(otx_osd_refine(osd, r->depth));
    for (int32_t l = 0; l <= r->depth; ++l)
        r->counts[l] = otx_osd_counts_at(osd, l);
    r->osd = osd;
    return otx_progress(run, STAGE, 0.5);
}

static otx_status
refine(otx_run *run, const otx_cage *cage, refinement *r, otx_surface *out)
{
    otx_cage parted;
    uint8_t *used;

    OTX_TRY(otx_pinch_split(run, cage, &parted));
    r->cage = &parted;
    used = OTX_ZNEW(run->scratch, uint8_t, parted.vert_count);
    if (!used)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(refine_topology(run, r));
    if (!allocate(run, r) || !list_tasks(run->scratch, r))
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(otx_progress(run, STAGE, 0.6));
    OTX_TRY(otx_pool_for(run->pool, r->task_count, run_task, r));
    OTX_TRY(otx_progress(run, STAGE, 0.8));
    fill_ancestors(r);
    if (r->depth > r->level)
        OTX_TRY(keep_level_0(run, r));
    pin_isolated(r, used);
    return publish(run, r, cage, out);
}

otx_status
otx_refine_cage(
    otx_run *run, const otx_cage *cage, int32_t level, otx_surface *out,
    float **tangents)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    refinement r = {.level = level, .depth = level > 0 ? level : 1};
    otx_where where = OTX_NOWHERE;
    const otx_status status = refine(run, cage, &r, out);

    otx_arena_release(run->scratch, mark);
    *tangents = r.tangents;
    where.file = cage->path;
    switch (status)
    {
    case OSDTEX_OK:
    case OSDTEX_ERROR_CANCELLED:
        return status;
    case OSDTEX_ERROR_MEMORY:
        return otx_fail_memory(run, STAGE);
    case OSDTEX_ERROR_TOPOLOGY:
        return otx_fail(
            run, status, STAGE, where,
            "OpenSubdiv refuses this cage; clean it up in a modeller and "
            "export it again");
    default:
        return otx_fail(
            run, status, STAGE, where,
            "OpenSubdiv's levels are not ordered as osdtex needs them; build "
            "against OpenSubdiv 3.5");
    }
}

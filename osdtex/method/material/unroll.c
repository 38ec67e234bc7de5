/* unroll.c -- the length of strips.
 *
 * The direction along a strip is at right angles to the gradient across it;
 * the coordinate along is what has this direction, a texel to a texel, as its
 * gradient in the least squares sense. A strip that meets itself is torn where
 * the way round ends, and closed again after a length that the exemplar has. */
#include "method/material/strips.h"

#include "method/material/solved_face.h"

#include "base/union_find.h"
#include "mapping/seam.h"
#include "math/sparse.h"

#include <stdlib.h>

/* Faces that are this far apart, in courses, do not lie side by side. */
static const double APART = 0.75;

/* How much farther than once round a ring may reach as it is first laid. */
static const double ONCE = 1.25;

/* Holds the free constant of a strip; relative to weights of about one. */
static const double GROUND = 1e-7;

/* Cotangents below this are raised to it. */
static const double WEIGHT_MIN = 0.02;

/* -- one face ------------------------------------------------------------ */

/* Texels along, per scene unit, in the frame of the face. */
static otx_vec2
heading(const otx_strips *s, int32_t face)
{
    const otx_vec2 r = s->rise[face];
    const double size =
        s->sense[face] * otx_material_density(s->m, face) / otx_vec2_length(r);

    return (otx_vec2){size * r.y, -size * r.x};
}

/* Lays a face so that its corner `from` lies at `value`. */
static void
lay_face(otx_strips *s, int32_t face, int32_t from, double value)
{
    const otx_level *leaf = s->leaf.level;
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    const otx_vec2 d = heading(s, face);

    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t at = first + (from - first + k) % size;

        s->along[at] = value;
        value += otx_vec2_dot(d, s->leaf.sides[at]);
    }
}

/* Texels from the first face of an edge to the second, as they are laid. */
static double
lag_across(const otx_strips *s, int32_t edge)
{
    const int32_t *f = s->leaf.level->edge_faces + 2 * (size_t)edge;
    int32_t a[2], b[2];

    otx_seam_corners(s->leaf.level, edge, f[0], a);
    otx_seam_corners(s->leaf.level, edge, f[1], b);
    return 0.5 *
           (s->along[b[0]] + s->along[b[1]] - s->along[a[0]] - s->along[a[1]]);
}

/* -- the way round ------------------------------------------------------- */

static double
apart(const otx_strips *s)
{
    return APART * s->m->cell * s->m->texels;
}

/* Moves a face, which lies somewhere, to where its neighbours have it that
 * agree with the first of them. */
static void
join_face(otx_strips *s, int32_t face, const uint8_t *laid)
{
    const otx_level *leaf = s->leaf.level;
    double first = 0.0, sum = 0.0;
    int32_t count = 0;

    for (int32_t i = leaf->face_first[face]; i < leaf->face_first[face + 1];
         ++i)
    {
        const int32_t e = leaf->face_edges[i];
        const int32_t *f = leaf->edge_faces + 2 * (size_t)e;
        double lag;

        if (abs(s->edges[e]) != 1 || !laid[f[f[0] == face]])
            continue;
        lag = f[0] == face ? lag_across(s, e) : -lag_across(s, e);
        if (count == 0)
            first = lag;
        if (fabs(lag - first) > apart(s))
            continue;
        sum += lag;
        ++count;
    }
    for (int32_t i = leaf->face_first[face];
         count > 0 && i < leaf->face_first[face + 1]; ++i)
        s->along[i] += sum / count;
}

/* Lays the faces of all strips one after the other. */
static otx_status
lay_all(otx_strips *s)
{
    const otx_level *leaf = s->leaf.level;
    int32_t *queue =
        OTX_NEW(s->m->job->run->scratch, int32_t, leaf->face_count);
    uint8_t *laid =
        OTX_ZNEW(s->m->job->run->scratch, uint8_t, leaf->face_count);
    uint8_t *seen =
        OTX_ZNEW(s->m->job->run->scratch, uint8_t, leaf->face_count);

    OTX_TRY(otx_run_ok(s->m->job->run));
    for (int32_t seed = 0; seed < leaf->face_count; ++seed)
    {
        int32_t head = 0, tail = 0;

        if (s->of[seed] < 0 || seen[seed])
            continue;
        queue[tail++] = seed;
        seen[seed] = 1;
        while (head < tail)
        {
            const int32_t face = queue[head++];

            lay_face(s, face, leaf->face_first[face], 0.0);
            join_face(s, face, laid);
            laid[face] = 1;
            for (int32_t i = leaf->face_first[face];
                 i < leaf->face_first[face + 1]; ++i)
            {
                const int32_t e = leaf->face_edges[i];
                const int32_t *f = leaf->edge_faces + 2 * (size_t)e;
                const int32_t other = f[f[0] == face];

                if (abs(s->edges[e]) != 1 || seen[other])
                    continue;
                seen[other] = 1;
                queue[tail++] = other;
            }
        }
    }
    return OSDTEX_OK;
}

/* Tears that share a vertex of one strip make a group. */
static otx_status
group_tears(otx_strips *s, otx_strip_tears *t)
{
    const otx_level *leaf = s->leaf.level;
    otx_arena *scratch = s->m->job->run->scratch;
    int32_t *last = OTX_NEW(scratch, int32_t, leaf->vert_count);
    int32_t *parent = OTX_NEW(scratch, int32_t, t->count);
    int32_t *number = OTX_NEW(scratch, int32_t, t->count);
    int32_t *members = OTX_ZNEW(scratch, int32_t, t->count);

    t->lengths = OTX_ZNEW(scratch, double, t->count);
    OTX_TRY(otx_run_ok(s->m->job->run));
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        last[v] = -1;
    for (int32_t i = 0; i < t->count; ++i)
    {
        parent[i] = i;
        number[i] = -1;
        for (int k = 0; k < 2; ++k)
        {
            const int32_t v =
                leaf->edge_verts[2 * (size_t)t->tears[i].edge + k];

            if (last[v] >= 0 &&
                s->of[t->tears[last[v]].low] == s->of[t->tears[i].low])
                otx_union_find_join(parent, i, last[v]);
            last[v] = i;
        }
    }
    for (int32_t i = 0; i < t->count; ++i)
    {
        const int32_t root = otx_union_find_root(parent, i);
        otx_strip_tear *tear = &t->tears[i];

        if (number[root] < 0)
        {
            number[root] = t->group_count++;
            ++s->strips[s->of[tear->low]].loops;
        }
        tear->group = number[root];
        t->lengths[tear->group] += tear->rest;
        ++members[tear->group];
    }
    for (int32_t g = 0; g < t->group_count; ++g)
        t->lengths[g] /= members[g];
    return OSDTEX_OK;
}

/* A strip that is torn once, after all of its length, is a ring. */
static otx_status
find_rings(otx_strips *s, const otx_strip_tears *t)
{
    const otx_level *leaf = s->leaf.level;
    double *low = OTX_NEW(s->m->job->run->scratch, double, s->count);
    double *high = OTX_NEW(s->m->job->run->scratch, double, s->count);

    OTX_TRY(otx_run_ok(s->m->job->run));
    for (int32_t i = 0; i < s->count; ++i)
    {
        low[i] = INFINITY;
        high[i] = -INFINITY;
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t i = leaf->face_first[f];
             s->of[f] >= 0 && i < leaf->face_first[f + 1]; ++i)
        {
            low[s->of[f]] = fmin(low[s->of[f]], s->along[i]);
            high[s->of[f]] = fmax(high[s->of[f]], s->along[i]);
        }
    for (int32_t i = 0; i < t->count; ++i)
    {
        const int32_t strip = s->of[t->tears[i].low];
        const double length = t->lengths[t->tears[i].group];

        if (s->strips[strip].loops == 1 &&
            high[strip] - low[strip] < ONCE * length + apart(s))
            s->strips[strip].length = length;
    }
    return OSDTEX_OK;
}

otx_status
otx_unroll_measure(otx_strips *s, otx_strip_tears *out)
{
    const otx_level *leaf = s->leaf.level;

    *out = (otx_strip_tears){
        .tears =
            OTX_NEW(s->m->job->run->scratch, otx_strip_tear, leaf->edge_count)};
    OTX_TRY(otx_run_ok(s->m->job->run));
    OTX_TRY(lay_all(s));
    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *f = leaf->edge_faces + 2 * (size_t)e;
        double lag;

        if (abs(s->edges[e]) != 1)
            continue;
        lag = lag_across(s, e);
        if (fabs(lag) > apart(s))
            out->tears[out->count++] =
                (otx_strip_tear){e, f[lag < 0.0], fabs(lag), 0};
    }
    OTX_TRY(group_tears(s, out));
    return find_rings(s, out);
}

/* -- the coordinate ------------------------------------------------------ */

/* Corners that are one unknown but for a shift. */
typedef struct nodes
{
    int32_t *parent; /* [corner_count] */
    double *shift;   /* [corner_count] texels ahead of the parent */
    int32_t *row;    /* [corner_count] of roots */
    int32_t count;
} nodes;

/* The unknown of a corner, and how far the corner is ahead of it. Roots have no
 * shift, so that adding theirs does nothing. */
static int32_t
find_node(nodes *n, int32_t corner, double *shift)
{
    *shift = 0.0;
    while (n->parent[corner] != corner)
    {
        const int32_t up = n->parent[corner];

        n->shift[corner] += n->shift[up];
        n->parent[corner] = n->parent[up];
        *shift += n->shift[corner];
        corner = n->parent[corner];
    }
    return corner;
}

/* Makes the corner b lie `ahead` of a. */
static void
join_corners(nodes *n, int32_t a, int32_t b, double ahead)
{
    double x, y;
    const int32_t p = find_node(n, a, &x), q = find_node(n, b, &y);

    if (p == q)
        return;
    n->parent[q] = p;
    n->shift[q] = x + ahead - y;
}

static double
closing_of(const otx_strips *s, const otx_strip_tears *t, int32_t tear)
{
    const otx_course_strip *strip = &s->strips[s->of[t->tears[tear].low]];
    const double period = s->m->courses.period;

    if (strip->loops == 1)
        return strip->closing;
    return period * fmax(1.0, round(t->lengths[t->tears[tear].group] / period));
}

static otx_status
make_nodes(otx_strips *s, const otx_strip_tears *t, nodes *n)
{
    const otx_level *leaf = s->leaf.level;
    otx_arena *scratch = s->m->job->run->scratch;
    int32_t tear = 0;

    *n = (nodes){
        OTX_NEW(scratch, int32_t, leaf->corner_count),
        OTX_ZNEW(scratch, double, leaf->corner_count),
        OTX_NEW(scratch, int32_t, leaf->corner_count), 0};
    if (!n->parent || !n->shift || !n->row)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < leaf->corner_count; ++i)
        n->parent[i] = i;
    for (int32_t e = 0; e < leaf->edge_count; ++e)
    {
        const int32_t *f = leaf->edge_faces + 2 * (size_t)e;
        double ahead = 0.0;
        int32_t a[2], b[2];

        if (abs(s->edges[e]) != 1)
            continue;
        if (tear < t->count && t->tears[tear].edge == e)
        {
            ahead = closing_of(s, t, tear);
            if (t->tears[tear++].low != f[0])
                ahead = -ahead;
        }
        otx_seam_corners(leaf, e, f[0], a);
        otx_seam_corners(leaf, e, f[1], b);
        for (int k = 0; k < 2; ++k)
            join_corners(n, a[k], b[k], ahead);
    }
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t i = leaf->face_first[f]; i < leaf->face_first[f + 1]; ++i)
            n->row[i] = s->of[f] >= 0 && n->parent[i] == i ? n->count++ : -1;
    return OSDTEX_OK;
}

typedef struct equations
{
    otx_sparse_entry *entries;
    int64_t count;
    double *x; /* right side, then solution */
} equations;

/* Adds w (s_b - s_a - wish)^2. */
static void
add_spring(
    nodes *n, equations *q, int32_t a, int32_t b, double weight, double wish)
{
    double shift[2];
    const int32_t i = n->row[find_node(n, a, &shift[0])];
    const int32_t j = n->row[find_node(n, b, &shift[1])];

    wish -= shift[1] - shift[0];
    if (i == j)
        return;
    q->entries[q->count++] = (otx_sparse_entry){i, i, weight, 0.0};
    q->entries[q->count++] = (otx_sparse_entry){j, j, weight, 0.0};
    q->entries[q->count++] =
        (otx_sparse_entry){i > j ? i : j, i > j ? j : i, -weight, 0.0};
    q->x[i] -= weight * wish;
    q->x[j] += weight * wish;
}

/* A triangle's sides weigh half the cotangents of the angles across. */
static void
add_triangle(
    const otx_strips *s, nodes *n, equations *q, int32_t face,
    const int32_t corners[3], const otx_vec2 at[3])
{
    const otx_vec2 d = heading(s, face);

    for (int k = 0; k < 3; ++k)
    {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const otx_vec2 a = otx_vec2_sub(at[i], at[k]);
        const otx_vec2 b = otx_vec2_sub(at[j], at[k]);
        const double cross = fabs(otx_vec2_cross(a, b));
        const double weight = 0.5 * otx_vec2_dot(a, b) / fmax(cross, 1e-30);

        add_spring(
            n, q, corners[i], corners[j],
            fmin(fmax(weight, WEIGHT_MIN), 1.0 / WEIGHT_MIN),
            otx_vec2_dot(d, otx_vec2_sub(at[j], at[i])));
    }
}

static void
add_face(const otx_strips *s, nodes *n, equations *q, int32_t face)
{
    const otx_level *leaf = s->leaf.level;
    const int32_t first = leaf->face_first[face];
    otx_vec2 at[3] = {{0, 0}, s->leaf.sides[first], {0, 0}};

    for (int32_t k = 1; k + 1 < otx_level_face_size(leaf, face); ++k)
    {
        const int32_t corners[3] = {first, first + k, first + k + 1};

        at[2] = otx_vec2_add(at[1], s->leaf.sides[first + k]);
        add_triangle(s, n, q, face, corners, at);
        at[1] = at[2];
    }
}

static otx_status
solve(otx_strips *s, nodes *n)
{
    const otx_level *leaf = s->leaf.level;
    otx_arena *scratch = s->m->job->run->scratch;
    equations q = {
        OTX_NEW(
            scratch, otx_sparse_entry,
            9 * (int64_t)leaf->corner_count + n->count),
        0, OTX_ZNEW(scratch, double, n->count)};
    otx_sparse *lhs;

    if (!q.entries || !q.x)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (s->of[f] >= 0)
            add_face(s, n, &q, f);
    for (int32_t i = 0; i < leaf->corner_count; ++i)
        if (n->row[i] >= 0)
        {
            q.entries[q.count++] =
                (otx_sparse_entry){n->row[i], n->row[i], GROUND, 0.0};
            q.x[n->row[i]] += GROUND * s->along[i];
        }
    OTX_TRY(otx_sparse_factor(
        scratch, OTX_SPARSE_REAL, n->count, NULL, q.entries, q.count, &lhs));
    OTX_TRY(otx_sparse_solve(lhs, q.x, q.x));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t i = leaf->face_first[f];
             s->of[f] >= 0 && i < leaf->face_first[f + 1]; ++i)
        {
            double shift;
            const int32_t root = find_node(n, i, &shift);

            s->along[i] = q.x[n->row[root]] + shift;
        }
    return OSDTEX_OK;
}

otx_status
otx_unroll_solve(otx_strips *s, const otx_strip_tears *tears)
{
    const otx_arena_mark mark = otx_arena_here(s->m->job->run->scratch);
    nodes n;
    otx_status status = make_nodes(s, tears, &n);

    if (status == OSDTEX_OK && n.count > 0)
        status = solve(s, &n);
    otx_arena_release(s->m->job->run->scratch, mark);
    if (status == OSDTEX_ERROR_MEMORY)
        return otx_fail_memory(s->m->job->run, "map");
    if (status != OSDTEX_OK)
        return otx_fail(
            s->m->job->run, status, "map", OTX_NOWHERE,
            "the courses have no length: the surface has positions that are "
            "not finite");
    return OSDTEX_OK;
}

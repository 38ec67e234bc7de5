/* growth.c -- a chart while faces are added to it [Praun00, sec. 3.3]. */
#include "method/lapped/growth.h"

#include <string.h>

enum
{
    CELL = 6, /* texels, of the test against folds */
    CORNERS_MAX = OTX_LAPPED_CORNERS
};

/* How much surface a cell may carry, of its area. */
static const double BUDGET = 1.6;
/* Distances in the plane fall behind those in space only by a fold. */
static const double FOLD = 1.35;
/* Areas in the plane to those on the surface, as faces are added. */
static const double RATIO_LEAST = 0.45, RATIO_MOST = 2.2;

/* ---- room ---- */

static bool
widen(otx_arena *arena, void **array, int32_t count, size_t size, int32_t to)
{
    void *wider = otx_arena_alloc(arena, (size_t)to, size);

    if (wider && *array)
        memcpy(wider, *array, (size_t)count * size);
    *array = wider;
    return wider != NULL;
}

/* Room for one face more, of `size` corners. */
static bool
make_room(otx_growth *g, int32_t size)
{
    otx_lapped_chart *c = g->chart;
    const int32_t corners = c->face_count ? c->first[c->face_count] : 0;
    bool ok = true;

    if (c->face_count + 1 >= g->face_capacity)
    {
        const int32_t to = 2 * g->face_capacity + 64;

        ok = widen(g->arena, (void **)&c->faces, c->face_count, 4, to) &&
             widen(g->arena, (void **)&c->first, c->face_count + 1, 4, to) &&
             widen(
                 g->arena, (void **)&g->headings, c->face_count,
                 sizeof *g->headings, to);
        g->face_capacity = to;
    }
    if (ok && c->vert_count + size > g->vert_capacity)
    {
        const int32_t to = 2 * g->vert_capacity + 64 + size;

        ok = widen(g->arena, (void **)&c->verts, c->vert_count, 4, to) &&
             widen(
                 g->arena, (void **)&c->flat, c->vert_count, sizeof *c->flat,
                 to);
        g->vert_capacity = to;
    }
    if (ok && corners + size > g->corner_capacity)
    {
        const int32_t to = 2 * g->corner_capacity + 256 + size;

        ok = widen(g->arena, (void **)&c->corners, corners, 4, to);
        g->corner_capacity = to;
    }
    return ok;
}

/* ---- a face that may be added ---- */

typedef struct candidate
{
    int32_t face, size;
    otx_vec2 heading;
    otx_vec2 flat[CORNERS_MAX];
    bool known[CORNERS_MAX]; /* in the chart already */
} candidate;

/* The heading that a face hands on across its edge k. */
static otx_vec2
carry(const otx_lapped *l, int32_t from, int32_t edge, otx_vec2 heading)
{
    const double turn = l->connection.turns[edge];

    return otx_vec2_mul(
        heading,
        otx_vec2_polar(l->leaf->edge_faces[2 * edge] == from ? turn : -turn));
}

static otx_vec2
unit_or(otx_vec2 a, otx_vec2 otherwise)
{
    const double length = otx_vec2_length(a);

    return length > 1e-9 ? otx_vec2_scale(1.0 / length, a) : otherwise;
}

/* The branch of the guide on a face that is nearest to `heading`. */
static otx_vec2
guided(const otx_lapped *l, int32_t face, otx_vec2 heading)
{
    const otx_guide *guide = &l->guide;
    const double step = 2.0 * 3.14159265358979323846 / guide->symmetry;
    const otx_vec2 along = unit_or(
        otx_connection_project(&l->connection, face, guide->directions[face]),
        heading);
    otx_vec2 best = {0, 0};

    for (int32_t k = 0; k < guide->symmetry; ++k)
    {
        const otx_vec2 branch =
            otx_vec2_mul(along, otx_vec2_polar(step * k - guide->angle));

        if (k == 0 ||
            otx_vec2_dot(branch, heading) > otx_vec2_dot(best, heading))
            best = branch;
    }
    return best;
}

/* What the faces of the chart around a face hand on to it [Praun00, sec.
 * 3.2]. */
static otx_vec2
heading_of(const otx_growth *g, int32_t face)
{
    const otx_lapped *l = g->l;
    const int32_t first = l->leaf->face_first[face];
    otx_vec2 sum = {0, 0};

    for (int32_t k = 0; k < otx_level_face_size(l->leaf, face); ++k)
    {
        const int32_t other = otx_level_neighbour(l->leaf, face, k);
        const int32_t slot = other >= 0 ? g->space->face_slot[other] : -1;

        if (slot >= 0)
            sum = otx_vec2_add(
                sum, carry(
                         l, other, l->leaf->face_edges[first + k],
                         g->headings[slot]));
    }
    sum = unit_or(sum, (otx_vec2){1, 0});
    return l->guide.directions ? guided(l, face, sum) : sum;
}

/* Corners in the face's own plane, turned as its heading says, texels. */
static void
turn_corners(const otx_lapped *l, candidate *c)
{
    const int32_t *verts = l->leaf->face_verts + l->leaf->face_first[c->face];
    const double texels = otx_lapped_texels(l, c->face);
    const otx_vec2 back = {c->heading.x, -c->heading.y};

    for (int32_t k = 0; k < c->size; ++k)
        c->flat[k] = otx_vec2_mul(
            back,
            otx_vec2_scale(
                texels, otx_connection_project(
                            &l->connection, c->face,
                            otx_vec3_sub(
                                otx_vec3_load(l->surface->points, verts[k]),
                                l->connection.centres[c->face]))));
}

/* Moves the face to where the chart has its corners; those stay there. */
static void
join(const otx_growth *g, candidate *c)
{
    const otx_lapped *l = g->l;
    const int32_t *verts = l->leaf->face_verts + l->leaf->face_first[c->face];
    otx_vec2 move = {0, 0};
    int32_t known = 0;

    for (int32_t k = 0; k < c->size; ++k)
    {
        const int32_t slot = g->space->vert_slot[verts[k]];

        c->known[k] = slot >= 0;
        if (slot < 0)
            continue;
        move =
            otx_vec2_add(move, otx_vec2_sub(g->chart->flat[slot], c->flat[k]));
        ++known;
    }
    for (int32_t k = 0; k < c->size; ++k)
        c->flat[k] =
            c->known[k]
                ? g->chart->flat[g->space->vert_slot[verts[k]]]
                : otx_vec2_add(
                      c->flat[k],
                      otx_vec2_scale(1.0 / (known > 0 ? known : 1), move));
}

/* ---- tests ---- */

/* Areas of the triangles in the plane to those on the surface. */
static bool
ratio_is_within(
    const otx_lapped *l, int32_t face, const otx_vec2 *flat, double least,
    double most)
{
    const double texels = otx_lapped_texels(l, face);
    const int32_t first = l->leaf->face_first[face];

    for (int32_t i = 0; i < otx_facet_count(l->leaf, face); ++i)
    {
        const otx_facet facet = otx_facet_at(l->leaf, face, i);
        otx_vec2 u[3];
        otx_vec3 p[3];
        double plane, surface;

        for (int k = 0; k < 3; ++k)
        {
            u[k] = flat[facet.corners[k] - first];
            p[k] = otx_vec3_load(
                l->surface->points, l->leaf->face_verts[facet.corners[k]]);
        }
        plane =
            otx_vec2_cross(otx_vec2_sub(u[1], u[0]), otx_vec2_sub(u[2], u[0]));
        surface = texels * texels *
                  otx_vec3_length(otx_vec3_cross(
                      otx_vec3_sub(p[1], p[0]), otx_vec3_sub(p[2], p[0])));
        if (!(plane >= least * surface && plane <= most * surface))
            return false;
    }
    return true;
}

static otx_vec2
middle_of(const candidate *c)
{
    otx_vec2 sum = {0, 0};

    for (int32_t k = 0; k < c->size; ++k)
        sum = otx_vec2_add(sum, c->flat[k]);
    return otx_vec2_scale(1.0 / c->size, sum);
}

/* A chart that has gone around something comes back near its own middle. */
static bool
comes_back(const otx_growth *g, const candidate *c)
{
    const double away = otx_vec3_length(
        otx_vec3_sub(g->l->connection.centres[c->face], g->origin));

    return away * otx_lapped_texels(g->l, c->face) >
           FOLD * otx_vec2_length(middle_of(c)) + CELL;
}

/* The cell of a place; NULL beyond them. */
static double *
cell_at(otx_growth *g, otx_vec2 at)
{
    const double x = floor(at.x / CELL) + g->cells / 2;
    const double y = floor(at.y / CELL) + g->cells / 2;

    if (!(x >= 0 && y >= 0 && x < g->cells && y < g->cells))
        return NULL;
    return &g->budget[(int32_t)y * g->cells + (int32_t)x];
}

/* Spends the area of a face, times `sign`, on the cells under it. False when
 * one is then overdrawn. */
static bool
spend(otx_growth *g, const candidate *c, double sign)
{
    const otx_lapped *l = g->l;
    const int32_t facets = otx_facet_count(l->leaf, c->face);
    const int32_t steps = (l->samples.steps[c->face] + 1) / 2;
    const int32_t first = l->leaf->face_first[c->face];
    const double texels = otx_lapped_texels(l, c->face);
    const double share = l->connection.areas[c->face] * texels * texels /
                         (facets * steps * (steps + 1) / 2);
    bool within = true;

    for (int32_t t = 0; t < facets; ++t)
    {
        const otx_facet facet = otx_facet_at(l->leaf, c->face, t);
        const otx_vec2 o = c->flat[facet.corners[0] - first];
        const otx_vec2 x = otx_vec2_sub(c->flat[facet.corners[1] - first], o);
        const otx_vec2 y = otx_vec2_sub(c->flat[facet.corners[2] - first], o);

        for (int32_t i = 0; i < steps; ++i)
            for (int32_t j = 0; j < steps - i; ++j)
            {
                double *cell = cell_at(
                    g, otx_vec2_add(
                           o, otx_vec2_add(
                                  otx_vec2_scale((i + 1.0 / 3.0) / steps, x),
                                  otx_vec2_scale((j + 1.0 / 3.0) / steps, y))));

                if (!cell)
                    continue;
                *cell += sign * share;
                within = within && *cell <= BUDGET * CELL * CELL;
            }
    }
    return within;
}

/* ---- adding ---- */

static void
push_edges(otx_growth *g, int32_t face, const int32_t *corners)
{
    const otx_level *leaf = g->l->leaf;
    const int32_t size = otx_level_face_size(leaf, face);

    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t other = otx_level_neighbour(leaf, face, k);
        const otx_vec2 a = g->chart->flat[corners[k]];
        const otx_vec2 b = g->chart->flat[corners[k + 1 < size ? k + 1 : 0]];

        if (other >= 0 && !leaf->face_hole[other] &&
            g->space->face_slot[other] < 0)
            otx_pqueue_push(
                &g->queue, otx_vec2_length(otx_vec2_lerp(a, b, 0.5)),
                leaf->face_first[face] + k);
    }
}

static otx_status
add(otx_growth *g, const candidate *c)
{
    const otx_lapped *l = g->l;
    const int32_t *verts = l->leaf->face_verts + l->leaf->face_first[c->face];
    otx_lapped_chart *chart = g->chart;
    int32_t *corners;

    if (!make_room(g, c->size))
        return OSDTEX_ERROR_MEMORY;
    if (chart->face_count == 0)
        chart->first[0] = 0;
    corners = chart->corners + chart->first[chart->face_count];
    for (int32_t k = 0; k < c->size; ++k)
    {
        int32_t *slot = &g->space->vert_slot[verts[k]];

        if (*slot < 0)
        {
            *slot = chart->vert_count++;
            chart->verts[*slot] = verts[k];
            chart->flat[*slot] = c->flat[k];
        }
        corners[k] = *slot;
    }
    g->space->face_slot[c->face] = chart->face_count;
    chart->faces[chart->face_count] = c->face;
    g->headings[chart->face_count++] = c->heading;
    chart->first[chart->face_count] =
        chart->first[chart->face_count - 1] + c->size;
    push_edges(g, c->face, corners);
    return OSDTEX_OK;
}

static bool
begin_candidate(const otx_growth *g, int32_t face, candidate *c)
{
    c->face = face;
    c->size = otx_level_face_size(g->l->leaf, face);
    return c->size <= CORNERS_MAX && g->l->connection.areas[face] > 0.0;
}

static otx_status
try_face(otx_growth *g, int32_t face)
{
    candidate c;

    if (!begin_candidate(g, face, &c))
        return OSDTEX_OK;
    c.heading = heading_of(g, face);
    turn_corners(g->l, &c);
    join(g, &c);
    if (!ratio_is_within(g->l, face, c.flat, RATIO_LEAST, RATIO_MOST) ||
        comes_back(g, &c))
        return OSDTEX_OK;
    if (!spend(g, &c, 1.0))
    {
        spend(g, &c, -1.0);
        return OSDTEX_OK;
    }
    return add(g, &c);
}

/* Whether an edge comes nearer to the middle than the hull. */
static bool
reaches(const otx_growth *g, int32_t face, int32_t k)
{
    const otx_lapped_chart *c = g->chart;
    const int32_t slot = g->space->face_slot[face];
    const int32_t first = c->first[slot], size = c->first[slot + 1] - first;
    const otx_vec2 a = c->flat[c->corners[first + k]];
    const otx_vec2 b = c->flat[c->corners[first + (k + 1) % size]];
    const otx_vec2 d = otx_vec2_sub(b, a);
    const double t = -otx_vec2_dot(a, d) / fmax(otx_vec2_dot(d, d), 1e-12);

    return otx_vec2_length(otx_vec2_lerp(a, b, fmin(fmax(t, 0.0), 1.0))) <
           g->hull;
}

/* The face of a corner of the level. */
static int32_t
face_of(const otx_growth *g, int32_t corner)
{
    const otx_level *leaf = g->l->leaf;
    int32_t low = 0, high = leaf->face_count;

    while (high - low > 1)
    {
        const int32_t middle = low + (high - low) / 2;

        if (leaf->face_first[middle] <= corner)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static otx_status
begin(otx_growth *g)
{
    const otx_sample_place *place = &g->seed->place;
    const otx_lapped *l = g->l;
    candidate c;
    otx_vec2 at = {0, 0};

    c.face = g->seed->face;
    c.size = otx_level_face_size(l->leaf, c.face);
    c.heading = l->guide.directions ? guided(l, c.face, g->seed->heading)
                                    : g->seed->heading;
    turn_corners(l, &c);
    for (int k = 0; k < 3; ++k)
        at = otx_vec2_add(
            at, otx_vec2_scale(
                    place->at[k],
                    c.flat[place->corners[k] - l->leaf->face_first[c.face]]));
    for (int32_t k = 0; k < c.size; ++k)
        c.flat[k] = otx_vec2_sub(c.flat[k], at);
    g->origin = otx_lapped_point(l, place);
    spend(g, &c, 1.0);
    return add(g, &c);
}

otx_status
otx_growth_run(otx_growth *g)
{
    otx_pqueue_entry entry;

    g->cells = 2 * ((int32_t)ceil(1.5 * g->hull / CELL) + 1);
    g->budget = OTX_ZNEW(g->arena, double, g->cells * g->cells);
    g->queue = otx_pqueue_make(g->arena);
    if (!g->budget)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(begin(g));
    while (otx_pqueue_pop(&g->queue, &entry))
    {
        const int32_t face = face_of(g, entry.item);
        const int32_t k = entry.item - g->l->leaf->face_first[face];
        const int32_t other = otx_level_neighbour(g->l->leaf, face, k);

        if (g->space->face_slot[other] < 0 && reaches(g, face, k))
            OTX_TRY(try_face(g, other));
    }
    return otx_arena_failed(g->arena) ? OSDTEX_ERROR_MEMORY : OSDTEX_OK;
}

static otx_status
try_sewing(otx_growth *g, int32_t face, double ratio, int32_t *added)
{
    const otx_lapped *l = g->l;
    const int32_t *verts = l->leaf->face_verts + l->leaf->face_first[face];
    candidate c;

    if (!begin_candidate(g, face, &c))
        return OSDTEX_OK;
    for (int32_t k = 0; k < c.size; ++k)
    {
        const int32_t slot = g->space->vert_slot[verts[k]];

        if (slot < 0)
            return OSDTEX_OK;
        c.flat[k] = g->chart->flat[slot];
    }
    if (!ratio_is_within(l, face, c.flat, 1.0 / ratio, ratio))
        return OSDTEX_OK;
    c.heading = heading_of(g, face);
    ++*added;
    return add(g, &c);
}

otx_status
otx_growth_sew(otx_growth *g, double ratio, int32_t *added)
{
    const otx_level *leaf = g->l->leaf;

    *added = 0;
    for (int32_t i = 0; i < g->chart->face_count; ++i)
    {
        const int32_t face = g->chart->faces[i];

        for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, face, k);

            if (other >= 0 && !leaf->face_hole[other] &&
                g->space->face_slot[other] < 0)
                OTX_TRY(try_sewing(g, other, ratio, added));
        }
    }
    return OSDTEX_OK;
}

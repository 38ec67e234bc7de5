/* nudge.c -- greedy random search over the hierarchy's border vertices. */
#include "relax/nudge.h"

#include "base/random.h"
#include "flatten/descent.h"
#include "image/view.h"
#include "seam/difference.h"
#include "seam/edge.h"

enum
{
    TRIES = 14 /* for each vertex and level */
};

/* Largest change of a triangle's area. */
static const double AREA_LIMIT = 1.6;
/* Radius of the disc, as a share of the level's mesh width; and in texels, at
 * least, since a seam may be off by a texel at every level. */
static const double RADIUS_SHARE = 0.06;
static const double RADIUS_LEAST = 1.5;
/* What a texel of displacement costs, in sigma squared, at the top level;
 * doubled from level to level. */
static const double MOVE_COST = 0.02;

/* A leaf edge between the core and a textured face. */
typedef struct border
{
    int32_t a, b;   /* chart vertices */
    int32_t first;  /* sample */
    int32_t count;  /* samples, evenly along it */
    double spacing; /* texels of length per sample */
} border;

typedef struct nudge
{
    const otx_nudge_request *request;
    const otx_cluster *cluster;
    const otx_chart *chart;
    const otx_level *leaf;
    const int32_t *slots;
    otx_vec2 *uv;

    border *borders;
    int32_t border_count;
    float *colors;    /* [samples * 3] of the neighbours */
    uint8_t *on_edge; /* [vert_count] on the textured border */

    /* Corners of the level's faces in the core, listed by vertex. */
    int32_t *head, *next, *owner;

    /* What the vertex in hand moves. */
    double *hat;    /* [vert_count], 0 elsewhere */
    int32_t *faces; /* chart faces below it */
    int32_t face_count;
    int32_t *touched; /* borders */
    int32_t touched_count;
} nudge;

/* -- the border ---------------------------------------------------------- */

static void
sample(const otx_exemplar *e, otx_vec2 at, float color[3])
{
    otx_view_value(otx_view_of(&e->match, e->wrap_x, e->wrap_y), at, color);
}

/* What a textured face shows. */
static const otx_exemplar *
exemplar_of(const nudge *n, int32_t face)
{
    const otx_nudge_request *r = n->request;

    return r->patch_exemplar
               ? &r->exemplars[r->patch_exemplar[r->face_patch[face]]]
               : r->exemplar;
}

/* The textured face across edge k of a core face, -1 when there is none. */
static int32_t
textured_across(const nudge *n, int32_t i, int32_t k)
{
    const int32_t other = otx_level_neighbour(n->leaf, n->chart->faces[i], k);

    return other >= 0 && n->request->face_patch[other] >= 0 ? other : -1;
}

static int32_t
sample_count(const nudge *n, int32_t edge, double *length)
{
    *length =
        n->request->texels * otx_seam_edge_length(n->request->surface, edge);
    return otx_seam_sample_count(*length);
}

/* The neighbour's UVs at the ends of the edge, in this face's order; the
 * neighbour goes round it the other way. */
static void
far_side(const nudge *n, int32_t edge, int32_t face, otx_vec2 out[2])
{
    const int32_t first = n->leaf->face_first[face];
    const int32_t size = otx_level_face_size(n->leaf, face);
    int32_t k = 0;

    while (n->leaf->face_edges[first + k] != edge)
        ++k;
    out[0] = n->request->uvs[first + (k + 1) % size];
    out[1] = n->request->uvs[first + k];
}

static void
add_border(nudge *n, int32_t i, int32_t k, int32_t other, int32_t *samples)
{
    const otx_chart *chart = n->chart;
    const int32_t face = chart->faces[i];
    const int32_t edge = n->leaf->face_edges[n->leaf->face_first[face] + k];
    const int32_t first = chart->first[i], size = chart->first[i + 1] - first;
    border *b = &n->borders[n->border_count++];
    otx_vec2 far[2];
    double length;

    b->a = chart->corners[first + k];
    b->b = chart->corners[first + (k + 1) % size];
    b->first = *samples;
    b->count = sample_count(n, edge, &length);
    b->spacing = length / b->count;
    *samples += b->count;
    n->on_edge[b->a] = n->on_edge[b->b] = 1;
    far_side(n, edge, other, far);
    for (int32_t s = 0; s < b->count; ++s)
        sample(
            exemplar_of(n, other),
            otx_vec2_lerp(far[0], far[1], (s + 0.5) / b->count),
            n->colors + 3 * (size_t)(b->first + s));
}

/* Lists the border; colours of the far side are looked up once. */
static otx_status
list_borders(nudge *n, otx_arena *scratch)
{
    const otx_chart *chart = n->chart;
    int64_t edges = 0, samples = 0;
    int32_t used = 0;

    for (int32_t i = 0; i < chart->core_count; ++i)
        for (int32_t k = 0; k < chart->first[i + 1] - chart->first[i]; ++k)
            if (textured_across(n, i, k) >= 0)
            {
                const int32_t c = n->leaf->face_first[chart->faces[i]] + k;
                double length;

                ++edges;
                samples += sample_count(n, n->leaf->face_edges[c], &length);
            }
    n->borders = OTX_NEW(scratch, border, edges);
    n->colors = OTX_NEW(scratch, float, 3 * samples);
    n->on_edge = OTX_ZNEW(scratch, uint8_t, chart->vert_count);
    if (!n->borders || !n->colors || !n->on_edge || samples > INT32_MAX)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < chart->core_count; ++i)
        for (int32_t k = 0; k < chart->first[i + 1] - chart->first[i]; ++k)
        {
            const int32_t other = textured_across(n, i, k);

            if (other >= 0)
                add_border(n, i, k, other, &used);
        }
    return OSDTEX_OK;
}

static otx_vec2
moved(const nudge *n, int32_t vert, otx_vec2 delta)
{
    return otx_vec2_add(n->uv[vert], otx_vec2_scale(n->hat[vert], delta));
}

/* Squared colour difference over one border edge, texels times colour, with
 * its vertices moved. `hat` weighs each place by how far it moves, as the
 * paper does, or all the same. */
static double
border_energy(const nudge *n, const border *b, otx_vec2 delta, bool hat)
{
    const otx_vec2 from = moved(n, b->a, delta), to = moved(n, b->b, delta);
    double sum = 0.0;

    for (int32_t s = 0; s < b->count; ++s)
    {
        const double t = (s + 0.5) / b->count;
        const float *far = n->colors + 3 * (size_t)(b->first + s);
        double square, ours[3], theirs[3];
        float near[3];

        sample(n->request->exemplar, otx_vec2_lerp(from, to, t), near);
        for (int c = 0; c < 3; ++c)
        {
            ours[c] = near[c];
            theirs[c] = far[c];
        }
        square = otx_difference_add_sq(0.0, ours, theirs);
        if (hat)
            square *= (1.0 - t) * n->hat[b->a] + t * n->hat[b->b];
        sum += square;
    }
    return sum * b->spacing;
}

static double
remaining_error(const nudge *n)
{
    const double sigma = n->request->exemplar->match_sigma;
    double sum = 0.0, length = 0.0;

    for (int32_t i = 0; i < n->border_count; ++i)
    {
        const border *b = &n->borders[i];

        sum += border_energy(n, b, (otx_vec2){0, 0}, false);
        length += b->spacing * b->count;
    }
    return length > 0.0 && sigma > 0.0 ? sqrt(sum / length) / sigma : 0.0;
}

/* -- moves that are allowed ---------------------------------------------- */

/* How much a triangle's area is off, at least 1; INFINITY when it is flipped.
 */
static double
area_badness(double plane, double surface)
{
    return plane > 0.0 ? fmax(plane / surface, surface / plane) : INFINITY;
}

static bool
triangle_allows(const nudge *n, const int32_t v[3], otx_vec2 delta)
{
    otx_vec3 p[3];
    otx_vec2 old[3], new[3];
    double surface, before, after;

    if (n->hat[v[0]] == 0.0 && n->hat[v[1]] == 0.0 && n->hat[v[2]] == 0.0)
        return true;
    for (int i = 0; i < 3; ++i)
    {
        p[i] = otx_vec3_scale(
            n->request->texels,
            otx_vec3_load(n->request->surface->points, n->chart->verts[v[i]]));
        old[i] = n->uv[v[i]];
        new[i] = moved(n, v[i], delta);
    }
    surface = otx_vec3_length(
        otx_vec3_cross(otx_vec3_sub(p[1], p[0]), otx_vec3_sub(p[2], p[0])));
    if (!(surface > 0.0))
        return true;
    before = area_badness(
        otx_vec2_cross(
            otx_vec2_sub(old[1], old[0]), otx_vec2_sub(old[2], old[0])),
        surface);
    after = area_badness(
        otx_vec2_cross(
            otx_vec2_sub(new[1], new[0]), otx_vec2_sub(new[2], new[0])),
        surface);
    return after <= AREA_LIMIT || after <= before;
}

static bool
stays_inside(const nudge *n, int32_t vert, otx_vec2 delta)
{
    const otx_exemplar *e = n->request->exemplar;
    const otx_vec2 p = moved(n, vert, delta);

    return n->hat[vert] == 0.0 ||
           ((e->wrap_x || (p.x >= 0.5 && p.x <= e->match.width - 0.5)) &&
            (e->wrap_y || (p.y >= 0.5 && p.y <= e->match.height - 0.5)));
}

static bool
allowed(const nudge *n, otx_vec2 delta)
{
    const otx_chart *chart = n->chart;

    for (int32_t i = 0; i < n->face_count; ++i)
    {
        const int32_t first = chart->first[n->faces[i]];
        const int32_t end = chart->first[n->faces[i] + 1];

        for (int32_t c = first; c < end; ++c)
            if (!stays_inside(n, chart->corners[c], delta))
                return false;
        for (int32_t c = first + 1; c + 1 < end; ++c)
        {
            const int32_t v[3] = {
                chart->corners[first], chart->corners[c],
                chart->corners[c + 1]};

            if (!triangle_allows(n, v, delta))
                return false;
        }
    }
    return true;
}

/* -- one vertex ---------------------------------------------------------- */

/* Where a leaf is in the core, whose faces ascend. */
static int32_t
core_index(const otx_chart *chart, int32_t face)
{
    int32_t low = 0, high = chart->core_count;

    while (high - low > 1)
    {
        const int32_t middle = low + (high - low) / 2;

        if (chart->faces[middle] <= face)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The hat of `vert` at `level`: 1 there, 0 at the other vertices of the level,
 * carried down the faces around it; and all that it moves. */
static void
take_hold(nudge *n, int32_t level, int32_t vert)
{
    const otx_surface *surface = n->request->surface;
    const otx_level *here = &surface->levels[level];

    n->face_count = n->touched_count = 0;
    for (int32_t c = n->head[vert]; c >= 0; c = n->next[c])
    {
        const int32_t face = n->owner[c];
        int32_t first, end;

        for (int32_t k = here->face_first[face]; k < here->face_first[face + 1];
             ++k)
        {
            const int32_t v = n->slots[here->face_verts[k]];

            n->hat[v] = v == vert ? 1.0 : 0.0;
        }
        otx_descent_average(surface, level, face, n->slots, n->hat);
        otx_surface_leaves(surface, level, face, &first, &end);
        for (int32_t f = first; f < end; ++f)
            n->faces[n->face_count++] = core_index(n->chart, f);
    }
    for (int32_t i = 0; i < n->border_count; ++i)
        if (n->hat[n->borders[i].a] > 0.0 || n->hat[n->borders[i].b] > 0.0)
            n->touched[n->touched_count++] = i;
}

/* Moves what is held and clears the hat, which is done once per vertex. */
static void
let_go(nudge *n, otx_vec2 delta)
{
    const otx_chart *chart = n->chart;

    for (int32_t i = 0; i < n->face_count; ++i)
        for (int32_t c = chart->first[n->faces[i]];
             c < chart->first[n->faces[i] + 1]; ++c)
        {
            const int32_t v = chart->corners[c];

            n->uv[v] = moved(n, v, delta);
            n->hat[v] = 0.0;
        }
}

static double
touched_energy(const nudge *n, otx_vec2 delta)
{
    double sum = 0.0;

    for (int32_t i = 0; i < n->touched_count; ++i)
        sum += border_energy(n, &n->borders[n->touched[i]], delta, true);
    return sum;
}

/* Tries places in a disc around the best so far; the disc shrinks. */
static void
try_vertex(nudge *n, int32_t level, int32_t vert, double width, double top)
{
    const double sigma = n->request->exemplar->match_sigma;
    const double radius = fmax(RADIUS_LEAST, RADIUS_SHARE * width);
    const double cost = MOVE_COST * sigma * sigma * top / width;
    const uint64_t element = (uint64_t)(uint32_t)n->chart->verts[vert] * 64u;
    otx_vec2 best = {0, 0};
    double least;

    take_hold(n, level, vert);
    least = touched_energy(n, best);
    for (uint32_t i = 0; i < TRIES && n->touched_count > 0; ++i)
    {
        const double disc = radius * (TRIES - i) / TRIES;
        const double r =
            disc * sqrt(otx_random_unit(
                       n->request->seed, (uint32_t)level, element + 2 * i));
        const double angle =
            2.0 * OTX_PI *
            otx_random_unit(
                n->request->seed, (uint32_t)level, element + 2 * i + 1);
        const otx_vec2 delta =
            otx_vec2_add(best, otx_vec2_scale(r, otx_vec2_polar(angle)));
        const double energy =
            touched_energy(n, delta) + cost * otx_vec2_length(delta);

        if (energy < least && allowed(n, delta))
        {
            least = energy;
            best = delta;
        }
    }
    let_go(n, best);
}

/* -- levels -------------------------------------------------------------- */

/* The faces of `level` below one face of the cluster. */
static void
faces_below(
    const nudge *n, int32_t face, int32_t level, int32_t *first, int32_t *end)
{
    *first = face;
    *end = face + 1;
    for (int32_t l = n->cluster->level; l < level; ++l)
    {
        const otx_level *here = &n->request->surface->levels[l];

        *first = here->face_child_first[*first];
        *end = here->face_child_first[*end];
    }
}

/* Lists the corners of the level's faces by chart vertex. */
static void
list_corners(nudge *n, int32_t level)
{
    const otx_level *here = &n->request->surface->levels[level];
    int32_t count = 0;

    for (int32_t v = 0; v < n->chart->vert_count; ++v)
        n->head[v] = -1;
    for (int32_t i = 0; i < n->cluster->face_count; ++i)
    {
        int32_t first, end;

        faces_below(n, n->cluster->faces[i], level, &first, &end);
        for (int32_t f = first; f < end; ++f)
            for (int32_t c = here->face_first[f]; c < here->face_first[f + 1];
                 ++c)
            {
                const int32_t v = n->slots[here->face_verts[c]];

                n->owner[count] = f;
                n->next[count] = n->head[v];
                n->head[v] = count++;
            }
    }
}

static void
relax_level(nudge *n, int32_t level, double width, double top)
{
    list_corners(n, level);
    for (int32_t v = 0; v < n->chart->vert_count; ++v)
        if (n->on_edge[v] && n->head[v] >= 0)
            try_vertex(n, level, v, width, top);
}

static void
relax_levels(nudge *n)
{
    const otx_surface *surface = n->request->surface;
    const double top = n->request->texels * sqrt(n->cluster->area);
    double width = top / sqrt(n->cluster->face_count);

    if (!(top > 0.0))
        return;
    for (int32_t l = n->cluster->level; l < surface->level_count; ++l)
    {
        relax_level(n, l, width, top);
        width *= 0.5;
    }
}

static otx_status
allocate(nudge *n, otx_arena *scratch)
{
    const otx_chart *chart = n->chart;
    const int32_t corners = chart->first[chart->core_count];

    n->head = OTX_NEW(scratch, int32_t, chart->vert_count);
    n->next = OTX_NEW(scratch, int32_t, corners);
    n->owner = OTX_NEW(scratch, int32_t, corners);
    n->hat = OTX_ZNEW(scratch, double, chart->vert_count);
    n->faces = OTX_NEW(scratch, int32_t, chart->core_count);
    n->touched = OTX_NEW(scratch, int32_t, n->border_count);
    if (!n->head || !n->next || !n->owner || !n->hat || !n->faces ||
        !n->touched)
        return OSDTEX_ERROR_MEMORY;
    return OSDTEX_OK;
}

otx_status
otx_nudge_run(
    const otx_nudge_request *request, const otx_cluster *cluster,
    const otx_chart *chart, int32_t *slots, otx_arena *scratch, otx_vec2 *uv,
    double *error)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    nudge n = {
        .request = request,
        .cluster = cluster,
        .chart = chart,
        .leaf = otx_surface_leaf(request->surface),
        .slots = slots,
        .uv = uv,
    };
    const int32_t corners = chart->first[chart->core_count];

    OTX_TRY(list_borders(&n, scratch));
    OTX_TRY(allocate(&n, scratch));
    for (int32_t c = 0; c < corners; ++c)
        slots[chart->verts[chart->corners[c]]] = chart->corners[c];
    if (n.border_count > 0)
        relax_levels(&n);
    for (int32_t c = 0; c < corners; ++c)
        slots[chart->verts[chart->corners[c]]] = -1;
    *error = remaining_error(&n);
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

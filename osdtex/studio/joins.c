/* joins.c -- where patches meet, and how much that shows. */
#include "studio/joins.h"

#include <math.h>
#include <stdlib.h>

enum
{
    CELLS = 24, /* across the model */
    SAMPLES = 8 /* along an edge */
};

static const double SAME_UV = 1e-5;

/* What is looked at, taken apart once. */
typedef struct sight
{
    const osdtex_surface_info *surface;
    const osdtex_mapping_info *mapping;
    const osdtex_exemplar_info *exemplars[OTX_SNAPSHOT_EXEMPLARS_MAX];
} sight;

static sight
look(const otx_snapshot *s)
{
    sight out = {
        osdtex_surface_describe(osdtex_mapping_surface(s->outcome->mapping)),
        osdtex_mapping_describe(s->outcome->mapping),
        {NULL}};

    for (int k = 0; k < OTX_SNAPSHOT_EXEMPLARS_MAX; ++k)
        if (s->outcome->exemplars[k])
            out.exemplars[k] =
                osdtex_exemplar_describe(s->outcome->exemplars[k]);
    return out;
}

/* A side of an edge: the face, and its corners in one order on both sides. */
typedef struct side
{
    int32_t face, corners[2];
} side;

static int32_t
next_corner(const osdtex_surface_info *s, int32_t face, int32_t c)
{
    return c + 1 < s->face_first[face + 1] ? c + 1 : s->face_first[face];
}

/* -- one edge ------------------------------------------------------------- */

static const osdtex_exemplar_info *
exemplar_of(const sight *s, int32_t face)
{
    const int32_t patch = s->mapping->face_patch[face];
    const int k = patch >= 0 && s->mapping->patch_exemplar
                      ? s->mapping->patch_exemplar[patch]
                      : 0;

    return s->exemplars[k] ? s->exemplars[k] : s->exemplars[0];
}

/* Into 0 .. size - 1, around or to the rim. */
static int32_t
texel_at(double at, int32_t size, bool wraps)
{
    const double turned = wraps ? at - floor(at) : fmin(1.0, fmax(0.0, at));
    const int32_t texel = (int32_t)(turned * size);

    return texel < size ? texel : size - 1;
}

static void
color_at(const sight *s, const side *a, double t, double out[3])
{
    const osdtex_exemplar_info *e = exemplar_of(s, a->face);
    const float *p = s->mapping->uvs + 2 * (size_t)a->corners[0];
    const float *q = s->mapping->uvs + 2 * (size_t)a->corners[1];
    const int32_t x =
        texel_at((double)p[0] + t * ((double)q[0] - p[0]), e->width, e->wrap_x);
    const int32_t y = texel_at(
        (double)p[1] + t * ((double)q[1] - p[1]), e->height, e->wrap_y);
    const float *pixel =
        e->pixels +
        ((size_t)y * (size_t)e->width + (size_t)x) * (size_t)e->channels;

    for (int k = 0; k < 3; ++k)
        out[k] = sqrt(fmax(0.0, (double)pixel[k]));
}

/* 0 where both sides show the same place, or almost. */
static double
difference(const sight *s, const side sides[2])
{
    const float *uvs = s->mapping->uvs;
    double sum = 0.0;
    bool is_seam =
        exemplar_of(s, sides[0].face) != exemplar_of(s, sides[1].face);

    for (int i = 0; i < 4; ++i)
    {
        const double d =
            (double)uvs[2 * (size_t)sides[0].corners[i / 2] + i % 2] -
            (double)uvs[2 * (size_t)sides[1].corners[i / 2] + i % 2];

        is_seam |= fabs(d) > SAME_UV;
    }
    if (!is_seam)
        return 0.0;
    for (int i = 0; i < SAMPLES; ++i)
    {
        double a[3], b[3];

        color_at(s, &sides[0], (i + 0.5) / SAMPLES, a);
        color_at(s, &sides[1], (i + 0.5) / SAMPLES, b);
        for (int k = 0; k < 3; ++k)
            sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return fmax(1e-9, sqrt(sum / (3.0 * SAMPLES)));
}

/* -- all of them ---------------------------------------------------------- */

/* Edges by their vertex of the smaller number: `next` chains corners. */
typedef struct chains
{
    int32_t *first; /* [verts] */
    int32_t *next;  /* [corners] */
    int32_t *face;  /* [corners] */
} chains;

static void
free_chains(chains *c)
{
    free(c->first);
    free(c->next);
    free(c->face);
}

static bool
make_chains(const osdtex_surface_info *s, chains *out)
{
    *out = (chains){
        malloc(sizeof(int32_t) * (size_t)s->vert_count),
        malloc(sizeof(int32_t) * (size_t)s->corner_count),
        malloc(sizeof(int32_t) * (size_t)s->corner_count)};
    if (!out->first || !out->next || !out->face)
        return false;
    for (int32_t v = 0; v < s->vert_count; ++v)
        out->first[v] = -1;
    for (int32_t f = 0; f < s->face_count; ++f)
        for (int32_t c = s->face_first[f]; c < s->face_first[f + 1]; ++c)
            out->face[c] = f;
    return true;
}

static void
ends_of(
    const osdtex_surface_info *s, const chains *all, int32_t c, int32_t v[2])
{
    const int32_t a = s->face_verts[c];
    const int32_t b = s->face_verts[next_corner(s, all->face[c], c)];

    v[0] = a < b ? a : b;
    v[1] = a < b ? b : a;
}

/* The corner whose edge is that of c, of those before; -1 none. */
static int32_t
twin_of(const osdtex_surface_info *s, chains *all, int32_t c)
{
    int32_t ends[2], others[2];

    ends_of(s, all, c, ends);
    for (int32_t d = all->first[ends[0]]; d >= 0; d = all->next[d])
    {
        ends_of(s, all, d, others);
        if (others[1] == ends[1])
            return d;
    }
    all->next[c] = all->first[ends[0]];
    all->first[ends[0]] = c;
    return -1;
}

static side
side_of(const osdtex_surface_info *s, int32_t face, int32_t c, int32_t from)
{
    const int32_t after = next_corner(s, face, c);

    return s->face_verts[c] == from ? (side){face, {c, after}}
                                    : (side){face, {after, c}};
}

otx_joins
otx_joins_find(const otx_snapshot *snapshot)
{
    const sight s = look(snapshot);
    const int32_t corners = s.surface->corner_count;
    otx_joins out = {malloc(sizeof(otx_join) * (size_t)corners), 0, false};
    chains all;

    out.failed = !make_chains(s.surface, &all) || !out.items;
    for (int32_t c = 0; c < corners && !out.failed; ++c)
    {
        const int32_t d = twin_of(s.surface, &all, c);
        const int32_t from = s.surface->face_verts[c];
        double differs;

        if (d < 0 || s.mapping->face_patch[all.face[c]] < 0 ||
            s.mapping->face_patch[all.face[d]] < 0)
            continue;
        differs = difference(
            &s, (const side[2]){
                    side_of(s.surface, all.face[c], c, from),
                    side_of(s.surface, all.face[d], d, from)});
        if (differs > 0.0)
            out.items[out.count++] = (otx_join){c, (float)differs};
    }
    free_chains(&all);
    return out;
}

/* -- places --------------------------------------------------------------- */

typedef struct place
{
    double length, badness;
    double point[3], normal[3]; /* sums, weighted by badness */
} place;

/* The box around all vertices, as its lowest corner and a cell's width. */
static double
find_grid(const osdtex_surface_info *s, double low[3])
{
    double width = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        double high = -INFINITY;

        low[k] = INFINITY;
        for (int32_t v = 0; v < s->vert_count; ++v)
        {
            low[k] = fmin(low[k], (double)s->points[3 * (size_t)v + (size_t)k]);
            high = fmax(high, (double)s->points[3 * (size_t)v + (size_t)k]);
        }
        width = fmax(width, high - low[k]);
    }
    return width > 0.0 ? width * (1.0 + 1e-9) / CELLS : 1.0;
}

static void
add_join(
    const osdtex_surface_info *s, const otx_join *join, int32_t face,
    const double low[3], double cell, place *places)
{
    const size_t a = 3 * (size_t)s->face_verts[join->corner];
    const size_t b =
        3 * (size_t)s->face_verts[next_corner(s, face, join->corner)];
    double middle[3], length = 0.0, badness;
    place *p = places;

    for (int k = 0, stride = 1; k < 3; ++k, stride *= CELLS)
    {
        const double d =
            (double)s->points[b + (size_t)k] - (double)s->points[a + (size_t)k];

        middle[k] = (double)s->points[a + (size_t)k] + 0.5 * d;
        length += d * d;
        p += stride * (int)fmin(CELLS - 1, (middle[k] - low[k]) / cell);
    }
    length = sqrt(length);
    badness = length * (double)join->difference;
    p->length += length;
    p->badness += badness;
    for (int k = 0; k < 3; ++k)
    {
        p->point[k] += badness * middle[k];
        p->normal[k] += badness * (double)s->normals[a + (size_t)k];
    }
}

static json_t *
tell_place(const osdtex_surface_info *s, const place *p)
{
    double at[3], normal[3], length = 0.0;

    for (int k = 0; k < 3; ++k)
    {
        at[k] = p->point[k] / p->badness + s->origin[k];
        length += p->normal[k] * p->normal[k];
    }
    for (int k = 0; k < 3; ++k)
        normal[k] = length > 0.0 ? p->normal[k] / sqrt(length) : k == 2;
    return json_pack(
        "{s:[f,f,f], s:[f,f,f], s:f, s:f}", "point", at[0], at[1], at[2],
        "normal", normal[0], normal[1], normal[2], "length", p->length,
        "difference", p->badness / p->length);
}

/* The worst cell; its neighbours are in the same picture, and pass. */
static json_t *
take_worst(const osdtex_surface_info *s, place *places)
{
    int worst = 0;
    json_t *told;

    for (int i = 1; i < CELLS * CELLS * CELLS; ++i)
        if (places[i].badness > places[worst].badness)
            worst = i;
    if (!(places[worst].badness > 0.0))
        return NULL;
    told = tell_place(s, &places[worst]);
    for (int i = 0; i < 27; ++i)
    {
        const int x = worst % CELLS + i % 3 - 1;
        const int y = worst / CELLS % CELLS + i / 3 % 3 - 1;
        const int z = worst / CELLS / CELLS + i / 9 - 1;

        if (x >= 0 && y >= 0 && z >= 0 && x < CELLS && y < CELLS && z < CELLS)
            places[x + CELLS * (y + CELLS * z)].badness = 0.0;
    }
    return told;
}

json_t *
otx_joins_places(const otx_snapshot *snapshot, const otx_joins *joins)
{
    const osdtex_surface_info *s = osdtex_surface_describe(
        osdtex_mapping_surface(snapshot->outcome->mapping));
    place *places = calloc(CELLS * CELLS * CELLS, sizeof *places);
    json_t *list = json_array(), *told;
    double low[3];
    const double cell = find_grid(s, low);
    int32_t face = 0;

    /* Joins are in the order of corners, and so of faces. */
    for (int32_t i = 0; places && i < joins->count; ++i)
    {
        while (s->face_first[face + 1] <= joins->items[i].corner)
            ++face;
        add_join(s, &joins->items[i], face, low, cell, places);
    }
    for (int i = 0; places && i < OTX_JOINS_PLACES_MOST &&
                    (told = take_worst(s, places)) != NULL;
         ++i)
        json_array_append_new(list, told);
    free(places);
    return list;
}

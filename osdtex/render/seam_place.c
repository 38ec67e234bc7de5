/* seam_place.c -- seams by cells of a grid. */
#include "render/seam_place.h"

#include "image/view.h"
#include "render/island.h"
#include "seam/difference.h"

#include <stdlib.h>

enum
{
    CELLS = 24,  /* across the model */
    SAMPLES = 8, /* along an edge */
    PULSE = 4096 /* edges, after which somebody may have lost patience */
};

/* What shares a cell. */
typedef struct pile
{
    int32_t at[3]; /* cell */
    int32_t corner;
    double length;
    double badness;         /* length times difference */
    otx_vec3 point, normal; /* sums, weighted by badness */
} pile;

/* -- one edge ------------------------------------------------------------ */

/* A side of an edge: its face, and its corners in the order of corner c's
 * face. */
typedef struct side
{
    int32_t face;
    int32_t corners[2];
} side;

static int32_t
next_corner(const otx_scene *scene, int32_t face, int32_t c)
{
    return c + 1 < scene->face_first[face + 1] ? c + 1
                                               : scene->face_first[face];
}

static void
sides_of(
    const otx_scene *scene, const int32_t *faces, int32_t c, int32_t d,
    side out[2])
{
    const int32_t after = next_corner(scene, faces[d], d);
    const bool opposed = scene->face_verts[c] != scene->face_verts[d];

    out[0] = (side){faces[c], {c, next_corner(scene, faces[c], c)}};
    out[1] = (side){faces[d], {opposed ? after : d, opposed ? d : after}};
}

static otx_vec2
uv_at(const otx_scene *scene, const side *s, double t)
{
    const float *a = scene->uvs + 2 * (size_t)s->corners[0];
    const float *b = scene->uvs + 2 * (size_t)s->corners[1];

    return (otx_vec2){a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

static void
color_at(const otx_scene *scene, const side *s, double t, double color[3])
{
    const int32_t index =
        scene->face_texture ? scene->face_texture[s->face] : 0;
    const otx_scene_texture *texture;
    float pixel[4];
    otx_vec2 uv;

    color[0] = color[1] = color[2] = 0.0;
    if (index < 0 || index >= scene->texture_count)
        return;
    texture = &scene->textures[index];
    uv = uv_at(scene, s, t);
    otx_view_value(
        otx_view_of(&texture->image, texture->wrap_x, texture->wrap_y),
        (otx_vec2){uv.x * texture->image.width, uv.y * texture->image.height},
        pixel);
    for (int32_t k = 0; k < 3; ++k)
        color[k] =
            sqrt(fmax(0.0, (double)pixel[texture->image.channels < 3 ? 0 : k]));
}

/* 0 .. 1. */
static double
difference(const otx_scene *scene, const side sides[2])
{
    double sum = 0.0;

    for (int32_t i = 0; i < SAMPLES; ++i)
    {
        const double t = (i + 0.5) / SAMPLES;
        double a[3], b[3];

        color_at(scene, &sides[0], t, a);
        color_at(scene, &sides[1], t, b);
        sum = otx_difference_add_sq(sum, a, b);
    }
    return sqrt(sum / (3.0 * SAMPLES));
}

/* Area times normal. */
static otx_vec3
face_normal(const otx_scene *scene, int32_t face)
{
    const int32_t first = scene->face_first[face];
    const otx_vec3 o = otx_vec3_load(scene->points, scene->face_verts[first]);
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t c = first + 1; c + 1 < scene->face_first[face + 1]; ++c)
        sum = otx_vec3_add(
            sum, otx_vec3_cross(
                     otx_vec3_sub(
                         otx_vec3_load(scene->points, scene->face_verts[c]), o),
                     otx_vec3_sub(
                         otx_vec3_load(scene->points, scene->face_verts[c + 1]),
                         o)));
    return sum;
}

static pile
pile_of(
    const otx_scene *scene, const side sides[2], double differs, otx_vec3 low,
    double cell)
{
    const otx_vec3 a =
        otx_vec3_load(scene->points, scene->face_verts[sides[0].corners[0]]);
    const otx_vec3 b =
        otx_vec3_load(scene->points, scene->face_verts[sides[0].corners[1]]);
    const otx_vec3 middle = otx_vec3_mix(0.5, a, 0.5, b);
    const otx_vec3 across = otx_vec3_add(
        face_normal(scene, sides[0].face), face_normal(scene, sides[1].face));
    const double length = otx_vec3_length(across);
    const double edge = otx_vec3_length(otx_vec3_sub(b, a));
    const double badness = edge * differs;

    return (pile){
        .at =
            {(int32_t)((middle.x - low.x) / cell),
             (int32_t)((middle.y - low.y) / cell),
             (int32_t)((middle.z - low.z) / cell)},
        .corner = sides[0].corners[0],
        .length = edge,
        .badness = badness,
        .point = otx_vec3_scale(badness, middle),
        .normal =
            otx_vec3_scale(length > 0.0 ? badness / length : 0.0, across)};
}

/* -- all of them --------------------------------------------------------- */

static int
by_cell(const pile *a, const pile *b)
{
    for (int32_t k = 0; k < 3; ++k)
        if (a->at[k] != b->at[k])
            return a->at[k] < b->at[k] ? -1 : 1;
    return 0;
}

/* Sums are made in the order of corners. */
static int
by_cell_and_corner(const void *a, const void *b)
{
    const pile *x = a, *y = b;
    const int cells = by_cell(x, y);

    return cells != 0 ? cells
                      : (x->corner > y->corner) - (x->corner < y->corner);
}

static int
by_badness(const void *a, const void *b)
{
    const pile *x = a, *y = b;

    if (x->badness != y->badness)
        return x->badness > y->badness ? -1 : 1;
    return by_cell(x, y);
}

/* Adds up what shares a cell; how many are left. */
static int32_t
merge(pile *piles, int32_t count)
{
    int32_t kept = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        pile *last = kept > 0 ? &piles[kept - 1] : NULL;

        if (!last || by_cell(last, &piles[i]) != 0)
        {
            piles[kept++] = piles[i];
            continue;
        }
        last->length += piles[i].length;
        last->badness += piles[i].badness;
        last->point = otx_vec3_add(last->point, piles[i].point);
        last->normal = otx_vec3_add(last->normal, piles[i].normal);
    }
    return kept;
}

static bool
is_beside(const pile *a, const pile *b)
{
    for (int32_t k = 0; k < 3; ++k)
        if (abs(a->at[k] - b->at[k]) > 1)
            return false;
    return true;
}

static otx_seam_place
place_of(const pile *p)
{
    /* Two sides of a sheet may cancel. */
    const bool cancels = !(otx_vec3_length(p->normal) > 1e-6 * p->badness);

    return (otx_seam_place){
        otx_vec3_scale(1.0 / p->badness, p->point),
        cancels ? (otx_vec3){0.0, 0.0, 1.0} : otx_vec3_unit(p->normal),
        p->length, p->badness / p->length};
}

/* The first `most` of those that are sorted, show and lie apart; how many there
 * are. */
static int32_t
pick(const pile *piles, int32_t count, int32_t most, otx_seam_place *out)
{
    const pile *shown[OTX_SEAM_PLACES_MAX];
    int32_t shown_count = 0;

    for (int32_t i = 0;
         i < count && shown_count < most && piles[i].badness > 0.0; ++i)
    {
        bool apart = true;

        for (int32_t k = 0; k < shown_count && apart; ++k)
            apart = !is_beside(shown[k], &piles[i]);
        if (!apart)
            continue;
        out[shown_count] = place_of(&piles[i]);
        shown[shown_count++] = &piles[i];
    }
    return shown_count;
}

/* What seams are looked at with. */
typedef struct sight
{
    const otx_scene *scene;
    const int32_t *twin, *faces; /* [corner_count] */
    const uint8_t *seam;         /* [corner_count] */
    otx_vec3 low;
    double cell;
} sight;

static otx_status
look(otx_run *run, const otx_scene *scene, sight *out)
{
    int32_t *faces = OTX_NEW(run->scratch, int32_t, scene->corner_count);
    otx_vec3 centre;
    double radius;

    OTX_TRY(otx_run_ok(run));
    *out = (sight){.scene = scene, .faces = faces};
    OTX_TRY(otx_island_pair(run, run->scratch, scene, &out->twin));
    OTX_TRY(otx_island_seams(run, run->scratch, scene, out->twin, &out->seam));
    for (int32_t f = 0; f < scene->face_count; ++f)
        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
            faces[c] = f;
    otx_scene_bounds(scene, &centre, &radius);
    out->low = otx_vec3_sub(centre, (otx_vec3){radius, radius, radius});
    out->cell = radius > 0.0 ? 2.0 * radius / CELLS : 1.0;
    return OSDTEX_OK;
}

/* Whether the edge of a corner is a seam, and this corner's to tell of. */
static bool
tells(const sight *s, int32_t c)
{
    return s->seam[c] && c < s->twin[c];
}

static otx_status
list_edges(otx_run *run, const sight *s, otx_seam_edge *edges, pile *piles)
{
    int32_t count = 0;

    for (int32_t c = 0; c < s->scene->corner_count; ++c)
    {
        side sides[2];
        double differs;

        if (!tells(s, c))
            continue;
        if (count % PULSE == 0)
            OTX_TRY(otx_pulse(run));
        sides_of(s->scene, s->faces, c, s->twin[c], sides);
        differs = difference(s->scene, sides);
        edges[count] = (otx_seam_edge){c, (float)differs};
        piles[count++] = pile_of(s->scene, sides, differs, s->low, s->cell);
    }
    return OSDTEX_OK;
}

static otx_status
find(
    otx_run *run, otx_arena *arena, const otx_scene *scene, int32_t most,
    otx_seam_places *out)
{
    otx_seam_place *places = OTX_NEW(arena, otx_seam_place, most);
    otx_seam_edge *edges;
    pile *piles;
    sight s;

    OTX_TRY(look(run, scene, &s));
    for (int32_t c = 0; c < scene->corner_count; ++c)
        out->edge_count += tells(&s, c);
    edges = OTX_NEW(arena, otx_seam_edge, out->edge_count);
    piles = OTX_NEW(run->scratch, pile, out->edge_count);
    if (!places || !edges || !piles)
        return otx_fail_memory(run, "render");
    OTX_TRY(list_edges(run, &s, edges, piles));
    qsort(piles, (size_t)out->edge_count, sizeof *piles, by_cell_and_corner);
    out->count = merge(piles, out->edge_count);
    qsort(piles, (size_t)out->count, sizeof *piles, by_badness);
    out->count = pick(piles, out->count, most, places);
    out->edges = edges;
    out->places = places;
    out->cell = s.cell;
    return OSDTEX_OK;
}

otx_status
otx_seam_places_find(
    otx_run *run, otx_arena *arena, const otx_scene *scene, int32_t most,
    otx_seam_places *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);

    *out = (otx_seam_places){.cell = 1.0};
    if (!scene->uvs || scene->texture_count == 0)
        return OSDTEX_OK;
    OTX_TRY(find(run, arena, scene, most, out));
    if (arena != run->scratch)
        otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

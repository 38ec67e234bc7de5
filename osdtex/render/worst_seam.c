/* worst_seam.c -- seams by cells of a grid.
 *
 * A seam is as bad as its colour difference times its length. What is summed
 * over a cell of the grid is found by the eye as one place, however many edges
 * it has. Cells beside one that was shown are passed over: it was in that
 * picture. Colours are compared as square roots, about as they are seen. */
#include "render/worst_seam.h"

#include "image/view.h"
#include "render/island.h"
#include "seam/difference.h"

#include <stdlib.h>
#include <string.h>

enum
{
    CELLS = 24, /* across the model */
    SAMPLES = 8 /* along an edge */
};

/* Height of the picture, in cells. */
static const double PICTURE = 3.0;

/* Of the way to the place: in narrow corners other parts of the model are in
 * between. */
static const double CLIP = 0.75;

static const char STAGE[] = "render";

typedef struct place
{
    int32_t at[3]; /* cell */
    double length;
    double badness;         /* length times difference */
    otx_vec3 point, normal; /* sums, weighted by badness */
} place;

int32_t
otx_worst_seam_rank(const char *name)
{
    char *end;
    long rank;

    if (strncmp(name, "seam", 4) != 0 || name[4] < '1' || name[4] > '9')
        return 0;
    rank = strtol(name + 4, &end, 10);
    return *end == '\0' && rank <= OTX_WORST_SEAM_MAX ? (int32_t)rank : 0;
}

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
    return sqrt(sum / SAMPLES);
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

static place
place_of(const otx_scene *scene, const side sides[2], otx_vec3 low, double cell)
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
    const double badness = edge * difference(scene, sides);

    return (place){
        .at =
            {(int32_t)((middle.x - low.x) / cell),
             (int32_t)((middle.y - low.y) / cell),
             (int32_t)((middle.z - low.z) / cell)},
        .length = edge,
        .badness = badness,
        .point = otx_vec3_scale(badness, middle),
        .normal =
            otx_vec3_scale(length > 0.0 ? badness / length : 0.0, across)};
}

/* -- all of them --------------------------------------------------------- */

static int
by_cell(const void *a, const void *b)
{
    const place *x = a, *y = b;

    for (int32_t k = 0; k < 3; ++k)
        if (x->at[k] != y->at[k])
            return x->at[k] < y->at[k] ? -1 : 1;
    return 0;
}

static int
by_badness(const void *a, const void *b)
{
    const place *x = a, *y = b;

    if (x->badness != y->badness)
        return x->badness > y->badness ? -1 : 1;
    return by_cell(a, b);
}

/* Adds up what shares a cell; how many are left. */
static int32_t
merge(place *places, int32_t count)
{
    int32_t kept = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        place *last = &places[kept - 1];

        if (kept == 0 || by_cell(last, &places[i]) != 0)
        {
            places[kept++] = places[i];
            continue;
        }
        last->length += places[i].length;
        last->badness += places[i].badness;
        last->point = otx_vec3_add(last->point, places[i].point);
        last->normal = otx_vec3_add(last->normal, places[i].normal);
    }
    return kept;
}

static bool
is_beside(const place *a, const place *b)
{
    for (int32_t k = 0; k < 3; ++k)
        if (abs(a->at[k] - b->at[k]) > 1)
            return false;
    return true;
}

/* The first `most` of those that are sorted, show and lie apart; how many there
 * are. */
static int32_t
pick(const place *places, int32_t count, int32_t most, int32_t *shown)
{
    int32_t shown_count = 0;

    for (int32_t i = 0;
         i < count && shown_count < most && places[i].badness > 0.0; ++i)
    {
        bool apart = true;

        for (int32_t k = 0; k < shown_count && apart; ++k)
            apart = !is_beside(&places[shown[k]], &places[i]);
        if (apart)
            shown[shown_count++] = i;
    }
    return shown_count;
}

static otx_status
list_places(
    otx_run *run, const otx_scene *scene, otx_vec3 low, double cell,
    place **out, int32_t *count)
{
    const int32_t *twin;
    const uint8_t *seam;
    int32_t *faces = OTX_NEW(run->scratch, int32_t, scene->corner_count);

    *count = 0;
    OTX_TRY(otx_island_pair(run, run->scratch, scene, &twin));
    OTX_TRY(otx_island_seams(run, run->scratch, scene, twin, &seam));
    *out = OTX_NEW(run->scratch, place, scene->corner_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < scene->face_count; ++f)
        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
            faces[c] = f;
    for (int32_t c = 0; c < scene->corner_count; ++c)
    {
        side sides[2];

        if (!seam[c] || twin[c] < c)
            continue;
        sides_of(scene, faces, c, twin[c], sides);
        (*out)[(*count)++] = place_of(scene, sides, low, cell);
    }
    return OSDTEX_OK;
}

/* The place along its normal, in a picture of that height. */
static otx_camera
view_of(const place *p, double height)
{
    const otx_vec3 target = otx_vec3_scale(1.0 / p->badness, p->point);
    /* Two sides of a sheet may cancel. */
    const otx_vec3 normal = otx_vec3_length(p->normal) > 1e-6 * p->badness
                                ? otx_vec3_unit(p->normal)
                                : (otx_vec3){0.0, 0.0, 1.0};
    const double distance = 0.5 * height / tan(0.5 * OTX_CAMERA_FOV);

    return (otx_camera){
        otx_vec3_add(target, otx_vec3_scale(distance, normal)), target,
        OTX_CAMERA_FOV, CLIP, OTX_UP_Y};
}

/* Says where it is, and how bad. */
static void
note_place(otx_run *run, int32_t rank, const place *p)
{
    const otx_vec3 at = otx_vec3_scale(1.0 / p->badness, p->point);

    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
        "seam%d is around (%.4g, %.4g, %.4g): %.3g units of seams, whose two "
        "sides differ by %.2f in the mean (1: black beside white)",
        (int)rank, at.x, at.y, at.z, p->length,
        p->badness / p->length / sqrt(3.0));
}

/* Places by how bad they are; `count` is 0 where there is no seam. In
 * run->scratch. */
static otx_status
rank_places(
    otx_run *run, const otx_scene *scene, place **places, int32_t *count,
    double *cell)
{
    otx_vec3 centre, low;
    double radius;

    *count = 0;
    if (!scene->uvs || scene->texture_count == 0)
        return OSDTEX_OK;
    otx_scene_bounds(scene, &centre, &radius);
    low = otx_vec3_sub(centre, (otx_vec3){radius, radius, radius});
    *cell = radius > 0.0 ? 2.0 * radius / CELLS : 1.0;
    OTX_TRY(list_places(run, scene, low, *cell, places, count));
    qsort(*places, (size_t)*count, sizeof **places, by_cell);
    *count = merge(*places, *count);
    qsort(*places, (size_t)*count, sizeof **places, by_badness);
    return OSDTEX_OK;
}

otx_status
otx_worst_seam_count(
    otx_run *run, const otx_scene *scene, int32_t most, int32_t *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t shown[OTX_WORST_SEAM_MAX], count;
    place *places;
    double cell;

    *out = 0;
    OTX_TRY(rank_places(run, scene, &places, &count, &cell));
    if (count > 0)
        *out = pick(places, count, most, shown);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_worst_seam_camera(
    otx_run *run, const otx_scene *scene, int32_t rank, otx_camera *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t shown[OTX_WORST_SEAM_MAX], count, found;
    place *places;
    double cell;

    if (!scene->uvs || scene->texture_count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the model has no texture whose seams could be looked for");
    OTX_TRY(rank_places(run, scene, &places, &count, &cell));
    if (count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the model has no seam to look at");
    found = pick(places, count, rank, shown);
    if (found == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no seam of the model shows");

    const place *worst = &places[shown[found - 1]];

    note_place(run, rank, worst);
    *out = view_of(worst, PICTURE * cell);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

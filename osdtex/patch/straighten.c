/* straighten.c -- triangles without area.
 *
 * Modellers close T-junctions by triangles whose corners lie on one line. In
 * UV such a corner comes to lie about a texel off the opposite edge, on either
 * side: nobody sees it, but programs that refuse reversed faces do. Where it is
 * on the wrong side it is moved, in all faces that share it, just across. */
#include "patch/straighten.h"
#include "patch/given_patches.h"
#include "surface/limit.h"

static const double FARTHEST = 4.0; /* texels: what is moved more would show */
static const double BEYOND = 0.02;  /* texels behind the edge */

enum
{
    ROUNDS = 4 /* triangles without area may lie beside each other */
};

/* Corners of a vertex that lie at one place, and where they go. */
typedef struct shift
{
    int32_t next; /* of the same vertex, -1 none */
    bool dropped;
    const otx_exemplar *exemplar;
    otx_vec2 from, to;
} shift;

typedef struct straightener
{
    const otx_mosaic_job *job;
    otx_cover *cover;
    const otx_level *leaf;
    int32_t *heads; /* [vert_count] the first shift of a vertex, -1 none */
    shift *shifts;  /* [face_count] */
    int32_t count;
} straightener;

static bool
same(otx_vec2 a, otx_vec2 b)
{
    return a.x == b.x && a.y == b.y;
}

/* The shift that takes a corner along; NULL none. */
static shift *
shift_of(const straightener *s, int32_t corner)
{
    for (int32_t i = s->heads[s->leaf->face_verts[corner]]; i >= 0;
         i = s->shifts[i].next)
        if (!s->shifts[i].dropped &&
            same(s->shifts[i].from, s->cover->uvs[corner]))
            return &s->shifts[i];
    return NULL;
}

static otx_vec2
place(const straightener *s, int32_t corner, bool moved)
{
    const shift *by = moved ? shift_of(s, corner) : NULL;

    return by ? by->to : s->cover->uvs[corner];
}

static double
uv_area2(const straightener *s, int32_t face, bool moved)
{
    const int32_t first = s->leaf->face_first[face];
    const otx_vec2 origin = place(s, first, moved);
    double sum = 0.0;

    for (int32_t c = first + 1; c + 1 < s->leaf->face_first[face + 1]; ++c)
        sum += otx_vec2_cross(
            otx_vec2_sub(place(s, c, moved), origin),
            otx_vec2_sub(place(s, c + 1, moved), origin));
    return sum;
}

static bool
is_flat(const straightener *s, int32_t face)
{
    return otx_limit_face_is_flat(s->leaf, s->job->surface->points, face);
}

/* The corner of a triangle that lies between the two others. */
static int32_t
middle_corner(const straightener *s, int32_t first)
{
    const float *points = s->job->surface->points;
    const int32_t *verts = s->leaf->face_verts + first;
    double longest = -1.0;
    int32_t middle = 0;

    for (int32_t k = 0; k < 3; ++k)
    {
        const otx_vec3 side = otx_vec3_sub(
            otx_vec3_load(points, verts[(k + 1) % 3]),
            otx_vec3_load(points, verts[(k + 2) % 3]));

        if (otx_vec3_dot(side, side) > longest)
        {
            longest = otx_vec3_dot(side, side);
            middle = k;
        }
    }
    return middle;
}

static void
plan_shift(straightener *s, int32_t face)
{
    const int32_t first = s->leaf->face_first[face];
    const int32_t k = middle_corner(s, first);
    const otx_vec2 *uvs = s->cover->uvs + first;
    const otx_vec2 from = uvs[k], a = uvs[(k + 1) % 3];
    const otx_vec2 edge = otx_vec2_sub(uvs[(k + 2) % 3], a);
    const double length = otx_vec2_length(edge);
    const double height = otx_vec2_cross(edge, otx_vec2_sub(from, a)) / length;
    int32_t *head = &s->heads[s->leaf->face_verts[first + k]];

    if (!(length > 0.0) || !(height > -FARTHEST) || shift_of(s, first + k))
        return;

    const double share = (BEYOND - height) / length;
    const otx_exemplar *exemplar = &s->job->exemplars[otx_cover_exemplar(
        s->cover, s->cover->face_patch[face])];

    s->shifts[s->count] = (shift){
        *head,
        false,
        exemplar,
        from,
        {from.x - share * edge.y, from.y + share * edge.x}};
    *head = s->count++;
}

static void
plan(straightener *s)
{
    s->count = 0;
    for (int32_t v = 0; v < s->leaf->vert_count; ++v)
        s->heads[v] = -1;
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
        if (s->cover->face_patch[f] >= 0 &&
            otx_level_face_size(s->leaf, f) == 3 &&
            !(uv_area2(s, f, false) > 0.0) && is_flat(s, f))
            plan_shift(s, f);
}

/* Gives up what would change a face that an edit leaves alone. */
static void
spare_held(straightener *s)
{
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
        for (int32_t c = s->leaf->face_first[f];
             otx_given_holds(s->job, f) && c < s->leaf->face_first[f + 1]; ++c)
        {
            shift *by = shift_of(s, c);

            if (by)
                by->dropped = true;
        }
}

/* Gives up what would reverse a face that has area, until nothing does. */
static void
spare_others(straightener *s)
{
    for (bool again = true; again;)
    {
        again = false;
        for (int32_t f = 0; f < s->leaf->face_count; ++f)
        {
            if (s->cover->face_patch[f] < 0 || uv_area2(s, f, true) > 0.0 ||
                !(uv_area2(s, f, false) > 0.0) || is_flat(s, f))
                continue;
            for (int32_t c = s->leaf->face_first[f];
                 c < s->leaf->face_first[f + 1]; ++c)
            {
                shift *by = shift_of(s, c);

                if (by)
                    again = by->dropped = true;
            }
        }
    }
}

/* Away from its border, where the exemplar does not tile. */
static void
stay_inside(straightener *s)
{
    for (int32_t i = 0; i < s->count; ++i)
    {
        shift *by = &s->shifts[i];
        const otx_exemplar *e = by->exemplar;

        by->dropped |=
            (!e->wrap_x && !(by->to.x >= 0.0 && by->to.x <= e->match.width)) ||
            (!e->wrap_y && !(by->to.y >= 0.0 && by->to.y <= e->match.height));
    }
}

static void
apply(straightener *s)
{
    for (int32_t c = 0; c < s->leaf->corner_count; ++c)
        s->cover->uvs[c] = place(s, c, true);
}

otx_status
otx_straighten(const otx_mosaic_job *job, otx_cover *cover)
{
    const otx_level *leaf = job->leaves.level;
    straightener s = {
        .job = job,
        .cover = cover,
        .leaf = leaf,
        .heads = OTX_NEW(job->run->scratch, int32_t, leaf->vert_count),
        .shifts = OTX_NEW(job->run->scratch, shift, leaf->face_count),
    };

    OTX_TRY(otx_run_ok(job->run));
    for (int32_t round = 0; round < ROUNDS; ++round)
    {
        plan(&s);
        if (s.count == 0)
            break;
        stay_inside(&s);
        spare_held(&s);
        spare_others(&s);
        apply(&s);
    }
    return OSDTEX_OK;
}

/* ground.c -- charts that grow face by face. */
#include "place/ground.h"

#include "base/pqueue.h"

#include <string.h>

enum
{
    STEPS_PER_LOOK = 4096
};

/* Areas in the plane to those on the surface that a face may have when it is
 * added. */
static const double AREA_LEAST = 0.4, AREA_MOST = 2.5;

static const otx_level *
leaf_of(const otx_ground *u)
{
    return otx_surface_leaf(u->ask->surface);
}

static int32_t
largest_face(const otx_level *leaf)
{
    int32_t size = 3;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (otx_level_face_size(leaf, f) > size)
            size = otx_level_face_size(leaf, f);
    return size;
}

/* ---- one face ---- */

/* Twice the area of a face on the surface as a vector, in widths. */
static otx_vec3
area_vector(const otx_ground *u, int32_t face)
{
    const otx_level *leaf = leaf_of(u);
    const int32_t *verts = leaf->face_verts + leaf->face_first[face];
    const float *points = u->ask->surface->points;
    const otx_vec3 origin = otx_vec3_load(points, verts[0]);
    otx_vec3 sum = {0, 0, 0};

    for (int32_t k = 1; k + 1 < otx_level_face_size(leaf, face); ++k)
        sum = otx_vec3_add(
            sum,
            otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(points, verts[k]), origin),
                otx_vec3_sub(otx_vec3_load(points, verts[k + 1]), origin)));
    return otx_vec3_scale(1.0 / (u->ask->width * u->ask->width), sum);
}

/* The corners of a face in its mean plane. */
static void
project(otx_ground *u, int32_t face)
{
    const otx_level *leaf = leaf_of(u);
    const int32_t *verts = leaf->face_verts + leaf->face_first[face];
    const float *points = u->ask->surface->points;
    const otx_vec3 n = otx_vec3_unit(area_vector(u, face));
    const otx_vec3 helper =
        fabs(n.x) < 0.6 ? (otx_vec3){1, 0, 0} : (otx_vec3){0, 1, 0};
    const otx_vec3 x = otx_vec3_unit(otx_vec3_cross(helper, n));
    const otx_vec3 y = otx_vec3_cross(n, x);
    const otx_vec3 origin = otx_vec3_load(points, verts[0]);

    for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
    {
        const otx_vec3 d = otx_vec3_scale(
            1.0 / u->ask->width,
            otx_vec3_sub(otx_vec3_load(points, verts[k]), origin));

        u->shape[k] = (otx_vec2){otx_vec3_dot(d, x), otx_vec3_dot(d, y)};
    }
}

static int32_t
slot_of(const otx_ground *u, int32_t face, int32_t k)
{
    const otx_level *leaf = leaf_of(u);

    return u->space->vert_slot[leaf->face_verts[leaf->face_first[face] + k]];
}

/* Means of the corners that are in the chart, in the face's plane and in the
 * chart's; how many they are. */
static int32_t
means(const otx_ground *u, int32_t face, otx_vec2 *from, otx_vec2 *to)
{
    const int32_t size = otx_level_face_size(leaf_of(u), face);
    int32_t known = 0;

    *from = *to = (otx_vec2){0, 0};
    for (int32_t k = 0; k < size; ++k)
        if (slot_of(u, face, k) >= 0)
        {
            *from = otx_vec2_add(*from, u->shape[k]);
            *to = otx_vec2_add(*to, u->chart->flat[slot_of(u, face, k)]);
            ++known;
        }
    *from = otx_vec2_scale(1.0 / (known > 0 ? known : 1), *from);
    *to = otx_vec2_scale(1.0 / (known > 0 ? known : 1), *to);
    return known;
}

/* Where the corners of a face go: known ones stay, the others follow by the
 * rigid motion that suits the known ones best. */
static void
lay(otx_ground *u, int32_t face)
{
    const int32_t size = otx_level_face_size(leaf_of(u), face);
    otx_vec2 from, to, turn = {0, 0};
    double length;

    project(u, face);
    means(u, face, &from, &to);
    for (int32_t k = 0; k < size; ++k)
        if (slot_of(u, face, k) >= 0)
        {
            const otx_vec2 a = otx_vec2_sub(u->shape[k], from);
            const otx_vec2 b =
                otx_vec2_sub(u->chart->flat[slot_of(u, face, k)], to);

            turn = otx_vec2_add(turn, otx_vec2_mul((otx_vec2){a.x, -a.y}, b));
        }
    length = otx_vec2_length(turn);
    turn = length > 0.0 ? otx_vec2_scale(1.0 / length, turn) : (otx_vec2){1, 0};
    for (int32_t k = 0; k < size; ++k)
        u->laid[k] =
            slot_of(u, face, k) >= 0
                ? u->chart->flat[slot_of(u, face, k)]
                : otx_vec2_add(
                      to, otx_vec2_mul(turn, otx_vec2_sub(u->shape[k], from)));
}

static double
laid_area2(const otx_ground *u, int32_t size)
{
    double sum = 0.0;

    for (int32_t k = 1; k + 1 < size; ++k)
        sum += otx_vec2_cross(
            otx_vec2_sub(u->laid[k], u->laid[0]),
            otx_vec2_sub(u->laid[k + 1], u->laid[0]));
    return sum;
}

static otx_footprint_box
widened(const otx_footprint_box *box, double reach)
{
    return (otx_footprint_box){
        {box->low.x - reach, box->low.y - reach},
        {box->high.x + reach, box->high.y + reach}};
}

/* By the bounds of the face, which is enough where they are small. */
static bool
meets(const otx_vec2 *at, int32_t size, const otx_footprint_box *box)
{
    otx_vec2 low = at[0], high = at[0];

    for (int32_t k = 1; k < size; ++k)
    {
        low = (otx_vec2){fmin(low.x, at[k].x), fmin(low.y, at[k].y)};
        high = (otx_vec2){fmax(high.x, at[k].x), fmax(high.y, at[k].y)};
    }
    return low.x < box->high.x && high.x > box->low.x && low.y < box->high.y &&
           high.y > box->low.y;
}

/* Of faces without area nothing is asked. */
static bool
keeps_area(const otx_ground *u, int32_t face)
{
    const double on = otx_vec3_length(area_vector(u, face));
    const double in = laid_area2(u, otx_level_face_size(leaf_of(u), face));

    return !(on > 1e-12) || (in > AREA_LEAST * on && in < AREA_MOST * on);
}

static void
add(otx_ground *u, int32_t face)
{
    const otx_level *leaf = leaf_of(u);
    const int32_t size = otx_level_face_size(leaf, face);
    otx_footprint *c = u->chart;
    const int32_t end = c->first[c->face_count];

    u->space->face_slot[face] = c->face_count;
    c->faces[c->face_count++] = face;
    c->first[c->face_count] = end + size;
    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t v = leaf->face_verts[leaf->face_first[face] + k];

        if (u->space->vert_slot[v] < 0)
        {
            u->space->vert_slot[v] = c->vert_count;
            c->verts[c->vert_count] = v;
            c->flat[c->vert_count++] = u->laid[k];
        }
        c->corners[end + k] = u->space->vert_slot[v];
    }
}

/* ---- growing ---- */

otx_status
otx_ground_begin(otx_ground *u)
{
    const otx_level *leaf = leaf_of(u);
    const int32_t size = largest_face(leaf);

    u->shape = OTX_NEW(u->arena, otx_vec2, size);
    u->laid = OTX_NEW(u->arena, otx_vec2, size);
    *u->chart = (otx_footprint){
        .faces = OTX_NEW(u->arena, int32_t, leaf->face_count),
        .first = OTX_NEW(u->arena, int32_t, (int64_t)leaf->face_count + 1),
        .corners = OTX_NEW(u->arena, int32_t, leaf->corner_count),
        .verts = OTX_NEW(u->arena, int32_t, leaf->vert_count),
        .flat = OTX_NEW(u->arena, otx_vec2, leaf->vert_count)};
    if (otx_arena_failed(u->arena))
        return OSDTEX_ERROR_MEMORY;
    u->chart->first[0] = 0;
    lay(u, u->ask->spot.face);
    add(u, u->ask->spot.face);
    return OSDTEX_OK;
}

/* Neighbours of a face that are not in the chart, by how far the edge to them
 * is from the origin. */
static void
push_around(const otx_ground *u, int32_t face, otx_pqueue *queue)
{
    const otx_level *leaf = leaf_of(u);
    const int32_t size = otx_level_face_size(leaf, face);

    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t next = otx_level_neighbour(leaf, face, k);
        otx_vec2 middle;

        if (next < 0 || leaf->face_hole[next] || u->space->face_slot[next] >= 0)
            continue;
        middle = otx_vec2_lerp(
            u->chart->flat[slot_of(u, face, k)],
            u->chart->flat[slot_of(u, face, (k + 1) % size)], 0.5);
        otx_pqueue_push(queue, otx_vec2_length(middle), next);
    }
}

otx_status
otx_ground_grow(otx_ground *u, double reach)
{
    const otx_footprint_box box = widened(&u->ask->box, reach);
    otx_pqueue queue = otx_pqueue_make(u->arena);
    otx_pqueue_entry entry;
    uint32_t steps = 0;

    for (int32_t i = 0; i < u->chart->face_count; ++i)
        push_around(u, u->chart->faces[i], &queue);
    while (otx_pqueue_pop(&queue, &entry))
    {
        if (u->ask->worker && ++steps % STEPS_PER_LOOK == 0)
            OTX_TRY(otx_worker_look(u->ask->worker));
        if (u->space->face_slot[entry.item] >= 0)
            continue;
        lay(u, entry.item);
        if (!meets(
                u->laid, otx_level_face_size(leaf_of(u), entry.item), &box) ||
            !keeps_area(u, entry.item))
            continue;
        add(u, entry.item);
        push_around(u, entry.item, &queue);
    }
    return otx_arena_failed(u->arena) ? OSDTEX_ERROR_MEMORY : OSDTEX_OK;
}

/* ---- trimming ---- */

static void
gather(otx_ground *u, int32_t slot)
{
    const otx_footprint *c = u->chart;

    for (int32_t i = c->first[slot]; i < c->first[slot + 1]; ++i)
        u->laid[i - c->first[slot]] = c->flat[c->corners[i]];
}

/* Marks the faces that meet the box, from the spot's on; `stack` is as long as
 * the chart. */
static void
mark_kept(
    otx_ground *u, const otx_footprint_box *box, int32_t *stack, uint8_t *kept)
{
    const otx_level *leaf = leaf_of(u);
    int32_t count = 0;

    kept[0] = 1;
    stack[count++] = 0;
    while (count > 0)
    {
        const int32_t face = u->chart->faces[stack[--count]];

        for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
        {
            const int32_t next = otx_level_neighbour(leaf, face, k);
            const int32_t slot = next < 0 ? -1 : u->space->face_slot[next];

            if (slot < 0 || kept[slot])
                continue;
            gather(u, slot);
            if (!meets(u->laid, otx_level_face_size(leaf, next), box))
                continue;
            kept[slot] = 1;
            stack[count++] = slot;
        }
    }
}

static void
drop_faces(const otx_ground *u, const uint8_t *kept)
{
    otx_footprint *c = u->chart;
    int32_t count = 0, end = 0;

    for (int32_t i = 0; i < c->face_count; ++i)
    {
        const int32_t first = c->first[i], size = c->first[i + 1] - first;

        u->space->face_slot[c->faces[i]] = kept[i] ? count : -1;
        if (!kept[i])
            continue;
        memmove(
            c->corners + end, c->corners + first,
            (size_t)size * sizeof *c->corners);
        c->faces[count] = c->faces[i];
        c->first[count++] = end;
        end += size;
    }
    c->face_count = count;
    c->first[count] = end;
}

/* Those of no face. */
static void
drop_vertices(const otx_ground *u, int32_t *number)
{
    otx_footprint *c = u->chart;
    int32_t count = 0;

    for (int32_t i = 0; i < c->first[c->face_count]; ++i)
        number[c->corners[i]] = 1;
    for (int32_t v = 0; v < c->vert_count; ++v)
    {
        u->space->vert_slot[c->verts[v]] = number[v] ? count : -1;
        if (!number[v])
            continue;
        c->verts[count] = c->verts[v];
        c->flat[count] = c->flat[v];
        number[v] = count++;
    }
    for (int32_t i = 0; i < c->first[c->face_count]; ++i)
        c->corners[i] = number[c->corners[i]];
    c->vert_count = count;
}

otx_status
otx_ground_trim(otx_ground *u, double reach)
{
    const otx_footprint_box box = widened(&u->ask->box, reach);
    int32_t *stack = OTX_NEW(u->arena, int32_t, u->chart->face_count);
    uint8_t *kept = OTX_ZNEW(u->arena, uint8_t, u->chart->face_count);
    int32_t *number = OTX_ZNEW(u->arena, int32_t, u->chart->vert_count);

    if (!stack || !kept || !number)
        return OSDTEX_ERROR_MEMORY;
    mark_kept(u, &box, stack, kept);
    drop_faces(u, kept);
    drop_vertices(u, number);
    return OSDTEX_OK;
}

void
otx_ground_end(otx_ground *u)
{
    for (int32_t i = 0; i < u->chart->face_count; ++i)
        u->space->face_slot[u->chart->faces[i]] = -1;
    for (int32_t v = 0; v < u->chart->vert_count; ++v)
        u->space->vert_slot[u->chart->verts[v]] = -1;
}

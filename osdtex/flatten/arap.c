/* arap.c -- unfolding, then local/global rounds [Liu08, sec. 3 and 4]. */
#include "flatten/arap.h"

#include "base/pqueue.h"
#include "flatten/rigid.h"

enum
{
    CG_ROUNDS = 60,
    STEPS_PER_LOOK = 4096 /* faces unfolded between looks at the clock */
};

static const double CG_TOLERANCE = 1e-3;

/* Corners of a face projected into its mean plane, texels. */
static void
project_face(
    const otx_chart *chart, const otx_surface *surface, double texels,
    otx_vec3 normal, int32_t face, otx_vec2 *out)
{
    const int32_t first = chart->first[face];
    const int32_t size = chart->first[face + 1] - first;
    const otx_vec3 origin =
        otx_vec3_load(surface->points, chart->verts[chart->corners[first]]);
    const otx_vec3 helper =
        fabs(normal.x) < 0.6 ? (otx_vec3){1, 0, 0} : (otx_vec3){0, 1, 0};
    const otx_vec3 x = otx_vec3_unit(otx_vec3_cross(helper, normal));
    const otx_vec3 y = otx_vec3_cross(normal, x);

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec3 d = otx_vec3_sub(
            otx_vec3_load(
                surface->points, chart->verts[chart->corners[first + k]]),
            origin);

        out[k] = (otx_vec2){
            texels * otx_vec3_dot(d, x), texels * otx_vec3_dot(d, y)};
    }
}

/* Places the corners of a face that have no place yet, by the rigid motion
 * that carries the projected face nearest to the corners that have one. */
static void
place_face(
    otx_chart *chart, int32_t face, const otx_vec2 *shape, uint8_t *placed)
{
    const int32_t first = chart->first[face];
    const int32_t size = chart->first[face + 1] - first;
    otx_vec2 from = {0, 0}, to = {0, 0}, turn = {0, 0};
    int32_t known = 0;
    double length;

    for (int32_t k = 0; k < size; ++k)
    {
        if (!placed[chart->corners[first + k]])
            continue;
        from = otx_vec2_add(from, shape[k]);
        to = otx_vec2_add(to, chart->flat[chart->corners[first + k]]);
        ++known;
    }
    if (known > 0)
    {
        from = otx_vec2_scale(1.0 / known, from);
        to = otx_vec2_scale(1.0 / known, to);
    }
    for (int32_t k = 0; k < size; ++k)
    {
        otx_vec2 a, b;

        if (!placed[chart->corners[first + k]])
            continue;
        a = otx_vec2_sub(shape[k], from);
        b = otx_vec2_sub(chart->flat[chart->corners[first + k]], to);
        turn = otx_vec2_add(turn, otx_vec2_mul((otx_vec2){a.x, -a.y}, b));
    }
    length = otx_vec2_length(turn);
    turn = length > 0.0 ? otx_vec2_scale(1.0 / length, turn)
                        : (otx_vec2){1.0, 0.0};
    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t v = chart->corners[first + k];

        if (placed[v])
            continue;
        chart->flat[v] =
            otx_vec2_add(to, otx_vec2_mul(turn, otx_vec2_sub(shape[k], from)));
        placed[v] = 1;
    }
}

/* The core face nearest to the middle of the core. */
static int32_t
middle_face(const otx_chart *chart, const otx_dual *leaves)
{
    otx_vec3 middle = {0, 0, 0};
    int32_t best = 0;
    double nearest = INFINITY;

    for (int32_t i = 0; i < chart->core_count; ++i)
        middle = otx_vec3_mix(
            1.0, middle, 1.0 / chart->core_count,
            leaves->centroids[chart->faces[i]]);
    for (int32_t i = 0; i < chart->core_count; ++i)
    {
        const double d = otx_vec3_length(
            otx_vec3_sub(leaves->centroids[chart->faces[i]], middle));

        if (d < nearest)
        {
            nearest = d;
            best = i;
        }
    }
    return best;
}

static int32_t
largest_face(const otx_chart *chart)
{
    int32_t size = 0;

    for (int32_t f = 0; f < chart->face_count; ++f)
        if (chart->first[f + 1] - chart->first[f] > size)
            size = chart->first[f + 1] - chart->first[f];
    return size;
}

static otx_status
unfold(
    otx_chart *chart, const otx_chart_request *request,
    const otx_chart_space *space, otx_arena *scratch)
{
    const otx_dual *leaves = request->leaves;
    otx_pqueue queue = otx_pqueue_make(scratch);
    otx_pqueue_entry entry;
    uint32_t steps = 0;
    uint8_t *placed = OTX_ZNEW(scratch, uint8_t, chart->vert_count);
    uint8_t *done = OTX_ZNEW(scratch, uint8_t, chart->face_count);
    otx_vec2 *shape = OTX_NEW(scratch, otx_vec2, largest_face(chart));

    otx_pqueue_push(&queue, 0.0, middle_face(chart, leaves));
    if (otx_arena_failed(scratch))
        return OSDTEX_ERROR_MEMORY;
    while (otx_pqueue_pop(&queue, &entry))
    {
        const int32_t face = chart->faces[entry.item];

        if (done[entry.item])
            continue;
        if (++steps % STEPS_PER_LOOK == 0)
            OTX_TRY(otx_worker_look(request->worker));
        done[entry.item] = 1;
        project_face(
            chart, request->surface,
            request->texels * otx_dual_leaf_density(request->surface, face),
            leaves->normals[face], entry.item, shape);
        place_face(chart, entry.item, shape, placed);
        for (int32_t k = 0; k < otx_level_face_size(leaves->level, face); ++k)
        {
            const int32_t next = otx_level_neighbour(leaves->level, face, k);
            const int32_t slot = next < 0 ? -1 : space->face_slot[next];

            if (slot < 0 || done[slot])
                continue;
            otx_pqueue_push(
                &queue, entry.key + otx_dual_step(leaves, face, next, 0.0),
                slot);
        }
    }
    return otx_arena_failed(scratch) ? OSDTEX_ERROR_MEMORY : OSDTEX_OK;
}

static void
apply(
    const void *context, const otx_vec2 *x, int32_t first, int32_t end,
    otx_vec2 *out)
{
    otx_rigid_apply(context, x, first, end, out);
}

otx_status
otx_arap_flatten(
    otx_chart *chart, const otx_chart_request *request,
    const otx_chart_space *space, otx_arena *scratch)
{
    const otx_rigid_mesh mesh = {chart->face_count, chart->vert_count,
                                 chart->first,      chart->corners,
                                 chart->verts,      request->surface->points,
                                 request->texels,   request->surface->density};
    otx_rigid rigid;
    otx_vec2 *b = OTX_NEW(scratch, otx_vec2, chart->vert_count);
    otx_vec2 *diagonal = OTX_NEW(scratch, otx_vec2, chart->vert_count);
    otx_rigid_system system = {
        .count = chart->vert_count,
        .apply = apply,
        .context = &rigid,
        .diagonal = diagonal,
        .rounds = CG_ROUNDS,
        .tolerance = CG_TOLERANCE,
        .worker = request->worker};

    if (!b || !diagonal)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(unfold(chart, request, space, scratch));
    OTX_TRY(otx_rigid_build(scratch, &mesh, &rigid));
    for (int32_t v = 0; v < chart->vert_count; ++v)
        diagonal[v] = (otx_vec2){rigid.diagonal[v], rigid.diagonal[v]};
    for (int32_t round = 0; round < request->rounds; ++round)
    {
        otx_rigid_pull(&rigid, chart->flat, b);
        OTX_TRY(otx_rigid_solve(scratch, &system, b, chart->flat));
    }
    return OSDTEX_OK;
}

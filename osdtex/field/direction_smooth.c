/* direction_smooth.c -- a direction field made smooth, face by face. */
#include "field/direction.h"

/* What the faces of one round share. */
typedef struct round_job
{
    const otx_direction *field;
    const otx_direction_request *request;
    const uint8_t *held;
    const otx_vec2 *from;
    otx_vec2 *to;
} round_job;

static otx_status
smooth_face(void *context, int64_t index, otx_worker *worker)
{
    const round_job *job = context;
    const otx_connection *c = job->field->connection;
    const int32_t face = (int32_t)index;
    const double s = job->field->symmetry;
    otx_vec2 sum = {0, 0};
    double weight = 0.0;

    (void)worker;
    job->to[face] = job->from[face];
    if (job->held[face])
        return OSDTEX_OK;
    for (int32_t i = c->level->face_first[face];
         i < c->level->face_first[face + 1]; ++i)
    {
        const int32_t e = c->level->face_edges[i];
        const int32_t *faces = c->level->edge_faces + 2 * (size_t)e;
        const bool first = faces[0] == face;

        if (!c->inner[e])
            continue;
        weight += c->weights[e];
        sum = otx_vec2_add(
            sum, otx_vec2_scale(
                     c->weights[e],
                     otx_vec2_mul(
                         otx_vec2_polar((first ? -s : s) * c->turns[e]),
                         job->from[faces[first]])));
    }
    if (job->request->pull)
        sum = otx_vec2_add(
            sum, otx_vec2_scale(
                     c->areas[face] / (job->request->pull_length *
                                       job->request->pull_length),
                     job->request->pull[face]));
    /* Half of what it was damps the checkerboards of simultaneous rounds. */
    sum = otx_vec2_add(sum, otx_vec2_scale(0.5 * weight, job->from[face]));
    job->to[face] = otx_direction_unit(sum, job->from[face]);
    return OSDTEX_OK;
}

otx_status
otx_direction_smooth(
    otx_run *run, const otx_direction_request *request, int32_t rounds,
    otx_direction *field)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t count = field->connection->level->face_count;
    otx_vec2 *other = OTX_NEW(run->scratch, otx_vec2, count);
    uint8_t *held = OTX_NEW(run->scratch, uint8_t, count);
    round_job job = {field, request, held, NULL, NULL};

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
        held[f] = field->connection->level->face_hole[f];
    for (int32_t p = 0; p < request->pin_count; ++p)
        held[request->pins[p].face] = 1;
    /* An even number of rounds ends where it began. */
    for (int32_t round = 0; round < 2 * ((rounds + 1) / 2); ++round)
    {
        job.from = round % 2 ? other : field->powers;
        job.to = round % 2 ? field->powers : other;
        OTX_TRY(otx_pool_for(run->pool, count, smooth_face, &job));
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* poles.c -- where a field turns too fast to be followed.
 *
 * Around a pole no window of the exemplar lies along the field: what is held to
 * it there comes out as a star without a feature. So within half of the
 * coarsest window the angle is free. */
#include "method/vertex/vertex.h"

#include "base/pqueue.h"
#include "field/connection.h"

#define TURN_MOST 0.5 /* radians from a face to the next, beside a pole */

/* The least angle between the directions of two faces across an edge, of a
 * field of this symmetry. */
static double
turn_across(const otx_connection *c, const otx_guide *guide, int32_t edge)
{
    const int32_t *faces = c->level->edge_faces + 2 * (size_t)edge;
    const otx_vec2 a = otx_vec2_mul(
        otx_connection_project(c, faces[0], guide->directions[faces[0]]),
        otx_vec2_polar(c->turns[edge]));
    const otx_vec2 b =
        otx_connection_project(c, faces[1], guide->directions[faces[1]]);
    const double turn = 2.0 * OTX_PI / guide->symmetry;
    const double angle = fabs(atan2(otx_vec2_cross(a, b), otx_vec2_dot(a, b)));
    const double rest = angle - turn * floor(angle / turn);

    return fmin(rest, turn - rest);
}

typedef struct grower
{
    const otx_connection *connection;
    double *distance; /* [face_count] scene units from a pole */
    otx_pqueue queue;
} grower;

static void
offer(grower *g, int32_t face, double distance)
{
    if (!(distance < g->distance[face]))
        return;
    g->distance[face] = distance;
    otx_pqueue_push(&g->queue, distance, face);
}

static void
go_on_from(grower *g, int32_t face, double reach)
{
    const otx_connection *c = g->connection;
    const otx_level *level = c->level;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
    {
        const int32_t edge = level->face_edges[i];
        const int32_t *faces = level->edge_faces + 2 * (size_t)edge;
        const int32_t other = faces[0] == face ? faces[1] : faces[0];
        double distance;

        if (!c->inner[edge])
            continue;
        distance =
            g->distance[face] +
            otx_vec3_length(otx_vec3_sub(c->centres[other], c->centres[face]));
        if (distance <= reach)
            offer(g, other, distance);
    }
}

otx_status
otx_vertex_find_poles(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    double reach, uint8_t **out)
{
    const int32_t count = otx_surface_leaf(surface)->face_count;
    otx_connection connection;
    otx_pqueue_entry entry;
    grower g = {
        .connection = &connection,
        .distance = OTX_NEW(run->scratch, double, count),
        .queue = otx_pqueue_make(run->scratch)};
    uint8_t *near = OTX_ZNEW(run->arena, uint8_t, count);

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_connection_build(
        run, surface, surface->level_count - 1, &connection));
    for (int32_t f = 0; f < count; ++f)
        g.distance[f] = INFINITY;
    for (int32_t e = 0; e < connection.level->edge_count; ++e)
        if (connection.inner[e] &&
            turn_across(&connection, guide, e) > TURN_MOST)
        {
            offer(&g, connection.level->edge_faces[2 * (size_t)e], 0.0);
            offer(&g, connection.level->edge_faces[2 * (size_t)e + 1], 0.0);
        }
    while (otx_pqueue_pop(&g.queue, &entry))
        go_on_from(&g, entry.item, reach);
    for (int32_t f = 0; f < count; ++f)
        near[f] = g.distance[f] < INFINITY;
    *out = near;
    return otx_run_ok(run);
}

/* comb.c -- one of the equal directions of a field for each face.
 *
 * Breadth first from face to face, the direction of the one is carried into the
 * plane of the other, and of that one's equals the nearest is taken. What is
 * left are lines from pole to pole where a turn of the symmetry lies between
 * neighbours; where they run says nothing. */
#include "method/vertex/vertex.h"

#include "field/connection.h"

typedef struct comber
{
    const otx_connection *connection;
    int32_t symmetry;
    otx_vec2 *flat; /* [face_count] in the frames of the connection */
    uint8_t *done;
    int32_t *queue;
    int32_t count; /* in the queue */
} comber;

/* Of z's equals the one that lies along `by`. */
static otx_vec2
nearest_equal(otx_vec2 z, otx_vec2 by, int32_t symmetry)
{
    otx_vec2 best = z;

    for (int32_t i = 1; i < symmetry; ++i)
    {
        z = otx_vec2_mul(z, otx_vec2_polar(2.0 * OTX_PI / symmetry));
        if (otx_vec2_dot(z, by) > otx_vec2_dot(best, by))
            best = z;
    }
    return best;
}

static void
go_on_from(comber *c, int32_t face)
{
    const otx_level *level = c->connection->level;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
    {
        const int32_t edge = level->face_edges[i];
        const int32_t first = level->edge_faces[2 * (size_t)edge];
        const int32_t other =
            first == face ? level->edge_faces[2 * (size_t)edge + 1] : first;
        const double turn = c->connection->turns[edge];

        if (!c->connection->inner[edge] || c->done[other])
            continue;
        c->flat[other] = nearest_equal(
            c->flat[other],
            otx_vec2_mul(
                c->flat[face], otx_vec2_polar(first == face ? turn : -turn)),
            c->symmetry);
        c->done[other] = 1;
        c->queue[c->count++] = other;
    }
}

static void
comb(comber *c)
{
    for (int32_t f = 0; f < c->connection->level->face_count; ++f)
    {
        if (c->done[f])
            continue;
        c->done[f] = 1;
        c->count = 0;
        c->queue[c->count++] = f;
        for (int32_t i = 0; i < c->count; ++i)
            go_on_from(c, c->queue[i]);
    }
}

otx_status
otx_vertex_comb(
    otx_run *run, const otx_surface *surface, const otx_guide *guide,
    otx_guide *out)
{
    const int32_t count = otx_surface_leaf(surface)->face_count;
    otx_connection connection;
    otx_vec3 *directions = OTX_NEW(run->arena, otx_vec3, count);
    comber c = {
        .connection = &connection,
        .symmetry = guide->symmetry,
        .flat = OTX_NEW(run->scratch, otx_vec2, count),
        .done = OTX_ZNEW(run->scratch, uint8_t, count),
        .queue = OTX_NEW(run->scratch, int32_t, count)};

    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_connection_build(
        run, surface, surface->level_count - 1, &connection));
    for (int32_t f = 0; f < count; ++f)
        c.flat[f] =
            otx_connection_project(&connection, f, guide->directions[f]);
    comb(&c);
    for (int32_t f = 0; f < count; ++f)
        directions[f] = otx_connection_lift(&connection, f, c.flat[f]);
    *out = (otx_guide){directions, guide->symmetry, guide->angle};
    return OSDTEX_OK;
}

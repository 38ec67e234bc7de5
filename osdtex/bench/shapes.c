/* shapes.c -- a sphere, an octopus, and whatever the user brings. */
#include "bench/shapes.h"

#include "base/random.h"
#include "file/obj.h"
#include "math/vec.h"

enum
{
    ARMS = 8,
    RINGS = 15, /* of an arm */
    SIDE = 3,   /* faces of the body's cube */
    OCTOPUS_FACES = 6 * SIDE * SIDE + 4 * ARMS * RINGS,
    OCTOPUS_VERTS = 56 + 4 * ARMS * RINGS
};

/* A mesh of quads that grows; arrays are long enough from the start. */
typedef struct quads
{
    otx_vec3 *points;
    int32_t vert_count;
    int32_t *verts; /* [face_count * 4] */
    int32_t face_count;
    /* Vertex of each point of a lattice of side^3, -1 none. */
    int32_t *lattice;
    int32_t side;
} quads;

static bool
make_quads(otx_run *run, int64_t verts, int64_t faces, int32_t side, quads *out)
{
    const int64_t cells = (int64_t)side * side * side;

    *out = (quads){
        .points = OTX_NEW(run->arena, otx_vec3, verts),
        .verts = OTX_NEW(run->arena, int32_t, 4 * faces),
        .lattice = OTX_NEW(run->arena, int32_t, cells),
        .side = side};
    if (!out->points || !out->verts || !out->lattice)
        return false;
    for (int64_t i = 0; i < cells; ++i)
        out->lattice[i] = -1;
    return true;
}

/* The vertex at a point of the lattice; a new one lies there too. */
static int32_t
lattice_vert(quads *q, const int32_t at[3])
{
    int32_t *vert =
        q->lattice + ((int64_t)at[2] * q->side + at[1]) * q->side + at[0];

    if (*vert < 0)
    {
        *vert = q->vert_count++;
        q->points[*vert] = (otx_vec3){at[0], at[1], at[2]};
    }
    return *vert;
}

static otx_status
build_cage(
    otx_run *run, const quads *q, const float *uvs, int32_t uv_count,
    const int32_t *face_uvs, otx_cage *out)
{
    const otx_cage_options options = otx_cage_options_default();
    otx_cage_input input = otx_cage_input_none();
    float *points = OTX_NEW(run->arena, float, 3 * (int64_t)q->vert_count);
    int32_t *first = OTX_NEW(run->arena, int32_t, q->face_count + 1);

    if (!points || !first)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t v = 0; v < q->vert_count; ++v)
    {
        points[3 * v] = (float)q->points[v].x;
        points[3 * v + 1] = (float)q->points[v].y;
        points[3 * v + 2] = (float)q->points[v].z;
    }
    for (int32_t f = 0; f <= q->face_count; ++f)
        first[f] = 4 * f;
    input.vert_count = q->vert_count;
    input.face_count = q->face_count;
    input.points = points;
    input.face_first = first;
    input.face_verts = q->verts;
    input.uv_count = uv_count;
    input.uvs = uvs;
    input.face_uvs = face_uvs;
    return otx_cage_build(run, &input, &options, out);
}

/* -- sphere -------------------------------------------------------------- */

/* Corners of the rhombus over edge `edge` of a cube, in the lattice of the
 * dodecahedron's own vertices, (+-1 +-1 +-1) and (+-2 0 0), turned outwards. */
static void
rhombus(int32_t edge, int32_t corners[4][3])
{
    const int32_t a = edge / 4, b = (a + 1) % 3, c = (a + 2) % 3;
    const int32_t sb = edge % 2 ? 1 : -1, sc = edge / 2 % 2 ? 1 : -1;
    const bool turn = sb * sc < 0;

    for (int k = 0; k < 4; ++k)
        corners[k][0] = corners[k][1] = corners[k][2] = 0;
    for (int k = 0; k < 4; k += 2)
    {
        corners[k][a] = k == 0 ? -1 : 1;
        corners[k][b] = sb;
        corners[k][c] = sc;
    }
    corners[turn ? 3 : 1][b] = 2 * sb;
    corners[turn ? 1 : 3][c] = 2 * sc;
}

/* Vertex (i, j) of the n x n grid of a rhombus. */
static int32_t
grid_vert(
    quads *q, const int32_t corners[4][3], int32_t n, int32_t i, int32_t j)
{
    int32_t at[3];

    for (int k = 0; k < 3; ++k)
        at[k] = 2 * n + n * corners[0][k] +
                i * (corners[1][k] - corners[0][k]) +
                j * (corners[3][k] - corners[0][k]);
    return lattice_vert(q, at);
}

static void
fill_rhombus(quads *q, int32_t edge, int32_t n, int32_t *face_uvs)
{
    static const int32_t ring[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    int32_t corners[4][3];

    rhombus(edge, corners);
    for (int32_t j = 0; j < n; ++j)
        for (int32_t i = 0; i < n; ++i)
        {
            for (int k = 0; k < 4; ++k)
            {
                const int32_t x = i + ring[k][0], y = j + ring[k][1];

                q->verts[4 * q->face_count + k] =
                    grid_vert(q, corners, n, x, y);
                if (face_uvs)
                    face_uvs[4 * q->face_count + k] =
                        (edge * (n + 1) + y) * (n + 1) + x;
            }
            ++q->face_count;
        }
}

otx_status
bench_shapes_sphere(otx_run *run, int32_t n, bool with_uvs, otx_cage *out)
{
    const int64_t faces = 12 * (int64_t)n * n;
    const int32_t uv_count = with_uvs ? 12 * (n + 1) * (n + 1) : 0;
    float *uvs = OTX_NEW(run->arena, float, 2 * (int64_t)uv_count);
    int32_t *face_uvs = OTX_NEW(run->arena, int32_t, 4 * faces);
    quads q;

    if (!uvs || !face_uvs || !make_quads(run, faces + 2, faces, 4 * n + 1, &q))
        return OSDTEX_ERROR_MEMORY;
    for (int32_t edge = 0; edge < 12; ++edge)
        fill_rhombus(&q, edge, n, with_uvs ? face_uvs : NULL);
    for (int32_t v = 0; v < q.vert_count; ++v)
        q.points[v] = otx_vec3_unit(
            otx_vec3_sub(q.points[v], (otx_vec3){2 * n, 2 * n, 2 * n}));
    for (int32_t i = 0; i < uv_count; ++i)
    {
        const int32_t row = i / (n + 1);

        uvs[2 * i] = (float)(i % (n + 1)) / (float)n;
        uvs[2 * i + 1] = (float)(row % (n + 1)) / (float)n;
    }
    return build_cage(run, &q, uvs, uv_count, with_uvs ? face_uvs : NULL, out);
}

/* -- octopus ------------------------------------------------------------- */

/* The face of a cube's side, turned outwards. */
static void
body_face(quads *q, int32_t axis, int32_t side, int32_t i, int32_t j)
{
    static const int32_t ring[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

    for (int k = 0; k < 4; ++k)
    {
        const int32_t *step = ring[side ? k : 3 - k];
        int32_t at[3];

        at[axis] = side ? SIDE : 0;
        at[(axis + 1) % 3] = i + step[0];
        at[(axis + 2) % 3] = j + step[1];
        q->verts[4 * q->face_count + k] = lattice_vert(q, at);
    }
    ++q->face_count;
}

/* Between the cube and the ball, with bumps. */
static void
round_body(quads *q)
{
    for (int32_t v = 0; v < q->vert_count; ++v)
    {
        const double half = 0.5 * SIDE;
        const otx_vec3 p =
            otx_vec3_sub(q->points[v], (otx_vec3){half, half, half});
        const double bump = 0.3 * otx_random_unit(7, 0, (uint64_t)v);

        q->points[v] = otx_vec3_mix(0.3, p, 1.2 + bump, otx_vec3_unit(p));
    }
}

/* Grows an arm out of a face, which ends up as its tip: away from the axis of
 * the body, waving up and down, thinner and thinner. */
static void
grow_arm(quads *q, int32_t face, int32_t arm)
{
    int32_t *tip = q->verts + 4 * (int64_t)face;
    otx_vec3 middle = {0, 0, 0}, away;

    for (int k = 0; k < 4; ++k)
        middle = otx_vec3_mix(1.0, middle, 0.25, q->points[tip[k]]);
    away = otx_vec3_unit((otx_vec3){middle.x, 0.0, middle.z});
    for (int32_t r = 0; r < RINGS; ++r)
    {
        const double wave = sin(0.7 * r + 1.1 * arm);
        const otx_vec3 step = otx_vec3_mix(
            0.45, away, 0.25, (otx_vec3){0.0, wave - 0.4 * (r < 4), 0.0});
        const otx_vec3 next = otx_vec3_add(middle, step);
        const int32_t first = q->vert_count;

        for (int k = 0; k < 4; ++k)
            q->points[q->vert_count++] = otx_vec3_mix(
                1.0, next, 0.93, otx_vec3_sub(q->points[tip[k]], middle));
        for (int k = 0; k < 4; ++k)
        {
            const int32_t side[4] = {
                tip[k], tip[(k + 1) % 4], first + (k + 1) % 4, first + k};

            for (int c = 0; c < 4; ++c)
                q->verts[4 * q->face_count + c] = side[c];
            ++q->face_count;
        }
        for (int k = 0; k < 4; ++k)
            tip[k] = first + k;
        middle = next;
    }
}

otx_status
bench_shapes_octopus(otx_run *run, otx_cage *out)
{
    int32_t arms[ARMS], arm_count = 0;
    quads q;

    if (!make_quads(run, OCTOPUS_VERTS, OCTOPUS_FACES, SIDE + 1, &q))
        return OSDTEX_ERROR_MEMORY;
    for (int32_t axis = 0; axis < 3; ++axis)
        for (int32_t face = 0; face < 2 * SIDE * SIDE; ++face)
        {
            const int32_t i = face / 2 % SIDE, j = face / 2 / SIDE;
            /* i runs along y on the sides across x, j on those across z. */
            const int32_t height = axis == 0 ? i : j;
            const int32_t place = axis == 0 ? j : i;

            /* Two arms on each side, at the foot, left and right. */
            if (axis != 1 && height == 0 && place != 1)
                arms[arm_count++] = q.face_count;
            body_face(&q, axis, face % 2, i, j);
        }
    round_body(&q);
    for (int32_t a = 0; a < arm_count; ++a)
        grow_arm(&q, arms[a], a);
    return build_cage(run, &q, NULL, 0, NULL, out);
}

/* -- files --------------------------------------------------------------- */

otx_status
bench_shapes_read(otx_run *run, const char *path, otx_cage *out)
{
    const otx_cage_options options = otx_cage_options_default();
    otx_cage_input input = otx_cage_input_none();
    otx_obj obj;

    OTX_TRY(otx_obj_read(run, path, &obj));
    input.path = obj.path;
    input.vert_count = obj.vert_count;
    input.face_count = obj.face_count;
    input.points = obj.points;
    input.face_first = obj.face_first;
    input.face_verts = obj.face_verts;
    input.face_line = obj.face_line;
    input.crease_count = obj.creases.count;
    input.crease_verts = obj.creases.verts;
    input.crease_sharpness = obj.creases.sharpness;
    return otx_cage_build(run, &input, &options, out);
}

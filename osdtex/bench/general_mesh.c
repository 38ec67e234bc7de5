/* general_mesh.c -- spheres of triangles, bent by rule. */
#include "bench/general_mesh.h"

#include "math/vec.h"

/* A bump of a sphere: where, how far, how wide. */
typedef struct bump
{
    otx_vec3 at; /* unit */
    double height, width;
} bump;

enum
{
    BUMPS_MAX = 3
};

/* 2 * around * (rows - 1) triangles, and two more for each split edge. */
typedef struct shape
{
    const char *name;
    int32_t around, rows, splits;
    otx_vec3 stretch;
    double ribs, depth; /* around, and how deep between them */
    bump bumps[BUMPS_MAX];
} shape;

static const shape SHAPES[BENCH_GENERAL_COUNT] = {
    {"bunny-like, paper",
     40,
     38,
     1,
     {1.0, 1.1, 1.3},
     0.0,
     0.0,
     {{{0.35, 0.8, 0.49}, 0.9, 0.25}, {{-0.35, 0.8, 0.49}, 0.9, 0.25}}},
    {"pumpkin-like, paper",
     100,
     51,
     0,
     {1.0, 0.8, 1.0},
     10.0,
     0.12,
     {{{0.0, 1.0, 0.0}, 0.0, 0.0}}},
    {"triceratops-like, paper",
     69,
     42,
     1,
     {0.8, 0.9, 1.9},
     0.0,
     0.0,
     {{{0.3, 0.5, 0.81}, 0.5, 0.15},
      {{-0.3, 0.5, 0.81}, 0.5, 0.15},
      {{0.0, 0.1, 0.99}, 0.3, 0.15}}}};

const char *
bench_general_mesh_name(bench_general_kind kind)
{
    return SHAPES[kind].name;
}

static otx_vec3
place(const shape *s, double up, double around)
{
    const otx_vec3 unit = {
        sin(up) * sin(around), -cos(up), sin(up) * cos(around)};
    double r = 1.0 - s->depth * sin(up) * (0.5 + 0.5 * cos(s->ribs * around));

    for (int k = 0; k < BUMPS_MAX && s->bumps[k].width > 0.0; ++k)
    {
        const bump *b = &s->bumps[k];
        const double away =
            otx_vec3_length(otx_vec3_sub(unit, otx_vec3_unit(b->at)));

        r += b->height * exp(-away * away / (b->width * b->width));
    }
    return (otx_vec3){
        r * unit.x * s->stretch.x, r * unit.y * s->stretch.y,
        r * unit.z * s->stretch.z};
}

typedef struct triangles
{
    float *points;
    int32_t *verts;
    int32_t vert_count, face_count;
} triangles;

static int32_t
add_vert(triangles *t, otx_vec3 p)
{
    float *to = t->points + 3 * t->vert_count;

    to[0] = (float)p.x;
    to[1] = (float)p.y;
    to[2] = (float)p.z;
    return t->vert_count++;
}

static void
add_face(triangles *t, int32_t a, int32_t b, int32_t c)
{
    int32_t *to = t->verts + 3 * t->face_count++;

    to[0] = a;
    to[1] = b;
    to[2] = c;
}

/* Poles are vertices 0 and 1; row i begins at 2 + (i - 1) * around. */
static void
fill(const shape *s, triangles *t)
{
    const int32_t n = s->around;

    add_vert(t, place(s, 0.0, 0.0));
    add_vert(t, place(s, OTX_PI, 0.0));
    for (int32_t i = 1; i < s->rows; ++i)
        for (int32_t j = 0; j < n; ++j)
            add_vert(
                t, place(
                       s, OTX_PI * i / s->rows,
                       2.0 * OTX_PI * (j + 0.5 * (i % 2)) / n));
    for (int32_t j = 0; j < n; ++j)
    {
        const int32_t last = 2 + (s->rows - 2) * n;

        add_face(t, 0, 2 + (j + 1) % n, 2 + j);
        add_face(t, 1, last + j, last + (j + 1) % n);
    }
    for (int32_t i = 1; i + 1 < s->rows; ++i)
        for (int32_t j = 0; j < n; ++j)
        {
            const int32_t low = 2 + (i - 1) * n, high = low + n;
            const int32_t k = (j + 1) % n;

            /* Rows are half a step apart, to either side by turns. */
            if (i % 2)
            {
                add_face(t, low + j, low + k, high + k);
                add_face(t, low + j, high + k, high + j);
            }
            else
            {
                add_face(t, low + j, low + k, high + j);
                add_face(t, low + k, high + k, high + j);
            }
        }
}

/* Halves the edge between the last two triangles, which share one. */
static void
split(triangles *t)
{
    int32_t *f = t->verts + 3 * (t->face_count - 2), *g = f + 3;

    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
        {
            const int32_t a = f[i], b = f[(i + 1) % 3], c = f[(i + 2) % 3];
            const int32_t d = g[(j + 2) % 3];
            int32_t middle;

            if (g[j] != b || g[(j + 1) % 3] != a)
                continue;
            middle = add_vert(
                t, otx_vec3_scale(
                       0.5, otx_vec3_add(
                                otx_vec3_load(t->points, a),
                                otx_vec3_load(t->points, b))));
            f[0] = a;
            f[1] = middle;
            f[2] = c;
            g[0] = b;
            g[1] = middle;
            g[2] = d;
            add_face(t, middle, b, c);
            add_face(t, middle, a, d);
            return;
        }
}

otx_status
bench_general_mesh(otx_run *run, bench_general_kind kind, otx_cage *out)
{
    const shape *s = &SHAPES[kind];
    const int32_t faces = 2 * s->around * (s->rows - 1) + 2 * s->splits;
    const int32_t verts = 2 + s->around * (s->rows - 1) + s->splits;
    otx_cage_options options = otx_cage_options_default();
    otx_cage_input input = otx_cage_input_none();
    triangles t = {
        .points = OTX_NEW(run->arena, float, 3 * verts),
        .verts = OTX_NEW(run->arena, int32_t, 3 * faces)};
    int32_t *first = OTX_NEW(run->arena, int32_t, faces + 1);

    OTX_TRY(otx_run_ok(run));
    fill(s, &t);
    for (int32_t i = 0; i < s->splits; ++i)
        split(&t);
    for (int32_t f = 0; f <= faces; ++f)
        first[f] = 3 * f;
    input.vert_count = t.vert_count;
    input.face_count = t.face_count;
    input.points = t.points;
    input.face_first = first;
    input.face_verts = t.verts;
    options.scheme = OTX_SCHEME_NONE;
    return otx_cage_build(run, &input, &options, out);
}

/* test_field.h -- surfaces that the tests of fields share. */
#ifndef OTX_TESTS_TEST_FIELD_H
#define OTX_TESTS_TEST_FIELD_H

#include "field/connection.h"
#include "unit/surface/meshes.h"

/* A n x m torus of quads, radii 3 and 1, round the y axis. */
static inline otx_cage_input
field_torus(otx_run *run, int32_t n, int32_t m)
{
    float *points = OTX_NEW(run->arena, float, 3 * n * m);
    int32_t *verts = OTX_NEW(run->arena, int32_t, 4 * n * m);

    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = 0; j < m; ++j)
        {
            const double a = 2.0 * OTX_PI * i / n, b = 2.0 * OTX_PI * j / m;
            const int32_t at = i * m + j, right = (i + 1) % n * m;
            const int32_t up = (j + 1) % m;

            points[3 * at] = (float)((3.0 + cos(b)) * cos(a));
            points[3 * at + 1] = (float)sin(b);
            points[3 * at + 2] = (float)(-(3.0 + cos(b)) * sin(a));
            verts[4 * at] = at;
            verts[4 * at + 1] = right + j;
            verts[4 * at + 2] = right + up;
            verts[4 * at + 3] = i * m + up;
        }
    return mesh_input(run, points, n * m, verts, n * m, 4);
}

typedef struct field_surface
{
    otx_cage cage;
    otx_surface surface;
    otx_connection connection;
} field_surface;

static inline field_surface *
field_from_input(otx_run *run, const otx_cage_input *in, int32_t level)
{
    field_surface *s = OTX_ZNEW(run->arena, field_surface, 1);

    s->cage = mesh_build(run, in, NULL);
    s->surface = mesh_refine(run, &s->cage, level);
    assert_int_equal(
        otx_connection_build(run, &s->surface, level, &s->connection),
        OSDTEX_OK);
    return s;
}

/* NULL when the file is not there. */
static inline field_surface *
field_from_file(otx_run *run, const char *path, int32_t level)
{
    field_surface *s = OTX_ZNEW(run->arena, field_surface, 1);
    FILE *file = fopen(path, "rb");

    if (!file)
        return NULL;
    fclose(file);
    if (mesh_cage_from_file(run, path, &s->cage) != OSDTEX_OK)
        fail_msg("%s: %s", path, test_last_message(run));
    s->surface = mesh_refine(run, &s->cage, level);
    assert_int_equal(
        otx_connection_build(run, &s->surface, level, &s->connection),
        OSDTEX_OK);
    return s;
}

/* V - E + F of a level. */
static inline int32_t
field_euler(const otx_level *level)
{
    return level->vert_count - level->edge_count + level->face_count;
}

#endif

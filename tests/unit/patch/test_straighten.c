/* test_straighten.c -- triangles without area that came out reversed. */
#include "grid.h"
#include "unit/cluster/sheets.h"

#include "patch/straighten.h"

/* A triangle whose vertex 3 lies on the side of a larger one, and the triangle
 * without area that closes the joint. */
static const float points[] = {0, 0, 0, 2, 0, 0, 1, 2, 0, 1, 0, 0, 1, -2, 0};
static const int32_t verts[] = {0, 1, 2, 0, 3, 1, 0, 4, 3, 3, 4, 1};

typedef struct fixture
{
    otx_run *run;
    otx_mosaic_job job;
    otx_cover cover;
} fixture;

/* All of it at 8 texels to a unit, but vertex 3 `off` texels above its side,
 * where the triangle without area is reversed. */
static fixture
make(double off)
{
    fixture f = {.run = test_run_create()};
    otx_run *run = f.run;
    const otx_cage_input in = mesh_input(run, points, 5, verts, 4, 3);
    otx_surface *surface = OTX_NEW(run->arena, otx_surface, 1);
    const otx_level *leaf;

    *surface = sheet_refine(run, &in, OTX_SCHEME_NONE, 0);
    leaf = otx_surface_leaf(surface);
    f.job = (otx_mosaic_job){
        .run = run,
        .surface = surface,
        .exemplars = test_exemplar_create(run->arena, 64, 64, true, 1),
        .exemplar_count = 1,
        .texels = 8.0,
    };
    f.job.leaves = sheet_dual(run, surface, 0);
    f.cover = (otx_cover){
        .face_patch = OTX_ZNEW(run->arena, int32_t, leaf->face_count),
        .uvs = OTX_NEW(run->arena, otx_vec2, leaf->corner_count),
        .patch_count = 1,
    };
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const otx_vec3 p = otx_vec3_load(surface->points, leaf->face_verts[c]);

        f.cover.uvs[c] = (otx_vec2){
            8.0 * p.x, 8.0 * p.y + (leaf->face_verts[c] == 3 ? off : 0.0)};
    }
    return f;
}

static double
area2(const fixture *f, int32_t face)
{
    const otx_vec2 *q = f->cover.uvs + 3 * face;

    return otx_vec2_cross(otx_vec2_sub(q[1], q[0]), otx_vec2_sub(q[2], q[0]));
}

static void
a_reversed_one_is_moved_just_across(void **state)
{
    fixture f = make(0.7);

    (void)state;
    assert_true(area2(&f, 1) < 0.0);
    assert_int_equal(otx_straighten(&f.job, &f.cover), OSDTEX_OK);
    for (int32_t i = 0; i < 4; ++i)
        assert_true(area2(&f, i) > 0.0);
    /* The same in all faces that share it. */
    assert_memory_equal(
        &f.cover.uvs[3 * 1 + 1], &f.cover.uvs[3 * 2 + 2], sizeof(otx_vec2));
    assert_true(fabs(f.cover.uvs[3 * 1 + 1].y) < 0.1);
    test_run_destroy(f.run);
}

static void
what_is_right_or_too_far_stays(void **state)
{
    static const double off[] = {-0.5, 9.0};

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        fixture f = make(off[i]);
        otx_vec2 before[12];

        memcpy(before, f.cover.uvs, sizeof before);
        assert_int_equal(otx_straighten(&f.job, &f.cover), OSDTEX_OK);
        assert_memory_equal(before, f.cover.uvs, sizeof before);
        test_run_destroy(f.run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_reversed_one_is_moved_just_across),
        cmocka_unit_test(what_is_right_or_too_far_stays),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

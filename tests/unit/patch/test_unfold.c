/* test_unfold.c -- faces that came out folded or reversed. */
#include "patch/unfold.h"
#include "unit/field/test_field.h"

enum
{
    SIDE = 64
};

static double
least_corner(const otx_cover *cover, const otx_level *leaf, int32_t face)
{
    const int32_t first = leaf->face_first[face];
    const int32_t size = otx_level_face_size(leaf, face);
    double least = INFINITY;

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec2 at = cover->uvs[first + k];

        least = fmin(
            least,
            otx_vec2_cross(
                otx_vec2_sub(cover->uvs[first + (k + 1) % size], at),
                otx_vec2_sub(cover->uvs[first + (k + size - 1) % size], at)));
    }
    return least;
}

/* Squares of 8 texels; face 0 with a corner pushed through its diagonal, face 1
 * mirrored near the border, face 2 as it should be. */
static void
folded_faces_get_their_own_shape(void **state)
{
    (void)state;
    for (int wrap = 0; wrap < 2; ++wrap)
    {
        otx_run *run = test_run_create();
        const otx_cage_input in = mesh_cube(run);
        const field_surface *s = field_from_input(run, &in, 2);
        otx_exemplar e = {.wrap_x = wrap == 1, .wrap_y = wrap == 1};
        otx_mosaic_job job = {
            .run = run,
            .surface = &s->surface,
            .exemplars = &e,
            .exemplar_count = 1};
        otx_cover cover = {.patch_count = 1};
        const otx_level *leaf;
        otx_vec2 kept[4];

        e.match.width = e.match.height = SIDE;
        assert_int_equal(
            otx_dual_build(
                run, job.surface, job.surface->level_count - 1, &job.leaves),
            OSDTEX_OK);
        leaf = job.leaves.level;
        job.texels = 8.0 / job.surface->mean_edge_length;
        cover.uvs = OTX_ZNEW(run->arena, otx_vec2, leaf->corner_count);
        cover.face_patch = OTX_NEW(run->arena, int32_t, leaf->face_count);
        for (int32_t f = 0; f < leaf->face_count; ++f)
        {
            otx_vec2 *q = cover.uvs + leaf->face_first[f];

            cover.face_patch[f] = f < 3 ? 0 : -1;
            q[0] = (otx_vec2){1, 1};
            q[1] = (otx_vec2){9, 1};
            q[2] = (otx_vec2){9, 9};
            q[3] = (otx_vec2){1, 9};
        }
        cover.uvs[leaf->face_first[0] + 2] = (otx_vec2){4, 4};
        cover.uvs[leaf->face_first[1] + 1] = (otx_vec2){1, 9};
        cover.uvs[leaf->face_first[1] + 3] = (otx_vec2){9, 1};
        for (int32_t k = 0; k < 4; ++k)
            kept[k] = cover.uvs[leaf->face_first[2] + k];
        otx_unfold(&job, &cover);
        assert_int_equal(cover.patch_count, 3);
        assert_int_equal(cover.face_patch[2], 0);
        assert_memory_equal(kept, cover.uvs + leaf->face_first[2], sizeof kept);
        for (int32_t f = 0; f < 2; ++f)
        {
            assert_true(cover.face_patch[f] > 0);
            assert_true(least_corner(&cover, leaf, f) > 1.0);
            for (int32_t k = 0; k < 4; ++k)
            {
                const otx_vec2 q = cover.uvs[leaf->face_first[f] + k];

                assert_true(wrap || (q.x >= 0.0 && q.y >= 0.0));
            }
        }
        test_run_destroy(run);
    }
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(folded_faces_get_their_own_shape),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

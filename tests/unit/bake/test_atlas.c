/* test_atlas.c -- blocks that are apart, on a grid, and as large as their
 * faces.
 */
#include "unit/bake/flat.h"

#include "bake/atlas.h"
#include "bake/extent.h"

static otx_cage
cage_of(otx_run *run, const char *path)
{
    otx_cage cage;

    if (mesh_cage_from_file(run, path, &cage) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return cage;
}

static const char *const CAGES[] = {
    "models/cages/creature.obj", "models/cages/ngons_and_triangles.obj",
    "models/cages/loop_open.obj", "models/cages/creased.obj"};

/* Cells do not overlap, lie in their tile, and keep their margins. */
static void
blocks_are_apart(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof CAGES / sizeof *CAGES; ++i)
    {
        otx_run *run = test_run_create();
        const otx_cage cage = cage_of(run, CAGES[i]);
        const otx_surface surface = mesh_refine(run, &cage, 1);
        const int32_t side = 1024;
        const otx_atlas_options options = {side, 0, 0.0};
        otx_atlas atlas;
        float *box = OTX_NEW(run->arena, float, 4 * cage.face_count);

        assert_int_equal(
            otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
        assert_int_equal(atlas.tile_count, 1);
        for (int32_t f = 0; f < cage.face_count; ++f)
        {
            float *b = box + 4 * f;

            b[0] = b[1] = INFINITY;
            b[2] = b[3] = -INFINITY;
            for (int32_t c = cage.face_first[f]; c < cage.face_first[f + 1];
                 ++c)
                for (int k = 0; k < 2; ++k)
                {
                    b[k] = fminf(b[k], atlas.uvs[2 * c + k] * (float)side);
                    b[2 + k] =
                        fmaxf(b[2 + k], atlas.uvs[2 * c + k] * (float)side);
                }
            for (int k = 0; k < 2; ++k)
                assert_true(
                    b[k] >= (float)atlas.margin - 0.01f &&
                    b[2 + k] <= (float)(side - atlas.margin) + 0.01f);
        }
        for (int32_t f = 0; f < cage.face_count; ++f)
            for (int32_t g = 0; g < f; ++g)
            {
                const float *a = box + 4 * f, *b = box + 4 * g;
                const float gap = fmaxf(
                    fmaxf(a[0] - b[2], b[0] - a[2]),
                    fmaxf(a[1] - b[3], b[1] - a[3]));

                assert_true(gap >= 2.0f * (float)atlas.margin - 0.01f);
            }
        test_run_destroy(run);
    }
}

/* A block of a face: its lower left corner and size in texels of its tile. */
typedef struct block
{
    double x, y, width, height;
} block;

static block
block_of(const otx_cage *cage, const otx_atlas *atlas, int32_t f, int32_t side)
{
    const int32_t first = cage->face_first[f];
    const int32_t n = cage->face_first[f + 1] - first;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};

    for (int32_t c = first; c < first + n; ++c)
        for (int k = 0; k < 2; ++k)
        {
            const double at = (double)atlas->uvs[2 * c + k] * side;

            low[k] = fmin(low[k], at);
            high[k] = fmax(high[k], at);
        }
    return (block){
        fmod(low[0], side), fmod(low[1], side), high[0] - low[0],
        high[1] - low[1]};
}

/* How far a number is from a multiple of another. */
static double
off_grid(double value, double step)
{
    return fabs(value - step * nearbyint(value / step));
}

/* The longest side of any quad, scene units. */
static double
longest_of(const otx_cage *cage, const double *extents)
{
    double longest = 0.0;

    for (int32_t i = 0; i < 2 * cage->face_count; ++i)
        longest = fmax(longest, extents[i]);
    return longest;
}

/* Quads fill their blocks: with margins they start and end on multiples of
 * twice the margin, so that the first mip levels never straddle two. */
static void
cells_lie_on_a_grid_as_large_as_their_faces(void **state)
{
    const int32_t side = 1024;

    (void)state;
    for (int32_t margin = OTX_ATLAS_MARGIN_MIN; margin <= 32; margin *= 2)
    {
        otx_run *run = test_run_create();
        const otx_cage cage = cage_of(run, "models/cages/jack.obj");
        const otx_surface surface = mesh_refine(run, &cage, 1);
        const otx_atlas_options options = {side, margin, 0.0};
        double *extents = OTX_NEW(run->arena, double, 2 * cage.face_count);
        otx_atlas atlas;

        assert_int_equal(otx_extent_measure(run, &surface, extents), OSDTEX_OK);
        assert_int_equal(
            otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
        assert_int_equal(atlas.margin, margin);
        for (int32_t f = 0; f < cage.face_count; ++f)
        {
            const block b = block_of(&cage, &atlas, f, side);
            const double wanted = atlas.texels_per_unit * extents[2 * f];

            if (cage.face_first[f + 1] - cage.face_first[f] != 4)
                continue;
            assert_true(off_grid(b.x - margin, 2 * margin) < 0.01);
            assert_true(off_grid(b.y - margin, 2 * margin) < 0.01);
            assert_true(off_grid(b.width, 2 * margin) < 0.01);
            assert_true(off_grid(b.height, 2 * margin) < 0.01);
            assert_true(b.width > wanted - 0.01);
            assert_true(
                b.width < longest_of(&cage, extents) * atlas.texels_per_unit +
                              2 * margin + 0.01);
        }
        test_run_destroy(run);
    }
}

/* The side of a block that edge k of its quad is, in texels. */
static double
side_of(const block *b, int32_t k)
{
    return k % 2 == 0 ? b->width : b->height;
}

/* Quads that share an edge have as many texels along it. */
static void
sides_meet(void **state)
{
    const int32_t side = 2048;

    (void)state;
    for (size_t i = 0; i < sizeof CAGES / sizeof *CAGES; ++i)
    {
        otx_run *run = test_run_create();
        const otx_cage cage = cage_of(run, CAGES[i]);
        const otx_surface surface = mesh_refine(run, &cage, 1);
        const otx_level *level = &surface.levels[0];
        const otx_atlas_options options = {side, 0, 0.0};
        otx_atlas atlas;

        assert_int_equal(
            otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
        for (int32_t f = 0; f < level->face_count; ++f)
            for (int32_t k = 0; k < otx_level_face_size(level, f); ++k)
            {
                const int32_t other = otx_level_neighbour(level, f, k);
                const block here = block_of(&cage, &atlas, f, side);
                block there;
                int32_t back = 0;

                if (other < 0 || otx_level_face_size(level, f) != 4 ||
                    otx_level_face_size(level, other) != 4)
                    continue;
                there = block_of(&cage, &atlas, other, side);
                while (level->face_edges[level->face_first[other] + back] !=
                       level->face_edges[level->face_first[f] + k])
                    ++back;
                assert_true(
                    fabs(side_of(&here, k) - side_of(&there, back)) < 0.01);
            }
        test_run_destroy(run);
    }
}

/* A margin that nobody asked for costs no more than half of the texture, unless
 * it is the least; and a density that is asked for is kept. */
static void
what_is_left_open_is_chosen(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage cage = cage_of(run, "models/cages/creature.obj");
    const otx_surface surface = mesh_refine(run, &cage, 1);
    int32_t before = OTX_ATLAS_MARGIN_MIN;

    (void)state;
    for (int32_t side = 256; side <= 8192; side *= 2)
    {
        const otx_atlas_options options = {side, 0, 0.0};
        otx_atlas atlas;

        assert_int_equal(
            otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
        assert_true(atlas.margin >= before && atlas.margin <= 16);
        before = atlas.margin;
    }
    assert_int_equal(before, 16);
    for (double density = 20.0; density < 2000.0; density *= 3.0)
    {
        const otx_atlas_options options = {1024, 8, density};
        otx_atlas atlas;

        assert_int_equal(
            otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
        assert_true(atlas.texels_per_unit == density);
    }
    test_run_destroy(run);
}

/* 128 texels hold 64 blocks of the least size; no texels to a unit are found.
 */
static void
more_faces_than_a_tile_holds_are_told(void **state)
{
    static const otx_atlas_options options = {128, 0, 0.0};
    otx_run *run = test_run_create();
    const otx_cage cage = cage_of(run, "models/cages/creature.obj");
    const otx_surface surface = mesh_refine(run, &cage, 1);
    otx_atlas atlas;

    (void)state;
    assert_int_equal(
        otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
    assert_int_equal(atlas.tile_count, (278 + 63) / 64);
    assert_non_null(
        strstr(test_last_message(run), "278 faces fill 5 tiles of 128 x 128"));
    test_run_destroy(run);
}

static void
what_cannot_be_packed_is_refused(void **state)
{
    static const struct
    {
        otx_atlas_options options;
        otx_status status;
        const char *says;
    } cases[] = {
        {{1024, 5, 0.0}, OSDTEX_ERROR_ARGUMENT, "4, 8, 16, 32 or 64"},
        {{1024, 2, 0.0}, OSDTEX_ERROR_ARGUMENT, "4, 8, 16, 32 or 64"},
        {{1024, 128, 0.0}, OSDTEX_ERROR_ARGUMENT, "4, 8, 16, 32 or 64"},
        {{15, 0, 0.0}, OSDTEX_ERROR_ARGUMENT, "raise the resolution"},
        {{127, 32, 0.0}, OSDTEX_ERROR_ARGUMENT, "raise the resolution"},
    };
    otx_run *run = test_run_create();
    const otx_cage cage = cage_of(run, "models/cages/creature.obj");
    const otx_surface surface = mesh_refine(run, &cage, 0);
    otx_atlas atlas;

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        assert_int_equal(
            otx_atlas_pack(run, &surface, &cases[i].options, &atlas),
            cases[i].status);
        assert_non_null(strstr(test_last_message(run), cases[i].says));
    }
    test_run_destroy(run);
}

/* A margin that is not asked for leaves room for blocks. */
static void
small_tiles_hold_blocks(void **state)
{
    static const int32_t sides[] = {16, 24, 40, 64};
    static const float points[] = {
        0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 3, 1, 0};
    static const int32_t verts[] = {0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6};
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_input(run, points, 8, verts, 3, 4);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 1);

    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof *sides; ++i)
    {
        const otx_atlas_options options = {sides[i], 0, 0.0};
        otx_atlas atlas;

        assert_int_equal(
            otx_atlas_pack(run, &surface, &options, &atlas), OSDTEX_OK);
        for (int32_t f = 0; f < cage.face_count; ++f)
        {
            const float *uv = atlas.uvs + 8 * f;

            assert_true(uv[0] > 0.0f && uv[1] > 0.0f);
            assert_true(uv[4] > uv[0] && uv[5] > uv[1]);
        }
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_are_apart),
        cmocka_unit_test(cells_lie_on_a_grid_as_large_as_their_faces),
        cmocka_unit_test(sides_meet),
        cmocka_unit_test(what_is_left_open_is_chosen),
        cmocka_unit_test(more_faces_than_a_tile_holds_are_told),
        cmocka_unit_test(what_cannot_be_packed_is_refused),
        cmocka_unit_test(small_tiles_hold_blocks),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_tile.c -- tiles meet exactly on every mesh, at every mip level. */
#include "method/tile/tile.h"

#include "../../grid.h"
#include "../file/picture_support.h"
#include "../surface/meshes.h"

#include "export/texture_file.h"
#include "file/exr.h"
#include "image/pyramid.h"
#include "mapping/tile_check.h"
#include "tiling/tileset.h"

#include <dirent.h>
#include <math.h>

enum
{
    SAMPLES = 9,
    FULL_LEVELS = 16
};

/* Quad cages with poles of valence 3 to 64, boundaries, a handle, holes. */
static const char *const cages[] = {
    "catmark_cube",          "catmark_torus_creases0", "catmark_pole64",
    "catmark_edgecorner",    "catmark_xord_interior",  "catmark_hole_test2",
    "catmark_gregory_test1", "catmark_nonquads",       "catmark_rook",
};

/* All quad cages of the data, for the run that takes its time. */
static bool all_cages;

/* What a test maps: an exemplar that has tiles, its levels as stored. */
typedef struct fixture
{
    otx_run *run;
    otx_exemplar exemplar;
    int32_t level_count;
    otx_image levels[FULL_LEVELS];
} fixture;

/* Blobs of a few texels, so that cuts have something to follow. */
static otx_exemplar *
make_exemplar(otx_run *run, int32_t side, uint64_t seed)
{
    otx_exemplar *e = test_exemplar_create(run->arena, side, side, true, seed);
    otx_image smooth;

    assert_int_equal(
        otx_image_create(run, run->arena, side, side, 3, &smooth), OSDTEX_OK);
    for (int32_t y = 0; y < side; ++y)
        for (int32_t x = 0; x < side; ++x)
            for (int32_t c = 0; c < 3; ++c)
            {
                float sum = 0.0f;

                for (int32_t k = 0; k < 16; ++k)
                    sum += otx_image_at(
                        &e->linear, (x + k % 4) % side, (y + k / 4) % side)[c];
                otx_image_at(&smooth, x, y)[c] = sum / 1600.0f;
            }
    e->linear = e->match = smooth;
    return e;
}

static void
make_tiles(fixture *f, const otx_tileset_options *options, uint64_t picture)
{
    otx_run *run = f->run;
    const otx_exemplar *source = make_exemplar(run, 96, picture);
    const test_folder folder = test_folder_create();
    const char *path = test_path(&folder, "tiles.exr");
    char command[2048] = "oiiotool -q";
    otx_atomic_file_set *set;
    otx_tileset made;
    otx_picture read;

    if (otx_tileset_make(run, source, options, &made) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    assert_int_equal(otx_atomic_file_begin(run, run->arena, &set), OSDTEX_OK);
    assert_int_equal(
        otx_texture_file_write(
            run, set, path, source, &made.linear, &made.layout),
        OSDTEX_OK);
    assert_int_equal(otx_atomic_file_commit(run, set, false), OSDTEX_OK);
    read = test_read(run, path);
    f->exemplar = *source;
    f->exemplar.linear = read.image;
    f->exemplar.wrap_x = f->exemplar.wrap_y = false;
    assert_non_null(read.tiles);
    assert_int_equal(
        otx_tile_layout_parse(
            run, path, read.tiles, read.image.width, read.image.height,
            &f->exemplar.tiles),
        OSDTEX_OK);
    f->level_count = otx_pyramid_count(read.image.width, read.image.height);
    for (int32_t l = 0; l < f->level_count; ++l)
        sprintf(
            command + strlen(command), " tiles.exr --selectmip %d -o %d.exr", l,
            l);
    assert_int_equal(test_shell(&folder, command), 0);
    for (int32_t l = 0; l < f->level_count; ++l)
    {
        char name[16];

        snprintf(name, sizeof name, "%d.exr", l);
        f->levels[l] = test_read(run, test_path(&folder, name)).image;
    }
    test_folder_remove(&folder);
}

static otx_mapping
map_tiles(fixture *f, const otx_surface *surface, int32_t level)
{
    const otx_tile_settings settings = {level, OTX_TILE_SPREAD, 0, 1};
    const otx_map_request request = {.scale = 1.0, .first_face = -1};
    const otx_job job = {
        f->run, surface, &f->exemplar, 1, &request, &settings, NULL};
    otx_mapping mapping;

    if (otx_method_map(otx_method_find("tile"), &job, &mapping) != OSDTEX_OK)
        fail_msg("%s", test_last_message(f->run));
    return mapping;
}

/* Both sides of every edge and all tiles around every vertex show the same to
 * within 1/1024, at every level that the file has. */
static void
check_cage(fixture *f, const char *name, int32_t tile_level, int32_t level)
{
    const otx_arena_mark mark = otx_arena_here(f->run->arena);
    double worst = 0.0;
    char path[512];
    otx_cage cage;
    otx_surface surface;
    otx_mapping mapping;

    snprintf(path, sizeof path, SHARED_DATA "/cages/%s.obj", name);
    if (mesh_cage_from_file(f->run, path, &cage) != OSDTEX_OK)
        fail_msg("%s", test_last_message(f->run));
    surface = mesh_refine(f->run, &cage, level);
    mapping = map_tiles(f, &surface, tile_level);
    for (int32_t l = 0; l < f->level_count; ++l)
    {
        otx_tile_match match;

        assert_int_equal(
            otx_tile_check_match(
                f->run, &mapping, &f->levels[l], SAMPLES, &match),
            OSDTEX_OK);
        if (match.edge > 1.0 / 1024 || match.corner > 1.0 / 1024)
            fail_msg(
                "%s at mip %d: edges %g, corners %g", name, (int)l, match.edge,
                match.corner);
        worst = fmax(worst, fmax(match.edge, match.corner));
    }
    if (all_cages)
        print_message(
            "%s: tiles of level %d on level %d, at most %g\n", name,
            (int)tile_level, (int)level, worst);
    otx_arena_release(f->run->arena, mark);
}

/* Quad cages of the data: those that are not said to be made for Loop. */
static void
check_all_cages(fixture *f, int32_t tile_level, int32_t level)
{
    DIR *folder = opendir(SHARED_DATA "/cages");
    struct dirent *entry;

    assert_non_null(folder);
    while ((entry = readdir(folder)) != NULL)
    {
        char *dot = strrchr(entry->d_name, '.');

        if (!dot || strcmp(dot, ".obj") != 0 ||
            strncmp(entry->d_name, "loop_", 5) == 0)
            continue;
        *dot = '\0';
        check_cage(f, entry->d_name, tile_level, level);
    }
    closedir(folder);
}

static void
check_cages(fixture *f, int32_t tile_level, int32_t level)
{
    if (all_cages)
    {
        check_all_cages(f, tile_level, level);
        return;
    }
    for (int32_t i = 0; i < COUNT(cages); ++i)
        check_cage(f, cages[i], tile_level, level);
}

static bool
has_what_it_needs(void)
{
    FILE *file = fopen(SHARED_DATA "/cages/catmark_cube.obj", "r");

    if (!file || !test_has_tool("oiiotool"))
    {
        print_message("skipped: no " SHARED_DATA " or no oiiotool\n");
        if (file)
            fclose(file);
        return false;
    }
    fclose(file);
    return true;
}

static void
check_sets(const otx_tileset_options *options)
{
    fixture *f;
    otx_run *run;

    if (!has_what_it_needs())
        skip();
    run = test_run_create();
    f = OTX_ZNEW(run->arena, fixture, 1);
    f->run = run;
    make_tiles(f, options, 1);
    check_cages(f, 1, 1);
    check_cages(f, 3, 3);
    check_cages(f, 1, 2);
    test_run_destroy(run);
}

static void
test_one_boundary_is_exact(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 32, .gutter = 4};

    (void)state;
    check_sets(&options);
}

static void
test_two_boundaries_are_exact(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 2, .corners = 1, .cell = 16, .gutter = 2};

    (void)state;
    check_sets(&options);
}

static void
test_two_corners_are_exact(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 2, .cell = 32, .gutter = 2};

    (void)state;
    check_sets(&options);
}

static void
test_oriented_is_exact(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1,
        .corners = 1,
        .cell = 16,
        .gutter = 2,
        .oriented = true,
    };

    (void)state;
    check_sets(&options);
}

/* The check bites: levels averaged over the whole picture do not meet once a
 * texel is wider than both gutters. */
static void
test_plain_levels_would_not_meet(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 32, .gutter = 2};
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 2);
    fixture f = {.run = run, .exemplar = *make_exemplar(run, 48, 1)};
    otx_tile_match match;
    otx_pyramid pyramid;
    otx_mapping mapping;
    otx_tileset made;

    (void)state;
    assert_int_equal(
        otx_tileset_make(run, &f.exemplar, &options, &made), OSDTEX_OK);
    f.exemplar.linear = made.linear;
    f.exemplar.tiles = made.layout;
    mapping = map_tiles(&f, &surface, 2);
    assert_int_equal(
        otx_pyramid_build(run, run->arena, &made.linear, &pyramid), OSDTEX_OK);
    for (int32_t l = 0; l < 4; ++l)
    {
        assert_int_equal(
            otx_tile_check_match(
                run, &mapping, &pyramid.levels[l], SAMPLES, &match),
            OSDTEX_OK);
        if (l < otx_tile_layout_exact_levels(&made.layout))
            assert_true(match.edge < 1e-5 && match.corner < 1e-5);
        else
            assert_true(match.edge > 1e-2);
    }
    test_run_destroy(run);
}

/* Three pictures, one OBJ: UVs are the same bytes. */
static void
test_pictures_can_be_swapped(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 16, .gutter = 2};
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface surface = mesh_refine(run, &cage, 3);
    const size_t bytes =
        2 * sizeof(float) * (size_t)otx_surface_leaf(&surface)->corner_count;
    float *first = NULL;

    (void)state;
    for (uint64_t picture = 1; picture <= 3; ++picture)
    {
        fixture f = {.run = run};
        otx_exemplar *source = make_exemplar(run, 48, picture);
        otx_tileset made;
        otx_mapping mapping;

        assert_int_equal(
            otx_tileset_make(run, source, &options, &made), OSDTEX_OK);
        f.exemplar = *source;
        f.exemplar.linear = made.linear;
        f.exemplar.tiles = made.layout;
        mapping = map_tiles(&f, &surface, 2);
        if (first)
            assert_memory_equal(first, mapping.uvs, bytes);
        first = mapping.uvs;
    }
    test_run_destroy(run);
}

/* The same bytes at 1, 2 and 5 threads. */
static void
test_threads_change_nothing(void **state)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 32, .gutter = 2};
    float *first = NULL;
    size_t floats = 0;

    (void)state;
    for (int32_t threads = 1; threads <= 5; threads += threads)
    {
        otx_run *run = test_run_create_with(NULL, threads);
        otx_tileset made;

        assert_int_equal(
            otx_tileset_make(run, make_exemplar(run, 64, 7), &options, &made),
            OSDTEX_OK);
        floats = 3 * (size_t)made.linear.width * (size_t)made.linear.height;
        if (first)
            assert_memory_equal(
                first, made.linear.pixels, floats * sizeof *first);
        else
        {
            first = malloc(floats * sizeof *first);
            assert_non_null(first);
            memcpy(first, made.linear.pixels, floats * sizeof *first);
        }
        test_run_destroy(run);
    }
    free(first);
}

static void
test_triangles_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in =
        mesh_input(run, octahedron_points, 6, octahedron_verts, 8, 3);
    otx_cage_options scheme = otx_cage_options_default();
    const otx_tile_layout layout = {
        .boundaries = 1,
        .corners = 1,
        .cell = 16,
        .gutter = 2,
        .source_width = 16};
    otx_tile_settings settings = {-1, 0, 0, 1};
    otx_surface surface;
    otx_cage cage;
    int32_t level;

    (void)state;
    cage = mesh_build(run, &in, NULL);
    surface = mesh_refine(run, &cage, 2);
    assert_int_equal(
        otx_tile_level(run, &surface, &layout, &settings, 1.0, &level),
        OSDTEX_OK);
    assert_true(level >= 1);
    settings.level = 0;
    assert_int_equal(
        otx_tile_level(run, &surface, &layout, &settings, 1.0, &level),
        OSDTEX_ERROR_TOPOLOGY);
    scheme.scheme = OTX_SCHEME_LOOP;
    cage = mesh_build(run, &in, &scheme);
    surface = mesh_refine(run, &cage, 2);
    assert_int_equal(
        otx_tile_level(run, &surface, &layout, &settings, 1.0, &level),
        OSDTEX_ERROR_TOPOLOGY);
    assert_non_null(strstr(test_last_message(run), "catmark"));
    test_run_destroy(run);
}

/* With an argument: on all cages of the data. */
int
main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_boundary_is_exact),
        cmocka_unit_test(test_two_boundaries_are_exact),
        cmocka_unit_test(test_two_corners_are_exact),
        cmocka_unit_test(test_oriented_is_exact),
        cmocka_unit_test(test_plain_levels_would_not_meet),
        cmocka_unit_test(test_pictures_can_be_swapped),
        cmocka_unit_test(test_threads_change_nothing),
        cmocka_unit_test(test_triangles_are_refused),
    };

    const struct CMUnitTest on_cages[] = {
        cmocka_unit_test(test_one_boundary_is_exact),
        cmocka_unit_test(test_two_boundaries_are_exact),
        cmocka_unit_test(test_two_corners_are_exact),
    };

    (void)argv;
    all_cages = argc > 1;
    return all_cages ? cmocka_run_group_tests(on_cages, NULL, NULL)
                     : cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_look.c -- a baked cage comes out as it went in, all files or none. */
#include "unit/bake/flat.h"

#include "export/look.h"

#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

/* A folder of its own for each test. */
static const char *
make_folder(otx_run *run)
{
    char *path = otx_arena_strdup(run->arena, "/tmp/osdtex_look_XXXXXX");

    assert_non_null(mkdtemp(path));
    return path;
}

static const char *
inside(otx_run *run, const char *folder, const char *name)
{
    char *path = OTX_NEW(run->arena, char, 512);

    snprintf(path, 512, "%s/%s", folder, name);
    return path;
}

/* Removes a folder; how many files were in it. */
static int32_t
empty_folder(otx_run *run, const char *folder)
{
    DIR *dir = opendir(folder);
    int32_t count = 0;

    assert_non_null(dir);
    for (const struct dirent *e; (e = readdir(dir));)
        if (e->d_name[0] != '.')
        {
            unlink(inside(run, folder, e->d_name));
            ++count;
        }
    closedir(dir);
    rmdir(folder);
    return count;
}

typedef struct job
{
    otx_cage cage;
    otx_surface surface;
    otx_mapping *mapping;
    otx_exemplar *exemplar;
    otx_layout layout;
} job;

static job *
make_job(otx_run *run, const char *path, otx_layout_source source)
{
    job *j = OTX_NEW(run->arena, job, 1);

    assert_int_equal(mesh_cage_from_file(run, path, &j->cage), OSDTEX_OK);
    j->surface = mesh_refine(run, &j->cage, 1);
    j->mapping = flat_mapping(run, &j->surface, 10.0);
    j->exemplar = flat_ramp(run, 32);
    j->exemplar->linear_space = "ACEScg";
    j->exemplar->interop_id = "lin_ap1_scene";
    j->layout = flat_layout(run, j->mapping, source, 128, 0);
    return j;
}

static otx_status
write_job(otx_run *run, const job *j, const char *path)
{
    const otx_look_options options = {.path = path};

    return otx_look_write(run, j->mapping, j->exemplar, &j->layout, &options);
}

static void
assert_same_names(
    const otx_obj_names *names, const int32_t *faces,
    const otx_obj_names *old_names, const int32_t *old_faces, int32_t count)
{
    for (int32_t f = 0; f < count; ++f)
    {
        const int32_t a = faces ? faces[f] : -1;
        const int32_t b = old_faces ? old_faces[f] : -1;

        assert_int_equal(a < 0, b < 0);
        if (a >= 0)
            assert_string_equal(names->text[a], old_names->text[b]);
    }
}

static void
the_cage_is_written_as_it_was_read(void **state)
{
    static const char *const cages[] = {
        "models/cages/materials_and_groups.obj", "models/cages/creased.obj",
        "models/cages/corner.obj", "models/cages/hole.obj",
        "models/cages/ngons_and_triangles.obj"};

    (void)state;
    for (size_t i = 0; i < sizeof cages / sizeof *cages; ++i)
    {
        otx_run *run = test_run_create();
        const char *folder = make_folder(run);
        const job *j = make_job(run, cages[i], OTX_LAYOUT_ATLAS);
        otx_obj before, after;

        if (write_job(run, j, inside(run, folder, "x.obj")) != OSDTEX_OK)
            fail_msg("%s", test_last_message(run));
        assert_int_equal(otx_obj_read(run, cages[i], &before), OSDTEX_OK);
        assert_int_equal(
            otx_obj_read(run, inside(run, folder, "x_cage.obj"), &after),
            OSDTEX_OK);
        assert_int_equal(before.vert_count, after.vert_count);
        assert_int_equal(before.face_count, after.face_count);
        assert_memory_equal(
            before.points, after.points, (size_t)before.vert_count * 12);
        assert_memory_equal(
            before.face_first, after.face_first,
            ((size_t)before.face_count + 1) * 4);
        assert_memory_equal(
            before.face_verts, after.face_verts,
            (size_t)before.corner_count * 4);
        assert_same_names(
            &after.groups, after.face_group, &before.groups, before.face_group,
            before.face_count);
        assert_same_names(
            &after.objects, after.face_object, &before.objects,
            before.face_object, before.face_count);
        assert_int_equal(before.creases.count, after.creases.count);
        assert_memory_equal(
            before.creases.verts, after.creases.verts,
            (size_t)before.creases.count * 8);
        assert_memory_equal(
            before.creases.sharpness, after.creases.sharpness,
            (size_t)before.creases.count * 4);
        assert_int_equal(before.corners.count, after.corners.count);
        assert_int_equal(before.hole_count, after.hole_count);
        assert_int_equal(after.fvar.value, OTX_FVAR_ALL);
        assert_int_equal(empty_folder(run, folder), 4 + j->layout.tile_count);
        test_run_destroy(run);
    }
}

static bool
stop_soon(void *user, const char *stage, double fraction)
{
    int32_t *left = user;

    (void)stage;
    (void)fraction;
    return (*left)-- > 0;
}

static void
a_stopped_job_leaves_nothing(void **state)
{
    (void)state;
    for (int32_t calls = 0; calls < 16; ++calls)
    {
        otx_run *run = test_run_create();
        otx_run *names = test_run_create();
        const char *folder = make_folder(names);
        const job *j =
            make_job(run, "models/cages/plane.obj", OTX_LAYOUT_ATLAS);
        int32_t left = calls;

        run->progress = stop_soon;
        run->progress_user = &left;
        assert_int_equal(
            write_job(run, j, inside(names, folder, "x.obj")),
            OSDTEX_ERROR_CANCELLED);
        test_run_destroy(run);
        assert_int_equal(empty_folder(names, folder), 0);
        test_run_destroy(names);
    }
}

static void
a_folder_that_is_not_there_is_an_error(void **state)
{
    otx_run *run = test_run_create();
    const job *j = make_job(run, "models/cages/plane.obj", OTX_LAYOUT_ATLAS);

    (void)state;
    assert_int_equal(
        write_job(run, j, "/nowhere/at/all/x.obj"), OSDTEX_ERROR_IO);
    test_run_destroy(run);
}

static void
own_uvs_keep_their_numbers(void **state)
{
    otx_run *run = test_run_create();
    const char *folder = make_folder(run);
    const job *j = make_job(run, "models/cages/uv_seams.obj", OTX_LAYOUT_OWN);
    otx_obj before, after;

    (void)state;
    if (write_job(run, j, inside(run, folder, "x.obj")) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    otx_obj_read(run, "models/cages/uv_seams.obj", &before);
    otx_obj_read(run, inside(run, folder, "x_cage.obj"), &after);
    assert_int_equal(before.uv_count, after.uv_count);
    assert_memory_equal(before.uvs, after.uvs, (size_t)before.uv_count * 8);
    assert_memory_equal(
        before.face_uvs, after.face_uvs, (size_t)before.corner_count * 4);
    assert_int_equal(after.fvar.value, (int32_t)j->cage.fvar);
    empty_folder(run, folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cage_is_written_as_it_was_read),
        cmocka_unit_test(a_stopped_job_leaves_nothing),
        cmocka_unit_test(a_folder_that_is_not_there_is_an_error),
        cmocka_unit_test(own_uvs_keep_their_numbers),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_surface_check.c -- damage is seen, and sound surfaces are not blamed. */
#include "meshes.h"

#include <dirent.h>

/* Breaks one array at a time: the checker must see each. */
static void
test_validate_sees_damage(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_grid(run, 3);
    const otx_cage cage = mesh_build(run, &in, NULL);
    const otx_surface s = mesh_refine(run, &cage, 2);
    const otx_level *l = &s.levels[1];
    const int32_t *const arrays[] = {
        l->face_verts,         l->face_edges,      l->edge_verts,
        l->edge_faces,         l->face_parent,     l->face_child_first,
        l->edge_child_vert,    l->face_child_vert, l->face_cage,
        s.levels[2].face_verts};

    (void)state;
    assert_int_equal(otx_surface_validate(run, &s), OSDTEX_OK);
    for (int32_t i = 0; i < COUNT(arrays); ++i)
    {
        int32_t *entry = (int32_t *)(uintptr_t)&arrays[i][5];
        const int32_t kept = *entry;

        *entry = kept + 1;
        if (otx_surface_validate(run, &s) != OSDTEX_ERROR_NUMERIC)
            fail_msg("damage to array %d is not seen", i);
        *entry = INT32_MAX;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
        *entry = kept;
    }
    {
        float *point = (float *)(uintptr_t)&s.points[7];
        float *normal = (float *)(uintptr_t)&s.normals[11];
        uint8_t *hole = (uint8_t *)(uintptr_t)&l->face_hole[3];

        *hole = 1;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
        *hole = 0;
        *point = NAN;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
        *point = 0.0f;
        *normal += 0.1f;
        assert_int_equal(otx_surface_validate(run, &s), OSDTEX_ERROR_NUMERIC);
    }
    test_run_destroy(run);
}

/* Every cage of a folder at levels 0 to 3. */
static int32_t
refine_folder(const char *folder)
{
    DIR *dir = opendir(folder);
    const struct dirent *entry;
    int32_t count = 0;

    while (dir && (entry = readdir(dir)))
    {
        const char *dot = strrchr(entry->d_name, '.');
        char path[512];

        if (!dot || strcmp(dot, ".obj") != 0)
            continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        ++count;
        for (int32_t level = 0; level <= 3; ++level)
        {
            otx_run *run = test_run_create();
            otx_surface s;
            otx_cage cage;

            if (mesh_cage_from_file(run, path, &cage) != OSDTEX_OK ||
                otx_surface_refine(run, &cage, level, 0, &s) != OSDTEX_OK ||
                otx_surface_validate(run, &s) != OSDTEX_OK)
                fail_msg(
                    "%s at level %d: %s", path, level, test_last_message(run));
            test_run_destroy(run);
        }
    }
    if (dir)
        closedir(dir);
    return count;
}

static void
test_model_cages(void **state)
{
    (void)state;
    assert_true(refine_folder("models/cages") >= 10);
}

static void
test_real_cages(void **state)
{
    const int32_t count = refine_folder(SHARED_DATA "/cages");

    (void)state;
    if (count == 0)
    {
        print_message("skipped: no " SHARED_DATA "\n");
        skip();
    }
    assert_int_equal(count, 31);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_validate_sees_damage),
        cmocka_unit_test(test_model_cages),
        cmocka_unit_test(test_real_cages),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_lapped.c -- pastes: nothing opens, nothing turns over, few layers. */
#include "unit/method/trial.h"

#include <dirent.h>

/* Of every face that has lookups the lowest is all there is at the least, so
 * that no place is left open, however it is sampled. How many have. */
static int32_t
check_nothing_opens(const trial *t)
{
    const otx_lookups *l = t->mapping.lookups;
    const otx_level *leaf = otx_surface_leaf(&t->surface);
    int32_t layered = 0;

    assert_int_equal(l->layering, OTX_LAYERING_OVER);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f); ++k)
        {
            const otx_lookup *item = l->items + l->first[f] + k;

            if (l->first[f + 1] == l->first[f])
                continue;
            ++layered;
            assert_float_equal(item->weight, 1.0, 0.0);
            assert_null(l->fragments[item->fragment].outline);
            assert_null(l->fragments[item->fragment].mask);
        }
    return layered;
}

static void
the_lowest_is_opaque(void **state)
{
    trial *t = paste("models/cages/creature.obj", 2, 12.0, "auto", 2);

    (void)state;
    assert_true(check_nothing_opens(t) > 0);
    test_run_destroy(t->run);
}

static void
layers_are_few_and_lie_along_the_field(void **state)
{
    static const char *const modes[] = {"splotch", "paper"};

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        trial *t = paste("models/cages/torus.obj", 3, 100.0, modes[i], 2);
        const double seen = otx_figures_value(&t->figures, "lapped.visible");

        assert_true(seen >= 1.0 && seen <= 3.2);
        assert_true(
            otx_figures_value(&t->figures, "lapped.touched") >= seen - 1.0);
        assert_true(
            otx_figures_value(&t->figures, "lapped.misfit_right") <= 0.15);
        assert_true(otx_figures_value(&t->figures, "lapped.misfit_up") <= 0.15);
        test_run_destroy(t->run);
    }
}

/* The level at which a cage has some hundred faces. */
static int32_t
level_for(const char *path)
{
    otx_run *run = test_run_create();
    const otx_surface cage = sheet_from_file(run, path, 0);
    int32_t faces = otx_surface_leaf(&cage)->face_count, level = 0;

    for (; faces < 400; faces *= 4)
        ++level;
    test_run_destroy(run);
    return level;
}

/* Whatever its shape, a cage of the data is covered; how many layers that takes
 * is said. */
static void
check_cage(const char *path)
{
    trial *t = paste(path, level_for(path), 20.0, "splotch", 2);
    const double seen = otx_figures_value(&t->figures, "lapped.visible");
    const double touched = otx_figures_value(&t->figures, "lapped.touched");

    check_nothing_opens(t);
    print_message(
        "%s: %d faces, %.0f pastes, touched %.2f, visible %.2f\n", path,
        (int)otx_surface_leaf(&t->surface)->face_count,
        otx_figures_value(&t->figures, "lapped.pastes"), touched, seen);
    assert_true(seen >= 1.0 && touched >= seen - 1.0);
    test_run_destroy(t->run);
}

static void
every_cage_is_covered(void **state)
{
    DIR *folder = opendir(SHARED_DATA "/cages");
    struct dirent *entry;

    (void)state;
    if (!folder)
        test_skip("no real cages beside the project");
    while ((entry = readdir(folder)) != NULL)
    {
        const size_t length = strlen(entry->d_name);
        char path[512];

        if (length < 5 || strcmp(entry->d_name + length - 4, ".obj") != 0)
            continue;
        snprintf(
            path, sizeof path, "%s/%s", SHARED_DATA "/cages", entry->d_name);
        check_cage(path);
    }
    closedir(folder);
}

int
main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lowest_is_opaque),
        cmocka_unit_test(layers_are_few_and_lie_along_the_field),
    };
    const struct CMUnitTest on_cages[] = {
        cmocka_unit_test(every_cage_is_covered),
    };

    (void)argv;
    return argc > 1 ? cmocka_run_group_tests(on_cages, NULL, NULL)
                    : cmocka_run_group_tests(tests, NULL, NULL);
}

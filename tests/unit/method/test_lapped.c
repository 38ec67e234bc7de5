/* test_lapped.c -- pastes: nothing opens, nothing turns over, few layers. */
#include "unit/method/trial.h"

/* Of every face that has lookups the lowest is all there is at the least, so
 * that no place is left open, however it is sampled. */
static void
the_lowest_is_opaque(void **state)
{
    trial *t = paste("models/cages/creature.obj", 2, 12.0, "auto", 2);
    const otx_lookups *l = t->mapping.lookups;
    const otx_level *leaf = otx_surface_leaf(&t->surface);
    int32_t layered = 0;

    (void)state;
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
    assert_true(layered > 0);
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

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_lowest_is_opaque),
        cmocka_unit_test(layers_are_few_and_lie_along_the_field),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

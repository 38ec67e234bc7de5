/* test_elastic_system.c -- ends of seams lie with their variables, and where
 * all is well the step is none. */
#include "grid.h"

#include "relax/elastic_state.h"

enum
{
    SIDE = 6,
    DENSITY = 8
};

/* Sheets of two halves of a grid, of which the right one is off by `off`
 * texels, with room for what a round needs. */
static otx_elastic *
prepare(otx_run *run, const otx_elastic_options *options, otx_vec2 off)
{
    otx_elastic *e = OTX_ZNEW(run->arena, otx_elastic, 1);
    otx_surface *surface = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t *patch = OTX_NEW(run->arena, int32_t, leaf->face_count);
    otx_vec2 *uvs = OTX_NEW(run->arena, otx_vec2, leaf->corner_count);
    otx_elastic_view *view = OTX_NEW(run->arena, otx_elastic_view, 1);
    int32_t n;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        patch[f] = f % SIDE >= SIDE / 2;
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const float *p = surface->points + 3 * leaf->face_verts[c];

        uvs[c] = (otx_vec2){
            DENSITY * (double)p[0] + patch[c / 4] * off.x,
            DENSITY * (double)p[1] + patch[c / 4] * off.y};
    }
    e->run = run;
    e->surface = surface;
    e->options = options;
    assert_int_equal(
        otx_sheet_build(run, surface, DENSITY, patch, NULL, uvs, &e->sheet),
        OSDTEX_OK);
    n = e->sheet.count;
    e->pictures.exemplars = test_exemplar_create(run->arena, 64, 64, true, 3);
    e->pictures.count = 1;
    *view = (otx_elastic_view){
        e->pictures.exemplars, &e->pictures.exemplars->match};
    e->pictures.views = view;
    e->pictures.source = OTX_ZNEW(run->arena, uint8_t, n);
    e->ends.first = OTX_ZNEW(run->arena, int32_t, n + 2);
    e->ends.items =
        OTX_ZNEW(run->arena, otx_elastic_end, 4 * e->sheet.seam_count);
    e->ends.shares =
        OTX_ZNEW(run->arena, otx_elastic_share, 4 * e->sheet.seam_count);
    e->ends.of = OTX_ZNEW(run->arena, int32_t, 4 * e->sheet.seam_count);
    e->system.step = OTX_ZNEW(run->arena, otx_vec2, n);
    e->system.b = OTX_ZNEW(run->arena, otx_vec2, n);
    e->system.diagonal = OTX_ZNEW(run->arena, otx_vec2, n);
    otx_elastic_list_ends(e);
    return e;
}

static void
ends_lie_with_their_variables(void **state)
{
    const otx_elastic_options options = {.texels = DENSITY, .stiffness = 0.3};
    otx_run *run = test_run_create();
    const otx_elastic *e = prepare(run, &options, (otx_vec2){3, 2});
    const int32_t *first = e->ends.first;

    (void)state;
    assert_int_equal(e->sheet.seam_count, SIDE);
    assert_int_equal(first[0], 0);
    assert_int_equal(first[e->sheet.count], 4 * SIDE);
    for (int32_t i = 0; i < e->sheet.seam_count; ++i)
    {
        int32_t v[4];

        otx_elastic_variables(&e->sheet.seams[i], v);
        for (int k = 0; k < 4; ++k)
        {
            const int32_t at = e->ends.of[4 * i + k];

            assert_in_range(at, first[v[k]], first[v[k] + 1] - 1);
            assert_memory_equal(e->ends.items[at].v, v, sizeof v);
        }
    }
    test_run_destroy(run);
}

/* Both sides of a seam show the same: no residual, so no step. */
static void
where_all_is_well_there_is_no_step(void **state)
{
    const otx_elastic_options options = {.texels = DENSITY, .stiffness = 0.3};
    otx_run *run = test_run_create();

    (void)state;
    for (int moved = 0; moved < 2; ++moved)
    {
        otx_elastic *e = prepare(run, &options, (otx_vec2){2.5 * moved, 0});
        double longest = 0.0;
        otx_vec2 *step;

        assert_int_equal(otx_elastic_find_step(e, &step), OSDTEX_OK);
        for (int32_t v = 0; v < e->sheet.count; ++v)
            longest = fmax(longest, otx_vec2_length(step[v]));
        if (moved)
            assert_true(longest > 1e-3);
        else
            assert_true(longest < 1e-6);
    }
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_lie_with_their_variables),
        cmocka_unit_test(where_all_is_well_there_is_no_step),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_growth.c -- charts while faces are added to them: as far as they are to
 * reach, each face once, and not over themselves. */
#include "unit/method/pastes.h"

/* To a side of a face of a sheet. */
static const double TEXELS = 12.0;

typedef struct trial
{
    paste_bench *bench;
    otx_lapped_seed seed;
    otx_lapped_chart chart;
    otx_growth growth;
} trial;

static trial *
grow(
    otx_run *run, otx_surface surface, double texels, int32_t face, double hull)
{
    trial *t = OTX_ZNEW(run->arena, trial, 1);

    t->bench = paste_bench_create(run, surface, texels);
    t->seed = paste_seed(t->bench, face);
    t->growth = (otx_growth){
        .l = &t->bench->l,
        .seed = &t->seed,
        .space = &t->bench->space,
        .arena = run->arena,
        .chart = &t->chart,
        .hull = hull};
    assert_int_equal(otx_growth_run(&t->growth), OSDTEX_OK);
    paste_check_chart(t->bench, &t->chart);
    return t;
}

/* Where a chart vertex is on the surface, as seen from the seed, texels. */
static double
away(const trial *t, int32_t vert)
{
    return t->bench->l.texels *
           otx_vec3_length(otx_vec3_sub(
               otx_vec3_load(t->bench->surface.points, t->chart.verts[vert]),
               otx_lapped_point(&t->bench->l, &t->seed.place)));
}

/* Faces that the tests against folds refused come in by sewing. */
static void
sew(trial *t)
{
    int32_t added;

    assert_int_equal(otx_growth_sew(&t->growth, 1.01, &added), OSDTEX_OK);
}

/* On what is flat the chart is the surface, and has all that is near. */
static void
what_is_flat_lies_as_it_is(void **state)
{
    const double hull = 60.0;
    trial *t = grow(
        *state, sheet_create(*state, 30, 30, SHEET_FLAT), TEXELS, 15 * 30 + 15,
        hull);
    const otx_lapped *l = &t->bench->l;

    sew(t);
    for (int32_t v = 0; v < t->chart.vert_count; ++v)
        assert_float_equal(otx_vec2_length(t->chart.flat[v]), away(t, v), 1e-3);
    for (int32_t f = 0; f < l->leaf->face_count; ++f)
    {
        bool near = true;

        for (int32_t k = 0; k < 4; ++k)
            near = near && TEXELS * otx_vec3_length(otx_vec3_sub(
                                        otx_vec3_load(
                                            l->surface->points,
                                            l->leaf->face_verts[4 * f + k]),
                                        otx_lapped_point(l, &t->seed.place))) <
                               hull;
        if (near)
            assert_true(t->bench->space.face_slot[f] >= 0);
    }
    /* And not much more. */
    for (int32_t v = 0; v < t->chart.vert_count; ++v)
        assert_true(away(t, v) < hull + 2.0 * TEXELS * sqrt(2.0));
}

/* The picture's u runs along the heading. */
static void
the_seed_says_how_it_lies(void **state)
{
    trial *t = grow(
        *state, sheet_create(*state, 12, 12, SHEET_FLAT), 4.0, 6 * 12 + 6,
        20.0);
    const otx_connection *c = &t->bench->l.connection;

    for (int32_t v = 1; v < t->chart.vert_count; ++v)
    {
        const otx_vec3 on = otx_vec3_sub(
            otx_vec3_load(t->bench->surface.points, t->chart.verts[v]),
            otx_vec3_load(t->bench->surface.points, t->chart.verts[0]));
        const otx_vec2 seen = otx_connection_project(c, t->seed.face, on);
        const otx_vec2 flat = otx_vec2_sub(t->chart.flat[v], t->chart.flat[0]);

        assert_float_equal(flat.x, 4.0 * seen.x, 1e-3);
        assert_float_equal(flat.y, 4.0 * seen.y, 1e-3);
    }
}

/* A piece that reaches around the tube of a torus, and one that would lie on a
 * ball like a blanket. */
static void
charts_do_not_lie_over_themselves(void **state)
{
    static const char *const cages[] = {
        "models/cages/torus.obj", "models/cages/creature.obj"};

    for (int i = 0; i < 2; ++i)
    {
        otx_surface surface = sheet_from_file(*state, cages[i], 2);
        const double texels = 100.0 / sqrt(surface.area);

        for (int32_t face = 3; face < otx_surface_leaf(&surface)->face_count;
             face += otx_surface_leaf(&surface)->face_count / 3)
        {
            trial *t = grow(*state, surface, texels, face, 45.0);

            for (int32_t k = 1; k < t->chart.face_count; ++k)
            {
                const double ratio = paste_area_ratio(t->bench, &t->chart, k);

                assert_true(ratio > 0.4 && ratio < 2.3);
            }
            /* No place carries more than a cell's budget, about. */
            assert_true(paste_overlap(&t->chart, 70.0) < 0.6);
        }
    }
}

/* Sewing adds what is all but in the chart, as long as it keeps its area, and
 * then there is no more of it. */
static void
slits_are_sewn_until_none_are_left(void **state)
{
    const double ratio = 2.0;
    otx_surface surface =
        sheet_from_file(*state, "models/cages/creature.obj", 2);
    trial *t = grow(*state, surface, 100.0 / sqrt(surface.area), 40, 40.0);
    const int32_t grown = t->chart.face_count;
    const otx_lapped *l = &t->bench->l;
    int32_t added, again;

    assert_int_equal(otx_growth_sew(&t->growth, ratio, &added), OSDTEX_OK);
    assert_int_equal(t->chart.face_count, grown + added);
    paste_check_chart(t->bench, &t->chart);
    for (int32_t i = grown; i < t->chart.face_count; ++i)
    {
        const double found = paste_area_ratio(t->bench, &t->chart, i);

        assert_true(found > 0.9 / ratio && found < 1.1 * ratio);
    }
    for (int32_t v = 0; v < l->leaf->vert_count; ++v)
        if (t->bench->space.vert_slot[v] >= 0)
            assert_int_equal(t->chart.verts[t->bench->space.vert_slot[v]], v);
    assert_int_equal(otx_growth_sew(&t->growth, ratio, &again), OSDTEX_OK);
    assert_int_equal(again, 0);
}

static void
holes_are_left_out(void **state)
{
    otx_surface surface = sheet_create(*state, 10, 10, SHEET_FLAT);
    uint8_t *hole = (uint8_t *)(uintptr_t)otx_surface_leaf(&surface)->face_hole;
    trial *t;

    hole[5 * 10 + 6] = hole[6 * 10 + 6] = 1;
    t = grow(*state, surface, TEXELS, 5 * 10 + 5, 120.0);
    sew(t);
    assert_int_equal(t->chart.face_count, 98);
    assert_int_equal(t->bench->space.face_slot[5 * 10 + 6], -1);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(what_is_flat_lies_as_it_is),
        test_with_run(the_seed_says_how_it_lies),
        test_with_run(charts_do_not_lie_over_themselves),
        test_with_run(slits_are_sewn_until_none_are_left),
        test_with_run(holes_are_left_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

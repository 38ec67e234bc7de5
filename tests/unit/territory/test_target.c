/* test_target.c -- texels of charts: everyone's own, and where a collar's lie.
 */
#include "grid.h"
#include "unit/surface/meshes.h"

#include "territory/target.h"

enum
{
    SIDE = 64 /* texels of the exemplar */
};

#define TEXELS 40.0 /* per scene unit */

typedef struct scene
{
    otx_run *run;
    otx_cage cage;
    otx_surface surface;
    otx_target_set set;
} scene;

static void
set_up(scene *s, const char *cage)
{
    s->run = test_run_create();
    assert_int_equal(mesh_cage_from_file(s->run, cage, &s->cage), OSDTEX_OK);
    s->surface = mesh_refine(s->run, &s->cage, 2);
    s->set = (otx_target_set){
        .run = s->run,
        .exemplars = test_exemplar_create(s->run->arena, SIDE, SIDE, true, 1),
        .texels = TEXELS,
        .whole = true};
    s->set.mapping = test_mapping_create(
        s->run->arena, &s->surface, s->set.exemplars, TEXELS / SIDE, 0.0);
    assert_int_equal(otx_target_set_lay_out(&s->set, 60.0, 20.0), OSDTEX_OK);
    for (int32_t k = 0; k < s->set.territory.count; ++k)
        assert_int_equal(otx_target_fill(&s->set, k), OSDTEX_OK);
}

/* The point of the surface at a position of a plot, by a face's facet. */
static otx_vec3
point_at(const scene *s, int32_t k, int32_t slot, int32_t index, otx_vec2 p)
{
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    otx_plot_facet f;
    otx_vec3 sum = {0, 0, 0};

    assert_true(otx_plot_facet_of(
        &s->set.plots[k], &s->surface, TEXELS, slot, index, &f));
    for (int i = 0; i < 3; ++i)
        sum = otx_vec3_add(
            sum,
            otx_vec3_scale(
                f.at[i] + p.x * f.dx[i] + p.y * f.dy[i],
                otx_vec3_load(
                    s->surface.points, leaf->face_verts[f.facet.corners[i]])));
    return sum;
}

/* A collar's texel is on the surface where its place in the owner's chart is,
 * and the owner makes it. */
static void
collars_lie_where_their_owners_say(void **state)
{
    scene s;
    int64_t seen = 0;

    (void)state;
    set_up(&s, "models/cages/torus.obj");
    assert_true(s.set.territory.count > 2);
    for (int32_t k = 0; k < s.set.territory.count; ++k)
    {
        const otx_plot *plot = &s.set.plots[k];

        for (int32_t i = 0; i < plot->width * plot->height; ++i)
        {
            const otx_synth_place *place = &s.set.targets[k].places[i];
            const otx_vec2 at = {i % plot->width + 0.5, i / plot->width + 0.5};
            const int32_t slot = plot->facets[i] / OTX_PLOT_FACETS;
            const int32_t facet = plot->facets[i] % OTX_PLOT_FACETS;

            if (s.set.targets[k].kinds[i] != OTX_SYNTH_COLLAR)
                continue;

            const int32_t face = plot->chart->faces[slot];
            const otx_vec3 here = point_at(&s, k, slot, facet, at);
            const otx_vec3 there = point_at(
                &s, place->chart, s.set.territory.slot[face], facet,
                (otx_vec2){(double)place->x, (double)place->y});

            assert_int_equal(s.set.territory.owner[face], place->chart);
            assert_true(
                otx_vec3_length(otx_vec3_sub(here, there)) < 1e-3 / TEXELS);
            ++seen;
        }
    }
    assert_true(seen > 1000);
    test_run_destroy(s.run);
}

/* The texels to make are as many as the surface has. */
static void
owned_texels_are_the_surface(void **state)
{
    scene s;
    int64_t count = 0;

    (void)state;
    set_up(&s, "models/cages/torus.obj");
    for (int32_t k = 0; k < s.set.territory.count; ++k)
        count += s.set.targets[k].free;
    assert_true(
        fabs((double)count / (TEXELS * TEXELS * s.surface.area) - 1.0) < 0.05);
    test_run_destroy(s.run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collars_lie_where_their_owners_say),
        cmocka_unit_test(owned_texels_are_the_surface),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

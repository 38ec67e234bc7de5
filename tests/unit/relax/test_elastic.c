/* test_elastic.c -- seams close, faces never flip, sheets stay whole. */
#include "grid.h"

#include "flatten/stretch.h"
#include "relax/elastic.h"

enum
{
    SIDE = 12,
    FACES = SIDE * SIDE,
    CORNERS = 4 * FACES,
    DENSITY = 8
};

typedef struct scene
{
    otx_run *run;
    otx_surface *surface;
    otx_exemplar *exemplar;
    int32_t patch[FACES];
    otx_vec2 uvs[CORNERS];
    otx_elastic_options options;
} scene;

/* Smooth colours: waves of 16 and 32 texels, so that a step downhill leads
 * somewhere. */
static void
draw_waves(otx_exemplar *e)
{
    for (int32_t y = 0; y < e->match.height; ++y)
        for (int32_t x = 0; x < e->match.width; ++x)
        {
            float *p = otx_image_at(&e->match, x, y);

            p[0] = (float)(50.0 + 40.0 * sin(2.0 * OTX_PI * x / 32.0));
            p[1] = (float)(50.0 + 40.0 * sin(2.0 * OTX_PI * y / 32.0));
            p[2] = (float)(50.0 + 20.0 * sin(2.0 * OTX_PI * (x + y) / 16.0));
        }
    /* Twice the variance of the three waves. */
    e->match_sigma = sqrt(2.0 * (800.0 + 800.0 + 200.0));
}

/* Two halves, the right one off by `off` texels and turned a little. */
static scene *
make_scene(int32_t threads, bool wrap, otx_vec2 off)
{
    otx_run *run = test_run_create_with(NULL, threads);
    scene *s = OTX_ZNEW(run->arena, scene, 1);
    const otx_level *leaf;

    s->run = run;
    s->surface = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    s->exemplar = test_exemplar_create(run->arena, 128, 128, wrap, 5);
    draw_waves(s->exemplar);
    s->options = (otx_elastic_options){
        .texels = DENSITY,
        .rounds = 12,
        .levels = 3,
        .stiffness = 0.3,
        .stretch = 1.6,
    };
    leaf = otx_surface_leaf(s->surface);
    for (int32_t c = 0; c < CORNERS; ++c)
    {
        const otx_vec3 p =
            otx_vec3_load(s->surface->points, leaf->face_verts[c]);

        s->patch[c / 4] = c / 4 % SIDE >= SIDE / 2;
        s->uvs[c] = (otx_vec2){DENSITY * p.x + 8.0, DENSITY * p.y + 8.0};
        if (s->patch[c / 4])
            s->uvs[c] = otx_vec2_add(s->uvs[c], off);
    }
    return s;
}

static otx_elastic_stats
relax(scene *s)
{
    otx_elastic_stats stats;

    assert_int_equal(
        otx_elastic_run(
            s->run, s->surface, s->exemplar, &s->options, s->patch, s->uvs,
            &stats),
        OSDTEX_OK);
    return stats;
}

static void
check_shape(const scene *s)
{
    const otx_level *leaf = otx_surface_leaf(s->surface);
    otx_vec2 at[2][(SIDE + 1) * (SIDE + 1)];
    bool known[2][(SIDE + 1) * (SIDE + 1)] = {{false}};

    for (int32_t c = 0; c < CORNERS; ++c)
    {
        const int32_t p = s->patch[c / 4], v = leaf->face_verts[c];

        if (known[p][v])
            assert_memory_equal(&at[p][v], &s->uvs[c], sizeof *s->uvs);
        known[p][v] = true;
        at[p][v] = s->uvs[c];
    }
    for (int32_t f = 0; f < FACES; ++f)
        for (int32_t k = 1; k < 3; ++k)
        {
            const int32_t c[3] = {4 * f, 4 * f + k, 4 * f + k + 1};
            otx_vec3 p[3];
            otx_vec2 uv[3];
            double sigma[2];

            for (int i = 0; i < 3; ++i)
            {
                p[i] = otx_vec3_scale(
                    DENSITY,
                    otx_vec3_load(s->surface->points, leaf->face_verts[c[i]]));
                uv[i] = s->uvs[c[i]];
            }
            otx_stretch_singular(p, uv, sigma);
            assert_true(sigma[0] <= 1.6 && sigma[1] >= 1.0 / 1.6);
        }
}

static void
seams_close_and_faces_stay_upright(void **state)
{
    (void)state;
    for (int k = 0; k < 8; ++k)
    {
        scene *s = make_scene(
            2, true, otx_vec2_scale(3.0, otx_vec2_polar(0.25 * OTX_PI * k)));
        const otx_elastic_stats stats = relax(s);

        assert_true(stats.seam_after < 0.1 * stats.seam_before);
        check_shape(s);
        test_run_destroy(s->run);
    }
}

static void
noise_never_raises_the_energy(void **state)
{
    (void)state;
    for (int levels = 1; levels <= 3; ++levels)
    {
        scene *s = make_scene(2, true, (otx_vec2){5.0, 3.0});
        otx_elastic_stats stats;

        *s->exemplar = *test_exemplar_create(s->run->arena, 128, 128, true, 9);
        s->options.levels = levels;
        stats = relax(s);
        /* It starts without strain, so at one level the seams can only
         * improve. */
        if (levels == 1)
            assert_true(stats.seam_after <= stats.seam_before);
        check_shape(s);
        test_run_destroy(s->run);
    }
}

static void
without_seams_nothing_moves(void **state)
{
    scene *s = make_scene(2, true, (otx_vec2){0, 0});
    otx_vec2 before[CORNERS];
    otx_elastic_stats stats;

    (void)state;
    memcpy(before, s->uvs, sizeof before);
    stats = relax(s);
    assert_true(stats.seam_before == 0.0 && stats.seam_after == 0.0);
    for (int32_t c = 0; c < CORNERS; ++c)
        assert_true(otx_vec2_length(otx_vec2_sub(before[c], s->uvs[c])) < 1e-6);
    test_run_destroy(s->run);
}

static void
what_does_not_tile_is_not_left(void **state)
{
    scene *s = make_scene(2, false, (otx_vec2){15.0, 14.0});

    (void)state;
    relax(s);
    for (int32_t c = 0; c < CORNERS; ++c)
    {
        assert_true(s->uvs[c].x >= 0.5 && s->uvs[c].x <= 127.5);
        assert_true(s->uvs[c].y >= 0.5 && s->uvs[c].y <= 127.5);
    }
    test_run_destroy(s->run);
}

static void
threads_do_not_matter(void **state)
{
    scene *a = make_scene(1, true, (otx_vec2){2.0, -1.0});
    scene *b = make_scene(8, true, (otx_vec2){2.0, -1.0});

    (void)state;
    relax(a);
    relax(b);
    assert_memory_equal(a->uvs, b->uvs, sizeof a->uvs);
    test_run_destroy(a->run);
    test_run_destroy(b->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seams_close_and_faces_stay_upright),
        cmocka_unit_test(noise_never_raises_the_energy),
        cmocka_unit_test(without_seams_nothing_moves),
        cmocka_unit_test(what_does_not_tile_is_not_left),
        cmocka_unit_test(threads_do_not_matter),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* materials.h -- exemplars with a lattice or with courses, and mappings made of
 * them. */
#ifndef OTX_TESTS_MATERIALS_H
#define OTX_TESTS_MATERIALS_H

#include "cluster/dual.h"
#include "flatten/stretch.h"
#include "method/method.h"
#include "unit/field/test_field.h"

#include "base/random.h"

#include <stdlib.h>
#include <string.h>

enum
{
    SIDE = 128
};

/* Discs on a square lattice of 32 texels, with a little noise. */
static inline otx_exemplar
make_exemplar(otx_run *run, bool lattice, bool wrap)
{
    otx_exemplar e = {.wrap_x = wrap, .wrap_y = wrap};
    double sum = 0.0, square_sum = 0.0;

    assert_int_equal(
        otx_image_create(run, run->arena, SIDE, SIDE, 3, &e.match), OSDTEX_OK);
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const double u = x % 32 - 15.5, v = y % 32 - 15.5;
            const double c =
                (lattice ? (u * u + v * v < 100 ? 70.0 : 20.0) : 0.0) +
                10.0 * otx_random_unit(5, 0, (uint64_t)(y * SIDE + x));

            for (int k = 0; k < 3; ++k)
                otx_image_at(&e.match, x, y)[k] = (float)c;
            sum += c;
            square_sum += c * c;
        }
    sum /= SIDE * SIDE;
    e.match_sigma = e.lab_sigma =
        sqrt(6.0 * (square_sum / (SIDE * SIDE) - sum * sum));
    e.match_step = e.lab_step = 0.3 * e.match_sigma;
    e.lab = e.linear = e.match;
    return e;
}

/* A figure of the coordinates. */
static inline double
lattice(const otx_figures *figures, const char *key)
{
    char name[64];

    snprintf(name, sizeof name, "lattice.%s", key);
    return otx_figures_value(figures, name);
}

static inline otx_status
map_with(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    double scale, otx_mapping *out, otx_figures *figures)
{
    const otx_method *method = otx_method_find("material");
    void *settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    const otx_map_request request = {.scale = scale, .first_face = -1};

    otx_option_defaults(method->options, method->option_count, settings);
    return otx_method_map(
        method,
        &(otx_job){run, surface, exemplar, 1, &request, settings, figures},
        out);
}

static inline otx_status
map(otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    double scale, otx_mapping *out)
{
    otx_figures figures;

    return map_with(run, surface, exemplar, scale, out, &figures);
}

static inline void
check(const otx_mapping *m, const otx_exemplar *e)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        assert_true(m->face_patch[f] >= 0 && m->face_patch[f] < m->patch_count);
        for (int32_t k = 1; k + 1 < otx_level_face_size(leaf, f); ++k)
        {
            const int32_t at[3] = {
                leaf->face_first[f], leaf->face_first[f] + k,
                leaf->face_first[f] + k + 1};
            otx_vec3 p[3];
            otx_vec2 q[3];
            double s[2];

            for (int j = 0; j < 3; ++j)
            {
                p[j] =
                    otx_vec3_load(m->surface->points, leaf->face_verts[at[j]]);
                q[j] = (otx_vec2){m->uvs[2 * at[j]], m->uvs[2 * at[j] + 1]};
                if (!e->wrap_x)
                    assert_true(
                        q[j].x >= 0.0 && q[j].x <= 1.0 && q[j].y >= 0.0 &&
                        q[j].y <= 1.0);
            }
            otx_stretch_singular(p, q, s);
            assert_true(s[1] > 0.0);
        }
    }
}

/* The same coordinates, to the bit. */
static inline void
assert_same_uvs(const otx_mapping *a, const otx_mapping *b)
{
    assert_memory_equal(
        a->uvs, b->uvs,
        2 * sizeof(float) * (size_t)otx_surface_leaf(a->surface)->corner_count);
}

/* A cube refined three times, for exemplars that are refused on it; what one is
 * refused for names `word`. */
typedef otx_status (*map_trial)(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    otx_mapping *out);

static inline void
assert_unsupported(map_trial trial, const char *word)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, false);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 3);
    otx_mapping m;

    assert_int_equal(trial(run, &s->surface, &e, &m), OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), word));
    test_run_destroy(run);
}

/* -- several lookups ----------------------------------------------------- */

/* With the exemplar's lattice as it is: it looks the same turned by half. */
static inline otx_status
map_lattice(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    const char *fill, double scale, otx_mapping *out, otx_figures *figures)
{
    const otx_method *method = otx_method_find("material");
    void *settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    const otx_analysis analysis = {
        .kind = OTX_ANALYSIS_LATTICE,
        .symmetry = 2,
        .generators = {{32.0, 0.0}, {0.0, 32.0}},
        .centre = {16.0, 16.0},
        .regularity = 1.0,
        .contrast = 1.0};
    const otx_map_request request = {
        .scale = scale, .first_face = -1, .analysis = &analysis};

    otx_option_defaults(method->options, method->option_count, settings);
    assert_int_equal(
        otx_option_set(
            run, method->options, method->option_count, settings, "fill", fill),
        OSDTEX_OK);
    return otx_method_map(
        method,
        &(otx_job){run, surface, exemplar, 1, &request, settings, figures},
        out);
}

/* -- courses ------------------------------------------------------------- */

/* Four courses of 32 texels, bricks of 64, joints of 6. */
static inline otx_exemplar
make_bricks(otx_run *run)
{
    otx_exemplar e = make_exemplar(run, true, true);

    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x)
        {
            const bool bed = y % 32 < 6;
            const bool head = (x + y / 32 % 2 * 32) % 64 < 6;

            for (int k = 0; k < 3; ++k)
                otx_image_at(&e.match, x, y)[k] =
                    (bed || head ? 20.0f : 70.0f) +
                    10.0f *
                        (float)otx_random_unit(5, 0, (uint64_t)(y * SIDE + x));
        }
    return e;
}

static inline otx_status
map_courses(
    otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    double scale, otx_mapping *out, otx_figures *figures)
{
    const otx_method *method = otx_method_find("material");
    void *settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    const otx_map_request request = {.scale = scale, .first_face = -1};

    otx_option_defaults(method->options, method->option_count, settings);
    assert_int_equal(
        otx_option_set(
            run, method->options, method->option_count, settings, "courses",
            "on"),
        OSDTEX_OK);
    return otx_method_map(
        method,
        &(otx_job){run, surface, exemplar, 1, &request, settings, figures},
        out);
}

#endif

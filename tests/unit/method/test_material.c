/* test_material.c -- whole mappings: covered, unfolded, the same for any
 * number of threads, refused where there is no lattice. */
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
static otx_exemplar
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
static double
lattice(const otx_figures *figures, const char *key)
{
    char name[64];

    snprintf(name, sizeof name, "lattice.%s", key);
    return otx_figures_value(figures, name);
}

static otx_status
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

static otx_status
map(otx_run *run, const otx_surface *surface, const otx_exemplar *exemplar,
    double scale, otx_mapping *out)
{
    otx_figures figures;

    return map_with(run, surface, exemplar, scale, out, &figures);
}

static void
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

static void
covers_without_folds(void **state)
{
    (void)state;
    for (int wrap = 0; wrap < 2; ++wrap)
    {
        otx_run *run = test_run_create();
        const otx_exemplar e = make_exemplar(run, true, wrap == 1);
        const otx_cage_input inputs[] = {
            mesh_cube(run), field_torus(run, 12, 8)};

        for (int i = 0; i < 2; ++i)
        {
            const field_surface *s = field_from_input(run, &inputs[i], 4);
            otx_mapping m;

            if (map(run, &s->surface, &e, i == 0 ? 1.5 : 4.0, &m) != OSDTEX_OK)
                fail_msg("%s", test_last_message(run));
            check(&m, &e);
        }
        test_run_destroy(run);
    }
}

static void
the_same_for_any_number_of_threads(void **state)
{
    otx_run *runs[2];
    otx_mapping m[2];

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        runs[i] = test_run_create_with(NULL, i == 0 ? 1 : 3);

        otx_exemplar *e = OTX_NEW(runs[i]->arena, otx_exemplar, 1);
        const otx_cage_input in = mesh_cube(runs[i]);
        const field_surface *s = field_from_input(runs[i], &in, 4);

        *e = make_exemplar(runs[i], true, true);
        assert_int_equal(map(runs[i], &s->surface, e, 1.5, &m[i]), OSDTEX_OK);
    }
    assert_int_equal(m[0].patch_count, m[1].patch_count);
    assert_memory_equal(
        m[0].uvs, m[1].uvs,
        2 * sizeof(float) *
            (size_t)otx_surface_leaf(m[0].surface)->corner_count);
    test_run_destroy(runs[0]);
    test_run_destroy(runs[1]);
}

/* The report's figures, and cells that pictures can be made of. */
static void
what_was_done_is_told(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    int32_t open = 0;
    otx_figures figures;
    otx_mapping m;

    (void)state;
    assert_int_equal(
        map_with(run, &s->surface, &e, 1.5, &m, &figures), OSDTEX_OK);
    assert_true(lattice(&figures, "faces") > 0);
    assert_true(
        lattice(&figures, "clean_area_share") > 0.0 &&
        lattice(&figures, "clean_area_share") <= 1.0);
    assert_true(
        lattice(&figures, "gradient_error") > 0.0 &&
        lattice(&figures, "gradient_error") < 0.5);
    assert_non_null(m.lattice);
    assert_true(m.lattice->defect_count == lattice(&figures, "singular_faces"));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        open += m.lattice->open[f];
    assert_int_equal(open > 0, lattice(&figures, "filled_area_share") > 0.0);
    test_run_destroy(run);
}

/* Area of the kept faces that hang together with `seed`; marks them open. */
static double
take_region(const otx_surface *surface, int32_t seed, uint8_t *open)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    int32_t *stack = calloc((size_t)leaf->face_count, sizeof *stack);
    int32_t depth = 1;
    double area = 0.0;

    assert_non_null(stack);
    stack[0] = seed;
    open[seed] = 1;
    while (depth > 0)
    {
        const int32_t face = stack[--depth];
        otx_vec3 unused;

        area +=
            0.5 * otx_vec3_length(otx_dual_leaf_area(surface, face, &unused));
        for (int32_t k = 0; k < otx_level_face_size(leaf, face); ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, face, k);

            if (other < 0 || open[other])
                continue;
            open[other] = 1;
            stack[depth++] = other;
        }
    }
    free(stack);
    return area;
}

/* What is left of the lattice between patches is wider than two cells. */
static void
no_scraps_of_the_lattice_are_left(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 4);
    const int32_t faces = otx_surface_leaf(&s->surface)->face_count;

    (void)state;
    for (double scale = 1.0; scale < 6.0; scale *= 1.5)
    {
        const double cell = 0.25 * scale;
        otx_figures figures;
        otx_mapping m;

        assert_int_equal(
            map_with(run, &s->surface, &e, scale, &m, &figures), OSDTEX_OK);
        check(&m, &e);

        uint8_t *open = OTX_NEW(run->arena, uint8_t, faces);

        memcpy(open, m.lattice->open, (size_t)faces);
        for (int32_t f = 0; f < faces; ++f)
            if (!open[f])
                assert_true(
                    take_region(&s->surface, f, open) > 1.5 * cell * cell);
    }
    test_run_destroy(run);
}

/* A mesh as it is has a lattice as well as one that is subdivided. */
static void
plain_meshes_have_lattices(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = field_torus(run, 72, 36);
    otx_cage_options options = otx_cage_options_default();
    otx_surface surface;
    otx_cage cage;
    otx_figures figures;
    otx_mapping m;

    (void)state;
    options.scheme = OTX_SCHEME_NONE;
    cage = mesh_build(run, &in, &options);
    surface = mesh_refine(run, &cage, 0);
    assert_int_equal(surface.level_count, 1);
    if (map_with(run, &surface, &e, 4.0, &m, &figures) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    check(&m, &e);
    assert_true(lattice(&figures, "singular_faces") == 0.0);
    assert_true(lattice(&figures, "clean_area_share") == 1.0);
    test_run_destroy(run);
}

/* -- several lookups ----------------------------------------------------- */

/* With the exemplar's lattice as it is: it looks the same turned by half. */
static otx_status
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

/* Something that has the exemplar's lattice and symmetry, from -2 to 2. */
static double
repeating(double u, double v)
{
    return -cos(8.0 * OTX_PI * u) - cos(8.0 * OTX_PI * v);
}

/* What a face shows on the way from its corner k to the next one. */
static double
shown(const otx_mapping *m, int32_t face, int32_t k, double t, bool blended)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);
    const int32_t size = otx_level_face_size(leaf, face);
    const int32_t next = (k + 1) % size;
    const otx_lookups *l = m->lookups;
    double sum = 0.0;

    if (!blended || l->first[face + 1] == l->first[face])
    {
        const float *a = m->uvs + 2 * (leaf->face_first[face] + k);
        const float *b = m->uvs + 2 * (leaf->face_first[face] + next);

        return repeating(
            (1.0 - t) * a[0] + t * b[0], (1.0 - t) * a[1] + t * b[1]);
    }
    for (int64_t i = l->first[face]; i < l->first[face + 1]; i += size)
    {
        const otx_lookup *a = l->items + i + k, *b = l->items + i + next;

        sum += ((1.0 - t) * a->weight + t * b->weight) *
               repeating(
                   (1.0 - t) * a->uv[0] + t * b->uv[0],
                   (1.0 - t) * a->uv[1] + t * b->uv[1]);
    }
    return sum;
}

/* The largest difference between both sides of the edges of faces that have
 * several lookups. */
static double
largest_jump(const otx_mapping *m, bool blended)
{
    const otx_level *leaf = otx_surface_leaf(m->surface);
    double most = 0.0;

    for (int32_t f = 0; f < leaf->face_count; ++f)
        for (int32_t k = 0; k < otx_level_face_size(leaf, f) &&
                            m->lookups->first[f + 1] > m->lookups->first[f];
             ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);
            const int32_t edge = leaf->face_edges[leaf->face_first[f] + k];
            int32_t there = 0;

            while (leaf->face_edges[leaf->face_first[other] + there] != edge)
                ++there;
            for (double t = 0.0; t <= 1.0; t += 0.125)
                most = fmax(
                    most, fabs(
                              shown(m, f, k, t, blended) -
                              shown(m, other, there, 1.0 - t, blended)));
        }
    return most;
}

/* Floats of UVs are off by 1e-7, by 25 times that in what is looked up. */
static void
singular_faces_do_not_tear(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = mesh_cube(run);

    (void)state;
    for (int32_t level = 3; level < 6; ++level)
    {
        const field_surface *s = field_from_input(run, &in, level);
        const otx_level *leaf = otx_surface_leaf(&s->surface);
        otx_figures figures;
        otx_mapping m;

        if (map_lattice(run, &s->surface, &e, "blend", 1.5, &m, &figures) !=
            OSDTEX_OK)
            fail_msg("%s", test_last_message(run));
        check(&m, &e);
        assert_non_null(m.lookups);
        assert_true(
            lattice(&figures, "blended_faces") >=
            lattice(&figures, "singular_faces"));
        assert_true(
            lattice(&figures, "blended_area_share") > 0.0 &&
            lattice(&figures, "blended_area_share") < 0.8);
        assert_true(lattice(&figures, "filled_area_share") == 0.0);
        for (int32_t f = 0; f < leaf->face_count; ++f)
        {
            const int32_t size = otx_level_face_size(leaf, f);
            const otx_lookup *items = m.lookups->items + m.lookups->first[f];
            const int64_t count = m.lookups->first[f + 1] - m.lookups->first[f];

            assert_true(count == 0 || count == 4 * (int64_t)size);
            for (int32_t c = 0; c < size && count > 0; ++c)
            {
                double sum = 0.0;

                for (int64_t i = c; i < count; i += size)
                    sum += items[i].weight;
                assert_true(fabs(sum - 1.0) < 1e-6);
            }
        }
        if (!(largest_jump(&m, true) < 1e-4 && largest_jump(&m, false) > 0.5))
            fail_msg(
                "level %d: %g, torn %g", level, largest_jump(&m, true),
                largest_jump(&m, false));
    }
    test_run_destroy(run);
}

/* Without dislocations there is nothing to mix. */
static void
whole_lattices_are_not_blended(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, true);
    const otx_cage_input in = field_torus(run, 12, 8);
    const field_surface *s = field_from_input(run, &in, 4);
    otx_figures figures;
    otx_mapping m[2];

    (void)state;
    for (int i = 0; i < 2; ++i)
        assert_int_equal(
            map_lattice(
                run, &s->surface, &e, i == 0 ? "on" : "blend", 4.0, &m[i],
                &figures),
            OSDTEX_OK);
    assert_true(lattice(&figures, "singular_rings") == 0.0);
    assert_true(lattice(&figures, "blended_faces") == 0.0);
    assert_null(m[1].lookups);
    assert_memory_equal(
        m[0].uvs, m[1].uvs,
        2 * sizeof(float) *
            (size_t)otx_surface_leaf(&s->surface)->corner_count);
    test_run_destroy(run);
}

static void
what_does_not_tile_is_not_blended(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, false);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 3);
    otx_figures figures;
    otx_mapping m;

    (void)state;
    assert_int_equal(
        map_lattice(run, &s->surface, &e, "blend", 1.5, &m, &figures),
        OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), "tiles"));
    test_run_destroy(run);
}

/* -- courses ------------------------------------------------------------- */

/* Four courses of 32 texels, bricks of 64, joints of 6. */
static otx_exemplar
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

static otx_status
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

/* Radii differ by a factor of two between the outside of a torus and its
 * inside, bricks by a quarter at most: courses run round the hole, each of its
 * own length, and close. */
static void
courses_keep_their_size(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_bricks(run);
    const otx_cage_input in = field_torus(run, 16, 8);
    const field_surface *s = field_from_input(run, &in, 4);
    const otx_level *leaf = otx_surface_leaf(&s->surface);
    const double scale = 2.5;
    otx_figures figures;
    otx_mapping m;

    (void)state;
    if (map_courses(run, &s->surface, &e, scale, &m, &figures) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    check(&m, &e);
    assert_true(lattice(&figures, "singular_faces") == 0.0);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t first = leaf->face_first[f];
        otx_vec3 p[3];
        otx_vec2 q[3];
        double stretch[2];

        for (int j = 0; j < 3; ++j)
        {
            p[j] =
                otx_vec3_load(s->surface.points, leaf->face_verts[first + j]);
            q[j] = (otx_vec2){
                scale * (double)m.uvs[2 * (first + j)],
                scale * (double)m.uvs[2 * (first + j) + 1]};
        }
        otx_stretch_singular(p, q, stretch);
        assert_true(stretch[0] < 1.25 && stretch[1] > 1.0 / 1.25);
    }
    test_run_destroy(run);
}

static void
courses_do_not_depend_on_threads(void **state)
{
    otx_run *runs[2];
    otx_mapping m[2];

    (void)state;
    for (int i = 0; i < 2; ++i)
    {
        otx_figures figures;

        runs[i] = test_run_create_with(NULL, i == 0 ? 1 : 3);

        otx_exemplar *e = OTX_NEW(runs[i]->arena, otx_exemplar, 1);
        const otx_cage_input in = mesh_cube(runs[i]);
        const field_surface *s = field_from_input(runs[i], &in, 4);

        *e = make_bricks(runs[i]);
        assert_int_equal(
            map_courses(runs[i], &s->surface, e, 2.0, &m[i], &figures),
            OSDTEX_OK);
        check(&m[i], e);
    }
    assert_memory_equal(
        m[0].uvs, m[1].uvs,
        2 * sizeof(float) *
            (size_t)otx_surface_leaf(m[0].surface)->corner_count);
    for (int i = 0; i < 2; ++i)
        test_run_destroy(runs[i]);
}

static void
courses_that_are_not_there_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, true, false);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 3);
    otx_figures figures;
    otx_mapping m;

    (void)state;
    assert_int_equal(
        map_courses(run, &s->surface, &e, 1.5, &m, &figures),
        OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), "courses"));
    test_run_destroy(run);
}

static void
what_has_no_lattice_is_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar e = make_exemplar(run, false, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 2);
    otx_mapping m;

    (void)state;
    assert_int_equal(map(run, &s->surface, &e, 1.5, &m), OSDTEX_ERROR_SUPPORT);
    assert_non_null(strstr(test_last_message(run), "lattice"));
    test_run_destroy(run);
}

static void
the_method_follows_the_exemplar(void **state)
{
    otx_run *run = test_run_create();
    const otx_exemplar lattice_of_cells = make_exemplar(run, true, true);
    const otx_exemplar noise = make_exemplar(run, false, true);
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 2);
    otx_map_request request = {.scale = 1.0, .first_face = -1};
    otx_job job = {
        run, &s->surface, &lattice_of_cells, 1, &request, NULL, NULL};
    const otx_method *method;

    (void)state;
    assert_int_equal(otx_method_choose(&job, &method), OSDTEX_OK);
    assert_string_equal(method->name, "material");
    assert_non_null(strstr(test_last_message(run), "limbs"));
    job.exemplars = &noise;
    assert_int_equal(otx_method_choose(&job, &method), OSDTEX_OK);
    assert_string_equal(method->name, "hierarchical");
    request.scale = 50.0;
    job.exemplars = &lattice_of_cells;
    assert_int_equal(otx_method_choose(&job, &method), OSDTEX_OK);
    assert_string_equal(method->name, "hierarchical");
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_without_folds),
        cmocka_unit_test(the_same_for_any_number_of_threads),
        cmocka_unit_test(what_was_done_is_told),
        cmocka_unit_test(no_scraps_of_the_lattice_are_left),
        cmocka_unit_test(plain_meshes_have_lattices),
        cmocka_unit_test(singular_faces_do_not_tear),
        cmocka_unit_test(whole_lattices_are_not_blended),
        cmocka_unit_test(what_does_not_tile_is_not_blended),
        cmocka_unit_test(courses_keep_their_size),
        cmocka_unit_test(courses_do_not_depend_on_threads),
        cmocka_unit_test(courses_that_are_not_there_are_refused),
        cmocka_unit_test(what_has_no_lattice_is_refused),
        cmocka_unit_test(the_method_follows_the_exemplar),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

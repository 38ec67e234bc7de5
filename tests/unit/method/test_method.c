/* test_method.c -- the driver, and what holds of every method of its table.
 *
 * A method that is added to the table is tested by this file without a change
 * to it, if it is applicable to a lattice that tiles or to a tiled texture. */
#include "grid.h"
#include "unit/bake/flat.h"
#include "unit/cluster/sheets.h"

#include "method/method.h"
#include "tiling/tileset.h"

/* Lays everything flat along z as one patch; a trial method to break. */
static otx_status
lay_flat(
    otx_run *run, const otx_surface *surface, const otx_map_request *request,
    otx_mapping *out)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    *out = (otx_mapping){
        .surface = surface,
        .scale = request->scale,
        .uvs = OTX_NEW(run->arena, float, 2 * (size_t)leaf->corner_count),
        .face_patch = OTX_ZNEW(run->arena, int32_t, leaf->face_count),
        .patch_count = 1,
    };
    if (!out->uvs || !out->face_patch)
        return otx_fail_memory(run, "map");
    for (int32_t c = 0; c < leaf->corner_count; ++c)
    {
        const otx_vec3 p = otx_vec3_load(surface->points, leaf->face_verts[c]);

        out->uvs[2 * c] = (float)(p.x / request->scale);
        out->uvs[2 * c + 1] = (float)(p.y / request->scale);
    }
    return OSDTEX_OK;
}

static otx_status
sound(const otx_job *job, otx_mapping *out)
{
    return lay_flat(job->run, job->surface, job->request, out);
}

static otx_status
with_a_patch_that_is_none(const otx_job *job, otx_mapping *out)
{
    OTX_TRY(sound(job, out));
    out->face_patch[7] = 1000000;
    out->patch_count = 2;
    return OSDTEX_OK;
}

static otx_status
with_a_third_covered(const otx_job *job, otx_mapping *out)
{
    OTX_TRY(sound(job, out));
    for (int32_t f = 0; f < otx_surface_leaf(job->surface)->face_count; ++f)
        out->face_patch[f] = f % 3 == 0 ? 0 : -1;
    return OSDTEX_OK;
}

static otx_status
with_a_uv_that_is_no_number(const otx_job *job, otx_mapping *out)
{
    OTX_TRY(sound(job, out));
    out->uvs[15] = NAN;
    return OSDTEX_OK;
}

static otx_status
with_nothing(const otx_job *job, otx_mapping *out)
{
    (void)job, (void)out;
    return OSDTEX_OK;
}

static otx_status
run_method(otx_status (*map)(const otx_job *, otx_mapping *))
{
    const otx_method method = {.name = "trial", .map = map};
    const otx_map_request request = {.scale = 2.0, .first_face = -1};
    otx_run *run = test_run_create();
    const otx_surface surface =
        sheet_from_file(run, "models/cages/plane.obj", 2);
    const otx_job job = {
        .run = run,
        .surface = &surface,
        .exemplars = test_exemplar_create(run->arena, 16, 16, true, 1),
        .exemplar_count = 1,
        .request = &request,
    };
    otx_mapping mapping;
    const otx_status status = otx_method_map(&method, &job, &mapping);

    if (status != OSDTEX_OK)
        assert_non_null(strstr(test_last_message(run), "'trial'"));
    test_run_destroy(run);
    return status;
}

static void
rubbish_is_an_internal_error(void **state)
{
    (void)state;
    assert_int_equal(run_method(sound), OSDTEX_OK);
    assert_int_equal(
        run_method(with_a_patch_that_is_none), OSDTEX_ERROR_INTERNAL);
    assert_int_equal(run_method(with_a_third_covered), OSDTEX_ERROR_INTERNAL);
    assert_int_equal(
        run_method(with_a_uv_that_is_no_number), OSDTEX_ERROR_INTERNAL);
    assert_int_equal(run_method(with_nothing), OSDTEX_ERROR_INTERNAL);
}

/* ------------------------------------------------------------- the table */

enum
{
    SIDE = 96
};

static const float COLOUR[3] = {0.25f, 0.5f, 0.75f};

/* Discs on a lattice of 24 texels and a little noise, which tile. */
static otx_exemplar *
make_lattice(otx_run *run)
{
    otx_exemplar *e = test_exemplar_create(run->arena, SIDE, SIDE, true, 4);
    float *p = e->match.pixels;

    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; ++x, p += 3)
        {
            const double u = x % 24 - 11.5, v = y % 24 - 11.5;
            const double c = u * u + v * v < 60.0 ? 70.0 : 20.0;

            for (int k = 0; k < 3; ++k)
                p[k] = (float)(c + 0.1 * (double)p[k]);
        }
    e->match_sigma = e->lab_sigma = 60.0;
    e->match_step = e->lab_step = 20.0;
    return e;
}

static otx_exemplar *
make_tiles(otx_run *run)
{
    const otx_tileset_options options = {
        .boundaries = 1, .corners = 1, .cell = 32, .gutter = 4};
    otx_exemplar *e = make_lattice(run);
    otx_tileset made;

    if (otx_tileset_make(run, e, &options, &made) != OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    e->linear = e->match = e->lab = made.linear;
    e->tiles = made.layout;
    e->wrap_x = e->wrap_y = false;
    return e;
}

/* One run of a method on a cage, with the first exemplar that suits it. Its
 * colours are one and the same; what it is matched by is not. */
typedef struct trial
{
    otx_run *run;
    otx_surface surface;
    otx_exemplar *exemplar;
    otx_map_request request;
    otx_figures figures;
    otx_mapping mapping;
    otx_job job;
} trial;

static void
paint(otx_run *run, otx_exemplar *e)
{
    otx_image image = e->linear;

    image.pixels = OTX_NEW(
        run->arena, float, (int64_t)image.width *image.height *image.channels);
    for (int32_t i = 0; i < image.width * image.height; ++i)
        for (int32_t c = 0; c < image.channels; ++c)
            image.pixels[i * image.channels + c] = c < 3 ? COLOUR[c] : 1.0f;
    e->linear = image;
}

static bool
suits(const otx_method *method, const otx_job *job)
{
    otx_suitability found = {0};

    assert_int_equal(method->applicable(job, &found), OSDTEX_OK);
    return found.score > 0.0;
}

static trial *
prepare(
    const otx_allocator_hooks *hooks, int32_t threads, const otx_method *method,
    const char *cage)
{
    otx_run *run = test_run_create_with(hooks, threads);
    trial *t = OTX_ZNEW(run->arena, trial, 1);
    void *settings = otx_arena_zalloc(run->arena, 1, method->settings_bytes);
    char path[128];

    snprintf(path, sizeof path, "models/cages/%s.obj", cage);
    t->run = run;
    t->surface = sheet_from_file(run, path, 2);
    t->exemplar = make_lattice(run);
    t->request = (otx_map_request){
        .scale = sqrt(t->surface.area / 6.0), .first_face = -1};
    t->job = (otx_job){
        .run = run,
        .surface = &t->surface,
        .exemplars = t->exemplar,
        .exemplar_count = 1,
        .request = &t->request,
        .settings = settings,
        .figures = &t->figures,
    };
    if (!suits(method, &t->job))
    {
        t->job.exemplars = t->exemplar = make_tiles(run);
        if (!suits(method, &t->job))
            fail_msg(
                "%s is applicable neither to a lattice nor to tiles",
                method->name);
    }
    otx_option_defaults(method->options, method->option_count, settings);
    if (method->resolve)
        method->resolve(settings, t->exemplar, t->surface.cage);
    paint(run, t->exemplar);
    return t;
}

static otx_status
map(trial *t, const otx_method *method)
{
    return otx_method_map(method, &t->job, &t->mapping);
}

static void
map_or_fail(trial *t, const otx_method *method)
{
    if (map(t, method) != OSDTEX_OK)
        fail_msg("%s: %s", method->name, test_last_message(t->run));
}

static void
every_row_says_what_it_is(void **state)
{
    (void)state;
    for (int32_t i = 0; i < otx_method_count(); ++i)
    {
        const otx_method *m = otx_method_at(i);

        assert_true(strspn(m->name, "abcdefghijklmnopqrstuvwxyz-") > 2);
        assert_true(m->summary[strlen(m->summary) - 1] == '.');
        assert_true(strlen(m->source) > 10);
        assert_non_null(m->map);
        assert_non_null(m->applicable);
        assert_ptr_equal(otx_method_find(m->name), m);
        for (int32_t k = 0; k < m->option_count; ++k)
            assert_true(
                m->options[k].offset + sizeof(int32_t) <= m->settings_bytes);
    }
}

/* The driver's check sees that holes have none, and all else has a patch. */
static void
every_method_covers_all_faces(void **state)
{
    static const char *const cages[] = {"torus", "hole", "open_boundary"};

    (void)state;
    for (int32_t i = 0; i < 3 * otx_method_count(); ++i)
    {
        const otx_method *method = otx_method_at(i / 3);
        trial *t = prepare(NULL, 2, method, cages[i % 3]);

        map_or_fail(t, method);
        assert_true(t->mapping.patch_count > 0);
        test_run_destroy(t->run);
    }
}

static void
every_method_gives_the_same_bytes_from_any_number_of_threads(void **state)
{
    static const int32_t threads[] = {1, 2, 8};

    (void)state;
    for (int32_t i = 0; i < otx_method_count(); ++i)
    {
        const otx_method *method = otx_method_at(i);
        trial *t[3];

        for (int k = 0; k < 3; ++k)
        {
            const otx_level *leaf;

            t[k] = prepare(NULL, threads[k], method, "torus");
            map_or_fail(t[k], method);
            leaf = otx_surface_leaf(&t[k]->surface);
            assert_memory_equal(
                t[0]->mapping.uvs, t[k]->mapping.uvs,
                2 * sizeof(float) * (size_t)leaf->corner_count);
            assert_memory_equal(
                t[0]->mapping.face_patch, t[k]->mapping.face_patch,
                sizeof(int32_t) * (size_t)leaf->face_count);
            assert_int_equal(t[0]->figures.count, t[k]->figures.count);
        }
        for (int k = 0; k < 3; ++k)
            test_run_destroy(t[k]->run);
    }
}

static void
one_colour_bakes_as_that_colour(void **state)
{
    static const otx_bake_options options = {.kind = OTX_TEXEL_COLOR};

    (void)state;
    for (int32_t i = 0; i < otx_method_count(); ++i)
    {
        const otx_method *method = otx_method_at(i);
        trial *t = prepare(NULL, 2, method, "torus");

        map_or_fail(t, method);

        const otx_layout layout =
            flat_layout(t->run, &t->mapping, OTX_LAYOUT_ATLAS, 128, 4);
        const flat_levels baked =
            flat_bake(t->run, &t->mapping, t->exemplar, &layout, &options, 0);
        int32_t seen = 0;

        for (int32_t p = 0; p < 128 * 128; ++p)
        {
            const float *texel = baked.levels[0].pixels +
                                 (size_t)p * (size_t)baked.levels[0].channels;

            if (texel[0] == 0.0f && texel[1] == 0.0f)
                continue; /* beyond all blocks */
            ++seen;
            for (int c = 0; c < 3; ++c)
                assert_float_equal(texel[c], COLOUR[c], 1e-3);
        }
        assert_true(seen > 1000);
        test_run_destroy(t->run);
    }
}

typedef struct countdown
{
    int64_t left;
} countdown;

static bool
stop_at_zero(void *user, const char *stage, double fraction)
{
    (void)stage, (void)fraction;
    return ((countdown *)user)->left-- > 0;
}

/* test_run_destroy finds what leaks. */
static void
stopping_at_any_call_leaves_nothing(void **state)
{
    (void)state;
    for (int32_t i = 0; i < otx_method_count(); ++i)
    {
        otx_status status = OSDTEX_ERROR_CANCELLED;

        for (int64_t stop = 0; status != OSDTEX_OK && stop < 100000;
             stop += 1 + stop / 3)
        {
            countdown c = {stop};
            trial *t = prepare(NULL, 2, otx_method_at(i), "plane");

            t->run->progress = stop_at_zero;
            t->run->progress_user = &c;
            status = map(t, otx_method_at(i));
            assert_true(
                status == OSDTEX_OK || status == OSDTEX_ERROR_CANCELLED);
            test_run_destroy(t->run);
        }
        assert_int_equal(status, OSDTEX_OK);
    }
}

static void
failing_any_allocation_leaves_nothing(void **state)
{
    (void)state;
    for (int32_t i = 0; i < otx_method_count(); ++i)
    {
        otx_status status = OSDTEX_ERROR_MEMORY;

        for (int64_t stop = 0; status != OSDTEX_OK && stop < 1000000;
             stop += 1 + stop / 3)
        {
            test_ration ration = {INT64_MAX};
            const otx_allocator_hooks hooks = test_ration_hooks(&ration);
            trial *t = prepare(&hooks, 1, otx_method_at(i), "plane");

            ration.left = stop;
            status = map(t, otx_method_at(i));
            ration.left = INT64_MAX;
            assert_true(status == OSDTEX_OK || status == OSDTEX_ERROR_MEMORY);
            test_run_destroy(t->run);
        }
        assert_int_equal(status, OSDTEX_OK);
    }
}

/* A tiled texture is for tiles, whatever else could be done with it. */
static void
auto_knows_tiles(void **state)
{
    const otx_method *chosen;
    trial *t = prepare(NULL, 1, otx_method_for_tiles(), "torus");

    (void)state;
    assert_int_equal(otx_method_choose(&t->job, &chosen), OSDTEX_OK);
    assert_ptr_equal(chosen, otx_method_for_tiles());
    test_run_destroy(t->run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rubbish_is_an_internal_error),
        cmocka_unit_test(every_row_says_what_it_is),
        cmocka_unit_test(every_method_covers_all_faces),
        cmocka_unit_test(
            every_method_gives_the_same_bytes_from_any_number_of_threads),
        cmocka_unit_test(one_colour_bakes_as_that_colour),
        cmocka_unit_test(stopping_at_any_call_leaves_nothing),
        cmocka_unit_test(failing_any_allocation_leaves_nothing),
        cmocka_unit_test(auto_knows_tiles),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

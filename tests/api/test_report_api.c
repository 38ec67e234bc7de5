/* test_report_api.c -- a report in memory: the text is that of the file, its
 * numbers are the figures, and every figure says what it is. */
#include "meter.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char GRAVEL[] = "models/exemplars/gravel_tile.png";

/* The plane mapped in one of the ways that a report has a part of its own for.
 *
 *   two  shows a second exemplar on half of the faces */
static osdtex_status
map_plane(
    osdtex_context *context, const char *picture, const char *method, bool two,
    osdtex_mapping **out)
{
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_exemplar *exemplar = NULL;
    osdtex_cage *cage = NULL;
    osdtex_also also = {0};
    uint8_t faces[256];
    osdtex_status status =
        osdtex_cage_read(context, "models/cages/plane.obj", NULL, &cage);

    map.method = method;
    map.level = 0;
    map.scale = 2.0;
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(context, picture, NULL, &exemplar);
    if (status == OSDTEX_OK && two)
    {
        for (size_t i = 0; i < sizeof faces; ++i)
            faces[i] = i % 2;
        also.exemplar = exemplar;
        map.also = &also;
        map.also_count = 1;
        map.face_exemplars = faces;
    }
    *out = NULL;
    if (status == OSDTEX_OK)
        status = osdtex_map(context, cage, exemplar, &map, out);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    return status;
}

static osdtex_context *
open_context(int32_t threads)
{
    osdtex_context_options how = osdtex_context_options_default();
    osdtex_context *context;

    how.threads = threads;
    assert_int_equal(osdtex_context_create(&how, &context), OSDTEX_OK);
    return context;
}

static osdtex_report *
report_on(osdtex_context *context, const osdtex_mapping *mapping)
{
    osdtex_report_options options = osdtex_report_options_default();
    osdtex_report *report;

    options.windows = 4;
    if (osdtex_report_create(context, mapping, &options, &report) != OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(context)->message);
    return report;
}

/* The member of an object that a key with dots leads to. */
static json_t *
find(json_t *root, const char *key)
{
    char part[96];

    for (; root && *key; key += *key == '.')
    {
        const size_t length = strcspn(key, ".");

        snprintf(part, sizeof part, "%.*s", (int)length, key);
        root = json_object_get(root, part);
        key += length;
    }
    return root;
}

static const osdtex_figure *
figure_of(const osdtex_report_info *info, const char *key)
{
    for (int32_t i = 0; i < info->figure_count; ++i)
        if (strcmp(info->figures[i].key, key) == 0)
            return &info->figures[i];
    return NULL;
}

/* ------------------------------------------------------------------------ */

static void
figures_are_the_numbers_of_the_text(void **state)
{
    osdtex_context *context = open_context(2);
    osdtex_mapping *mapping;
    osdtex_report *report;
    const osdtex_report_info *info;
    int32_t compared = 0;
    json_t *root;

    (void)state;
    assert_int_equal(
        map_plane(context, GRAVEL, NULL, false, &mapping), OSDTEX_OK);
    report = report_on(context, mapping);
    osdtex_mapping_destroy(mapping); /* what follows needs none */
    info = osdtex_report_describe(report);
    assert_int_equal(info->json_bytes, strlen(info->json));
    root = json_loads(info->json, 0, NULL);
    assert_non_null(root);
    for (int32_t i = 0; i < info->figure_count; ++i)
    {
        const osdtex_figure *figure = &info->figures[i];
        const json_t *value = find(root, figure->key);

        if (!json_is_number(value)) /* of a list */
            continue;
        ++compared;
        assert_true(
            fabs(figure->value - json_number_value(value)) <=
            1e-8 * fabs(figure->value));
        assert_int_equal(
            figure->kind == OSDTEX_FIGURE_COUNT, json_is_integer(value));
    }
    assert_true(compared > 40);
    assert_true(figure_of(info, "seams.windows.count")->value > 0.0);
    assert_string_equal(figure_of(info, "mapping.fits")->unit, "searches");
    assert_non_null(json_object_get(root, "inputs"));
    assert_null(figure_of(info, "inputs.exemplar.width"));
    json_decref(root);
    osdtex_report_destroy(report);
    osdtex_context_destroy(context);
}

/* What the host was run with is told; it is the context's own copy. */
static void
words_of_the_host_are_told(void **state)
{
    char word[] = "paint";
    const char *words[] = {word, "shirt.obj"};
    osdtex_context_options how = osdtex_context_options_default();
    osdtex_context *context;
    osdtex_mapping *mapping;
    osdtex_report *report;
    json_t *root, *told;

    (void)state;
    how.threads = 1;
    how.arguments = words;
    how.argument_count = -1;
    assert_int_equal(
        osdtex_context_create(&how, &context), OSDTEX_ERROR_ARGUMENT);
    how.argument_count = 2;
    assert_int_equal(osdtex_context_create(&how, &context), OSDTEX_OK);
    word[0] = 'f';
    words[1] = NULL;
    assert_int_equal(
        map_plane(context, GRAVEL, NULL, false, &mapping), OSDTEX_OK);
    report = report_on(context, mapping);
    root = json_loads(osdtex_report_describe(report)->json, 0, NULL);
    told = find(root, "process.arguments");
    assert_int_equal(json_array_size(told), 2);
    assert_string_equal(json_string_value(json_array_get(told, 0)), "paint");
    assert_int_equal(json_array_size(json_object_get(root, "outputs")), 0);
    json_decref(root);
    osdtex_report_destroy(report);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
}

/* Whoever adds a figure says what it is, in api/report_words.c. */
static void
assert_words(osdtex_context *context, const osdtex_mapping *mapping)
{
    osdtex_report *report = report_on(context, mapping);
    const osdtex_report_info *info = osdtex_report_describe(report);

    assert_true(info->figure_count > 40);
    for (int32_t i = 0; i < info->figure_count; ++i)
    {
        const char *sentence = info->figures[i].sentence;
        const size_t length = strlen(sentence);

        if (length < 10 || sentence[length - 1] != '.')
            fail_msg(
                "%s has no sentence; add it to osdtex/api/report_words.c",
                info->figures[i].key);
    }
    osdtex_report_destroy(report);
}

/* A tiled texture for the methods that want one. */
static void
make_tiles(osdtex_context *context, const char *path)
{
    osdtex_tiles_options options = osdtex_tiles_options_default();
    osdtex_exemplar *exemplar;

    options.tile_size = 32;
    assert_int_equal(
        osdtex_exemplar_read(context, GRAVEL, NULL, &exemplar), OSDTEX_OK);
    assert_int_equal(
        osdtex_tiles_write(context, exemplar, NULL, &options, path, NULL),
        OSDTEX_OK);
    osdtex_exemplar_destroy(exemplar);
}

static void
every_figure_of_every_method_has_words(void **state)
{
    char folder[] = "/tmp/osdtex_reportXXXXXX", tiles[64], command[64];
    osdtex_context *context = open_context(2);
    osdtex_mapping *mapping;

    (void)state;
    assert_non_null(mkdtemp(folder));
    snprintf(tiles, sizeof tiles, "%s/tiles.exr", folder);
    make_tiles(context, tiles);
    for (int32_t m = 0; m < osdtex_method_count(); ++m)
    {
        osdtex_method_info method;

        osdtex_method_get(m, &method);
        if (map_plane(context, GRAVEL, method.name, false, &mapping) ==
                OSDTEX_OK ||
            map_plane(context, tiles, method.name, false, &mapping) ==
                OSDTEX_OK)
            assert_words(context, mapping);
        osdtex_mapping_destroy(mapping);
    }
    assert_int_equal(
        map_plane(context, GRAVEL, NULL, true, &mapping), OSDTEX_OK);
    assert_words(context, mapping);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

/* What differs from run to run. */
static void
drop_costs(json_t *root)
{
    json_object_del(root, "seconds");
    json_object_del(root, "memory");
    json_object_del(root, "process");
    json_object_del(json_object_get(root, "options"), "threads");
}

static json_t *
plane_report(int32_t threads)
{
    osdtex_context *context = open_context(threads);
    osdtex_mapping *mapping;
    osdtex_report *report;
    json_t *root;

    assert_int_equal(
        map_plane(context, GRAVEL, NULL, false, &mapping), OSDTEX_OK);
    report = report_on(context, mapping);
    root = json_loads(osdtex_report_describe(report)->json, 0, NULL);
    drop_costs(root);
    osdtex_report_destroy(report);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
    return root;
}

static void
threads_make_no_difference(void **state)
{
    json_t *one = plane_report(1), *three = plane_report(3);

    (void)state;
    assert_true(json_equal(one, three));
    json_decref(one);
    json_decref(three);
}

static void
the_file_holds_the_same_text(void **state)
{
    char path[] = "/tmp/osdtex_reportXXXXXX";
    osdtex_context *context = open_context(2);
    const int file = mkstemp(path);
    osdtex_mapping *mapping;
    osdtex_report *report;
    json_t *ours, *theirs;

    (void)state;
    assert_true(file >= 0);
    close(file);
    assert_int_equal(
        map_plane(context, GRAVEL, NULL, false, &mapping), OSDTEX_OK);
    assert_int_equal(
        osdtex_report_create(context, mapping, NULL, &report), OSDTEX_OK);
    assert_int_equal(osdtex_report_write(context, mapping, path), OSDTEX_OK);
    ours = json_loads(osdtex_report_describe(report)->json, 0, NULL);
    theirs = json_load_file(path, 0, NULL);
    drop_costs(ours);
    drop_costs(theirs);
    assert_true(json_equal(ours, theirs));
    json_decref(ours);
    json_decref(theirs);
    osdtex_report_destroy(report);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
    unlink(path);
}

static void
what_cannot_be_reported_is_refused(void **state)
{
    osdtex_report_options options = osdtex_report_options_default();
    osdtex_context *context = open_context(1);
    osdtex_report *report = (osdtex_report *)1;
    const osdtex_status wrong = OSDTEX_ERROR_ARGUMENT;
    osdtex_mapping *mapping;

    (void)state;
    assert_int_equal(osdtex_report_create(NULL, NULL, NULL, &report), wrong);
    assert_null(report);
    assert_int_equal(osdtex_report_create(context, NULL, NULL, &report), wrong);
    assert_int_equal(osdtex_report_create(context, NULL, NULL, NULL), wrong);
    assert_int_equal(
        map_plane(context, GRAVEL, NULL, false, &mapping), OSDTEX_OK);
    options.windows = -1;
    assert_int_equal(
        osdtex_report_create(context, mapping, &options, &report), wrong);
    assert_null(osdtex_report_describe(NULL));
    osdtex_report_destroy(NULL);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
}

/* Mapped without the limit, so that only the report may fail. */
static osdtex_mapping *kept;

static osdtex_status
report_kept(osdtex_context *context)
{
    osdtex_report_options options = osdtex_report_options_default();
    osdtex_report *report = NULL;
    osdtex_status status;

    options.windows = 1;
    status = osdtex_report_create(context, kept, &options, &report);
    assert_true((status == OSDTEX_OK) == (report != NULL));
    osdtex_report_destroy(report);
    return status;
}

static void
failures_leak_nothing(void **state)
{
    const moments at = {2, 2};
    osdtex_context *context = open_context(1);

    (void)state;
    assert_int_equal(map_plane(context, GRAVEL, NULL, false, &kept), OSDTEX_OK);
    fail_at_moments(&at, report_kept);
    cancel_at_moments(&at, report_kept);
    osdtex_mapping_destroy(kept);
    osdtex_context_destroy(context);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_are_the_numbers_of_the_text),
        cmocka_unit_test(words_of_the_host_are_told),
        cmocka_unit_test(every_figure_of_every_method_has_words),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(the_file_holds_the_same_text),
        cmocka_unit_test(what_cannot_be_reported_is_refused),
        cmocka_unit_test(failures_leak_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

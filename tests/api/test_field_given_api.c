/* test_field_given_api.c -- fields of the host's own: directions and scales of
 * faces, vertices and corners, and mappings that follow them. */
#include "field_scene.h"

static osdtex_field *
field_from(scene *s, const osdtex_field_options *options)
{
    osdtex_field *field;

    if (osdtex_field_create(s->context, s->surface, options, &field) !=
        OSDTEX_OK)
        fail_msg("%s", last_message(s));
    return field;
}

/* How far two lines of a face are from each other: 1 - |cos|. */
static double
apart(const float *a, const float *b)
{
    return 1.0 -
           fabs(
               (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2]);
}

static void
a_field_from_its_own_directions_is_the_same(void **state)
{
    osdtex_field_options options = osdtex_field_options_default();
    const osdtex_field_info *from, *to;
    osdtex_field *field, *again;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/creature.obj", 1, NULL), OSDTEX_OK);
    field = make_field(&s, "curvature", 2);
    from = osdtex_field_describe(field);
    options.symmetry = 2;
    options.directions = from->directions;
    options.direction_count = from->face_count;
    again = field_from(&s, &options);
    to = osdtex_field_describe(again);
    for (int32_t f = 0; f < from->face_count; ++f)
        assert_true(
            apart(from->directions + 3 * f, to->directions + 3 * f) < 1e-5);
    assert_int_equal(from->singularity_count, to->singularity_count);
    osdtex_field_destroy(field);
    osdtex_field_destroy(again);
    close_scene(&s);
}

/* One axis for all elements of a kind, in the plane of a flat cage. */
static void
every_kind_of_element_gives_directions(void **state)
{
    osdtex_field_options options = osdtex_field_options_default();
    const osdtex_surface_info *surface;
    float *axes;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 2, NULL), OSDTEX_OK);
    surface = osdtex_surface_describe(s.surface);
    axes = calloc(3 * (size_t)surface->corner_count, sizeof *axes);
    options.symmetry = 1;
    options.directions = axes;
    for (int32_t i = 0; i < surface->corner_count; ++i)
    {
        axes[3 * i] = 3.0f; /* of any length */
        axes[3 * i + 2] = axes[3 * i + 1] = -4.0f;
    }
    for (osdtex_element of = OSDTEX_ELEMENT_FACE; of <= OSDTEX_ELEMENT_VERTEX;
         ++of)
    {
        const osdtex_field_info *info;
        osdtex_field *field;

        options.directions_of = of;
        options.direction_count =
            of == OSDTEX_ELEMENT_FACE ? surface->face_count
            : of == OSDTEX_ELEMENT_VERTEX
                ? surface->vert_count
                : osdtex_cage_describe(s.cage)->face_count;
        field = field_from(&s, &options);
        info = osdtex_field_describe(field);
        assert_directions_everywhere(info);
        for (int32_t f = 1; f < info->face_count; ++f)
            assert_true(
                apart(info->directions, info->directions + 3 * f) < 1e-5);
        assert_true(fabs(info->directions[0]) > 0.55);
        osdtex_field_destroy(field);
    }
    free(axes);
    close_scene(&s);
}

/* What no direction is given of continues its neighbours. */
static void
zero_leaves_a_field_free(void **state)
{
    osdtex_field_options options = osdtex_field_options_default();
    const osdtex_field_info *info;
    osdtex_field *field;
    float *axes;
    int32_t count;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 0, NULL), OSDTEX_OK);
    count = osdtex_surface_describe(s.surface)->face_count;
    axes = calloc(3 * (size_t)count, sizeof *axes);
    axes[0] = 1.0f;
    options.directions = axes;
    options.direction_count = count;
    field = field_from(&s, &options);
    info = osdtex_field_describe(field);
    for (int32_t f = 0; f < count; ++f)
        assert_true(apart(info->directions, info->directions + 3 * f) < 1e-3);
    osdtex_field_destroy(field);
    free(axes);
    close_scene(&s);
}

static osdtex_mapping *
map_with(scene *s, const char *picture, const osdtex_map_options *options)
{
    osdtex_exemplar *exemplar;
    osdtex_mapping *mapping;

    assert_int_equal(
        osdtex_exemplar_read(s->context, picture, NULL, &exemplar), OSDTEX_OK);
    if (osdtex_map(s->context, NULL, exemplar, options, &mapping) != OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(s->context)->message);
    osdtex_exemplar_destroy(exemplar);
    return mapping;
}

static double
figure_of(scene *s, const osdtex_mapping *mapping, const char *key)
{
    osdtex_report_options options = osdtex_report_options_default();
    const osdtex_report_info *info;
    osdtex_report *report;
    double value = NAN;

    options.windows = 0;
    assert_int_equal(
        osdtex_report_create(s->context, mapping, &options, &report),
        OSDTEX_OK);
    info = osdtex_report_describe(report);
    for (int32_t i = 0; i < info->figure_count; ++i)
        if (strcmp(info->figures[i].key, key) == 0)
            value = info->figures[i].value;
    osdtex_report_destroy(report);
    return value;
}

/* Of all faces, in squares of the exemplar. */
static double
uv_area(const osdtex_mapping *mapping)
{
    const osdtex_mapping_info *info = osdtex_mapping_describe(mapping);
    const osdtex_surface_info *surface =
        osdtex_surface_describe(osdtex_mapping_surface(mapping));
    double sum = 0.0;

    for (int32_t f = 0; f < surface->face_count; ++f)
    {
        const int32_t first = surface->face_first[f];
        const int32_t size = surface->face_first[f + 1] - first;

        for (int32_t k = 0; k < size; ++k)
        {
            const float *a = info->uvs + 2 * (size_t)(first + k);
            const float *b = info->uvs + 2 * (size_t)(first + (k + 1) % size);

            sum += 0.5 * ((double)a[0] * b[1] - (double)a[1] * b[0]);
        }
    }
    return sum;
}

/* On a flat cage a texture can lie as it is told, and be as large. */
static void
a_mapping_follows_its_field(void **state)
{
    osdtex_field_options options = osdtex_field_options_default();
    osdtex_map_options map = osdtex_map_options_default();
    const osdtex_surface_info *surface;
    float *axes, *scales;
    osdtex_mapping *mapping;
    osdtex_field *field;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 2, NULL), OSDTEX_OK);
    surface = osdtex_surface_describe(s.surface);
    axes = calloc(3 * (size_t)surface->face_count, sizeof *axes);
    scales = calloc((size_t)surface->vert_count, sizeof *scales);
    for (int32_t f = 0; f < surface->face_count; ++f)
        axes[3 * f] = axes[3 * f + 1] = axes[3 * f + 2] = 1.0f;
    for (int32_t v = 0; v < surface->vert_count; ++v)
        scales[v] = 2.0f;
    options.directions = axes;
    options.direction_count = surface->face_count;
    options.scales = scales;
    options.scale_count = surface->vert_count;
    field = field_from(&s, &options);
    map.field = field;
    map.scale = 1.0;
    map.exemplar_class = "directional";
    mapping = map_with(&s, "models/exemplars/grass_tile.png", &map);
    osdtex_field_destroy(field); /* what was made of it keeps it */
    assert_ptr_equal(osdtex_mapping_surface(mapping), s.surface);
    assert_true(figure_of(&s, mapping, "field.angle.p95") < 6.0);
    assert_true(figure_of(&s, mapping, "field.symmetry") == 2.0);
    /* Twice as large on the surface: half the texels along each axis. */
    assert_true(fabs(figure_of(&s, mapping, "field.scale.p50") - 2.0) < 0.1);
    assert_true(fabs(uv_area(mapping) * 4.0 / surface->area - 1.0) < 0.2);
    osdtex_mapping_destroy(mapping);
    free(axes);
    free(scales);
    close_scene(&s);
}

static void
assert_refused(scene *s, const osdtex_field_options *options)
{
    osdtex_field *field = (osdtex_field *)1;

    assert_int_equal(
        osdtex_field_create(s->context, s->surface, options, &field),
        OSDTEX_ERROR_ARGUMENT);
    assert_null(field);
}

static void
what_is_no_field_is_refused(void **state)
{
    static const float one[3] = {1.0f, 0.0f, 0.0f};
    osdtex_field_options options = osdtex_field_options_default();
    float *values;
    int32_t count;
    scene s;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 0, NULL), OSDTEX_OK);
    count = osdtex_surface_describe(s.surface)->vert_count;
    values = calloc(3 * (size_t)count, sizeof *values);
    options.directions = one;
    options.direction_count = 1;
    assert_refused(&s, &options);
    options.directions_of = 3;
    assert_refused(&s, &options);
    values[4] = NAN;
    options.directions = values;
    options.direction_count = count;
    options.directions_of = OSDTEX_ELEMENT_VERTEX;
    assert_refused(&s, &options);
    assert_non_null(strstr(last_message(&s), "direction 1 is not finite"));
    options.directions = NULL;
    options.scales = values; /* zeros */
    options.scale_count = count;
    assert_refused(&s, &options);
    free(values);
    close_scene(&s);
}

static void
assert_not_mapped(
    const scene *s, osdtex_exemplar *exemplar, const osdtex_map_options *map)
{
    osdtex_mapping *mapping = (osdtex_mapping *)1;

    assert_int_equal(
        osdtex_map(s->context, s->cage, exemplar, map, &mapping),
        OSDTEX_ERROR_ARGUMENT);
    assert_null(mapping);
}

/* Nor can a mapping follow two things, or what is elsewhere. */
static void
a_mapping_has_one_field_of_its_own_surface(void **state)
{
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_constraint item = osdtex_constraint_none();
    osdtex_exemplar *exemplar;
    scene s, other, mixed;

    (void)state;
    assert_int_equal(
        open_scene(&s, "models/cages/plane.obj", 0, NULL), OSDTEX_OK);
    assert_int_equal(
        open_scene(&other, "models/cages/plane.obj", 0, NULL), OSDTEX_OK);
    assert_int_equal(
        osdtex_exemplar_read(
            s.context, "models/exemplars/grass_tile.png", NULL, &exemplar),
        OSDTEX_OK);
    map.field = make_field(&s, "up", 2);
    map.follow = "edges";
    assert_not_mapped(&s, exemplar, &map);
    map.follow = NULL;
    item.face = 0;
    item.scale = 2.0;
    map.constraint_items = &item;
    map.constraint_count = 1;
    assert_not_mapped(&s, exemplar, &map);
    map.constraint_count = 0;
    map.surface = other.surface;
    mixed = other;
    mixed.context = s.context;
    assert_not_mapped(&mixed, exemplar, &map);
    close_scene(&other);
    osdtex_exemplar_destroy(exemplar);
    osdtex_field_destroy((osdtex_field *)(uintptr_t)map.field);
    close_scene(&s);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_from_its_own_directions_is_the_same),
        cmocka_unit_test(every_kind_of_element_gives_directions),
        cmocka_unit_test(zero_leaves_a_field_free),
        cmocka_unit_test(a_mapping_follows_its_field),
        cmocka_unit_test(what_is_no_field_is_refused),
        cmocka_unit_test(a_mapping_has_one_field_of_its_own_surface),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

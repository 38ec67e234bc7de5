/* test_textures_api.c -- a bake in memory is the bake in the files, and what
 * cannot be baked is refused. */
#include "textures_scene.h"

#include <unistd.h>

/* ---- what there is ------------------------------------------------------- */

static void
a_handle_says_what_it_will_bake(void **state)
{
    static const char *const names[] = {
        "color", "patch", "uv", "stretch", "seam", "source", "slice"};
    const osdtex_bake_options options = small_bake();
    const osdtex_textures_info *info;
    scene s;

    open_scene(state, &s, &options, 2);
    info = osdtex_textures_describe(s.textures);
    assert_int_equal(info->texture_count, TEXTURES);
    assert_int_equal(info->side, SIDE);
    assert_int_equal(info->level_count, LEVELS);
    assert_int_equal(info->tile_count, 1);
    assert_int_equal(info->tiles[0], 1001);
    assert_int_equal(info->uvs, OSDTEX_BAKE_UVS_ATLAS);
    assert_int_equal(info->fvar, OSDTEX_FVAR_ALL);
    for (int32_t i = 0; i < TEXTURES; ++i)
    {
        const osdtex_texture_info *one = osdtex_texture_describe(s.textures, i);

        assert_string_equal(one->name, names[i]);
        assert_int_equal(one->channels, i == 5 ? 4 : 3);
        assert_true((one->color_space != NULL) == (i == 0));
        assert_true(strlen(one->summary) > 10);
    }
    assert_null(osdtex_texture_describe(s.textures, TEXTURES));
    assert_null(osdtex_texture_describe(s.textures, -1));
    close_scene(&s);
}

/* Every corner of the cage has coordinates, in a tile that is there. */
static void
coordinates_lie_on_the_tiles(void **state)
{
    osdtex_bake_options options = small_bake();
    const osdtex_textures_info *info;
    scene s;

    options.texels_per_unit = 60.0;
    open_scene(state, &s, &options, 2);
    info = osdtex_textures_describe(s.textures);
    assert_true(info->tile_count > 1);
    for (int32_t c = 0; c < info->corner_count; ++c)
    {
        const float *uv = info->cage_uvs + 2 * (size_t)info->face_uvs[c];
        const int32_t udim =
            1001 + (int32_t)floorf(uv[0]) + 10 * (int32_t)floorf(uv[1]);
        bool found = false;

        for (int32_t t = 0; t < info->tile_count; ++t)
            found |= info->tiles[t] == udim;
        assert_true(found);
    }
    close_scene(&s);
}

static void
one_tile_is_that_of_all(void **state)
{
    osdtex_bake_options options = small_bake();
    osdtex_image *a, *b;
    scene all, one;

    options.texels_per_unit = 60.0;
    open_scene(state, &all, &options, 2);
    options.udim = osdtex_textures_describe(all.textures)->tiles[1];
    open_scene(state, &one, &options, 2);
    assert_int_equal(osdtex_textures_describe(one.textures)->tile_count, 1);
    assert_int_equal(
        osdtex_textures_describe(one.textures)->tiles[0], options.udim);
    a = image_of(&all, 0, 1, 0);
    b = image_of(&one, 0, 0, 0);
    assert_memory_equal(
        osdtex_image_describe(a)->pixels, osdtex_image_describe(b)->pixels,
        values_of(osdtex_image_describe(a)) * sizeof(float));
    osdtex_image_destroy(a);
    osdtex_image_destroy(b);
    close_scene(&all);
    close_scene(&one);
}

/* ---- the same texels ----------------------------------------------------- */

/* What a file holds of a value. */
static float
tolerance_of(int32_t texture, float value)
{
    return texture == 0 ? fabsf(value) / 1024.0f + 1e-6f : 0.0f;
}

static void
assert_file_holds(
    const scene *s, const char *path, int32_t texture,
    const osdtex_image *image)
{
    const osdtex_image_info *ours = osdtex_image_describe(image), *theirs;
    osdtex_image *read;

    assert_int_equal(osdtex_image_read(s->context, path, &read), OSDTEX_OK);
    theirs = osdtex_image_describe(read);
    assert_int_equal(theirs->width, ours->width);
    /* One channel is read as three alike. */
    assert_true(theirs->channels >= ours->channels);
    for (size_t i = 0; i < values_of(ours); ++i)
    {
        const size_t channels = (size_t)ours->channels;
        const float read_back =
            theirs->pixels
                [i / channels * (size_t)theirs->channels + i % channels];

        if (fabsf(ours->pixels[i] - read_back) >
            tolerance_of(texture, ours->pixels[i]))
            fail_msg(
                "%s: value %zu is %g, in memory %g", path, i, (double)read_back,
                (double)ours->pixels[i]);
    }
    osdtex_image_destroy(read);
}

static void
memory_holds_what_files_hold(void **state)
{
    const osdtex_bake_options options = small_bake();
    char folder[] = "/tmp/osdtex_texturesXXXXXX", path[128], command[64];
    scene s;

    assert_non_null(mkdtemp(folder));
    open_scene(state, &s, &options, 2);
    snprintf(path, sizeof path, "%s/a.obj", folder);
    assert_int_equal(
        osdtex_bake(s.context, s.mapping, path, &options), OSDTEX_OK);
    for (int32_t i = 0; i < TEXTURES; ++i)
    {
        osdtex_image *image = image_of(&s, i, 0, 0);

        snprintf(
            path, sizeof path, "%s/a%s%s.1001.exr", folder, i > 0 ? "_" : "",
            i > 0 ? osdtex_texture_describe(s.textures, i)->name : "");
        assert_file_holds(&s, path, i, image);
        osdtex_image_destroy(image);
    }
    close_scene(&s);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

/* A colour with all maps that a material can have. */
static osdtex_status
map_waves(osdtex_context *context, osdtex_mapping **out)
{
    osdtex_exemplar_options how = osdtex_exemplar_options_default();
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_exemplar *exemplar = NULL;
    osdtex_material *material = NULL;
    osdtex_cage *cage = NULL;
    osdtex_status status =
        osdtex_cage_read(context, "models/cages/plane.obj", NULL, &cage);

    map.level = 0;
    map.scale = 4.0;
    if (status == OSDTEX_OK)
        status =
            osdtex_material_find(context, "models/materials/waves", &material);
    if (status == OSDTEX_OK)
    {
        const osdtex_material_info *info = osdtex_material_describe(material);

        how.maps = info->maps;
        how.map_count = info->map_count;
        status = osdtex_exemplar_read(context, info->color, &how, &exemplar);
    }
    if (status == OSDTEX_OK)
        status = osdtex_map(context, cage, exemplar, &map, out);
    osdtex_material_destroy(material);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    return status;
}

static void
maps_of_a_material_come_with_its_colour(void **state)
{
    static const char *const names[] = {
        "color", "normal", "roughness", "height", "metalness", "occlusion"};
    osdtex_bake_options options = small_bake();
    char folder[] = "/tmp/osdtex_texturesXXXXXX", path[128], command[64];
    osdtex_context *context;
    osdtex_mapping *mapping = NULL;
    scene s;

    (void)state;
    options.extras = 0;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(osdtex_context_create(NULL, &context), OSDTEX_OK);
    if (map_waves(context, &mapping) != OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(context)->message);
    open_scene((void **)&mapping, &s, &options, 2);
    snprintf(path, sizeof path, "%s/a.obj", folder);
    assert_int_equal(osdtex_bake(context, mapping, path, &options), OSDTEX_OK);
    assert_int_equal(osdtex_textures_describe(s.textures)->texture_count, 6);
    for (int32_t i = 0; i < 6; ++i)
    {
        osdtex_image *image = image_of(&s, i, 0, 0);

        assert_string_equal(
            osdtex_texture_describe(s.textures, i)->name, names[i]);
        snprintf(
            path, sizeof path, "%s/a%s%s.1001.exr", folder, i > 0 ? "_" : "",
            i > 0 ? names[i] : "");
        assert_file_holds(&s, path, 0, image);
        osdtex_image_destroy(image);
    }
    close_scene(&s);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

/* A plane with maps of the host's own pixels. */
static osdtex_status
map_pixels(
    osdtex_context *context, const osdtex_companion *maps, int32_t count,
    osdtex_mapping **out)
{
    osdtex_exemplar_options how = osdtex_exemplar_options_default();
    osdtex_map_options map = osdtex_map_options_default();
    osdtex_exemplar *exemplar = NULL;
    osdtex_cage *cage = NULL;
    osdtex_status status =
        osdtex_cage_read(context, "models/cages/plane.obj", NULL, &cage);

    map.level = 0;
    map.scale = 4.0;
    how.maps = maps;
    how.map_count = count;
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(
            context, "models/exemplars/gravel_tile.png", &how, &exemplar);
    if (status == OSDTEX_OK)
        status = osdtex_map(context, cage, exemplar, &map, out);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    return status;
}

/* Every texel the same: `channels` of value. */
static osdtex_image *
even_image(osdtex_context *context, int32_t channels, const float *value)
{
    enum
    {
        TEXELS = 64
    };
    float *pixels = calloc((size_t)TEXELS * TEXELS * 4, sizeof *pixels);
    osdtex_image *image = NULL;

    for (int32_t i = 0; i < TEXELS * TEXELS * channels; ++i)
        pixels[i] = value[i % channels];
    assert_int_equal(
        osdtex_image_create(context, TEXELS, TEXELS, channels, pixels, &image),
        OSDTEX_OK);
    free(pixels);
    return image;
}

static void
maps_come_from_memory(void **state)
{
    static const float rough[] = {0.25f}, flat[] = {0.5f, 0.5f, 1.0f};
    osdtex_bake_options options = small_bake();
    osdtex_context *context;
    osdtex_mapping *mapping = NULL;
    osdtex_companion maps[2] = {
        {.kind = OSDTEX_MAP_ROUGHNESS}, {.kind = OSDTEX_MAP_NORMAL}};
    osdtex_image *normal, *roughness, *given[2];
    scene s;

    (void)state;
    options.extras = 0;
    assert_int_equal(osdtex_context_create(NULL, &context), OSDTEX_OK);
    assert_int_equal(
        map_pixels(context, maps, 1, &mapping), OSDTEX_ERROR_ARGUMENT);
    maps[0].image = given[0] = even_image(context, 1, rough);
    maps[1].image = given[1] = even_image(context, 3, flat);
    if (map_pixels(context, maps, 2, &mapping) != OSDTEX_OK)
        fail_msg("%s", osdtex_context_error(context)->message);
    osdtex_image_destroy(given[0]);
    osdtex_image_destroy(given[1]);
    open_scene((void **)&mapping, &s, &options, 2);
    assert_string_equal(osdtex_texture_describe(s.textures, 1)->name, "normal");
    normal = image_of(&s, 1, 0, 0);
    roughness = image_of(&s, 2, 0, 0);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; ++i)
    {
        const float *n = osdtex_image_describe(normal)->pixels + 3 * i;

        assert_float_equal(
            osdtex_image_describe(roughness)->pixels[i], rough[0], 1e-6);
        for (int k = 0; k < 3; ++k)
            assert_float_equal(n[k], flat[k], 1e-6);
    }
    osdtex_image_destroy(normal);
    osdtex_image_destroy(roughness);
    assert_int_equal(
        osdtex_mapping_save(context, mapping, "/tmp/none.osdtex"),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(
        strstr(osdtex_context_error(context)->message, "normal map"));
    close_scene(&s);
    osdtex_mapping_destroy(mapping);
    osdtex_context_destroy(context);
}

static void
arrays_hold_what_images_hold(void **state)
{
    const osdtex_bake_options options = small_bake();
    scene s;

    open_scene(state, &s, &options, 3);
    for (int32_t level = 0; level < LEVELS; ++level)
    {
        const osdtex_texture_part part = {level % TEXTURES, 0, level};
        osdtex_image *image = image_of(&s, part.texture, 0, level);
        const osdtex_image_info *info = osdtex_image_describe(image);
        const size_t count = values_of(info);
        float *pixels = calloc(count + 1, sizeof *pixels);

        assert_int_equal(info->width, SIDE >> level > 1 ? SIDE >> level : 1);
        pixels[count] = 7.0f;
        assert_int_equal(
            osdtex_textures_read(s.context, s.textures, &part, pixels, count),
            OSDTEX_OK);
        assert_memory_equal(pixels, info->pixels, count * sizeof *pixels);
        assert_true(pixels[count] == 7.0f);
        assert_int_equal(
            osdtex_textures_read(
                s.context, s.textures, &part, pixels, count - 1),
            OSDTEX_ERROR_ARGUMENT);
        free(pixels);
        osdtex_image_destroy(image);
    }
    close_scene(&s);
}

static void
threads_make_no_difference(void **state)
{
    osdtex_bake_options options = small_bake();
    osdtex_image *first = NULL;
    scene kept;

    options.seam_blend = 4.0;
    open_scene(state, &kept, &options, 1);
    first = image_of(&kept, 0, 0, 0);
    for (int32_t threads = 2; threads <= 8; threads *= 2)
    {
        osdtex_image *other;
        scene s;

        open_scene(state, &s, &options, threads);
        other = image_of(&s, 0, 0, 0);
        assert_memory_equal(
            osdtex_image_describe(first)->pixels,
            osdtex_image_describe(other)->pixels,
            values_of(osdtex_image_describe(first)) * sizeof(float));
        osdtex_image_destroy(other);
        close_scene(&s);
    }
    osdtex_image_destroy(first);
    close_scene(&kept);
}

/* A host's thread, with a context of its own. */
typedef struct baker
{
    pthread_t thread;
    const osdtex_textures *textures;
    float *pixels; /* of level 0 */
    osdtex_status status;
} baker;

static void *
bake_beside(void *user)
{
    const osdtex_texture_part part = {0, 0, 0};
    baker *b = user;
    osdtex_context *context;

    b->status = osdtex_context_create(NULL, &context);
    if (b->status == OSDTEX_OK)
        b->status = osdtex_textures_read(
            context, b->textures, &part, b->pixels, SIDE * SIDE * 3);
    osdtex_context_destroy(context);
    return NULL;
}

static void
contexts_share_a_handle(void **state)
{
    const osdtex_bake_options options = small_bake();
    baker bakers[3];
    scene s;

    open_scene(state, &s, &options, 1);
    for (int i = 0; i < 3; ++i)
    {
        bakers[i] = (baker){
            .textures = s.textures,
            .pixels = malloc(SIDE * SIDE * 3 * sizeof(float))};
        assert_int_equal(
            pthread_create(&bakers[i].thread, NULL, bake_beside, &bakers[i]),
            0);
    }
    for (int i = 0; i < 3; ++i)
    {
        pthread_join(bakers[i].thread, NULL);
        assert_int_equal(bakers[i].status, OSDTEX_OK);
        assert_memory_equal(
            bakers[i].pixels, bakers[0].pixels,
            SIDE * SIDE * 3 * sizeof(float));
    }
    for (int i = 0; i < 3; ++i)
        free(bakers[i].pixels);
    close_scene(&s);
}

static void
a_handle_keeps_its_mapping(void **state)
{
    const osdtex_bake_options options = small_bake();
    osdtex_image *image, *wanted;
    osdtex_mapping *mapping = NULL;
    scene s;

    open_scene(state, &s, &options, 2);
    wanted = image_of(&s, 0, 0, 1);
    osdtex_textures_destroy(s.textures);
    assert_int_equal(map_small(s.context, &mapping), OSDTEX_OK);
    assert_int_equal(
        osdtex_textures_create(s.context, mapping, &options, &s.textures),
        OSDTEX_OK);
    osdtex_mapping_destroy(mapping);
    image = image_of(&s, 0, 0, 1);
    assert_memory_equal(
        osdtex_image_describe(image)->pixels,
        osdtex_image_describe(wanted)->pixels,
        values_of(osdtex_image_describe(wanted)) * sizeof(float));
    osdtex_image_destroy(image);
    osdtex_image_destroy(wanted);
    close_scene(&s);
}

/* ---- what is refused ----------------------------------------------------- */

static void
what_is_not_there_is_refused(void **state)
{
    static const osdtex_texture_part parts[] = {{-1, 0, 0}, {TEXTURES, 0, 0},
                                                {0, -1, 0}, {0, 1, 0},
                                                {0, 0, -1}, {0, 0, LEVELS}};
    const osdtex_status wrong = OSDTEX_ERROR_ARGUMENT;
    osdtex_bake_options options = small_bake();
    osdtex_textures *none = (osdtex_textures *)1;
    osdtex_image *image = (osdtex_image *)1;
    scene s;

    open_scene(state, &s, &options, 1);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
    {
        assert_int_equal(
            osdtex_textures_image(s.context, s.textures, &parts[i], &image),
            wrong);
        assert_null(image);
    }
    assert_int_equal(
        osdtex_textures_image(s.context, NULL, &parts[0], &image), wrong);
    assert_int_equal(
        osdtex_textures_image(s.context, s.textures, NULL, &image), wrong);
    assert_int_equal(
        osdtex_textures_read(
            s.context, s.textures, &(osdtex_texture_part){0, 0, 0}, NULL,
            1000000),
        wrong);
    options.udim = 1099;
    assert_int_equal(
        osdtex_textures_create(s.context, s.mapping, &options, &none), wrong);
    assert_null(none);
    assert_non_null(
        strstr(osdtex_context_error(s.context)->message, "no tile 1099"));
    assert_int_equal(
        osdtex_textures_create(s.context, NULL, NULL, &none), wrong);
    assert_int_equal(
        osdtex_textures_create(NULL, s.mapping, NULL, &none), wrong);
    assert_null(osdtex_textures_describe(NULL));
    osdtex_textures_destroy(NULL);
    close_scene(&s);
}

static bool
take_any(void *user, const osdtex_bake_block *block)
{
    (void)user;
    return block->pixels != NULL;
}

static osdtex_status
bake_in_all_ways(osdtex_context *context)
{
    osdtex_bake_options options = small_bake();
    const osdtex_texture_part part = {0, 0, 1};
    osdtex_bake_sink sink = osdtex_bake_sink_none();
    osdtex_mapping *mapping = NULL;
    osdtex_textures *textures = NULL;
    osdtex_image *image = NULL;
    osdtex_status status = map_small(context, &mapping);

    options.extras = OSDTEX_BAKE_SEAM;
    options.resolution = 32;
    sink.put = take_any;
    sink.first_level = 1;
    if (status == OSDTEX_OK)
        status = osdtex_textures_create(context, mapping, &options, &textures);
    if (status == OSDTEX_OK)
        status = osdtex_textures_image(context, textures, &part, &image);
    if (status == OSDTEX_OK)
        status = osdtex_textures_bake(context, textures, &sink);
    osdtex_image_destroy(image);
    osdtex_textures_destroy(textures);
    osdtex_mapping_destroy(mapping);
    return status;
}

static void
failing_allocations_leak_nothing(void **state)
{
    const moments at = {1, 2};

    (void)state;
    fail_at_moments(&at, bake_in_all_ways);
}

static void
cancelling_leaks_nothing(void **state)
{
    const moments at = {2, 4};

    (void)state;
    cancel_at_moments(&at, bake_in_all_ways);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_handle_says_what_it_will_bake),
        cmocka_unit_test(coordinates_lie_on_the_tiles),
        cmocka_unit_test(one_tile_is_that_of_all),
        cmocka_unit_test(memory_holds_what_files_hold),
        cmocka_unit_test(maps_of_a_material_come_with_its_colour),
        cmocka_unit_test(maps_come_from_memory),
        cmocka_unit_test(arrays_hold_what_images_hold),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(contexts_share_a_handle),
        cmocka_unit_test(a_handle_keeps_its_mapping),
        cmocka_unit_test(what_is_not_there_is_refused),
        cmocka_unit_test(failing_allocations_leak_nothing),
        cmocka_unit_test(cancelling_leaks_nothing),
    };

    return cmocka_run_group_tests(tests, map_once, forget);
}

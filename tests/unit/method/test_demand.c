/* test_demand.c -- what materials, pictures and constraints ask for. */
#include "unit/cluster/sheets.h"

#include "method/demand.h"

#include <string.h>

static otx_surface
read_cage(otx_run *run, const char *name, int32_t level)
{
    char path[128];

    snprintf(path, sizeof path, "models/cages/%s.obj", name);
    return sheet_from_file(run, path, level);
}

static uint8_t *
no_demand(otx_run *run, const otx_surface *surface)
{
    return OTX_ZNEW(run->arena, uint8_t, otx_surface_leaf(surface)->face_count);
}

static void
expect_refused(otx_run *run, otx_status status, const char *words)
{
    assert_int_equal(status, OSDTEX_ERROR_ARGUMENT);
    if (!strstr(test_last_message(run), words))
        fail_msg("'%s' is not in: %s", words, test_last_message(run));
}

static void
a_material_asks_for_its_faces(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface = read_cage(run, "materials_and_groups", 1);
    const otx_cage *cage = surface.cage;
    const otx_level *leaf = otx_surface_leaf(&surface);
    uint8_t *demand = no_demand(run, &surface);
    int32_t asked = 0;

    (void)state;
    assert_true(cage->material_count > 1);
    assert_int_equal(
        otx_demand_material(run, &surface, cage->material_names[1], 3, demand),
        OSDTEX_OK);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const bool has = cage->face_material[leaf->face_cage[f]] == 1;

        assert_int_equal(demand[f], has ? 3 : 0);
        asked += has;
    }
    assert_true(asked > 0 && asked < leaf->face_count);
    expect_refused(
        run, otx_demand_material(run, &surface, "moss", 1, demand),
        cage->material_names[0]);
    test_run_destroy(run);
}

static void
a_cage_without_materials_says_so(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface = read_cage(run, "sphere", 1);

    (void)state;
    expect_refused(
        run,
        otx_demand_material(run, &surface, "moss", 1, no_demand(run, &surface)),
        "the cage has none");
    test_run_destroy(run);
}

static void
a_table_is_read_by_face(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface = read_cage(run, "sphere", 2);
    const otx_level *leaf = otx_surface_leaf(&surface);
    uint8_t *demand = no_demand(run, &surface);
    uint8_t *faces = OTX_ZNEW(run->arena, uint8_t, surface.cage->face_count);

    (void)state;
    faces[2] = 1;
    assert_int_equal(
        otx_demand_faces(run, &surface, faces, 2, demand), OSDTEX_OK);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        assert_int_equal(demand[f], leaf->face_cage[f] == 2);
    faces[2] = 2;
    expect_refused(
        run, otx_demand_faces(run, &surface, faces, 2, demand),
        "face 2 asks for exemplar 3");
    test_run_destroy(run);
}

/* Left to right: black, red, green, blue, in equal stripes. */
static otx_image
stripes(otx_run *run, int32_t channels)
{
    otx_image image;

    assert_int_equal(
        otx_image_create(run, run->arena, 64, 8, channels, &image), OSDTEX_OK);
    memset(image.pixels, 0, (size_t)(64 * 8 * channels) * sizeof *image.pixels);
    for (int32_t y = 0; y < 8; ++y)
        for (int32_t x = 16; x < 64; ++x)
            otx_image_at(&image, x, y)[x / 16 - 1] = 1.0f;
    return image;
}

static double
middle_u(const otx_surface *surface, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    double sum = 0.0;

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
        sum += (double)surface->uvs[2 * surface->face_uvs[c]];
    return sum / otx_level_face_size(leaf, face);
}

static otx_status
ask_picture(
    otx_run *run, const otx_surface *surface, const otx_image *image,
    int32_t count, uint8_t *demand)
{
    const otx_demand_mask mask = {.image = image, .path = "mask.png"};

    return otx_demand_picture(run, surface, &mask, count, demand);
}

static void
colours_ask_for_exemplars(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface = read_cage(run, "plane", 3);
    const otx_level *leaf = otx_surface_leaf(&surface);
    uint8_t *demand = no_demand(run, &surface);
    bool seen[4] = {false};

    (void)state;
    for (int32_t channels = 3; channels <= 4; ++channels)
    {
        const otx_image image = stripes(run, channels);

        assert_int_equal(
            ask_picture(run, &surface, &image, 4, demand), OSDTEX_OK);
        for (int32_t f = 0; f < leaf->face_count; ++f)
        {
            const double u = 4.0 * middle_u(&surface, f);

            seen[demand[f]] = true;
            if (fabs(u - round(u)) > 0.2)
                assert_int_equal(demand[f], (int)floor(u));
        }
    }
    assert_true(seen[0] && seen[1] && seen[2] && seen[3]);
    test_run_destroy(run);
}

static void
what_a_picture_cannot_ask_for_is_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface plane = read_cage(run, "plane", 2);
    const otx_surface sphere = read_cage(run, "sphere", 1);
    otx_surface beyond = plane;
    const otx_image image = stripes(run, 3);
    float *uvs = OTX_NEW(run->arena, float, 2 * (size_t)plane.uv_count);

    (void)state;
    expect_refused(
        run, ask_picture(run, &plane, &image, 2, no_demand(run, &plane)),
        "there are 2");
    memcpy(uvs, plane.uvs, 2 * (size_t)plane.uv_count * sizeof *uvs);
    beyond.uvs = uvs;
    uvs[2 * plane.face_uvs[0]] = 1.5f;
    expect_refused(
        run, ask_picture(run, &beyond, &image, 4, no_demand(run, &plane)),
        "outside of 0 to 1");
    uvs[2 * plane.face_uvs[0]] = NAN;
    expect_refused(
        run, ask_picture(run, &beyond, &image, 4, no_demand(run, &plane)),
        "has no UVs");
    if (sphere.uv_count == 0)
        expect_refused(
            run, ask_picture(run, &sphere, &image, 4, no_demand(run, &sphere)),
            "has no UVs");
    test_run_destroy(run);
}

/* The plane's UVs, of which u goes over `columns` tiles from `first`. */
static otx_surface
spread_uvs(otx_run *run, const otx_surface *plane, float first, float columns)
{
    otx_surface surface = *plane;
    float *uvs = OTX_NEW(run->arena, float, 2 * (size_t)plane->uv_count);

    for (int32_t i = 0; i < plane->uv_count; ++i)
    {
        uvs[2 * i] = first + columns * plane->uvs[2 * i];
        uvs[2 * i + 1] = 3.0f + plane->uvs[2 * i + 1];
    }
    surface.uvs = uvs;
    return surface;
}

/* Each picture is asked only about the faces of its tile, in which it lies as
 * one does in the unit square. */
static void
tiles_ask_for_what_lies_in_them(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface plane = read_cage(run, "plane", 3);
    const otx_surface surface = spread_uvs(run, &plane, 1.0f, 2.0f);
    const int32_t face_count = otx_surface_leaf(&surface)->face_count;
    const otx_image image = stripes(run, 3);
    uint16_t *tiles = OTX_NEW(run->arena, uint16_t, face_count);
    uint8_t *demand = no_demand(run, &surface);
    otx_demand_mask mask = {&image, "mask.1032.png", tiles, 1032};

    (void)state;
    assert_int_equal(
        otx_demand_tiles(run, &surface, "mask.<UDIM>.png", tiles), OSDTEX_OK);
    memset(demand, 9, (size_t)face_count);
    assert_int_equal(
        otx_demand_picture(run, &surface, &mask, 4, demand), OSDTEX_OK);
    for (int32_t f = 0; f < face_count; ++f)
    {
        const double u = middle_u(&surface, f);

        assert_int_equal(tiles[f], u < 2.0 ? 1032 : 1033);
        if (u > 2.0)
            assert_int_equal(demand[f], 9);
        else if (fabs(4.0 * u - round(4.0 * u)) > 0.2)
            assert_int_equal(demand[f], (int)floor(4.0 * (u - 1.0)));
    }
    test_run_destroy(run);
}

static void
what_lies_beyond_the_tiles_is_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface plane = read_cage(run, "plane", 1);
    const otx_surface left = spread_uvs(run, &plane, -0.5f, 1.0f);
    const otx_surface right = spread_uvs(run, &plane, 9.0f, 1.5f);
    const otx_surface last = spread_uvs(run, &plane, 9.0f, 1.0f);
    uint16_t *tiles =
        OTX_NEW(run->arena, uint16_t, otx_surface_leaf(&plane)->face_count);

    (void)state;
    expect_refused(
        run, otx_demand_tiles(run, &left, "m.<UDIM>.png", tiles),
        "outside of the UDIM tiles");
    expect_refused(
        run, otx_demand_tiles(run, &right, "m.<UDIM>.png", tiles),
        "outside of the UDIM tiles");
    assert_int_equal(
        otx_demand_tiles(run, &last, "m.<UDIM>.png", tiles), OSDTEX_OK);
    assert_int_equal(tiles[0], 1040);
    test_run_destroy(run);
}

/* What is asked for at corners of a plane, with the faces that came to show it.
 */
static void
count_shown(
    const otx_constraint *items, int32_t item_count, int32_t count,
    int32_t shown[4])
{
    otx_run *run = test_run_create();
    const otx_surface surface = read_cage(run, "plane", 3);
    const otx_level *leaf = otx_surface_leaf(&surface);
    const otx_constraint_set set = {.count = item_count, .items = items};
    uint8_t *demand = no_demand(run, &surface);

    assert_true(otx_demand_in(&set));
    assert_int_equal(
        otx_demand_constraints(run, &surface, &set, count, demand), OSDTEX_OK);
    memset(shown, 0, 4 * sizeof *shown);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        assert_true(demand[f] < count);
        ++shown[demand[f]];
        for (int32_t i = 0; i < item_count; ++i)
            if (items[i].face == leaf->face_cage[f] && items[i].exemplar > 0)
                assert_int_equal(demand[f], items[i].exemplar - 1);
    }
    test_run_destroy(run);
}

/* Two exemplars meet without a third between them; four corners of a plane get
 * a quarter each; without neighbours there is but one. */
static void
exemplars_meet_half_way(void **state)
{
    static const otx_constraint corners[] = {
        {.face = 0, .exemplar = 1},
        {.face = 15, .exemplar = 3},
        {.face = 3, .exemplar = 2},
        {.face = 12, .exemplar = 4}};
    static const otx_constraint ends[] = {
        {.face = 0, .has_material = true, .material = 0.0},
        {.face = 15, .has_material = true, .material = 1.0}};
    int32_t shown[4];

    (void)state;
    count_shown(corners, 2, 3, shown);
    assert_true(shown[1] == 0 && shown[0] > 300 && shown[2] > 300);
    count_shown(ends, 2, 3, shown);
    assert_true(shown[1] == 0 && shown[0] > 300 && shown[2] > 300);
    count_shown(corners, 4, 4, shown);
    for (int k = 0; k < 4; ++k)
        assert_true(shown[k] > 230 && shown[k] < 282);
    count_shown(corners + 1, 1, 3, shown);
    assert_int_equal(shown[2], 1024);
}

/* Faces that are named show what they ask for; others what lies between. */
static void
materials_of_constraints_divide_the_surface(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface surface = read_cage(run, "plane", 2);
    const otx_level *leaf = otx_surface_leaf(&surface);
    const int32_t last = surface.cage->face_count - 1;
    const otx_constraint items[] = {
        {.face = 0, .has_material = true, .material = 0.0},
        {.face = last, .has_material = true, .material = 1.0}};
    const otx_constraint_set set = {.count = 2, .items = items};
    uint8_t *demand = no_demand(run, &surface);
    bool seen[2] = {false};

    (void)state;
    assert_false(otx_demand_in(NULL));
    assert_true(otx_demand_in(&set));
    assert_int_equal(
        otx_demand_constraints(run, &surface, &set, 2, demand), OSDTEX_OK);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        seen[demand[f]] = true;
        if (leaf->face_cage[f] == 0)
            assert_int_equal(demand[f], 0);
        if (leaf->face_cage[f] == last)
            assert_int_equal(demand[f], 1);
    }
    assert_true(seen[0] && seen[1]);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_material_asks_for_its_faces),
        cmocka_unit_test(a_cage_without_materials_says_so),
        cmocka_unit_test(a_table_is_read_by_face),
        cmocka_unit_test(colours_ask_for_exemplars),
        cmocka_unit_test(what_a_picture_cannot_ask_for_is_refused),
        cmocka_unit_test(tiles_ask_for_what_lies_in_them),
        cmocka_unit_test(what_lies_beyond_the_tiles_is_refused),
        cmocka_unit_test(exemplars_meet_half_way),
        cmocka_unit_test(materials_of_constraints_divide_the_surface),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

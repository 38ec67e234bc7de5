/* test_cut_order.c -- who touches waits, who does not may run together; what is
 * remembered of an edge is what it costs. */
#include "grid.h"

#include "relax/cut_memo.h"
#include "relax/cut_order.h"

enum
{
    SIDE = 24,
    FACES = SIDE * SIDE,
    PATCHES = 40
};

typedef struct scene
{
    uint8_t offered[PATCHES][FACES];
    otx_offer offers[PATCHES];
} scene;

/* Rectangles of random place and size, with random UVs. */
static void
make_offers(otx_arena *arena, uint64_t seed, scene *s)
{
    memset(s, 0, sizeof *s);
    for (int32_t p = 0; p < PATCHES; ++p)
    {
        const uint64_t r = otx_random_bits(seed, 1, (uint64_t)p);
        const int32_t w = 2 + (int32_t)(r % 5), h = 2 + (int32_t)(r / 8 % 5);
        const int32_t x = (int32_t)(r / 64 % (SIDE - 6));
        const int32_t y = (int32_t)(r / 4096 % (SIDE - 6));
        int32_t *faces = OTX_NEW(arena, int32_t, w * h);
        int32_t *first = OTX_NEW(arena, int32_t, w * h + 1);
        otx_vec2 *uvs = OTX_NEW(arena, otx_vec2, 4 * w * h);

        for (int32_t i = 0; i < w * h; ++i)
        {
            faces[i] = (y + i / w) * SIDE + x + i % w;
            first[i] = 4 * i;
            s->offered[p][faces[i]] = 1;
        }
        first[w * h] = 4 * w * h;
        for (int32_t c = 0; c < 4 * w * h; ++c)
            uvs[c] = (otx_vec2){
                60.0 * otx_random_unit(seed, 2 + p, 2 * (uint64_t)c),
                60.0 * otx_random_unit(seed, 2 + p, 2 * (uint64_t)c + 1)};
        s->offers[p] = (otx_offer){w * h, faces, uvs, first, NULL, 0};
    }
}

/* Whether a face of one is a face of the other or beside one. */
static bool
touch(const otx_level *leaf, const scene *s, int32_t p, int32_t q)
{
    for (int32_t f = 0; f < FACES; ++f)
    {
        if (!s->offered[p][f])
            continue;
        if (s->offered[q][f])
            return true;
        for (int32_t k = 0; k < 4; ++k)
        {
            const int32_t other = otx_level_neighbour(leaf, f, k);

            if (other >= 0 && s->offered[q][other])
                return true;
        }
    }
    return false;
}

static void
those_that_touch_wait(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_level *leaf = otx_surface_leaf(surface);
    scene *s = OTX_NEW(run->arena, scene, 1);
    int32_t together = 0;

    (void)state;
    for (uint64_t seed = 1; seed <= 4; ++seed)
    {
        int32_t place[PATCHES];
        otx_cut_order order;

        make_offers(run->arena, seed, s);
        assert_int_equal(
            otx_cut_order_build(
                run, run->arena, leaf, s->offers, PATCHES, &order),
            OSDTEX_OK);
        memset(place, -1, sizeof place);
        for (int32_t k = 0; k < PATCHES; ++k)
            place[order.offers[k]] = k;
        for (int32_t q = 0; q < PATCHES; ++q)
        {
            uint8_t waits[PATCHES] = {0};

            assert_true(place[q] >= 0);
            for (int64_t i = order.places.first[place[q]];
                 i < order.places.first[place[q] + 1]; ++i)
            {
                assert_true(order.places.before[i] < place[q]);
                assert_false(waits[order.offers[order.places.before[i]]]);
                waits[order.offers[order.places.before[i]]] = 1;
            }
            for (int32_t p = 0; p < PATCHES; ++p)
                assert_int_equal(waits[p], p < q && touch(leaf, s, p, q));
            together += order.places.first[place[q] + 1] ==
                        order.places.first[place[q]];
        }
    }
    assert_true(together > 4 * 2);
    test_run_destroy(run);
}

static void
what_is_remembered_is_the_cost(void **state)
{
    otx_run *run = test_run_create();
    const otx_surface *surface = test_grid_create(run->arena, SIDE, SIDE, 1.0);
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_exemplar *exemplar =
        test_exemplar_create(run->arena, 64, 64, true, 5);
    scene *s = OTX_NEW(run->arena, scene, 1);
    otx_cut_options options = otx_cut_options_default();
    otx_cut_cost cost;
    otx_cut_memo memo;
    int32_t asked = 0;

    (void)state;
    make_offers(run->arena, 5, s);
    options.texels_per_unit = 8.0;
    cost = otx_cut_cost_create(surface, exemplar, s->offers, &options);
    assert_int_equal(
        otx_cut_memo_create(run->arena, &cost, PATCHES, &memo), OSDTEX_OK);
    for (int round = 0; round < 3; ++round)
        for (int32_t e = 0; e < leaf->edge_count; ++e)
            for (int32_t p = -1; p < PATCHES; ++p)
            {
                const int32_t q = (p + 1 + round * e) % PATCHES;
                const int32_t *faces = leaf->edge_faces + 2 * (size_t)e;
                otx_cut_view views[2] = {{-1, -1}, {-1, -1}};

                if (faces[1] < 0)
                    continue;
                for (int32_t i = 0; p >= 0 && i < s->offers[p].face_count; ++i)
                    if (s->offers[p].faces[i] == faces[0])
                        views[0] = (otx_cut_view){p, i};
                for (int32_t i = 0; i < s->offers[q].face_count; ++i)
                    if (s->offers[q].faces[i] == faces[1])
                        views[1] = (otx_cut_view){q, i};
                asked += views[0].label >= 0 && views[1].label >= 0;
                for (int side = 0; side < 2; ++side)
                    assert_true(
                        otx_cut_memo_edge(&memo, e, views, side) ==
                        otx_cut_cost_edge(&cost, e, views[0], views[1]));
            }
    assert_true(asked > 100);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(those_that_touch_wait),
        cmocka_unit_test(what_is_remembered_is_the_cost),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_textures_sink_api.c -- a bake handed out in blocks, in the order of the
 * files, by the thread that asked. */
#include "textures_scene.h"

/* What a sink has been given. */
typedef struct taken
{
    pthread_t thread;
    int32_t count;
    int32_t stop_at; /* block at which it has enough; -1 never */
    osdtex_bake_block last;
    float *levels[TEXTURES][LEVELS]; /* of each texture */
} taken;

/* Whether `b` may come after `a`. */
static bool
is_in_order(const osdtex_bake_block *a, const osdtex_bake_block *b)
{
    if (a->texture != b->texture)
        return b->texture == a->texture + 1;
    if (a->level != b->level)
        return b->level == a->level + 1;
    return b->y < a->y || (b->y == a->y && b->x == a->x + a->width);
}

static bool
take(void *user, const osdtex_bake_block *block)
{
    taken *t = user;
    float *to = t->levels[block->texture][block->level];

    assert_true(pthread_equal(t->thread, pthread_self()));
    assert_true(t->count == 0 || is_in_order(&t->last, block));
    assert_int_equal(block->udim, 1001);
    assert_true(block->x >= 0 && block->x + block->width <= block->side);
    assert_true(block->y >= 0 && block->y + block->height <= block->side);
    for (int32_t y = 0; to && y < block->height; ++y)
    {
        const size_t row = (size_t)block->width * (size_t)block->channels;

        memcpy(
            to + ((size_t)(block->y + y) * (size_t)block->side +
                  (size_t)block->x) *
                     (size_t)block->channels,
            block->pixels + (size_t)y * row, row * sizeof *to);
    }
    t->last = *block;
    return t->count++ != t->stop_at;
}

static osdtex_bake_sink
sink_for(taken *t)
{
    osdtex_bake_sink sink = osdtex_bake_sink_none();

    *t = (taken){.thread = pthread_self(), .stop_at = -1};
    sink.put = take;
    sink.user = t;
    return sink;
}

static void
blocks_make_up_the_images(void **state)
{
    const osdtex_bake_options options = small_bake();
    osdtex_bake_sink sink;
    taken t;
    scene s;

    open_scene(state, &s, &options, 3);
    sink = sink_for(&t);
    sink.level_count = 0;
    for (int i = 0; i < TEXTURES * LEVELS; ++i)
        t.levels[i / LEVELS][i % LEVELS] =
            calloc(SIDE * SIDE * 4, sizeof(float));
    assert_int_equal(
        osdtex_textures_bake(s.context, s.textures, &sink), OSDTEX_OK);
    assert_int_equal(t.count, TEXTURES * (4 + LEVELS - 1));
    for (int i = 0; i < TEXTURES * LEVELS; ++i)
    {
        osdtex_image *image = image_of(&s, i / LEVELS, 0, i % LEVELS);
        const osdtex_image_info *info = osdtex_image_describe(image);

        assert_memory_equal(
            t.levels[i / LEVELS][i % LEVELS], info->pixels,
            values_of(info) * sizeof(float));
        osdtex_image_destroy(image);
        free(t.levels[i / LEVELS][i % LEVELS]);
    }
    close_scene(&s);
}

static void
a_sink_gets_what_it_asks_for(void **state)
{
    const osdtex_bake_options options = small_bake();
    osdtex_bake_sink sink;
    taken t;
    scene s;

    open_scene(state, &s, &options, 1);
    sink = sink_for(&t);
    sink.texture = 3;
    sink.tile = 0;
    sink.first_level = 2;
    sink.level_count = 2;
    assert_int_equal(
        osdtex_textures_bake(s.context, s.textures, &sink), OSDTEX_OK);
    assert_int_equal(t.count, 2);
    assert_string_equal(t.last.name, "stretch");
    assert_int_equal(t.last.level, 3);
    assert_int_equal(t.last.side, SIDE / 8);
    close_scene(&s);
}

static void
a_sink_may_have_enough(void **state)
{
    const osdtex_bake_options options = small_bake();
    osdtex_bake_sink sink;
    taken t;
    scene s;

    open_scene(state, &s, &options, 2);
    for (int32_t stop = 0; stop < 5; ++stop)
    {
        sink = sink_for(&t);
        t.stop_at = stop;
        assert_int_equal(
            osdtex_textures_bake(s.context, s.textures, &sink),
            OSDTEX_ERROR_CANCELLED);
        assert_int_equal(t.count, stop + 1);
    }
    close_scene(&s);
}

static void
a_sink_that_takes_nothing_is_refused(void **state)
{
    const osdtex_bake_options options = small_bake();
    const osdtex_status wrong = OSDTEX_ERROR_ARGUMENT;
    osdtex_bake_sink sink;
    taken t;
    scene s;

    open_scene(state, &s, &options, 1);
    sink = sink_for(&t);
    sink.put = NULL;
    assert_int_equal(osdtex_textures_bake(s.context, s.textures, &sink), wrong);
    assert_int_equal(osdtex_textures_bake(s.context, s.textures, NULL), wrong);
    sink = sink_for(&t);
    sink.first_level = LEVELS;
    assert_int_equal(osdtex_textures_bake(s.context, s.textures, &sink), wrong);
    close_scene(&s);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_make_up_the_images),
        cmocka_unit_test(a_sink_gets_what_it_asks_for),
        cmocka_unit_test(a_sink_may_have_enough),
        cmocka_unit_test(a_sink_that_takes_nothing_is_refused),
    };

    return cmocka_run_group_tests(tests, map_once, forget);
}

/* test_source_field.c -- places that texels show, looked up between them. */
#include "support.h"

#include "mapping/source_field.h"

enum
{
    SIDE = 8,
    EXEMPLAR = 64 /* texels of its side */
};

typedef struct stage
{
    otx_source_texel texels[SIDE * SIDE];
    otx_source_chart chart;
    int32_t face_chart[1];
    float places[6], metric[3];
    otx_source_field field;
} stage;

/* A triangle over a chart whose texels all show (10, 20) and on, turned by a
 * right angle. */
static void
set(stage *s)
{
    const float places[6] = {1, 1, 7, 1, 1, 7};

    *s = (stage){
        .chart = {SIDE, SIDE, 0, {1.0 / EXEMPLAR, 1.0 / EXEMPLAR}, 0},
        .metric = {1, 0, 1}};
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        s->texels[i] = (otx_source_texel){
            (float)(10.0 - (i / SIDE + 0.5)) / EXEMPLAR,
            (float)(20.0 + (i % SIDE + 0.5)) / EXEMPLAR, 0.0f, 1.0f};
    memcpy(s->places, places, sizeof places);
    s->field = (otx_source_field){
        1, &s->chart, s->texels, s->face_chart, s->places, s->metric};
}

static void
look(const stage *s, double x, double y, otx_source_term out[4])
{
    const int32_t corners[3] = {0, 1, 2};
    const double at[3] = {
        1.0 - (x - 1.0) / 6.0 - (y - 1.0) / 6.0, (x - 1.0) / 6.0,
        (y - 1.0) / 6.0};

    otx_source_field_look(&s->field, 0, corners, at, out);
}

static void
coherent_texels_are_one_term(void **state)
{
    otx_source_term t[4];
    stage s;
    int32_t terms = 0;

    (void)state;
    set(&s);
    look(&s, 3.3, 2.8, t);
    for (int i = 0; i < 4; ++i)
        if (t[i].weight > 0.0)
        {
            ++terms;
            assert_float_equal(t[i].weight, 1.0, 1e-9);
            /* (1, 0) of the chart is (0, 1) of the exemplar. */
            assert_float_equal(t[i].uvs[0].x * EXEMPLAR, 9.0, 1e-4);
            assert_float_equal(t[i].uvs[0].y * EXEMPLAR, 21.0, 1e-4);
            assert_float_equal(t[i].uvs[1].y * EXEMPLAR, 27.0, 1e-4);
            assert_float_equal(t[i].uvs[2].x * EXEMPLAR, 3.0, 1e-4);
        }
    assert_int_equal(terms, 1);
}

static void
texels_that_differ_are_mixed(void **state)
{
    otx_source_term t[4];
    double low = 0.0, high = 0.0;
    stage s;

    (void)state;
    set(&s);
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
        if (i % SIDE >= 4)
            s.texels[i].u += 0.25f;
    look(&s, 3.75, 2.6, t);
    for (int i = 0; i < 4; ++i)
        *(t[i].uvs[0].x * EXEMPLAR > 17.0 ? &high : &low) += t[i].weight;
    assert_float_equal(low, 0.75, 1e-6);
    assert_float_equal(high, 0.25, 1e-6);
}

static void
nothing_has_no_weight(void **state)
{
    otx_source_term t[4];
    stage s;

    (void)state;
    set(&s);
    memset(s.texels, 0, sizeof s.texels);
    look(&s, 3.0, 3.0, t);
    for (int i = 0; i < 4; ++i)
        assert_true(t[i].weight == 0.0);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coherent_texels_are_one_term),
        cmocka_unit_test(texels_that_differ_are_mixed),
        cmocka_unit_test(nothing_has_no_weight),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

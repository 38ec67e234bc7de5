/* test_radial_cut.c -- closed paths round a piece: within its outline, without
 * jumps, and along what looks alike. */
#include "unit/method/pastes.h"

enum
{
    FACES = 30,
    SEED = 15 * FACES + 15
};

static const double RADIUS = 40.0;
static const double TAU = 6.283185307179586;

/* A piece on a plane that it lies on as it is, from the exemplar's middle. */
static otx_lapped_paste
make_paste(paste_bench *b)
{
    const otx_radial outline = paste_circle(RADIUS, 2.0);

    otx_lapped_paste p = {
        .chart = paste_unfold(b, SEED, &outline), .centre = {32.0, 32.0}};

    paste_whole(b, &outline, &p);
    return p;
}

static paste_bench *
make_bench(otx_run *run)
{
    return paste_bench_create(
        run, sheet_create(run, FACES, FACES, SHEET_FLAT), 4.0);
}

/* All samples of the chart are covered by what the paste shows there, plus
 * `lightness` of the place in its plane. */
static void
cover(
    paste_bench *b, const otx_lapped_paste *p, float (*lightness)(otx_vec2 at))
{
    otx_samples *s = &b->l.samples;

    for (int32_t i = 0; i < p->chart.face_count; ++i)
    {
        const int32_t face = p->chart.faces[i];

        for (int32_t k = 0; k < otx_samples_count(s, face); ++k)
        {
            const otx_sample_place place = otx_samples_at(s, face, k);
            const otx_vec2 at = paste_place(&b->l, &p->chart, i, &place);
            const int32_t x =
                otx_image_wrap((int32_t)floor(p->centre.x + at.x), 64);
            const int32_t y =
                otx_image_wrap((int32_t)floor(p->centre.y + at.y), 64);
            float *lab = s->shown + 3 * (s->first[face] + k);

            memcpy(lab, otx_image_at(&b->exemplar->lab, x, y), 12);
            lab[0] += lightness(at);
            otx_samples_set(s, face, s->first[face] + k);
        }
    }
}

static void
cut(paste_bench *b, otx_lapped_paste *p)
{
    const otx_radial outline = paste_circle(RADIUS, 2.0);

    assert_int_equal(
        otx_lapped_cut(&b->l, b->run->arena, &outline, p, p->pieces[0].cut),
        OSDTEX_OK);
    assert_float_equal(p->pieces[0].cut->feather, outline.feather, 0.0);
    for (int32_t a = 0; a < OTX_RADIAL_ANGLES; ++a)
    {
        const float next =
            p->pieces[0].cut->radius[(a + 1) % OTX_RADIAL_ANGLES];

        assert_true(p->pieces[0].cut->radius[a] <= (float)RADIUS + 1e-3f);
        assert_true(p->pieces[0].cut->radius[a] >= 0.14f * (float)RADIUS);
        /* Two rings of 23 in 85 % of the radius. */
        assert_true(
            fabsf(next - p->pieces[0].cut->radius[a]) <=
            2.001 * 0.85 * RADIUS / 23.0);
        assert_true(
            p->pieces[0].cut->least <= p->pieces[0].cut->radius[a] &&
            p->pieces[0].cut->radius[a] <= p->pieces[0].cut->most);
    }
}

static void
what_nothing_covers_is_pasted_to_the_outline(void **state)
{
    paste_bench *b = make_bench(*state);
    otx_lapped_paste p = make_paste(b);

    cut(b, &p);
    for (int32_t a = 0; a < OTX_RADIAL_ANGLES; ++a)
        assert_float_equal(p.pieces[0].cut->radius[a], RADIUS, 1e-3);
}

static float
ring(otx_vec2 at)
{
    return fabs(otx_vec2_length(at) - 28.0) < 3.0 ? 0.0f : 40.0f;
}

/* An egg that the path has to follow through all rings. */
static float
egg(otx_vec2 at)
{
    const double wanted = 28.0 + 7.0 * sin(atan2(at.y, at.x));

    return fabs(otx_vec2_length(at) - wanted) < 3.0 ? 0.0f : 40.0f;
}

static void
paths_run_where_both_look_alike(void **state)
{
    paste_bench *b = make_bench(*state);
    otx_lapped_paste p = make_paste(b);

    cover(b, &p, ring);
    cut(b, &p);
    for (int32_t a = 0; a < OTX_RADIAL_ANGLES; ++a)
        assert_float_equal(p.pieces[0].cut->radius[a], 28.0, 4.5);
    cover(b, &p, egg);
    cut(b, &p);
    for (int32_t a = 0; a < OTX_RADIAL_ANGLES; ++a)
        assert_float_equal(
            p.pieces[0].cut->radius[a],
            28.0 + 7.0 * sin(TAU * a / OTX_RADIAL_ANGLES), 4.5);
}

/* Right of the middle nothing is covered, so that the piece has to stay; left
 * of it the same ring is free to take. */
static void
what_is_open_is_not_left_open(void **state)
{
    paste_bench *b = make_bench(*state);
    otx_lapped_paste p = make_paste(b);
    otx_samples *s = &b->l.samples;

    cover(b, &p, ring);
    for (int32_t i = 0; i < p.chart.face_count; ++i)
        for (int32_t k = 0; k < otx_samples_count(s, p.chart.faces[i]); ++k)
        {
            const otx_sample_place place =
                otx_samples_at(s, p.chart.faces[i], k);

            if (paste_place(&b->l, &p.chart, i, &place).x > 0.0)
                s->covered[s->first[p.chart.faces[i]] + k] = 0;
        }
    cut(b, &p);
    assert_float_equal(p.pieces[0].cut->radius[0], RADIUS, 1e-3);
    assert_float_equal(
        p.pieces[0].cut->radius[OTX_RADIAL_ANGLES / 2], 28.0, 4.5);
}

static float
alike(otx_vec2 at)
{
    (void)at;
    return 0.0f;
}

/* Where nothing differs, no more is pasted than closes the gap and its feather.
 */
static void
what_is_covered_is_not_pasted_over(void **state)
{
    const double gap = 12.0;
    paste_bench *b = make_bench(*state);
    otx_lapped_paste p = make_paste(b);
    otx_samples *s = &b->l.samples;

    cover(b, &p, alike);
    for (int32_t i = 0; i < p.chart.face_count; ++i)
        for (int32_t k = 0; k < otx_samples_count(s, p.chart.faces[i]); ++k)
        {
            const otx_sample_place place =
                otx_samples_at(s, p.chart.faces[i], k);

            if (otx_vec2_length(paste_place(&b->l, &p.chart, i, &place)) < gap)
                s->covered[s->first[p.chart.faces[i]] + k] = 0;
        }
    cut(b, &p);
    for (int32_t a = 0; a < OTX_RADIAL_ANGLES; ++a)
    {
        assert_true((double)p.pieces[0].cut->radius[a] >= gap + 2.0);
        assert_true((double)p.pieces[0].cut->radius[a] <= gap + 9.0);
    }
}

/* What is inside of the cut is covered and shows the exemplar, what is outside
 * is as it was. */
static void
marks_are_those_of_the_cut(void **state)
{
    paste_bench *b = make_bench(*state);
    otx_lapped_paste p = make_paste(b);
    otx_samples *s = &b->l.samples;
    int64_t left = 0;

    *p.pieces[0].cut = paste_circle(20.0, 2.0);
    s->left -= otx_lapped_mark(&b->l, &p, s);
    for (int32_t i = 0; i < p.chart.face_count; ++i)
        for (int32_t k = 0; k < otx_samples_count(s, p.chart.faces[i]); ++k)
        {
            const int64_t sample = s->first[p.chart.faces[i]] + k;
            const otx_sample_place place =
                otx_samples_at(s, p.chart.faces[i], k);
            const otx_vec2 at = paste_place(&b->l, &p.chart, i, &place);
            const double away = otx_vec2_length(at);

            if (away < 17.9)
                assert_int_equal(s->covered[sample], 1);
            if (away > 18.1)
                assert_int_equal(s->covered[sample], 0);
            if (away < 18.9)
                assert_memory_equal(
                    s->shown + 3 * sample,
                    otx_image_at(
                        &b->exemplar->lab, (int32_t)floor(32.0 + at.x),
                        (int32_t)floor(32.0 + at.y)),
                    12);
        }
    for (int32_t f = 0; f < b->l.leaf->face_count; ++f)
    {
        int32_t open = 0;

        for (int32_t k = 0; k < otx_samples_count(s, f); ++k)
            open += !s->covered[s->first[f] + k];
        assert_int_equal(s->open[f], open);
        left += open;
    }
    assert_true(s->left == left);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(what_nothing_covers_is_pasted_to_the_outline),
        test_with_run(paths_run_where_both_look_alike),
        test_with_run(what_is_open_is_not_left_open),
        test_with_run(what_is_covered_is_not_pasted_over),
        test_with_run(marks_are_those_of_the_cut),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

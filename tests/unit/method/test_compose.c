/* test_compose.c -- what is seen of pieces, against laying them over each other
 * at every sample. */
#include "unit/method/pastes.h"

#include "mapping/show.h"

enum
{
    FACES = 20
};

/* Lays a piece of a circle on a face, all of it or what of it is to stay. */
static void
lay(paste_bench *b, int32_t face, double radius, otx_vec2 centre)
{
    const otx_radial outline = paste_circle(radius, 4.0);
    const otx_lapped_room room = paste_room(b);
    otx_lapped_paste *p = &b->l.pastes[b->l.paste_count++];

    p->chart = paste_unfold(b, face, &outline);
    p->centre = centre;
    paste_whole(b, &outline, p);
    assert_int_equal(
        otx_lapped_rim(&b->l, &room, p->pieces[0].cut, &p->chart), OSDTEX_OK);
}

/* One piece under all, and three that lie over parts of it. */
static paste_bench *
make_bench(otx_run *run)
{
    paste_bench *b = paste_bench_create(
        run, sheet_create(run, FACES, FACES, SHEET_FLAT), 4.0);

    b->l.pastes = OTX_NEW(run->arena, otx_lapped_paste, 8);
    lay(b, 10 * FACES + 10, 300.0, (otx_vec2){10.0, 20.0});
    lay(b, 9 * FACES + 5, 18.0, (otx_vec2){40.0, 7.0});
    lay(b, 9 * FACES + 9, 20.0, (otx_vec2){3.0, 50.0});
    lay(b, 14 * FACES + 12, 15.0, (otx_vec2){33.0, 33.0});
    return b;
}

static otx_mapping
compose(paste_bench *b)
{
    otx_mapping m;

    assert_int_equal(otx_lapped_compose(&b->l, &m), OSDTEX_OK);
    return m;
}

/* Light goes down through the pieces, the last one first; `by` gets the share
 * of each. */
static void
shares(
    const paste_bench *b, int32_t face, const otx_sample_place *sample,
    double *by)
{
    double through = 1.0;

    for (int32_t p = b->l.paste_count - 1; p >= 0; --p)
    {
        const otx_lapped_chart *c = &b->l.pastes[p].chart;
        int32_t slot = 0;
        double rim = 0.0, weight;

        by[p] = 0.0;
        while (slot < c->face_count && c->faces[slot] != face)
            ++slot;
        if (slot == c->face_count)
            continue;
        for (int k = 0; k < 3; ++k)
            rim +=
                sample->at[k] *
                (double)c
                    ->rim[c->corners
                              [c->first[slot] + sample->corners[k] - 4 * face]];
        weight = through * rim *
                 otx_radial_alpha(
                     b->l.pastes[p].pieces[0].cut,
                     paste_place(&b->l, c, slot, sample), 0.0);
        by[p] = weight;
        through -= weight;
    }
}

/* What a mapping shows of each piece at a sample. */
static void
shown(
    const paste_bench *b, const otx_mapping *m, int32_t face,
    const otx_sample_place *sample, double *by)
{
    const otx_show_view show = otx_show_of(m);
    const otx_show_place place = {
        face, sample->corners, sample->at, NULL, NULL};
    double through = 1.0;

    for (int32_t p = 0; p < b->l.paste_count; ++p)
        by[p] = 0.0;
    for (int32_t i = otx_show_term_count(&show, face) - 1; i >= 0; --i)
    {
        const otx_show_term term = otx_show_term_at(&show, &place, 0, i);
        const otx_vec2 uv = otx_show_mix(&show, &place, &term, sample->at);
        double weight = term.weight;

        for (int32_t p = 0; p < b->l.paste_count; ++p)
        {
            const otx_lapped_paste *paste = &b->l.pastes[p];
            const otx_vec2 at = {
                uv.x * 64.0 - paste->centre.x, uv.y * 64.0 - paste->centre.y};
            int32_t slot = 0;

            while (slot < paste->chart.face_count &&
                   paste->chart.faces[slot] != face)
                ++slot;
            if (slot == paste->chart.face_count ||
                otx_vec2_length(otx_vec2_sub(
                    at, paste_place(&b->l, &paste->chart, slot, sample))) >
                    1e-3)
                continue;
            if (term.fragment && term.fragment->outline)
                weight *= otx_radial_alpha(paste->pieces[0].cut, at, 0.0);
            by[p] += through * weight;
            break;
        }
        through -= through * weight;
    }
    assert_float_equal(through, 0.0, 1e-6);
}

static void
each_piece_is_seen_as_it_lies(void **state)
{
    paste_bench *b = make_bench(*state);
    const otx_mapping m = compose(b);
    int32_t mixed = 0;

    for (int32_t f = 0; f < FACES * FACES; ++f)
        for (int32_t k = 0; k < otx_samples_count(&b->l.samples, f); ++k)
        {
            const otx_sample_place sample = otx_samples_at(&b->l.samples, f, k);
            double wanted[8], found[8];

            shares(b, f, &sample, wanted);
            shown(b, &m, f, &sample, found);
            for (int32_t p = 0; p < b->l.paste_count; ++p)
            {
                assert_float_equal(found[p], wanted[p], 0.03);
                mixed += wanted[p] > 0.1 && wanted[p] < 0.9;
            }
        }
    assert_true(mixed > 100);
}

/* A piece with another one over all of it is in no lookup, and has no patch. */
static void
what_nobody_sees_is_left_out(void **state)
{
    paste_bench *b = make_bench(*state);
    otx_mapping m;

    lay(b, 10 * FACES + 10, 300.0, (otx_vec2){1.0, 2.0});
    m = compose(b);
    assert_int_equal(m.patch_count, 1);
    for (int32_t f = 0; f < FACES * FACES; ++f)
    {
        assert_int_equal(m.face_patch[f], 0);
        assert_true(m.lookups->first[f + 1] == m.lookups->first[f]);
    }
    assert_float_equal(
        otx_figures_value(&b->figures, "lapped.visible"), 1.0, 1e-9);
    assert_true(otx_figures_value(&b->figures, "lapped.touched") > 2.0);
}

/* Patches are numbered as they were laid, and each face's is the one that most
 * is seen of. */
static void
patches_are_what_is_seen_most(void **state)
{
    paste_bench *b = make_bench(*state);
    const otx_mapping m = compose(b);
    int32_t last = -1;

    for (int32_t f = 0; f < FACES * FACES; ++f)
    {
        double sum[8] = {0.0}, most = 0.0;

        assert_in_range(m.face_patch[f], 0, m.patch_count - 1);
        last = m.face_patch[f] > last ? m.face_patch[f] : last;
        for (int32_t k = 0; k < otx_samples_count(&b->l.samples, f); ++k)
        {
            const otx_sample_place sample = otx_samples_at(&b->l.samples, f, k);
            double by[8];

            shares(b, f, &sample, by);
            for (int32_t p = 0; p < b->l.paste_count; ++p)
                sum[p] += by[p];
        }
        for (int32_t p = 0; p < b->l.paste_count; ++p)
            most = fmax(most, sum[p]);
        /* All four have a patch, so that numbers are those of the pieces. */
        assert_float_equal(sum[m.face_patch[f]], most, 0.02 * most);
    }
    assert_int_equal(m.patch_count, 4);
    assert_int_equal(last, 3);
}

static void
holes_show_nothing(void **state)
{
    otx_run *run = *state;
    otx_surface surface = sheet_create(run, FACES, FACES, SHEET_FLAT);
    uint8_t *hole = (uint8_t *)(uintptr_t)otx_surface_leaf(&surface)->face_hole;
    paste_bench *b;
    otx_mapping m;

    hole[7] = 1;
    b = paste_bench_create(run, surface, 4.0);
    b->l.pastes = OTX_NEW(run->arena, otx_lapped_paste, 8);
    lay(b, 10 * FACES + 10, 300.0, (otx_vec2){10.0, 20.0});
    m = compose(b);
    assert_int_equal(m.face_patch[7], -1);
    assert_int_equal(m.face_patch[8], 0);
    assert_true(m.lookups->first[8] == m.lookups->first[7]);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(each_piece_is_seen_as_it_lies),
        test_with_run(what_nobody_sees_is_left_out),
        test_with_run(patches_are_what_is_seen_most),
        test_with_run(holes_show_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_surface_patch.c -- charts laid out: isometric where that can be, whole
 * under their outline, and fading where they are cut off. */
#include "unit/method/pastes.h"

#include "flatten/aligned.h"
#include "flatten/stretch.h"

static void
check_stretch(
    const paste_bench *b, const otx_lapped_chart *c, double least, double most)
{
    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t t = 0; t < otx_facet_count(b->l.leaf, c->faces[i]); ++t)
        {
            const otx_facet facet = otx_facet_at(b->l.leaf, c->faces[i], t);
            const int32_t shift =
                c->first[i] - b->l.leaf->face_first[c->faces[i]];
            double sigma[2];
            otx_vec2 u[3];
            otx_vec3 p[3];

            for (int k = 0; k < 3; ++k)
            {
                const int32_t v = c->corners[facet.corners[k] + shift];

                u[k] = c->flat[v];
                p[k] = otx_vec3_scale(
                    b->l.texels, otx_vec3_load(b->surface.points, c->verts[v]));
            }
            otx_stretch_singular(p, u, sigma);
            assert_true(sigma[1] >= least && sigma[0] <= most);
        }
}

/* Where the seed lies in the plane. */
static otx_vec2
seed_of(const paste_bench *b, const otx_lapped_chart *c)
{
    const otx_lapped_seed seed = paste_seed(b, c->faces[0]);

    return paste_place(&b->l, c, 0, &seed.place);
}

static void
what_unrolls_keeps_all_lengths(void **state)
{
    static const int kinds[] = {SHEET_FLAT, SHEET_ROLLED, SHEET_FOLDED};
    const otx_radial outline = paste_circle(24.0, 2.0);

    for (int i = 0; i < 3; ++i)
    {
        paste_bench *b = paste_bench_create(
            *state, sheet_create(*state, 24, 24, kinds[i]), 4.0);
        const otx_lapped_chart c = paste_unfold(b, 12 * 24 + 11, &outline);

        paste_check_chart(b, &c);
        paste_check_space(b);
        assert_int_equal(c.faces[0], 12 * 24 + 11);
        check_stretch(b, &c, 0.98, 1.02);
        assert_float_equal(otx_vec2_length(seed_of(b, &c)), 0.0, 1e-9);
        assert_true(paste_overlap(&c, 40.0) < 0.001);
    }
}

static void
elsewhere_faces_keep_their_shape_or_are_left_out(void **state)
{
    otx_surface surface =
        sheet_from_file(*state, "models/cages/creature.obj", 2);
    paste_bench *b =
        paste_bench_create(*state, surface, 110.0 / sqrt(surface.area));
    const otx_radial outline = paste_circle(24.0, 2.0);

    for (int32_t face = 0; face < b->l.leaf->face_count;
         face += b->l.leaf->face_count / 12)
    {
        const otx_lapped_chart c = paste_unfold(b, face, &outline);

        paste_check_chart(b, &c);
        paste_check_space(b);
        assert_int_equal(c.faces[0], face);
        assert_true(c.face_count > 4);
        assert_float_equal(otx_vec2_length(seed_of(b, &c)), 0.0, 1e-6);
        for (int32_t i = 0; i < c.face_count; ++i)
            assert_float_equal(otx_vec3_length(c.rights[i]), 1.0, 1e-6);
    }
}

/* Of a field that is straight, charts are, too: u along it at every face. */
static void
charts_lie_along_the_field(void **state)
{
    otx_run *run = *state;
    paste_bench *b =
        paste_bench_create(run, sheet_create(run, 20, 20, SHEET_ROLLED), 4.0);
    const otx_radial outline = paste_circle(20.0, 2.0);
    otx_vec3 *field = OTX_NEW(run->arena, otx_vec3, b->l.leaf->face_count);
    otx_lapped_chart c;
    otx_rigid_mesh mesh;

    for (int32_t f = 0; f < b->l.leaf->face_count; ++f)
        field[f] = (otx_vec3){0.0, 1.0, 0.0};
    b->l.guide = (otx_guide){.directions = field, .symmetry = 1};
    c = paste_unfold(b, 10 * 20 + 10, &outline);
    mesh = (otx_rigid_mesh){c.face_count, c.vert_count, c.first,
                            c.corners,    c.verts,      b->surface.points,
                            b->l.texels,  NULL};
    for (int32_t i = 0; i < c.face_count; ++i)
    {
        double sums[3] = {0.0};

        otx_aligned_error(&mesh, i, field[c.faces[i]], c.flat, sums);
        assert_true(sums[0] + sums[1] < 1e-3 * sums[2]);
    }
}

static void
a_piece_fades_where_its_chart_is_cut_off(void **state)
{
    otx_surface surface = sheet_from_file(*state, "models/cages/torus.obj", 3);
    paste_bench *b =
        paste_bench_create(*state, surface, 110.0 / sqrt(surface.area));
    const otx_lapped_room room = paste_room(b);
    const otx_radial small = paste_circle(20.0, 2.0);
    const otx_radial large = paste_circle(60.0, 2.0);
    otx_lapped_chart c = paste_unfold(b, 100, &small);
    int32_t cut = 0, whole = 0;

    /* The chart was grown for a smaller piece than is laid on it. */
    assert_int_equal(otx_lapped_rim(&b->l, &room, &large, &c), OSDTEX_OK);
    paste_check_space(b);
    for (int32_t i = 0; i < c.face_count; ++i)
        for (int32_t k = c.first[i]; k < c.first[i + 1]; ++k)
        {
            const int32_t v = c.corners[k];
            const int32_t w =
                c.corners[k + 1 < c.first[i + 1] ? k + 1 : c.first[i]];
            const double side =
                otx_vec2_length(otx_vec2_sub(c.flat[v], c.flat[w]));

            assert_true(c.rim[v] >= 0.0f && c.rim[v] <= 1.0f);
            assert_true(fabsf(c.rim[v] - c.rim[w]) <= side / 4.0 + 1e-5);
            cut += c.rim[v] == 0.0f;
            whole += c.rim[v] == 1.0f;
        }
    assert_true(cut > 0 && whole > 0);
    /* Under its own outline nothing is cut off. */
    assert_int_equal(
        otx_lapped_rim(&b->l, &room, &(otx_radial){.feather = 1.0f}, &c),
        OSDTEX_OK);
    for (int32_t v = 0; v < c.vert_count; ++v)
        assert_float_equal(c.rim[v], 1.0, 0.0);
}

/* The border of the surface cuts nothing off: there is nothing beyond it. */
static void
the_end_of_the_surface_is_no_rim(void **state)
{
    paste_bench *b =
        paste_bench_create(*state, sheet_create(*state, 8, 8, SHEET_FLAT), 4.0);
    const otx_lapped_room room = paste_room(b);
    const otx_radial outline = paste_circle(60.0, 2.0);
    otx_lapped_chart c = paste_unfold(b, 0, &outline);

    assert_int_equal(c.face_count, 64);
    assert_int_equal(otx_lapped_rim(&b->l, &room, &outline, &c), OSDTEX_OK);
    for (int32_t v = 0; v < c.vert_count; ++v)
        assert_float_equal(c.rim[v], 1.0, 0.0);
}

static void
points_of_samples_are_on_the_surface(void **state)
{
    paste_bench *b =
        paste_bench_create(*state, sheet_create(*state, 4, 4, SHEET_FLAT), 4.0);
    const otx_lapped_seed seed = paste_seed(b, 5);
    const otx_vec3 p = otx_lapped_point(&b->l, &seed.place);

    /* Face (1, 1): half of corner 0, a quarter of 1 and of 2. */
    assert_float_equal(p.x, 1.5, 1e-6);
    assert_float_equal(p.y, 1.25, 1e-6);
    assert_float_equal(p.z, 0.0, 1e-6);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        test_with_run(what_unrolls_keeps_all_lengths),
        test_with_run(elsewhere_faces_keep_their_shape_or_are_left_out),
        test_with_run(charts_lie_along_the_field),
        test_with_run(a_piece_fades_where_its_chart_is_cut_off),
        test_with_run(the_end_of_the_surface_is_no_rim),
        test_with_run(points_of_samples_are_on_the_surface),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

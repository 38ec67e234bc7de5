/* test_streamline.c -- lines that follow the field and keep their distance. */
#include "field/streamline.h"
#include "unit/field/test_field.h"

static otx_direction
smoothest(otx_run *run, const field_surface *s, int32_t symmetry)
{
    const otx_direction_request q = {.symmetry = symmetry};
    otx_direction field;

    assert_int_equal(
        otx_direction_solve(run, &s->connection, &q, &field), OSDTEX_OK);
    return field;
}

static otx_streamline_set
trace(otx_run *run, const otx_direction *field, double spacing)
{
    otx_streamline_set set;

    if (otx_streamline_trace(run, field, spacing, 0.1 * spacing, &set) !=
        OSDTEX_OK)
        fail_msg("%s", test_last_message(run));
    return set;
}

/* Cosine of the least angle between a piece and the field of its face. */
static double
likeness(const otx_direction *field, const otx_streamline_piece *piece)
{
    const otx_connection *c = field->connection;
    const bool ahead = piece->along[1] > piece->along[0];
    const otx_vec2 d = otx_connection_project(
        c, piece->face,
        otx_vec3_unit(otx_vec3_sub(piece->ends[ahead], piece->ends[!ahead])));
    const double s = field->symmetry;
    const double off = remainder(
        atan2(d.y, d.x) - otx_direction_angle(field, piece->face),
        2.0 * OTX_PI / s);

    return cos(off);
}

/* Pieces of neighbours are lent to a face, and turn with the edge. */
static void
pieces_follow_the_field(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = field_torus(run, 24, 12);
    const field_surface *s = field_from_input(run, &in, 1);

    (void)state;
    for (int32_t symmetry = 1; symmetry <= 4; symmetry *= 2)
    {
        const otx_direction field = smoothest(run, s, symmetry);
        const otx_streamline_set set = trace(run, &field, 0.3);
        int32_t off = 0;

        assert_true(set.count > 1000);
        for (int32_t i = 0; i < set.count; ++i)
            off += likeness(&field, &set.pieces[i]) < 0.9;
        assert_true(off < set.count / 50);
    }
    test_run_destroy(run);
}

/* As much line as the spacing asks for: the area over it. */
static void
lines_fill_the_surface_evenly(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = field_torus(run, 24, 12);
    const field_surface *s = field_from_input(run, &in, 1);
    const otx_direction field = smoothest(run, s, 2);
    double last = 0.0;

    (void)state;
    for (double spacing = 0.4; spacing > 0.15; spacing /= 2.0)
    {
        otx_streamline_set set;
        double length = 0.0;

        /* A width of next to nothing: no piece is lent. */
        assert_int_equal(
            otx_streamline_trace(run, &field, spacing, 1e-9, &set), OSDTEX_OK);
        for (int32_t i = 0; i < set.count; ++i)
            length += fabs(set.pieces[i].along[1] - set.pieces[i].along[0]);
        length *= spacing / s->connection.area;
        assert_true(length > 0.6 && length < 2.5);
        last = length;
    }
    assert_true(last > 0.0);
    test_run_destroy(run);
}

static void
lengths_that_are_not_positive_are_refused(void **state)
{
    otx_run *run = test_run_create();
    const otx_cage_input in = mesh_cube(run);
    const field_surface *s = field_from_input(run, &in, 2);
    const otx_direction field = smoothest(run, s, 4);
    otx_streamline_set set;

    (void)state;
    assert_int_equal(
        otx_streamline_trace(run, &field, 0.0, 0.1, &set),
        OSDTEX_ERROR_ARGUMENT);
    assert_int_equal(
        otx_streamline_trace(run, &field, NAN, 0.1, &set),
        OSDTEX_ERROR_ARGUMENT);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_follow_the_field),
        cmocka_unit_test(lines_fill_the_surface_evenly),
        cmocka_unit_test(lengths_that_are_not_positive_are_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

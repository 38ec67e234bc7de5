/* bench_edit.c -- how long an artist waits for a field after an edit.
 *
 * A direction, a scale or a material is asked for at one face; it takes effect
 * on about a quarter of the surface, all else stays. Through the public header,
 * so that all that a host pays for is in it. */
#include "bench/bench_row.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include <osdtex/osdtex.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum
{
    SIDE = 32, /* 12 n^2 quads in the cage, 49 152 on its first level */
    TURNS = 5
};

typedef struct scene
{
    osdtex_context *context;
    osdtex_cage *cage;
    osdtex_surface *surface;
    osdtex_field *field;
    double reach;
} scene;

static osdtex_status
create_cage(const bench_options *options, scene *s)
{
    osdtex_context_options how = osdtex_context_options_default();
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();
    osdtex_index *sizes;
    osdtex_status status;
    otx_cage cage;
    otx_run run;

    how.threads = options->threads;
    status = osdtex_context_create(&how, &s->context);
    if (status != OSDTEX_OK || bench_workspace_open(&run, 1) != OSDTEX_OK)
        return OSDTEX_ERROR_MEMORY;
    status = bench_shapes_sphere(&run, SIDE, false, &cage);
    sizes = OTX_NEW(run.arena, osdtex_index, cage.face_count);
    for (int32_t f = 0; sizes && f < cage.face_count; ++f)
        sizes[f] = 4;
    arrays.vert_count = cage.vert_count;
    arrays.face_count = cage.face_count;
    arrays.points = cage.points;
    arrays.face_sizes = sizes;
    arrays.face_verts = cage.face_verts;
    if (status == OSDTEX_OK && sizes)
        status = osdtex_cage_create(s->context, &arrays, NULL, &s->cage);
    bench_workspace_close(&run);
    return status;
}

static bool
open_scene(const bench_options *options, scene *s)
{
    osdtex_surface_options refine = osdtex_surface_options_default();
    osdtex_field_options asked = osdtex_field_options_default();

    *s = (scene){0};
    refine.level = 1;
    asked.octaves = 0.5;
    asked.symmetry = 2;
    if (create_cage(options, s) != OSDTEX_OK ||
        osdtex_surface_refine(s->context, s->cage, &refine, &s->surface) !=
            OSDTEX_OK)
        return false;
    /* A cap of a quarter of a sphere reaches 60 degrees; ways along faces are
     * some longer than geodesics. */
    s->reach = 1.3 * OTX_PI / 3.0 * 0.5 *
               osdtex_cage_describe(s->cage)->diagonal / sqrt(3.0);
    return osdtex_field_create(s->context, s->surface, &asked, &s->field) ==
           OSDTEX_OK;
}

static void
close_scene(scene *s)
{
    osdtex_field_destroy(s->field);
    osdtex_surface_destroy(s->surface);
    osdtex_cage_destroy(s->cage);
    osdtex_context_destroy(s->context);
}

/* Share of the faces or vertices that an edit has changed. */
static double
changed(const osdtex_field_info *a, const osdtex_field_info *b, int kind)
{
    const float *before = kind == 0   ? a->directions
                          : kind == 1 ? a->scales
                                      : a->materials;
    const float *after = kind == 0   ? b->directions
                         : kind == 1 ? b->scales
                                     : b->materials;
    const int32_t count = kind == 0 ? a->face_count : a->vert_count;
    const size_t width = kind == 0 ? 3 : 1;
    int32_t sum = 0;

    for (int32_t i = 0; i < count; ++i)
        sum += memcmp(
                   before + width * (size_t)i, after + width * (size_t)i,
                   width * sizeof(float)) != 0;
    return (double)sum / count;
}

static bool
time_edit(const scene *s, int kind, int32_t turns, bench_report *report)
{
    static const char *const names[] = {"direction", "scale", "material"};
    osdtex_constraint c = osdtex_constraint_none();
    double cpu = INFINITY, wall = INFINITY, share = 0.0;

    c.face = 7;
    c.direction[0] = c.direction[1] = kind == 0 ? 1.0 : 0.0;
    c.direction[2] = kind == 0 ? -0.5 : 0.0;
    c.scale = kind == 1 ? 2.0 : 0.0;
    c.has_material = kind == 2;
    c.material = 0.5;
    for (int32_t i = 0; i < turns; ++i)
    {
        const bench_time since = bench_stopwatch_now();
        osdtex_field *edited;
        bench_time spent;

        if (osdtex_field_edit(s->context, s->field, &c, s->reach, &edited) !=
            OSDTEX_OK)
            return false;
        spent = bench_stopwatch_since(since);
        cpu = fmin(cpu, spent.cpu);
        wall = fmin(wall, spent.wall);
        share = changed(
            osdtex_field_describe(s->field), osdtex_field_describe(edited),
            kind);
        osdtex_field_destroy(edited);
    }
    bench_report_row(
        report, names[kind],
        (double[]){
            osdtex_surface_describe(s->surface)->face_count, share, cpu, wall});
    return true;
}

static bool
time_edits(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {"edit of",       "faces",
                                          "share changed", "processor, s",
                                          "elapsed, s",    NULL};
    bool right;
    scene s;

    bench_report_begin(
        report, "edit: one constraint more on a field, best of its turns",
        columns);
    right = open_scene(options, &s);
    for (int kind = 0; kind < 3 && right; ++kind)
        right = time_edit(&s, kind, bench_row_repeat(options, TURNS), report);
    close_scene(&s);
    return right;
}

const bench_row bench_row_edit = {
    .name = "edit",
    .summary = "A direction, scale or material edited on a quarter of 49 152 "
               "faces.",
    .time = time_edits,
};

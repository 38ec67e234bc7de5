/* bench_bake.c -- one map and five maps of a material baked from one mapping,
 * by turns: what a colour costs alone, and what the others cost besides.
 *
 * All is written to files, compressed, with every mip level. */
#include "bench/bench_row.h"
#include "bench/patterns.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include "export/look.h"
#include "file/picture_read.h"
#include "method/method.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum
{
    SPHERE = 12, /* 864 faces */
    LEVEL = 2,
    EXEMPLAR = 256,
    SIDE = 1024,
    LARGE_SIDE = 4096,
    MAPS = 4, /* besides the colour */
    USUAL_TURNS = 3
};

static const otx_companion_kind KINDS[MAPS] = {
    OTX_COMPANION_NORMAL, OTX_COMPANION_ROUGHNESS, OTX_COMPANION_HEIGHT,
    OTX_COMPANION_OCCLUSION};

typedef struct scene
{
    otx_run run;
    otx_surface surface;
    otx_mapping mapping;
    otx_exemplar exemplar;
    otx_companions maps;
    char folder[64];
} scene;

/* One bake of it. */
typedef struct baking
{
    scene *s;
    int32_t side;
    bool with_maps;
    double peak; /* resident bytes beyond what stood before */
} baking;

/* Maps made of the picture: any numbers will do. */
static otx_status
make_maps(scene *s, const otx_image *pixels)
{
    otx_companion_input inputs[MAPS];
    otx_image normals;
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;

    OTX_TRY(otx_image_create(
        &s->run, s->run.arena, pixels->width, pixels->height, 3, &normals));
    for (size_t i = 0; i < count; ++i)
        normals.pixels[i] =
            i % 3 == 2 ? 0.95f : 0.35f + 0.3f * pixels->pixels[i];
    for (int k = 0; k < MAPS; ++k)
        inputs[k] = (otx_companion_input){
            .kind = KINDS[k],
            .pixels = KINDS[k] == OTX_COMPANION_NORMAL ? normals : *pixels,
            .is_float = true,
            .bits = 32};
    return otx_companions_build(
        &s->run, inputs, MAPS, pixels->width, pixels->height, true, true,
        &s->maps);
}

static otx_status
map(scene *s)
{
    const otx_method *method = otx_method_find("hierarchical");
    void *settings = otx_arena_zalloc(s->run.arena, 1, method->settings_bytes);
    const otx_map_request request = {
        .first_face = -1, .scale = 0.2 * s->surface.cage->diagonal};
    otx_figures figures;

    if (!settings)
        return OSDTEX_ERROR_MEMORY;
    otx_option_defaults(method->options, method->option_count, settings);
    return otx_method_map(
        method,
        &(otx_job){
            .run = &s->run,
            .surface = &s->surface,
            .exemplars = &s->exemplar,
            .exemplar_count = 1,
            .request = &request,
            .settings = settings,
            .figures = &figures,
        },
        &s->mapping);
}

static otx_status
fill(scene *s)
{
    otx_cage *cage = OTX_NEW(s->run.arena, otx_cage, 1);
    otx_image pixels;

    OTX_TRY(otx_run_ok(&s->run));
    OTX_TRY(bench_shapes_sphere(&s->run, SPHERE, true, cage));
    OTX_TRY(otx_surface_refine(&s->run, cage, LEVEL, 0, &s->surface));
    OTX_TRY(bench_patterns_pebbles(&s->run, EXEMPLAR, &pixels));
    OTX_TRY(make_maps(s, &pixels));
    OTX_TRY(bench_patterns_exemplar(&s->run, &pixels, &s->exemplar));
    return map(s);
}

static void
close_scene(scene *s)
{
    char command[160];

    bench_workspace_close(&s->run);
    snprintf(command, sizeof command, "rm -r '%s'", s->folder);
    if (system(command) != 0)
        fprintf(stderr, "%s is left\n", s->folder);
}

static otx_status
open_scene(scene *s, int32_t threads)
{
    otx_status status;

    *s = (scene){.folder = "/tmp/osdtex-bench-XXXXXX"};
    OTX_TRY(bench_workspace_open(&s->run, threads));
    if (!mkdtemp(s->folder))
    {
        bench_workspace_close(&s->run);
        return OSDTEX_ERROR_IO;
    }
    status = fill(s);
    if (status != OSDTEX_OK)
        close_scene(s);
    return status;
}

/* Where its files go. */
static void
name(const baking *b, const char *end, char path[128])
{
    snprintf(
        path, 128, "%s/%s%s", b->s->folder, b->with_maps ? "five" : "one", end);
}

static otx_status
bake_within(otx_run *run, const baking *b)
{
    const otx_layout_options place = {
        .source = OTX_LAYOUT_ATLAS, .side = b->side};
    otx_exemplar exemplar = b->s->exemplar;
    otx_layout layout;
    char path[128];

    name(b, ".obj", path);
    if (b->with_maps)
        exemplar.companions = b->s->maps;
    OTX_TRY(otx_layout_build(run, &b->s->mapping, &place, &layout));
    return otx_look_write(
        run, &b->s->mapping, &exemplar, &layout,
        &(otx_look_options){
            .path = path, .extras = {[OTX_TEXEL_COLOR] = true}});
}

static otx_status
bake(void *context)
{
    baking *b = context;
    const otx_arena_mark mark = otx_arena_here(b->s->run.arena);
    otx_status status;

    bench_workspace_reset_peak();
    b->peak = -bench_workspace_peak();
    status = bake_within(&b->s->run, b);
    b->peak += bench_workspace_peak();
    otx_arena_release(b->s->run.arena, mark);
    return status;
}

static otx_status
time_side(
    const bench_options *options, bench_report *report, scene *s, int32_t side)
{
    baking jobs[] = {
        {.s = s, .side = side}, {.s = s, .side = side, .with_maps = true}};
    bench_lane lanes[] = {
        {.body = bake, .context = &jobs[0]},
        {.body = bake, .context = &jobs[1]}};
    static const char *const labels[] = {"colour", "colour and four maps"};

    OTX_TRY(
        bench_stopwatch_race(lanes, 2, bench_row_repeat(options, USUAL_TURNS)));
    for (int l = 0; l < 2; ++l)
    {
        const double values[] = {
            side,
            lanes[l].best.wall,
            lanes[l].best.cpu,
            1e-6 * jobs[l].peak,
            lanes[l].best.cpu / lanes[0].best.cpu,
            jobs[l].peak / jobs[0].peak};

        bench_report_row(report, labels[l], values);
    }
    return OSDTEX_OK;
}

static bool
time_bake(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "maps",      "side",      "wall s",        "cpu s",
        "MB beyond", "times one", "MB, times one", NULL};
    otx_status status;
    scene s;

    if (open_scene(&s, options->threads) != OSDTEX_OK)
        return false;
    bench_report_begin(
        report, "bake: a material from one mapping (all threads)", columns);
    status = time_side(options, report, &s, SIDE);
    if (status == OSDTEX_OK && options->large)
        status = time_side(options, report, &s, LARGE_SIDE);
    close_scene(&s);
    return status == OSDTEX_OK;
}

/* Whether two files are the same. */
static bool
is_same(otx_run *run, const char *a, const char *b)
{
    otx_picture p, q;

    return otx_picture_read(run, a, &p) == OSDTEX_OK &&
           otx_picture_read(run, b, &q) == OSDTEX_OK &&
           p.image.width == q.image.width &&
           memcmp(
               p.image.pixels, q.image.pixels,
               3 * (size_t)p.image.width * (size_t)p.image.height *
                   sizeof *p.image.pixels) == 0;
}

static bool
verify_bake(const bench_options *options)
{
    char one[128], five[128];
    bool right = false;
    scene s;

    if (open_scene(&s, options->threads) != OSDTEX_OK)
        return false;

    baking jobs[] = {
        {.s = &s, .side = SIDE}, {.s = &s, .side = SIDE, .with_maps = true}};

    name(&jobs[0], ".1001.exr", one);
    name(&jobs[1], ".1001.exr", five);
    right = bench_row_check(
        bake(&jobs[0]) == OSDTEX_OK && bake(&jobs[1]) == OSDTEX_OK &&
            is_same(&s.run, one, five),
        "bake: the colour is the same with and without maps");
    close_scene(&s);
    return right;
}

const bench_row bench_row_bake = {
    .name = "bake",
    .summary = "A colour alone and a material of five maps, from one mapping; "
               "--large: of 4096 x 4096.",
    .time = time_bake,
    .verify = verify_bake,
};

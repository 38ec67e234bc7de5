/* bench_exr.c -- the EXR writer against the programs that make textures.
 *
 * All write one tiled, mip-mapped half file, ZIP compressed, of the same
 * pixels: maketx and exrmaketiled of an uncompressed EXR, ours of plain floats,
 * row after row as a bake makes them, and of the EXR read as a whole. Each is
 * a process of its own, whose processor time and peak memory the system tells.
 */
#include "bench/bench_row.h"
#include "bench/patterns.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include "file/exr.h"
#include "file/picture_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum
{
    SIDE = 4096,
    PATTERN = 1024,
    CHANNELS = 3,
    USUAL_TURNS = 3,
    WORDS_MAX = 16,
    NOT_THERE = 127 /* what a shell says, too */
};

typedef struct scene
{
    int32_t threads;
    char folder[64];
    char packed[96], flat[96], raw[96], ours[96], theirs[96];
} scene;

/* What a process took. */
typedef struct cost
{
    double wall, cpu, peak; /* seconds, seconds, megabytes */
    bool known;
} cost;

/* ---- processes -----------------------------------------------------------
 */

typedef otx_status (*task)(otx_run *run, const scene *s);

static int
do_task(task body, const scene *s)
{
    otx_run run;
    otx_status status = bench_workspace_open(&run, s->threads);

    if (status == OSDTEX_OK)
        status = body(&run, s);
    bench_workspace_close(&run);
    return status == OSDTEX_OK ? 0 : 1;
}

static int
do_program(const char *const *words)
{
    char *list[WORDS_MAX];
    int count = 0;

    /* execvp changes no word, though its type does not say so. */
    for (; words[count]; ++count)
        list[count] = (char *)(uintptr_t)words[count];
    list[count] = NULL;
    if (!freopen("/dev/null", "w", stdout))
        return 1;
    execvp(list[0], list);
    return NOT_THERE;
}

/* Runs a task, or where there is none, a program: its exit code. */
static int
spend(task body, const char *const *words, const scene *s, cost *out)
{
    const bench_time start = bench_stopwatch_now();
    struct rusage usage;
    int status;

    fflush(stdout);

    const pid_t child = fork();

    if (child == 0)
        _exit(body ? do_task(body, s) : do_program(words));
    if (child < 0 || wait4(child, &status, 0, &usage) != child ||
        !WIFEXITED(status))
        return 1;

    const cost now = {
        bench_stopwatch_since(start).wall,
        (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
            1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
        1e-3 * 1.024 * (double)usage.ru_maxrss, true};

    out->wall = out->known ? fmin(out->wall, now.wall) : now.wall;
    out->cpu = out->known ? fmin(out->cpu, now.cpu) : now.cpu;
    out->peak = out->known ? fmin(out->peak, now.peak) : now.peak;
    out->known = true;
    return WEXITSTATUS(status);
}

/* ---- ours ----------------------------------------------------------------
 */

static otx_status
write_image(otx_run *run, const otx_image *image, const char *path, bool tiled)
{
    otx_exr_options options = otx_exr_options_default();
    otx_atomic_file_set *set;

    options.tiled = tiled;
    OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    OTX_TRY(otx_exr_write(run, set, path, image, &options));
    return otx_atomic_file_commit(run, set, false);
}

static otx_status
write_whole(otx_run *run, const scene *s)
{
    otx_picture picture;

    OTX_TRY(otx_picture_read(run, s->flat, &picture));
    return write_image(run, &picture.image, s->ours, true);
}

/* A row of tiles. Rows of texels from the top. */
typedef struct strip
{
    const otx_exr_writer *writer;
    int32_t level, y;
    int32_t side, rows; /* texels of the level, and of the strip */
    const float *texels;
    float *below; /* the same of the next level */
    otx_exr_chunk chunks[SIDE / OTX_EXR_TILE];
} strip;

/* The texels of a tile to half their number. */
static void
halve(const strip *t, int32_t first, int32_t end)
{
    const size_t row = (size_t)t->side * CHANNELS;

    for (int32_t y = 0; y < t->rows / 2; ++y)
        for (int32_t x = first / 2; x < end / 2; ++x)
            for (int32_t c = 0; c < CHANNELS; ++c)
            {
                const float *p = t->texels + 2 * (size_t)y * row +
                                 2 * (size_t)x * CHANNELS + c;

                t->below[(size_t)y * (row / 2) + (size_t)x * CHANNELS + c] =
                    0.25f * (p[0] + p[CHANNELS] + p[row] + p[row + CHANNELS]);
            }
}

static otx_status
pack_tile(void *context, int64_t index, otx_worker *worker)
{
    strip *t = context;
    const int32_t x = (int32_t)index;
    const int32_t first = x * OTX_EXR_TILE;
    const int32_t end =
        first + (t->side < OTX_EXR_TILE ? t->side : OTX_EXR_TILE);
    const size_t row = (size_t)t->side * CHANNELS;

    if (t->side > 1)
        halve(t, first, end);
    otx_exr_pack(
        t->writer, worker->index, t->level, x, t->y,
        t->texels + (size_t)(t->rows - 1) * row + (size_t)first * CHANNELS,
        -(ptrdiff_t)row, &t->chunks[x]);
    return OSDTEX_OK;
}

static otx_status
put_strip(otx_run *run, otx_exr_writer *writer, strip *t)
{
    const int32_t columns = (t->side + OTX_EXR_TILE - 1) / OTX_EXR_TILE;

    OTX_TRY(otx_pool_for(run->pool, columns, pack_tile, t));
    for (int32_t x = 0; x < columns; ++x)
        OTX_TRY(otx_exr_put(writer, t->level, x, t->y, &t->chunks[x]));
    return OSDTEX_OK;
}

/* All strips of a level, from `from`, or where that is NULL, from the file. */
static otx_status
put_level(
    otx_run *run, otx_exr_writer *writer, strip *t, const float *from,
    float *below, FILE *file)
{
    const size_t row = (size_t)t->side * CHANNELS;
    float *texels = OTX_NEW(run->scratch, float, from ? 1 : row *OTX_EXR_TILE);

    if (!texels)
        return OSDTEX_ERROR_MEMORY;
    t->rows = t->side < OTX_EXR_TILE ? t->side : OTX_EXR_TILE;
    for (t->y = 0; t->y * OTX_EXR_TILE < t->side; ++t->y)
    {
        const size_t strips = (size_t)t->y * row * OTX_EXR_TILE;

        if (!from && fread(texels, sizeof *texels * row, OTX_EXR_TILE, file) !=
                         OTX_EXR_TILE)
            return OSDTEX_ERROR_IO;
        t->texels = from ? from + strips : texels;
        t->below = below + strips / 4;
        OTX_TRY(put_strip(run, writer, t));
    }
    return OSDTEX_OK;
}

static otx_status
put_levels(otx_run *run, otx_exr_writer *writer, FILE *file)
{
    const size_t half = SIDE / 2;
    float *from = NULL;
    float *below = OTX_NEW(run->scratch, float, half *half *CHANNELS * 4 / 3);
    strip *t = OTX_ZNEW(run->scratch, strip, 1);

    if (!below || !t)
        return OSDTEX_ERROR_MEMORY;
    t->writer = writer;
    for (int32_t x = 0; x < SIDE / OTX_EXR_TILE; ++x)
    {
        t->chunks[x].bytes =
            OTX_NEW(run->scratch, uint8_t, otx_exr_packed_bytes(writer));
        if (!t->chunks[x].bytes)
            return OSDTEX_ERROR_MEMORY;
    }
    for (t->side = SIDE; t->side > 0; t->side /= 2, ++t->level)
    {
        OTX_TRY(put_level(run, writer, t, from, below, file));
        from = below;
        below += (size_t)t->side * (size_t)t->side * CHANNELS / 4;
    }
    return otx_exr_end(writer);
}

static otx_status
write_rows(otx_run *run, const scene *s)
{
    const otx_exr_options options = otx_exr_options_default();
    otx_atomic_file_set *set;
    otx_exr_writer *writer;
    FILE *file = fopen(s->raw, "rb");
    otx_status status;

    if (!file)
        return OSDTEX_ERROR_IO;
    status = otx_atomic_file_begin(run, run->scratch, &set);
    if (status == OSDTEX_OK)
        status = otx_exr_begin(
            run, set, s->ours, (otx_exr_size){SIDE, SIDE, CHANNELS}, &options,
            &writer);
    if (status == OSDTEX_OK)
        status = put_levels(run, writer, file);
    if (status == OSDTEX_OK)
        status = otx_atomic_file_commit(run, set, false);
    fclose(file);
    return status;
}

/* ---- the pixels ----------------------------------------------------------
 */

static otx_status
write_raw(const otx_image *image, const char *path)
{
    const size_t row = (size_t)image->width * CHANNELS;
    FILE *file = fopen(path, "wb");
    bool ok = file;

    for (int32_t y = image->height - 1; ok && y >= 0; --y)
        ok = fwrite(otx_image_at(image, 0, y), sizeof(float), row, file) == row;
    return file && fclose(file) == 0 && ok ? OSDTEX_OK : OSDTEX_ERROR_IO;
}

/* The pebbles over and over: each tile is packed by itself. */
static otx_status
make_pixels(otx_run *run, const scene *s)
{
    otx_image pattern, image;
    otx_picture back;

    OTX_TRY(bench_patterns_pebbles(run, PATTERN, &pattern));
    OTX_TRY(otx_image_create(run, run->arena, SIDE, SIDE, CHANNELS, &image));
    for (int32_t y = 0; y < SIDE; ++y)
        for (int32_t x = 0; x < SIDE; x += PATTERN)
            memcpy(
                otx_image_at(&image, x, y),
                otx_image_at(&pattern, 0, y % PATTERN),
                PATTERN * CHANNELS * sizeof(float));
    OTX_TRY(write_image(run, &image, s->packed, false));
    /* What half makes of them. */
    OTX_TRY(otx_picture_read(run, s->packed, &back));
    return write_raw(&back.image, s->raw);
}

static void
scene_close(const scene *s)
{
    unlink(s->packed);
    unlink(s->flat);
    unlink(s->raw);
    unlink(s->ours);
    unlink(s->theirs);
    rmdir(s->folder);
}

static bool
scene_open(scene *s, int32_t threads)
{
    *s = (scene){.threads = threads, .folder = "/tmp/osdtex-bench-XXXXXX"};
    if (!mkdtemp(s->folder))
        return false;
    snprintf(s->packed, sizeof s->packed, "%s/packed.exr", s->folder);
    snprintf(s->flat, sizeof s->flat, "%s/flat.exr", s->folder);
    snprintf(s->raw, sizeof s->raw, "%s/pixels", s->folder);
    snprintf(s->ours, sizeof s->ours, "%s/ours.exr", s->folder);
    snprintf(s->theirs, sizeof s->theirs, "%s/theirs.exr", s->folder);

    const char *const flatten[] = {
        "oiiotool", s->packed, "--compression", "none", "-o", s->flat, NULL};
    cost unused = {0};

    if (spend(make_pixels, NULL, s, &unused) == 0 &&
        spend(NULL, flatten, s, &unused) == 0)
        return true;
    fprintf(stderr, "osdtex-bench: exr: oiiotool is needed for the pixels\n");
    scene_close(s);
    return false;
}

/* ---- the row -------------------------------------------------------------
 */

typedef struct contender
{
    const char *label;
    task body;
    const char *words[WORDS_MAX];
    cost cost;
} contender;

static bool
race(const scene *s, contender *all, int32_t count, int32_t turns)
{
    for (int32_t turn = 0; turn < turns; ++turn)
        for (int32_t i = 0; i < count; ++i)
        {
            const int code = spend(all[i].body, all[i].words, s, &all[i].cost);

            if (code == 0)
                continue;
            fprintf(stderr, "osdtex-bench: exr: %s: %d\n", all[i].label, code);
            return false;
        }
    return true;
}

static bool
time_exr(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "writer",     "wall s",        "cpu s", "MB at the peak",
        "cpu / ours", "memory / ours", NULL};
    scene s;

    if (!scene_open(&s, options->threads))
        return false;

    contender all[] = {
        {.label = "osdtex, row after row", .body = write_rows},
        {.label = "osdtex, the EXR as a whole", .body = write_whole},
        {.label = "maketx",
         .words =
             {"maketx", "--format", "openexr", "-d", "half", "--compression",
              "zip", "-o", s.theirs, s.flat, NULL}},
        {.label = "exrmaketiled",
         .words = {
             "exrmaketiled", "-m", "-t", "64", "64", "-z", "zip", s.flat,
             s.theirs, NULL}}};
    const int32_t count = sizeof all / sizeof *all;
    const bool done =
        race(&s, all, count, bench_row_repeat(options, USUAL_TURNS));

    if (done)
        bench_report_begin(
            report, "exr: 4096 x 4096, half, ZIP, mip-mapped", columns);
    for (int32_t i = 0; done && i < count; ++i)
    {
        const cost *c = &all[i].cost;

        bench_report_row(
            report, all[i].label,
            (const double[]){
                c->wall, c->cpu, c->peak, c->cpu / all[0].cost.cpu,
                c->peak / all[0].cost.peak});
    }
    scene_close(&s);
    return done;
}

/* Whether level 0 reads back. */
static otx_status
compare_files(otx_run *run, const scene *s)
{
    otx_picture pixels, back;

    OTX_TRY(write_rows(run, s));
    OTX_TRY(otx_picture_read(run, s->ours, &back));
    OTX_TRY(otx_picture_read(run, s->packed, &pixels));
    return memcmp(
               pixels.image.pixels, back.image.pixels,
               sizeof(float) * CHANNELS * SIDE * SIDE) == 0
               ? OSDTEX_OK
               : OSDTEX_ERROR_NUMERIC;
}

static bool
verify_exr(const bench_options *options)
{
    cost unused = {0};
    scene s;
    bool right;

    if (!scene_open(&s, options->threads))
        return false;
    right = bench_row_check(
        spend(compare_files, NULL, &s, &unused) == 0,
        "exr: what is written row after row reads back bit for bit");
    scene_close(&s);
    return right;
}

const bench_row bench_row_exr = {
    .name = "exr",
    .summary = "The EXR writer beside maketx and exrmaketiled.",
    .time = time_exr,
    .verify = verify_exr,
};

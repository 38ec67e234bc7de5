/* bench_write.c -- writing a mapping's files, against what plain C would take.
 *
 * The OBJ is compared with fprintf("%.9g") of the same lines, which is how many
 * writers do it, and longer in the file; the EXR with nothing but its size:
 * compression is nearly all of its time. Nothing waits for the disk. */
#include "bench/bench_row.h"
#include "bench/patterns.h"
#include "bench/shapes.h"
#include "bench/stopwatch.h"
#include "bench/workspace.h"

#include "file/exr.h"
#include "file/obj_write.h"
#include "file/picture_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    SPHERE = 16,
    LEVEL = 3, /* 196 608 faces */
    PICTURE = 2048,
    USUAL_TURNS = 5
};

typedef struct files
{
    otx_run run;
    otx_obj obj;
    otx_image image;
    char folder[64];
    char ours[96], plain[96], exr[96];
} files;

/* The leaf level of a sphere with its face-varying UVs. */
static otx_status
make_obj(files *f)
{
    otx_cage *cage = OTX_NEW(f->run.arena, otx_cage, 1);
    otx_surface surface;

    if (!cage)
        return OSDTEX_ERROR_MEMORY;
    OTX_TRY(bench_shapes_sphere(&f->run, SPHERE, true, cage));
    OTX_TRY(otx_surface_refine(&f->run, cage, LEVEL, 0, &surface));
    const otx_level *leaf = otx_surface_leaf(&surface);

    f->obj = (otx_obj){
        .path = f->ours,
        .vert_count = leaf->vert_count,
        .uv_count = surface.uv_count,
        .face_count = leaf->face_count,
        .corner_count = leaf->corner_count,
        .points = surface.points,
        .uvs = surface.uvs,
        .face_first = leaf->face_first,
        .face_verts = leaf->face_verts,
        .face_uvs = surface.face_uvs,
        .boundary = OTX_OBJ_NO_RULE,
        .fvar = OTX_OBJ_NO_RULE,
        .crease_method = OTX_OBJ_NO_RULE,
        .triangles = OTX_OBJ_NO_RULE,
    };
    return OSDTEX_OK;
}

static void
files_close(files *f)
{
    unlink(f->ours);
    unlink(f->plain);
    unlink(f->exr);
    rmdir(f->folder);
    bench_workspace_close(&f->run);
}

static otx_status
files_open(files *f, int32_t threads)
{
    otx_status status;

    *f = (files){.folder = "/tmp/osdtex-bench-XXXXXX"};
    OTX_TRY(bench_workspace_open(&f->run, threads));
    if (!mkdtemp(f->folder))
    {
        bench_workspace_close(&f->run);
        return OSDTEX_ERROR_IO;
    }
    snprintf(f->ours, sizeof f->ours, "%s/ours.obj", f->folder);
    snprintf(f->plain, sizeof f->plain, "%s/plain.obj", f->folder);
    snprintf(f->exr, sizeof f->exr, "%s/ours.exr", f->folder);
    status = make_obj(f);
    if (status == OSDTEX_OK)
        status = bench_patterns_pebbles(&f->run, PICTURE, &f->image);
    if (status != OSDTEX_OK)
        files_close(f);
    return status;
}

static otx_status
write_obj(void *context)
{
    files *f = context;

    return otx_obj_write(&f->run, &f->obj, f->ours, NULL);
}

static otx_status
write_plainly(void *context)
{
    const files *f = context;
    const otx_obj *obj = &f->obj;
    FILE *file = fopen(f->plain, "w");

    if (!file)
        return OSDTEX_ERROR_IO;
    for (int32_t v = 0; v < obj->vert_count; ++v)
    {
        const float *p = obj->points + 3 * (size_t)v;

        fprintf(
            file, "v %.9g %.9g %.9g\n", (double)p[0], (double)p[1],
            (double)p[2]);
    }
    for (int32_t i = 0; i < obj->uv_count; ++i)
        fprintf(
            file, "vt %.9g %.9g\n", (double)obj->uvs[2 * (size_t)i],
            (double)obj->uvs[2 * (size_t)i + 1]);
    for (int32_t t = 0; t < obj->face_count; ++t)
    {
        fputc('f', file);
        for (int32_t c = obj->face_first[t]; c < obj->face_first[t + 1]; ++c)
            fprintf(
                file, " %d/%d", obj->face_verts[c] + 1, obj->face_uvs[c] + 1);
        fputc('\n', file);
    }
    return fclose(file) == 0 ? OSDTEX_OK : OSDTEX_ERROR_IO;
}

static otx_status
write_exr(void *context)
{
    files *f = context;
    otx_run *run = &f->run;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_exr_options options = otx_exr_options_default();
    otx_atomic_file_set *set;
    otx_status status;

    OTX_TRY(otx_atomic_file_begin(run, run->scratch, &set));
    status = otx_exr_write(run, set, f->exr, &f->image, &options);
    if (status == OSDTEX_OK)
        status = otx_atomic_file_commit(run, set, false);
    otx_arena_release(run->scratch, mark);
    return status;
}

static double
megabytes(const char *path)
{
    struct stat info;

    return stat(path, &info) == 0 ? 1e-6 * (double)info.st_size : NAN;
}

static bool
time_write(const bench_options *options, bench_report *report)
{
    static const char *const columns[] = {
        "file", "MB", "wall s", "cpu s", "MB a second", "plain C / ours", NULL};
    otx_status status;
    files f;

    if (files_open(&f, options->threads) != OSDTEX_OK)
        return false;
    bench_lane lanes[] = {
        {.body = write_obj, .context = &f},
        {.body = write_plainly, .context = &f},
        {.body = write_exr, .context = &f}};
    const char *const paths[] = {f.ours, f.plain, f.exr};
    static const char *const labels[] = {
        "OBJ, 196 608 faces", "the same by fprintf",
        "EXR, 2048 x 2048, half, ZIP, mip-mapped"};

    status =
        bench_stopwatch_race(lanes, 3, bench_row_repeat(options, USUAL_TURNS));
    if (status == OSDTEX_OK)
        bench_report_begin(
            report, "write: a mapping's files (all threads)", columns);
    for (int l = 0; l < 3 && status == OSDTEX_OK; ++l)
    {
        const double values[] = {
            megabytes(paths[l]),
            lanes[l].best.wall,
            lanes[l].best.cpu,
            megabytes(paths[l]) / lanes[l].best.wall,
            l == 0 ? lanes[1].best.cpu / lanes[0].best.cpu : NAN,
        };

        bench_report_row(report, labels[l], values);
    }
    files_close(&f);
    return status == OSDTEX_OK;
}

/* Whether what was written reads back as the same floats. */
static bool
obj_is_identical(files *f)
{
    const otx_obj *obj = &f->obj;
    otx_obj back;

    return write_obj(f) == OSDTEX_OK &&
           otx_obj_read(&f->run, f->ours, &back) == OSDTEX_OK &&
           back.vert_count == obj->vert_count &&
           back.corner_count == obj->corner_count &&
           memcmp(
               back.points, obj->points,
               3 * (size_t)obj->vert_count * sizeof(float)) == 0 &&
           memcmp(
               back.face_uvs, obj->face_uvs,
               (size_t)obj->corner_count * sizeof(int32_t)) == 0;
}

/* Largest relative difference after the trip through half; INFINITY when it
 * does not read back. */
static double
exr_difference(files *f)
{
    double largest = 0.0;
    otx_picture back;

    if (write_exr(f) != OSDTEX_OK ||
        otx_picture_read(&f->run, f->exr, &back) != OSDTEX_OK ||
        back.image.width != PICTURE || back.image.height != PICTURE)
        return INFINITY;
    for (size_t i = 0; i < 3 * (size_t)PICTURE * PICTURE; ++i)
    {
        const double a = (double)f->image.pixels[i];

        largest = fmax(
            largest, fabs((double)back.image.pixels[i] - a) / fmax(a, 1e-4));
    }
    return largest;
}

static bool
verify_write(const bench_options *options)
{
    double difference;
    bool right;
    files f;

    if (files_open(&f, options->threads) != OSDTEX_OK)
        return false;
    right = bench_row_check(
        obj_is_identical(&f), "write: the OBJ reads back bit for bit");
    difference = exr_difference(&f);
    /* Half has eleven bits of mantissa. */
    right &= bench_row_check(
        difference <= 0x1p-11,
        "write: the EXR reads back within half a unit of half, %.2g",
        difference);
    files_close(&f);
    return right;
}

const bench_row bench_row_write = {
    .name = "write",
    .summary = "Writing OBJ and EXR.",
    .time = time_write,
    .verify = verify_write,
};

/* overlay.c -- lines and dots drawn on a model. */
#include "render/overlay.h"

#include "base/csr.h"

#include <string.h>

static const float INK[3] = {0.010f, 0.018f, 0.045f};
static const float RED[3] = {0.62f, 0.035f, 0.015f};
static const float BLUE[3] = {0.02f, 0.07f, 0.55f};
static const float PALE[3] = {0.85f, 0.85f, 0.85f};

/* -- what is on which face ----------------------------------------------- */

static otx_status
index_lines(otx_run *run, const otx_scene *scene, otx_overlay_index *out)
{
    const otx_overlay *o = out->overlay;
    int32_t *first =
        OTX_ZNEW(run->scratch, int32_t, (size_t)scene->face_count + 2);
    int32_t *lines = OTX_NEW(run->scratch, int32_t, o->line_count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < o->line_count; ++i)
    {
        if (o->lines[i].face < 0 || o->lines[i].face >= scene->face_count)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, "render", OTX_NOWHERE,
                "a line lies on a face that is not there");
        otx_csr_count(first, o->lines[i].face, 1);
    }
    otx_csr_sum(first, scene->face_count);
    for (int32_t i = 0; i < o->line_count; ++i)
        lines[otx_csr_place(first, o->lines[i].face)] = i;
    out->face_first_line = first;
    out->face_lines = lines;
    return OSDTEX_OK;
}

/* Whether a dot may reach a face: by the ball around the face's corners. */
static bool
reaches(const otx_scene *scene, int32_t face, otx_vec3 dot, double radius)
{
    const int32_t first = scene->face_first[face];
    const int32_t end = scene->face_first[face + 1];
    otx_vec3 middle = {0, 0, 0};
    double reach = 0.0;

    for (int32_t c = first; c < end; ++c)
        middle = otx_vec3_mix(
            1.0, middle, 1.0 / (end - first),
            otx_vec3_load(scene->points, scene->face_verts[c]));
    for (int32_t c = first; c < end; ++c)
        reach = fmax(
            reach,
            otx_vec3_length(otx_vec3_sub(
                otx_vec3_load(scene->points, scene->face_verts[c]), middle)));
    return otx_vec3_length(otx_vec3_sub(dot, middle)) < reach + radius;
}

/* Dots of each face; with `dots` NULL they are only counted. */
static int32_t
list_dots(
    const otx_scene *scene, const otx_overlay *o, int32_t *first, int32_t *dots)
{
    int32_t count = 0;

    for (int32_t f = 0; f < scene->face_count; ++f)
    {
        first[f] = count;
        for (int32_t i = 0; i < o->dot_count && count < INT32_MAX; ++i)
            if (reaches(scene, f, o->dots[i].at, o->dot_radius))
            {
                if (dots)
                    dots[count] = i;
                ++count;
            }
    }
    first[scene->face_count] = count;
    return count;
}

otx_status
otx_overlay_prepare(
    otx_run *run, const otx_scene *scene, const otx_overlay *overlay,
    otx_overlay_index *out)
{
    int32_t *first =
        OTX_NEW(run->scratch, int32_t, (size_t)scene->face_count + 1);
    int32_t *dots;

    *out = (otx_overlay_index){.overlay = overlay};
    OTX_TRY(index_lines(run, scene, out));
    OTX_TRY(otx_run_ok(run));
    dots =
        OTX_NEW(run->scratch, int32_t, list_dots(scene, overlay, first, NULL));
    OTX_TRY(otx_run_ok(run));
    list_dots(scene, overlay, first, dots);
    out->face_first_dot = first;
    out->face_dots = dots;
    return OSDTEX_OK;
}

/* -- drawing ------------------------------------------------------------- */

static void
lay_on(const float color[3], double share, float rgb[3])
{
    for (int c = 0; c < 3; ++c)
        rgb[c] += (float)share * (color[c] - rgb[c]);
}

/* How dark the line is at a point, 0 beside it. */
static double
ink_of(const otx_overlay *o, const otx_overlay_line *line, otx_vec3 at)
{
    const otx_vec3 side = otx_vec3_sub(line->ends[1], line->ends[0]);
    const double length_sq = otx_vec3_dot(side, side);
    const double raw =
        length_sq > 0.0
            ? otx_vec3_dot(otx_vec3_sub(at, line->ends[0]), side) / length_sq
            : 0.0;
    const double t = fmin(fmax(raw, 0.0), 1.0);
    const otx_vec3 near =
        otx_vec3_mix(1.0 - t, line->ends[0], t, line->ends[1]);
    double phase;

    if (otx_vec3_length(otx_vec3_sub(at, near)) > 0.5 * o->line_width)
        return 0.0;
    if (!(o->period > 0.0))
        return 1.0;
    phase =
        (line->along[0] + t * (line->along[1] - line->along[0])) / o->period;
    return 0.05 + 0.95 * (phase - floor(phase));
}

static void
draw_dot(
    const otx_overlay_dot *dot, double radius, otx_vec3 at, otx_vec3 right,
    otx_vec3 up, float rgb[3])
{
    const otx_vec3 v = otx_vec3_scale(1.0 / radius, otx_vec3_sub(at, dot->at));
    const double x = fabs(otx_vec3_dot(v, right));
    const double y = fabs(otx_vec3_dot(v, up));
    const double r = otx_vec3_length(v);
    const bool sign =
        (y < 0.16 && x < 0.55) || (dot->sign > 0 && x < 0.16 && y < 0.55);

    if (r < 1.0)
        lay_on(r > 0.82 || sign ? PALE : dot->sign > 0 ? RED : BLUE, 1.0, rgb);
}

void
otx_overlay_draw(
    const otx_overlay_index *index, int32_t face, otx_vec3 at, otx_vec3 right,
    otx_vec3 up, float rgb[3])
{
    const otx_overlay *o = index->overlay;
    double ink = 0.0;

    for (int32_t i = index->face_first_line[face];
         i < index->face_first_line[face + 1]; ++i)
        ink = fmax(ink, ink_of(o, &o->lines[index->face_lines[i]], at));
    lay_on(INK, ink, rgb);
    for (int32_t i = index->face_first_dot[face];
         i < index->face_first_dot[face + 1]; ++i)
        draw_dot(
            &o->dots[index->face_dots[i]], o->dot_radius, at, right, up, rgb);
}

/* lines.c -- distances to lines, measured in the picture. */
#include "render/lines.h"

#include "render/island.h"

enum
{
    LINES = 8 /* of equal u to a unit */
};

static double
distance_to_segment(otx_vec2 p, otx_vec2 a, otx_vec2 b)
{
    const otx_vec2 along = otx_vec2_sub(b, a);
    const double length_sq = otx_vec2_dot(along, along);
    const double t = length_sq > 0.0
                         ? otx_vec2_dot(otx_vec2_sub(p, a), along) / length_sq
                         : 0.0;
    const otx_vec2 near = otx_vec2_lerp(a, b, fmin(fmax(t, 0.0), 1.0));

    return otx_vec2_length(otx_vec2_sub(p, near));
}

static bool
project_corner(const otx_lines *lines, int32_t corner, otx_vec2 *out)
{
    const otx_vec3 p =
        otx_vec3_load(lines->scene->points, lines->scene->face_verts[corner]);

    return otx_camera_project(
        lines->frame, otx_tracer_inside(lines->tracer, p), out);
}

bool
otx_lines_on_edge(
    const otx_lines *lines, int32_t face, otx_vec2 at, const uint8_t *marked,
    double width)
{
    const int32_t first = lines->scene->face_first[face];
    const int32_t end = lines->scene->face_first[face + 1];

    for (int32_t c = first; c < end; ++c)
    {
        otx_vec2 a, b;

        if ((marked && !marked[c]) || !project_corner(lines, c, &a) ||
            !project_corner(lines, c + 1 < end ? c + 1 : first, &b))
            continue;
        if (distance_to_segment(at, a, b) < 0.5 * width)
            return true;
    }
    return false;
}

otx_status
otx_lines_wire(otx_run *run, const otx_scene *scene, const uint8_t **marked)
{
    const int32_t *root = scene->face_root;
    const int32_t *twin;
    int32_t *roots;
    uint8_t *out;

    *marked = NULL;
    if (!root)
        return OSDTEX_OK;
    OTX_TRY(otx_island_pair(run, run->scratch, scene, &twin));
    roots = OTX_NEW(run->scratch, int32_t, scene->corner_count);
    out = OTX_NEW(run->scratch, uint8_t, scene->corner_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < scene->face_count; ++f)
        for (int32_t c = scene->face_first[f]; c < scene->face_first[f + 1];
             ++c)
            roots[c] = root[f];
    for (int32_t c = 0; c < scene->corner_count; ++c)
        out[c] = twin[c] < 0 || roots[twin[c]] != roots[c];
    *marked = out;
    return OSDTEX_OK;
}

/* Whether a value is on one of the lines; *whole: of a whole number. */
static bool
on_line(double value, const double change[2], bool *whole)
{
    const double pixel =
        LINES * sqrt(change[0] * change[0] + change[1] * change[1]);
    const double at = LINES * value;
    const double line = round(at);

    if (!(pixel < 0.25))
        return false;
    *whole = fmod(fabs(line), LINES) == 0.0;
    return fabs(at - line) < (*whole ? 1.25 : 0.6) * pixel;
}

void
otx_lines_uv(otx_vec2 uv, const double du[2], const double dv[2], float rgb[3])
{
    static const float RED[3] = {0.55f, 0.02f, 0.01f};
    static const float GREEN[3] = {0.01f, 0.26f, 0.03f};
    bool whole = false;

    if (on_line(uv.x, du, &whole))
        for (int32_t c = 0; c < 3; ++c)
            rgb[c] = RED[c];
    else if (on_line(uv.y, dv, &whole))
        for (int32_t c = 0; c < 3; ++c)
            rgb[c] = GREEN[c];
}

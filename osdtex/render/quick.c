/* quick.c -- a few samples, and whether they agree. */
#include "render/quick.h"

#include "base/random.h"

enum
{
    PLACES = OTX_QUICK_SIDE_MAX * OTX_QUICK_SIDE_MAX,
    SIDE_LEAST = 4, /* samples to a side from which halving them pays */
    LIGHT_RAYS = 8  /* to the key's disc, for its gloss */
};

/* Cosine between normals of a pixel: beyond it there is an edge. */
static const double BEND = 0.92;
/* Of what UVs would move over one triangle, from which on they jump. */
static const double JUMP = 3.0;
/* What colours may differ by: of their sum, across a seam and elsewhere, and at
 * all. */
static const double SEAM_CONTRAST = 0.1, CONTRAST = 0.15, CONTRAST_LEAST = 0.02;

/* The samples of a pixel. */
typedef struct taken
{
    int32_t count;
    otx_shade_sample samples[PLACES];
    otx_hit hits[PLACES];
} taken;

bool
otx_quick_suits(const otx_render_options *options)
{
    const otx_show show = options->show;

    return options->samples >= SIDE_LEAST && !options->wire &&
           !options->uv_lines &&
           (show == OTX_SHOW_TEXTURE || show == OTX_SHOW_CLAY ||
            show == OTX_SHOW_FLAT);
}

void
otx_quick_prepare(
    const otx_shade *full, const otx_light_map *map, otx_quick *out)
{
    const otx_render_options *options = full->options;

    *out = (otx_quick){.options = *options, .shade = *full, .map = map};
    out->options.samples = options->samples > 1 ? options->samples / 2 : 1;
    out->shade.options = &out->options;
    out->shade.lines.frame = &out->shade.frame;
    out->shade.light_rays =
        (LIGHT_RAYS - 1) / (out->options.samples * out->options.samples) + 1;
}

otx_vec2
otx_quick_place(int32_t n, int32_t number, uint64_t pixel)
{
    const uint64_t bits = otx_random_bits(pixel, 0, (uint64_t)number);
    const double jx = (double)(bits >> 32) * 0x1p-32;
    const double jy = (double)(bits & 0xFFFFFFFFu) * 0x1p-32;

    if (n == 1)
        return (otx_vec2){0.5, 0.5};
    return (otx_vec2){(number % n + jx) / n, (number / n + jy) / n};
}

/* Traces them; the number of those that meet the model. */
static int32_t
trace_all(
    const otx_quick *quick, int32_t x, int32_t y, uint64_t pixel, taken *out)
{
    const int32_t n = quick->options.samples;
    int32_t met = 0;

    out->count = n * n;
    for (int32_t i = 0; i < n * n; ++i)
    {
        const otx_vec2 place = otx_quick_place(n, i, pixel);

        out->samples[i] = (otx_shade_sample){
            .at = {x + place.x, y + place.y}, .number = i, .pixel = pixel};
        met += otx_shade_trace(&quick->shade, &out->samples[i], &out->hits[i]);
        /* Some do and some do not. */
        if (met != 0 && met != i + 1)
            return -1;
    }
    return met;
}

/* Whether they lie on one surface that is no more bent than a pixel shows: by
 * the normals, and none far from the plane of the first. */
static bool
is_smooth(const otx_quick *quick, const taken *t, otx_vec3 normals[PLACES])
{
    const otx_camera_frame *frame = &quick->shade.frame;
    const otx_hit *first = &t->hits[0];
    const otx_vec3 to = otx_vec3_sub(first->at, frame->eye);
    const double pixel = otx_vec3_length(frame->right) * otx_vec3_length(to);

    for (int32_t i = 0; i < t->count; ++i)
    {
        const otx_vec3 step = otx_vec3_sub(t->hits[i].at, first->at);

        normals[i] = otx_shade_normal(quick->shade.scene, &t->hits[i]);
        if (!(otx_vec3_dot(normals[i], normals[0]) > BEND) ||
            fabs(otx_vec3_dot(first->normal, step)) > pixel)
            return false;
    }
    return true;
}

/* The light on the pixel; false where only rays of its own can tell. */
static bool
find_light(
    const otx_quick *quick, int32_t x, int32_t y, const taken *t,
    otx_vec3 normal, otx_light_known *known)
{
    const otx_camera_frame *frame = &quick->shade.frame;
    const double depth =
        otx_vec3_dot(otx_vec3_sub(t->hits[0].at, frame->eye), frame->forward);

    *known = (otx_light_known){1.0, 1.0};
    return !quick->map->texels ||
           otx_light_map_at(
               quick->map, x, y, normal, depth,
               depth * otx_vec3_length(frame->right), known);
}

static otx_vec2
uv_at(const otx_scene *scene, const otx_hit *hit)
{
    otx_vec2 uv = {0.0, 0.0};

    for (int32_t i = 0; i < 3; ++i)
    {
        const float *corner = scene->uvs + 2 * (size_t)hit->corners[i];

        uv = otx_vec2_add(
            uv,
            otx_vec2_scale(hit->weights[i], (otx_vec2){corner[0], corner[1]}));
    }
    return uv;
}

/* The most that UVs of a hit's triangle move for a step over it, about. */
static double
uv_speed(const otx_scene *scene, const otx_hit *hit)
{
    double most = 0.0;

    for (int32_t i = 0; i < 3; ++i)
    {
        const int32_t j = (i + 1) % 3;
        const float *a = scene->uvs + 2 * (size_t)hit->corners[i];
        const float *b = scene->uvs + 2 * (size_t)hit->corners[j];
        const double length =
            otx_vec3_length(otx_vec3_sub(hit->points[j], hit->points[i]));

        if (length > 0.0)
            most = fmax(most, hypot(b[0] - a[0], b[1] - a[1]) / length);
    }
    return most;
}

/* Whether two hits may be on either side of a seam: of other patches or, where
 * those are not known, with UVs that jump. */
static bool
crosses_seam(const otx_scene *scene, const otx_hit *a, const otx_hit *b)
{
    otx_vec2 step;

    if (a->face == b->face)
        return false;
    if (scene->face_patch)
        return scene->face_patch[a->face] != scene->face_patch[b->face];
    if (!scene->uvs)
        return false;
    step = otx_vec2_sub(uv_at(scene, b), uv_at(scene, a));
    return hypot(step.x, step.y) >
           JUMP * uv_speed(scene, a) *
               otx_vec3_length(otx_vec3_sub(b->at, a->at));
}

/* Whether colours differ by more than a share of their sum. */
static bool
differ(const float low[3], const float high[3], double share)
{
    bool far = false;

    for (int32_t c = 0; c < 3; ++c)
        far |= high[c] - low[c] > share * (high[c] + low[c]) + CONTRAST_LEAST;
    return far;
}

/* Whether a seam shows in the pixel, or what is too fine for a few samples. */
static bool
is_parted(
    const otx_scene *scene, const taken *t, const float low[3],
    const float high[3])
{
    bool crossed = false;

    for (int32_t i = 1; i < t->count; ++i)
        crossed |= crosses_seam(scene, &t->hits[0], &t->hits[i]);
    return differ(low, high, crossed ? SEAM_CONTRAST : CONTRAST);
}

static bool
shade_all(const otx_quick *quick, taken *t, float rgb[3])
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {0};
    double sum[3] = {0.0, 0.0, 0.0};

    for (int32_t i = 0; i < t->count; ++i)
    {
        float color[3];

        otx_shade_hit(&quick->shade, &t->hits[i], &t->samples[i], color);
        for (int32_t c = 0; c < 3; ++c)
        {
            sum[c] += color[c];
            low[c] = fminf(low[c], color[c]);
            high[c] = fmaxf(high[c], color[c]);
        }
    }
    for (int32_t c = 0; c < 3; ++c)
        rgb[c] = (float)(sum[c] / t->count);
    return !is_parted(quick->shade.scene, t, low, high);
}

otx_quick_result
otx_quick_pixel(
    const otx_quick *quick, int32_t x, int32_t y, uint64_t pixel, float rgb[3],
    otx_light_known *known)
{
    otx_vec3 normals[PLACES];
    taken t;

    switch (trace_all(quick, x, y, pixel, &t))
    {
    case -1:
        return OTX_QUICK_MIXED;
    case 0:
        return OTX_QUICK_EMPTY;
    default:
        break;
    }
    if (!is_smooth(quick, &t, normals) ||
        !find_light(quick, x, y, &t, normals[0], known))
        return OTX_QUICK_MIXED;
    for (int32_t i = 0; i < t.count; ++i)
        t.samples[i].known = known;
    return shade_all(quick, &t, rgb) ? OTX_QUICK_DONE : OTX_QUICK_FINE;
}

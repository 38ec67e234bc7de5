/* shade.c -- what is shown, times how it is lit. */
#include "render/shade.h"

#include "render/distortion.h"
#include "render/island.h"
#include "render/tint.h"

#include <string.h>

enum
{
    /* Light rays of each kind to a pixel, at least. */
    PIXEL_RAYS = 32
};

/* Corners whose normal is further than this from the triangle's lie on a
 * crease and are shaded flat: the cosine of 50 degrees. */
static const double CREASE = 0.643;

static otx_status
prepare_textures(otx_run *run, otx_shade *out)
{
    const int32_t count = out->scene->texture_count;
    otx_texture *textures = OTX_NEW(run->scratch, otx_texture, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_scene_texture *from = &out->scene->textures[i];

        OTX_TRY(otx_texture_create(
            run, run->scratch, &from->image, from->wrap_x, from->wrap_y,
            &textures[i]));
        if (from->slices)
            OTX_TRY(otx_texture_add_slices(
                run, run->scratch, from->slices->linear, from->slices->count,
                &textures[i]));
    }
    out->textures = textures;
    return OSDTEX_OK;
}

static otx_status
prepare_islands(otx_run *run, otx_shade *out)
{
    const otx_scene *scene = out->scene;
    const int32_t *twin;

    if (out->options->show == OTX_SHOW_PATCHES && scene->face_patch)
    {
        out->patch = scene->face_patch;
        return OSDTEX_OK;
    }
    OTX_TRY(otx_island_pair(run, run->scratch, scene, &twin));
    OTX_TRY(otx_island_seams(run, run->scratch, scene, twin, &out->seam));
    if (out->options->show == OTX_SHOW_PATCHES)
        OTX_TRY(otx_island_label(
            run, run->scratch, scene, twin, out->seam, &out->patch));
    return OSDTEX_OK;
}

static otx_status
prepare_stretch(otx_run *run, otx_shade *out)
{
    int64_t flipped;
    double mean;

    out->stretch = out->scene->face_stretch;
    if (!out->stretch)
        OTX_TRY(otx_distortion_faces(
            run, run->scratch, out->scene, NULL, &out->stretch));
    if (!out->stretch)
        return OSDTEX_OK;
    mean = otx_distortion_mean(out->scene, out->stretch, &flipped);
    otx_note(
        run, OSDTEX_SEVERITY_INFO, "render", OTX_NOWHERE,
        "mean stretch %.3f (white is 1, blue %.2f, red %.2f); %lld faces are "
        "flipped or without area in UV (magenta)",
        mean, 1.0 / OTX_TINT_STRETCH_FULL, OTX_TINT_STRETCH_FULL,
        (long long)flipped);
    return OSDTEX_OK;
}

otx_status
otx_shade_prepare(
    otx_run *run, const otx_scene *scene, const otx_render_options *options,
    const otx_tracer *tracer, const otx_camera_frame *frame, otx_shade *out)
{
    const int32_t per_pixel = options->samples * options->samples;

    *out = (otx_shade){
        .scene = scene,
        .options = options,
        .tracer = tracer,
        .frame = *frame,
        .light = otx_light_create(tracer, frame, !options->no_shadows),
        .light_rays = (PIXEL_RAYS + per_pixel - 1) / per_pixel,
        .share = 1.0 / options->samples,
    };
    out->lines = (otx_lines){scene, tracer, &out->frame};
    if (options->wire)
        OTX_TRY(otx_lines_wire(run, scene, &out->wire));
    switch (options->show)
    {
    case OTX_SHOW_SEAMS:
        OTX_TRY(prepare_islands(run, out));
        return prepare_textures(run, out);
    case OTX_SHOW_TEXTURE:
        return prepare_textures(run, out);
    case OTX_SHOW_PATCHES:
        return prepare_islands(run, out);
    case OTX_SHOW_STRETCH:
        return prepare_stretch(run, out);
    case OTX_SHOW_FIELD:
        return otx_overlay_prepare(run, scene, options->overlay, &out->overlay);
    case OTX_SHOW_SINGULARITIES:
    case OTX_SHOW_CELLS:
        OTX_TRY(
            otx_overlay_prepare(run, scene, options->overlay, &out->overlay));
        return prepare_textures(run, out);
    default:
        return OSDTEX_OK;
    }
}

static otx_vec2
corner_uv(const otx_scene *scene, int32_t corner)
{
    const float *uv = scene->uvs + 2 * (size_t)corner;

    return (otx_vec2){uv[0], uv[1]};
}

static otx_vec2
hit_uv(const otx_scene *scene, const otx_hit *hit)
{
    otx_vec2 uv = {0.0, 0.0};

    for (int32_t i = 0; i < 3; ++i)
        uv = otx_vec2_add(
            uv,
            otx_vec2_scale(hit->weights[i], corner_uv(scene, hit->corners[i])));
    return uv;
}

/* How the hit moves over its triangle's plane when the ray's direction D, that
 * of the frame and not unit, moves by `step`: P = eye + t D with
 * N . (P - P0) = 0 gives dP = t (step - D (N . step) / (N . D)). */
static otx_vec3
move_on_plane(const otx_hit *hit, otx_vec3 eye, otx_vec3 forward, otx_vec3 step)
{
    const otx_vec3 to_hit = otx_vec3_sub(hit->at, eye);
    const double depth = otx_vec3_dot(to_hit, forward);
    const double approach = otx_vec3_dot(hit->normal, to_hit);
    const double slide = otx_vec3_dot(hit->normal, step);

    return otx_vec3_mix(depth, step, -depth * slide / approach, to_hit);
}

/* The change of the hit's weights along `move`, which lies in the triangle's
 * plane. */
static void
weights_along(const otx_hit *hit, otx_vec3 move, double out[3])
{
    const otx_vec3 e1 = otx_vec3_sub(hit->points[1], hit->points[0]);
    const otx_vec3 e2 = otx_vec3_sub(hit->points[2], hit->points[0]);
    const otx_vec3 n = otx_vec3_cross(e1, e2);
    const double area_sq = otx_vec3_dot(n, n);

    out[1] = otx_vec3_dot(otx_vec3_cross(move, e2), n) / area_sq;
    out[2] = otx_vec3_dot(otx_vec3_cross(e1, move), n) / area_sq;
    out[0] = -out[1] - out[2];
}

static void
set_grey(float value, float rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = value;
}

/* What is looked up at a hit, and how far it is to the next sample: as moves
 * over the triangle's plane along the picture's two axes, and as weights. */
typedef struct footprint
{
    otx_vec3 right, up;
    double dx[3], dy[3];
} footprint;

static footprint
footprint_of(const otx_shade *shade, const otx_hit *hit)
{
    const otx_camera_frame *frame = &shade->frame;
    footprint f = {
        .right = move_on_plane(hit, frame->eye, frame->forward, frame->right),
        .up = move_on_plane(hit, frame->eye, frame->forward, frame->up)};

    weights_along(hit, f.right, f.dx);
    weights_along(hit, f.up, f.dy);
    return f;
}

/* Which texture a face shows; -1 none. */
static int32_t
texture_of(const otx_scene *scene, int32_t face)
{
    const int32_t t = scene->face_texture ? scene->face_texture[face] : 0;

    return scene->uvs && t < scene->texture_count ? t : -1;
}

static void
texture_color(const otx_shade *shade, const otx_hit *hit, float rgb[3])
{
    const otx_scene *scene = shade->scene;
    const otx_show_view show = {
        scene->uvs,   scene->face_first, scene->lookups,    NULL,
        scene->field, scene->along,      scene->face_verts, scene->decals};
    const int32_t t = texture_of(scene, hit->face);
    const double share = shade->share;
    float color[OTX_IMAGE_MAX_CHANNELS];

    if (t < 0)
    {
        set_grey(0.5f, rgb);
        return;
    }

    const footprint f = footprint_of(shade, hit);
    const otx_show_place place = {
        hit->face, hit->corners, hit->weights, f.dx, f.dy};
    const int32_t channels = shade->textures[t].pyramid.levels[0].channels;

    otx_show_color(&show, shade->textures, &place, t, share, channels, color);
    for (int32_t c = 0; c < 3; ++c)
        rgb[c] = color[channels < 3 ? 0 : c];
}

/* The texture's lightness, so that what is drawn on it stands out. */
static void
pale_color(const otx_shade *shade, const otx_hit *hit, float rgb[3])
{
    texture_color(shade, hit, rgb);

    const double grey = (rgb[0] + 2.0 * rgb[1] + rgb[2]) / 4.0;

    set_grey((float)(0.42 + 0.35 * fmin(fmax(grey, 0.0), 1.0)), rgb);
}

static void
seam_color(
    const otx_shade *shade, const otx_hit *hit, otx_vec2 at, float rgb[3])
{
    if (otx_lines_on_edge(
            &shade->lines, hit->face, at, shade->seam,
            shade->options->seam_width))
        set_grey(0.012f, rgb);
    else
        pale_color(shade, hit, rgb);
}

/* Draws the overlay on what is there. */
static void
draw_overlay(const otx_shade *shade, const otx_hit *hit, float rgb[3])
{
    const otx_scene *scene = shade->scene;
    otx_vec3 at = {0.0, 0.0, 0.0};

    for (int32_t i = 0; i < 3; ++i)
        at = otx_vec3_mix(
            1.0, at, hit->weights[i],
            otx_vec3_load(scene->points, scene->face_verts[hit->corners[i]]));
    otx_overlay_draw(
        &shade->overlay, hit->face, at, otx_vec3_unit(shade->frame.right),
        otx_vec3_unit(shade->frame.up), rgb);
}

static otx_vec3
corner_normal(const otx_scene *scene, int32_t corner, otx_vec3 face)
{
    const int32_t v = scene->face_verts[corner];
    otx_vec3 n;

    if (scene->corner_normals)
        n = otx_vec3_load(scene->corner_normals, corner);
    else if (scene->vert_normals)
        n = otx_vec3_load(scene->vert_normals, v);
    else
        return face;
    n = otx_vec3_unit(n);
    /* Written so that NaN is flat too. */
    if (!(otx_vec3_dot(n, face) > CREASE))
        return face;
    return n;
}

otx_vec3
otx_shade_normal(const otx_scene *scene, const otx_hit *hit)
{
    otx_vec3 sum = {0.0, 0.0, 0.0};

    for (int32_t i = 0; i < 3; ++i)
        sum = otx_vec3_add(
            sum, otx_vec3_scale(
                     hit->weights[i],
                     corner_normal(scene, hit->corners[i], hit->normal)));
    return otx_vec3_unit(sum);
}

static void
uv_color(const otx_scene *scene, const otx_hit *hit, float rgb[3])
{
    otx_vec2 uv;

    set_grey(0.0f, rgb);
    if (!scene->uvs)
        return;
    uv = hit_uv(scene, hit);
    rgb[0] = (float)(uv.x - floor(uv.x));
    rgb[1] = (float)(uv.y - floor(uv.y));
}

static void
surface_color(
    const otx_shade *shade, const otx_hit *hit, otx_vec2 at, otx_vec3 normal,
    float rgb[3])
{
    switch (shade->options->show)
    {
    case OTX_SHOW_TEXTURE:
        texture_color(shade, hit, rgb);
        return;
    case OTX_SHOW_PATCHES:
        otx_tint_patch(shade->patch[hit->face], rgb);
        return;
    case OTX_SHOW_STRETCH:
        set_grey(0.18f, rgb);
        if (shade->stretch)
            otx_tint_stretch(shade->stretch[hit->face], rgb);
        return;
    case OTX_SHOW_WINDOWS:
        set_grey(0.18f, rgb);
        if (shade->scene->face_windows &&
            shade->scene->face_windows[hit->face] >= 0.0f)
            otx_tint_stretch(shade->scene->face_windows[hit->face], rgb);
        return;
    case OTX_SHOW_SEAMS:
        seam_color(shade, hit, at, rgb);
        return;
    case OTX_SHOW_FIELD:
        set_grey(0.5f, rgb);
        draw_overlay(shade, hit, rgb);
        return;
    case OTX_SHOW_SINGULARITIES:
    case OTX_SHOW_CELLS:
        pale_color(shade, hit, rgb);
        draw_overlay(shade, hit, rgb);
        return;
    case OTX_SHOW_UV:
        uv_color(shade->scene, hit, rgb);
        return;
    case OTX_SHOW_NORMALS:
        rgb[0] = (float)(0.5 + 0.5 * normal.x);
        rgb[1] = (float)(0.5 + 0.5 * normal.y);
        rgb[2] = (float)(0.5 + 0.5 * normal.z);
        return;
    case OTX_SHOW_CLAY:
        set_grey(0.36f, rgb);
        return;
    default:
        set_grey(0.5f, rgb);
        return;
    }
}

/* What is drawn over any picture. */
static void
draw_lines(
    const otx_shade *shade, const otx_hit *hit, otx_vec2 at, float rgb[3])
{
    const otx_scene *scene = shade->scene;

    if (shade->options->uv_lines && scene->uvs)
    {
        const footprint f = footprint_of(shade, hit);
        double du[2] = {0.0, 0.0}, dv[2] = {0.0, 0.0};

        for (int32_t i = 0; i < 3; ++i)
        {
            const otx_vec2 uv = corner_uv(scene, hit->corners[i]);

            du[0] += f.dx[i] * uv.x;
            du[1] += f.dy[i] * uv.x;
            dv[0] += f.dx[i] * uv.y;
            dv[1] += f.dy[i] * uv.y;
        }
        otx_lines_uv(hit_uv(scene, hit), du, dv, rgb);
    }
    if (shade->options->wire &&
        otx_lines_on_edge(&shade->lines, hit->face, at, shade->wire, 1.0))
        for (int32_t c = 0; c < 3; ++c)
            rgb[c] *= 0.15f;
}

bool
otx_shade_is_lit(const otx_render_options *options)
{
    return !options->unlit && options->show != OTX_SHOW_UV &&
           options->show != OTX_SHOW_NORMALS;
}

/* ---- materials ------------------------------------------------------------
 */

/* Of clay: a highlight as wide as shows dents, and no wider. */
static const double CLAY_ROUGHNESS = 0.38;

/* What the maps say at a hit. */
typedef struct material
{
    otx_vec3 normal; /* unit, on the outside */
    double roughness, metalness, occlusion;
} material;

static double
value_of(
    const otx_map_textures *maps, const float *values, otx_companion_kind kind)
{
    float neutral[3];

    otx_companion_neutral(kind, neutral);
    return fmin(
        fmax(
            maps->first[kind] < 0 ? neutral[0] : values[maps->first[kind]],
            0.0f),
        1.0f);
}

/* A normal in the frame of two moves over the surface, on the smooth one. */
static otx_vec3
bend(otx_vec3 right, otx_vec3 up, const float n[3], otx_vec3 normal)
{
    const otx_vec3 x = otx_vec3_unit(right);
    const otx_vec3 y =
        otx_vec3_unit(otx_vec3_mix(1.0, up, -otx_vec3_dot(up, x), x));

    return otx_vec3_unit(otx_vec3_add(
        otx_vec3_mix(n[0], x, n[1], y), otx_vec3_scale(n[2], normal)));
}

/* How the hit moves over its triangle along the rows of its UVs, and across
 * them. False where the UVs have no area. */
static bool
uv_moves(
    const otx_scene *scene, const otx_hit *hit, otx_vec3 *right, otx_vec3 *up)
{
    const otx_vec2 a = corner_uv(scene, hit->corners[0]);
    const otx_vec2 b = otx_vec2_sub(corner_uv(scene, hit->corners[1]), a);
    const otx_vec2 c = otx_vec2_sub(corner_uv(scene, hit->corners[2]), a);
    const otx_vec3 e1 = otx_vec3_sub(hit->points[1], hit->points[0]);
    const otx_vec3 e2 = otx_vec3_sub(hit->points[2], hit->points[0]);
    const double side = otx_vec2_cross(b, c) > 0.0 ? 1.0 : -1.0;

    *right = otx_vec3_mix(side * c.y, e1, -side * b.y, e2);
    *up = otx_vec3_mix(-side * c.x, e1, side * b.x, e2);
    return otx_vec3_length(*right) > 0.0 && otx_vec3_length(*up) > 0.0;
}

/* The normal that a map tells. */
static otx_vec3
told_normal(
    const otx_scene *scene, const otx_hit *hit, const footprint *f,
    const float *values, otx_vec3 normal)
{
    const int32_t first = scene->maps->first[OTX_COMPANION_NORMAL];
    otx_vec3 right = f->right, up = f->up;

    if (first < 0 ||
        (!scene->maps->carry.surface && !uv_moves(scene, hit, &right, &up)))
        return normal;
    return bend(right, up, values + first, normal);
}

static material
material_at(
    const otx_shade *shade, const otx_hit *hit, int32_t t, otx_vec3 normal)
{
    const bool clay = shade->options->show == OTX_SHOW_CLAY;
    const otx_scene *scene = shade->scene;
    const otx_map_textures *maps = scene->maps;

    if (clay && (!maps || shade->options->plain || t < 0))
        return (material){normal, CLAY_ROUGHNESS, 0.0, 1.0};

    const otx_show_view show = {
        scene->uvs,        scene->face_first,
        scene->lookups,    maps->carry.surface ? &maps->carry : NULL,
        scene->field,      scene->along,
        scene->face_verts, NULL};
    const footprint f = footprint_of(shade, hit);
    const otx_show_place place = {
        hit->face, hit->corners, hit->weights, f.dx, f.dy};
    float values[OTX_IMAGE_MAX_CHANNELS];

    otx_show_color(
        &show, maps->textures, &place, t, shade->share, maps->channels, values);
    return (material){
        told_normal(scene, hit, &f, values, normal),
        clay ? CLAY_ROUGHNESS : value_of(maps, values, OTX_COMPANION_ROUGHNESS),
        clay ? 0.0 : value_of(maps, values, OTX_COMPANION_METALNESS),
        value_of(maps, values, OTX_COMPANION_OCCLUSION)};
}

/* Light of all rays of a sample on a material of the colour in `rgb`. */
static void
light_material(
    const otx_shade *shade, const otx_hit *hit, const otx_shade_sample *sample,
    const material *m, float rgb[3])
{
    static const double DIELECTRIC = 0.04;
    const bool behind = otx_vec3_dot(hit->normal, sample->direction) > 0.0;
    const double side = behind ? -1.0 : 1.0;
    const otx_light_place place = {
        hit->at,
        otx_vec3_scale(side, hit->normal),
        otx_vec3_scale(side, m->normal),
        otx_vec3_unit(otx_vec3_scale(-1.0, sample->direction)),
        m->roughness,
        m->occlusion};
    const int32_t rays = shade->light_rays;
    const int32_t count = shade->options->samples * shade->options->samples;
    otx_lit sum = {0.0, {0.0, 0.0}};

    for (int32_t i = 0; i < rays; ++i)
    {
        const otx_light_rays ray = {
            sample->number * rays + i, count * rays, sample->pixel,
            sample->known};
        const otx_lit lit = otx_light_material(&shade->light, &place, &ray);

        sum.matte += lit.matte / rays;
        sum.gloss.facing += lit.gloss.facing / rays;
        sum.gloss.grazing += lit.gloss.grazing / rays;
    }
    for (int32_t c = 0; c < 3; ++c)
    {
        const double facing = DIELECTRIC + m->metalness * (rgb[c] - DIELECTRIC);

        rgb[c] = (float)(
            (1.0 - m->metalness) * rgb[c] * sum.matte +
            facing * sum.gloss.facing + sum.gloss.grazing);
    }
}

static bool
shows_material(const otx_shade *shade, const otx_hit *hit)
{
    if (shade->options->show == OTX_SHOW_CLAY)
        return true;
    return shade->scene->maps && !shade->options->plain &&
           shade->options->show == OTX_SHOW_TEXTURE &&
           texture_of(shade->scene, hit->face) >= 0;
}

static double
light_at_hit(
    const otx_shade *shade, const otx_hit *hit, const otx_shade_sample *sample,
    otx_vec3 normal)
{
    const bool behind = otx_vec3_dot(hit->normal, sample->direction) > 0.0;
    const double side = behind ? -1.0 : 1.0;
    const int32_t rays = shade->light_rays;
    const int32_t n = shade->options->samples;
    double sum = 0.0;

    for (int32_t i = 0; i < rays; ++i)
    {
        const otx_light_rays ray = {
            sample->number * rays + i, n * n * rays, sample->pixel,
            sample->known};

        sum += otx_light_at(
            &shade->light, hit->at, otx_vec3_scale(side, hit->normal),
            otx_vec3_scale(side, normal), &ray);
    }
    return sum / rays;
}

void
otx_shade_hit(
    const otx_shade *shade, const otx_hit *hit, const otx_shade_sample *sample,
    float rgb[3])
{
    const otx_vec3 normal = otx_shade_normal(shade->scene, hit);

    surface_color(shade, hit, sample->at, normal, rgb);
    draw_lines(shade, hit, sample->at, rgb);
    if (!otx_shade_is_lit(shade->options))
        return;
    if (shows_material(shade, hit))
    {
        const material m = material_at(
            shade, hit, texture_of(shade->scene, hit->face), normal);

        light_material(shade, hit, sample, &m, rgb);
        return;
    }

    const double light = light_at_hit(shade, hit, sample, normal);

    for (int32_t c = 0; c < 3; ++c)
        rgb[c] = (float)(light * rgb[c]);
}

/* The nearest that a ray from far away need begin to meet the unit ball; the
 * rest of the way would cost the floats of the ray their precision. */
static otx_vec3
ray_origin(otx_vec3 eye, otx_vec3 direction)
{
    const double skip = -otx_vec3_dot(eye, direction) - 1.5;

    return skip > 0.0 ? otx_vec3_mix(1.0, eye, skip, direction) : eye;
}

bool
otx_shade_trace(const otx_shade *shade, otx_shade_sample *sample, otx_hit *out)
{
    const otx_camera_frame *frame = &shade->frame;
    otx_vec3 from;

    sample->direction = otx_camera_direction(frame, sample->at.x, sample->at.y);
    from = otx_vec3_mix(
        1.0, frame->eye,
        frame->near / otx_vec3_dot(sample->direction, frame->forward),
        sample->direction);
    return otx_tracer_hit(
        shade->tracer, ray_origin(from, sample->direction), sample->direction,
        out);
}

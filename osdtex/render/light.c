/* light.c -- one soft key, one sky.
 *
 * The samples of a pixel are one Hammersley set turned by a hash of the pixel
 * [Cranley76]: the first dimension is the sample's number, the second its
 * digits reversed. Few rays, no visible grain at 16 a pixel, and no state. */
#include "render/light.h"

#include "base/random.h"

/* Strengths; together about 1 on a surface that faces the camera. */
static const double KEY = 1.05;
static const double SKY = 0.62;
/* The sky from straight below to straight above. */
static const double SKY_BELOW = 0.35, SKY_ABOVE = 1.0;
/* Of the sky's light where the model hides it: as if by one bounce. */
static const double BOUNCE = 0.22;
/* Tangent of the half-angle of the key's disc. */
static const double KEY_SIZE = 0.22;
/* Mean of the cosine over the disc, where all of it is above the horizon, of
 * that to its middle: of 1 / sqrt(1 + r^2) over a disc of radius KEY_SIZE. */
static const double KEY_MEAN = 0.98818;
/* Cosine from which on it is, and bends too little to matter. */
static const double KEY_WHOLE = 0.25;
/* Lengths in the tracer's units, where the model has radius 1. */
static const double LIFT = 2e-4;
static const double REACH = 0.8;

otx_light
otx_light_create(
    const otx_tracer *tracer, const otx_camera_frame *frame, bool shadows)
{
    const otx_vec3 right = otx_vec3_unit(frame->right);
    const otx_vec3 up = otx_vec3_unit(frame->up);
    const otx_vec3 aside = otx_vec3_mix(-0.52, right, 0.68, up);
    const otx_vec3 key =
        otx_vec3_unit(otx_vec3_mix(1.0, aside, -0.72, frame->forward));
    const otx_vec3 across = otx_vec3_unit(otx_vec3_cross(key, right));

    return (otx_light){
        tracer,
        key,
        otx_vec3_scale(KEY_SIZE, across),
        otx_vec3_scale(KEY_SIZE, otx_vec3_cross(key, across)),
        shadows,
    };
}

static double
reverse_bits(uint32_t x)
{
    x = x << 16 | x >> 16;
    x = (x & 0x00FF00FFu) << 8 | (x & 0xFF00FF00u) >> 8;
    x = (x & 0x0F0F0F0Fu) << 4 | (x & 0xF0F0F0F0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xCCCCCCCCu) >> 2;
    x = (x & 0x55555555u) << 1 | (x & 0xAAAAAAAAu) >> 1;
    return x * 0x1p-32;
}

/* Point `number` of `count` in the unit square, turned by `key` and a stage of
 * its own. */
static otx_vec2
sample_square(int32_t number, int32_t count, uint64_t key, uint32_t stage)
{
    const uint64_t bits = otx_random_bits(key, stage, 0);
    const double x = (number + 0.5) / count + (double)(bits >> 32) * 0x1p-32;
    const double y =
        reverse_bits((uint32_t)number) + (double)(bits & 0xFFFFFFFFu) * 0x1p-32;

    return (otx_vec2){x - floor(x), y - floor(y)};
}

static otx_vec2
sample_disc(otx_vec2 square)
{
    return otx_vec2_scale(
        sqrt(square.x), otx_vec2_polar(2.0 * OTX_PI * square.y));
}

/* Two directions that make a frame with unit n; no branch but the sign
 * [Duff17]. */
static void
complete_frame(otx_vec3 n, otx_vec3 *x, otx_vec3 *y)
{
    const double sign = copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;

    *x = (otx_vec3){1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    *y = (otx_vec3){b, sign + n.y * n.y * a, -n.y};
}

static double
sky_from(otx_vec3 direction)
{
    const double t = 0.5 + 0.5 * direction.y;

    return SKY_BELOW + t * (SKY_ABOVE - SKY_BELOW);
}

/* A direction of the hemisphere about n, as likely as its cosine. */
static otx_vec3
cosine_direction(otx_vec3 n, otx_vec2 square)
{
    const otx_vec2 disc = sample_disc(square);
    const double height = sqrt(fmax(0.0, 1.0 - square.x));
    otx_vec3 x, y;

    complete_frame(n, &x, &y);
    return otx_vec3_add(
        otx_vec3_mix(disc.x, x, disc.y, y), otx_vec3_scale(height, n));
}

/* A direction to the key's disc. */
static otx_vec3
key_direction(const otx_light *light, otx_vec2 square)
{
    const otx_vec2 disc = sample_disc(square);

    return otx_vec3_unit(otx_vec3_add(
        light->key, otx_vec3_mix(disc.x, light->key_x, disc.y, light->key_y)));
}

/* How much of the key's disc is seen: all or nothing of it by a ray. */
static double
key_seen(
    const otx_light *light, const otx_light_known *known, otx_vec3 from,
    otx_vec3 face, otx_vec3 to)
{
    if (known)
        return known->key;
    return !light->shadows ||
                   (otx_vec3_dot(face, to) > 0.0 &&
                    !otx_tracer_occluded(light->tracer, from, to, INFINITY))
               ? 1.0
               : 0.0;
}

/* A ray's cosine; where no ray is needed, that of the whole disc. */
static double
key_cosine(
    const otx_light *light, const otx_light_known *known, otx_vec3 normal,
    otx_vec3 to)
{
    const double middle = otx_vec3_dot(normal, light->key);

    return known && middle > KEY_WHOLE ? KEY_MEAN * middle
                                       : otx_vec3_dot(normal, to);
}

static double
key_light(
    const otx_light *light, const otx_light_known *known, otx_vec3 from,
    otx_vec3 face, otx_vec3 normal, otx_vec2 square)
{
    const otx_vec3 to = key_direction(light, square);
    const double cosine = key_cosine(light, known, normal, to);

    return cosine > 0.0 ? cosine * key_seen(light, known, from, face, to) : 0.0;
}

/* Of the sky's light in a direction, what the model lets through. */
static double
sky_open(
    const otx_light *light, const otx_light_known *known, otx_vec3 from,
    otx_vec3 face, otx_vec3 to)
{
    if (known)
        return known->sky;
    return otx_vec3_dot(face, to) <= 0.0 ||
                   otx_tracer_occluded(light->tracer, from, to, REACH)
               ? BOUNCE
               : 1.0;
}

static double
sky_light(
    const otx_light *light, const otx_light_known *known, otx_vec3 from,
    otx_vec3 face, otx_vec3 normal, otx_vec2 square)
{
    /* Without rays: the exact mean over the hemisphere, which is that of the
     * direction two thirds of the way to the normal. */
    if (!light->shadows || known)
        return (known ? known->sky : 1.0) *
               sky_from(otx_vec3_scale(2.0 / 3.0, normal));

    const otx_vec3 to = cosine_direction(normal, square);

    return sky_open(light, NULL, from, face, to) * sky_from(to);
}

/* The same mirrored: from the direction that stands for all of it, as open as
 * the sky is in one of the matte surface's. */
static otx_gloss
sky_gloss(
    const otx_light *light, const otx_light_known *known,
    const otx_light_place *p, otx_vec3 from, otx_vec2 square)
{
    const double sky =
        sky_from(otx_gloss_direction(p->normal, p->eye, p->roughness));
    const double open = light->shadows
                            ? sky_open(
                                  light, known, from, p->face,
                                  cosine_direction(p->normal, square))
                            : 1.0;
    const otx_gloss all = otx_gloss_sky(p->normal, p->eye, p->roughness);

    return (otx_gloss){open * sky * all.facing, open * sky * all.grazing};
}

otx_lit
otx_light_material(
    const otx_light *light, const otx_light_place *p,
    const otx_light_rays *rays)
{
    const otx_light_known *known = rays->known;
    const otx_vec3 from = otx_vec3_add(p->at, otx_vec3_scale(LIFT, p->face));
    const otx_vec2 a = sample_square(rays->number, rays->count, rays->key, 1);
    const otx_vec2 b = sample_square(rays->number, rays->count, rays->key, 2);
    const otx_vec3 to = key_direction(light, a);
    const double cosine = key_cosine(light, known, p->normal, to);
    const double sky = SKY * p->open;
    const otx_gloss of_sky = sky_gloss(light, known, p, from, b);
    otx_lit lit = {
        sky * sky_light(light, known, from, p->face, p->normal, b),
        {sky * of_sky.facing, sky * of_sky.grazing}};

    const double key =
        cosine > 0.0 ? KEY * key_seen(light, known, from, p->face, to) : 0.0;

    if (!(key > 0.0))
        return lit;

    const otx_gloss gloss =
        otx_gloss_light(p->normal, to, p->eye, p->roughness);

    lit.matte += key * cosine;
    lit.gloss.facing += key * gloss.facing;
    lit.gloss.grazing += key * gloss.grazing;
    return lit;
}

double
otx_light_at(
    const otx_light *light, otx_vec3 at, otx_vec3 face, otx_vec3 normal,
    const otx_light_rays *rays)
{
    const otx_light_known *known = rays->known;
    const otx_vec3 from = otx_vec3_add(at, otx_vec3_scale(LIFT, face));
    const otx_vec2 a = sample_square(rays->number, rays->count, rays->key, 1);
    const otx_vec2 b = sample_square(rays->number, rays->count, rays->key, 2);

    return KEY * key_light(light, known, from, face, normal, a) +
           SKY * sky_light(light, known, from, face, normal, b);
}

otx_light_known
otx_light_probe(
    const otx_light *light, otx_vec3 at, otx_vec3 face, otx_vec3 normal,
    int32_t count, uint64_t key)
{
    const otx_vec3 from = otx_vec3_add(at, otx_vec3_scale(LIFT, face));
    double seen = 0.0, open = 0.0;
    int32_t lit = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec3 to =
            key_direction(light, sample_square(i, count, key, 1));
        const otx_vec3 sky =
            cosine_direction(normal, sample_square(i, count, key, 2));

        open += sky_open(light, NULL, from, face, sky);
        /* What turns away from it is dark without a ray. */
        if (!(otx_vec3_dot(normal, to) > 0.0))
            continue;
        ++lit;
        seen += key_seen(light, NULL, from, face, to);
    }
    return (otx_light_known){lit > 0 ? seen / lit : 0.0, open / count};
}

double
otx_light_open(
    const otx_tracer *tracer, otx_vec3 at, otx_vec3 normal, int32_t count)
{
    const otx_vec3 from = otx_vec3_add(at, otx_vec3_scale(LIFT, normal));
    int32_t open = 0;

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 square = sample_square(i, count, 0, 3);
        const otx_vec3 to = cosine_direction(normal, square);

        open += !otx_tracer_occluded(tracer, from, to, REACH);
    }
    return (double)open / count;
}

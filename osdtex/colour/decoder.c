/* decoder.c -- a curve or a profile, then a matrix. */
#include "colour/decoder.h"

#include "colour/colour_known.h"
#include "colour/embedding.h"
#include "colour/icc_profile.h"
#include "colour/primaries.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char stage[] = "colour";

enum
{
    NAME_BYTES = 160,
    PROBES = 5 /* a side of the cube of colours that are tried */
};

typedef otx_primaries_matrix matrix;

struct otx_decoder
{
    const char *space;
    char name[NAME_BYTES];
    const otx_icc_profile *profile; /* NULL: a curve */
    double exponent;                /* of the curve; 0: sRGB's */
    matrix to_space;                /* linear RGB of the file, or XYZ */
};

static const float srgb_xy[8] = {
    0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
static const float adobe_xy[8] = {
    0.64F, 0.33F, 0.21F, 0.71F, 0.15F, 0.06F, 0.3127F, 0.3290F};
static const double adobe_exponent = 563.0 / 256.0;

/* PNG's gamma of a file that is meant to be sRGB, rounded by its writers. */
static const double srgb_gamma = 0.45455;

/* ---- applying ---- */

/* sRGB's curve, mirrored below 0. */
static double
srgb_decode(double value)
{
    const double v = fabs(value);
    const double light =
        v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);

    return copysign(light, value);
}

static double
decode_curve(const otx_decoder *d, double value)
{
    if (d->exponent == 1.0)
        return value;
    return d->exponent > 0.0 ? copysign(pow(fabs(value), d->exponent), value)
                             : srgb_decode(value);
}

/* `count` colours of three values, side by side. */
static void
decode(const otx_decoder *d, float *colours, int32_t count)
{
    if (d->profile)
        otx_icc_profile_to_xyz(d->profile, colours, count);
    for (int32_t i = 0; i < count; ++i)
    {
        float *c = colours + 3 * (size_t)i;
        double in[3];

        for (int k = 0; k < 3; ++k)
            in[k] = d->profile ? (double)c[k] : decode_curve(d, (double)c[k]);
        for (int k = 0; k < 3; ++k)
            c[k] =
                (float)(d->to_space.m[k][0] * in[0] + d->to_space.m[k][1] * in[1] + d->to_space.m[k][2] * in[2]);
    }
}

typedef struct job
{
    const otx_decoder *decoder;
    const otx_image *image;
    float *rows; /* a row of three channels for each worker */
} job;

static otx_status
decode_row(void *context, int64_t y, otx_worker *worker)
{
    const job *j = context;
    const int32_t width = j->image->width;
    float *row = j->rows + 3 * (size_t)width * (size_t)worker->index;

    for (int32_t x = 0; x < width; ++x)
        memcpy(
            row + 3 * (size_t)x, otx_image_at(j->image, x, (int32_t)y),
            3 * sizeof *row);
    decode(j->decoder, row, width);
    for (int32_t x = 0; x < width; ++x)
        memcpy(
            otx_image_at(j->image, x, (int32_t)y), row + 3 * (size_t)x,
            3 * sizeof *row);
    return OSDTEX_OK;
}

otx_status
otx_decoder_apply(otx_run *run, const otx_decoder *decoder, otx_image *image)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const size_t threads = (size_t)otx_pool_threads(run->pool);
    job j = {decoder, image, NULL};
    otx_status status;

    j.rows = OTX_NEW(run->scratch, float, 3 * (size_t)image->width * threads);
    OTX_TRY(otx_run_ok(run));
    status = otx_pool_for(run->pool, image->height, decode_row, &j);
    otx_arena_release(run->scratch, mark);
    return status;
}

const char *
otx_decoder_space(const otx_decoder *decoder)
{
    return decoder->space;
}

const char *
otx_decoder_name(const otx_decoder *decoder)
{
    return decoder->name;
}

/* ---- what the file says ---- */

/* Goes from ACES2065-1 on to the linear space of the configuration. */
static bool
lead_to(otx_decoder *d, const otx_colour *colour, matrix to_aces)
{
    matrix from_aces;

    d->space = otx_colour_scene_linear(colour);
    if (!d->space || !otx_colour_from_aces(colour, d->space, &from_aces))
        return false;
    d->to_space = otx_primaries_multiply(from_aces, to_aces);
    for (int i = 0; i < 9; ++i)
        if (!(fabs(d->to_space.m[i / 3][i % 3]) < 1e3))
            return false;
    return true;
}

/* Whether all colours come out as those of an sRGB file would, up to half a
 * step of eight bits: then the configuration's own space does it. */
static bool
is_srgb(const otx_decoder *d, const otx_colour *colour, bool is_gray)
{
    otx_decoder srgb = {.exponent = 0.0};
    matrix to_aces;

    if (!otx_colour_srgb(colour) || !otx_primaries_to_aces(srgb_xy, &to_aces) ||
        !lead_to(&srgb, colour, to_aces))
        return false;
    for (int i = 0; i < PROBES * PROBES * PROBES; ++i)
    {
        const float step = 1.0F / (PROBES - 1);
        float a[3] = {
            step * (float)(i % PROBES), step * (float)(i / PROBES % PROBES),
            step * (float)(i / PROBES / PROBES)};
        float b[3];

        if (is_gray)
            a[1] = a[2] = a[0];
        memcpy(b, a, sizeof b);
        decode(d, a, 1);
        decode(&srgb, b, 1);
        for (int k = 0; k < 3; ++k)
            if (!(fabsf(
                      otx_embedding_encode(fmaxf(a[k], 0.0F)) -
                      otx_embedding_encode(fmaxf(b[k], 0.0F))) < 0.004F))
                return false;
    }
    return true;
}

static otx_status
warn(
    otx_run *run, const otx_colour_source *source, const char *what,
    const char *why)
{
    otx_note(
        run, OSDTEX_SEVERITY_WARNING, stage, otx_where_file(source->path),
        "passing over %s, which %s; say {from} to name the picture's colour "
        "space",
        what, why);
    return OSDTEX_OK;
}

static otx_status
from_profile(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    otx_decoder *d, bool *found)
{
    char name[OTX_ICC_NAME_BYTES];
    char reason[OTX_ICC_REASON_BYTES];
    otx_icc_profile *profile = NULL;
    matrix to_aces;

    if (source->icc_fault)
        snprintf(
            reason, sizeof reason, "cannot be used (%.120s)",
            source->icc_fault);
    name[0] = '\0';
    if (!source->icc_fault)
        OTX_TRY(otx_icc_profile_open(
            run, source->icc, source->icc_bytes, source->is_gray, &profile,
            name, reason));
    snprintf(
        d->name, sizeof d->name, "the file's ICC profile%s%s%s",
        name[0] ? " '" : "", name, name[0] ? "'" : "");
    if (!profile)
        return warn(run, source, d->name, reason);
    d->profile = profile;
    if (!otx_primaries_xyz_to_aces(&to_aces) || !lead_to(d, colour, to_aces))
        return warn(
            run, source, d->name,
            "no linear space of the configuration can be compared with");
    *found = true;
    return OSDTEX_OK;
}

/* A curve and primaries; `xy` NULL: those of sRGB. */
static otx_status
from_curve(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    const float *xy, double exponent, otx_decoder *d, bool *found)
{
    matrix to_aces;

    d->exponent = exponent;
    if (!(exponent == 0.0 || (exponent >= 0.1 && exponent <= 10.0)))
        return warn(run, source, d->name, "is out of range");
    if (!otx_primaries_to_aces(xy ? xy : srgb_xy, &to_aces))
        return warn(run, source, d->name, "span no colour space");
    if (!lead_to(d, colour, to_aces))
        return warn(
            run, source, d->name,
            "no linear space of the configuration can be compared with");
    *found = true;
    return OSDTEX_OK;
}

static otx_status
from_gamma(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    otx_decoder *d, bool *found)
{
    const double gamma = (double)source->gamma;
    const bool usual = gamma == 0.0 || fabs(gamma - srgb_gamma) < 0.005;
    const float *xy =
        source->has_chromaticities ? source->chromaticities : NULL;

    if (gamma == 0.0)
        snprintf(d->name, sizeof d->name, "the file's chromaticities (cHRM)");
    else
        snprintf(
            d->name, sizeof d->name, "the file's gamma %.4g%s", gamma,
            xy ? " and chromaticities (gAMA, cHRM)" : " (gAMA)");
    return from_curve(
        run, colour, source, xy, usual ? 0.0 : 1.0 / gamma, d, found);
}

/* The first that is there: a profile, PNG's word for sRGB, a camera's word for
 * Adobe RGB, a gamma and primaries. */
static otx_status
find(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    bool is_linear, otx_decoder *d, bool *found)
{
    if (is_linear)
    {
        snprintf(d->name, sizeof d->name, "the file's chromaticities");
        return from_curve(
            run, colour, source, source->chromaticities, 1.0, d, found);
    }
    if (source->icc || source->icc_fault)
        return from_profile(run, colour, source, d, found);
    if (source->says_srgb)
        return OSDTEX_OK;
    if (source->says_adobe_rgb)
    {
        snprintf(d->name, sizeof d->name, "Adobe RGB, as the file's Exif says");
        return from_curve(
            run, colour, source, adobe_xy, adobe_exponent, d, found);
    }
    if (source->gamma != 0.0F || source->has_chromaticities)
        return from_gamma(run, colour, source, d, found);
    return OSDTEX_OK;
}

otx_status
otx_decoder_create(
    otx_run *run, const otx_colour *colour, const otx_colour_source *source,
    bool is_linear, const otx_decoder **out)
{
    otx_decoder *d = OTX_ZNEW(run->arena, otx_decoder, 1);
    bool found = false;

    *out = NULL;
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(find(run, colour, source, is_linear, d, &found));
    if (!found)
        return OSDTEX_OK;
    if (!is_linear && is_srgb(d, colour, source->is_gray))
    {
        otx_note(
            run, OSDTEX_SEVERITY_INFO, stage, otx_where_file(source->path),
            "%s: sRGB", d->name);
        return OSDTEX_OK;
    }
    *out = d;
    return OSDTEX_OK;
}

/* plane.c -- resampling by area, aprons and spectra. */
#include "match/plane.h"

#include <string.h>

/* Pixels of a side of `size` texels at `level`: a size that transforms well,
 * never more than there are texels. */
static int32_t
side_at_level(int32_t size, int32_t level)
{
    const int32_t part = (int32_t)(((int64_t)size + (1 << level) - 1) >> level);
    const int32_t good = otx_fft_good_size(part);

    return level == 0 || good > size ? size : good;
}

/* Averages `count` source cells of `lanes` floats, `step` apart, over
 * to_count equal intervals: the box filter with exact fractional ends. */
static void
average_line(
    const float *from, int32_t count, size_t from_step, float *to,
    int32_t to_count, size_t to_step, int32_t lanes)
{
    const double width = (double)count / to_count;

    for (int32_t i = 0; i < to_count; ++i)
    {
        const double begin = i * width;
        const double end = i + 1 == to_count ? count : (i + 1) * width;
        double sum[OTX_PLANE_LANES] = {0};

        for (int32_t s = (int32_t)begin; s < count && s < end; ++s)
        {
            const double part = fmin(end, s + 1.0) - fmax(begin, s);

            for (int32_t k = 0; k < lanes; ++k)
                sum[k] += part * (double)from[(size_t)s * from_step + k];
        }
        for (int32_t k = 0; k < lanes; ++k)
            to[(size_t)i * to_step + k] = (float)(sum[k] / width);
    }
}

/* Fills the inside of the plane from `match`. */
static otx_status
resample(otx_run *run, const otx_image *match, otx_plane *plane)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const size_t channels = (size_t)match->channels;
    const size_t narrow_row = (size_t)plane->width * channels;
    float *narrow =
        OTX_NEW(run->scratch, float, (size_t)match->height *narrow_row);

    OTX_TRY(otx_run_ok(run));
    for (int32_t y = 0; y < match->height; ++y)
        average_line(
            otx_image_at(match, 0, y), match->width, channels,
            narrow + (size_t)y * narrow_row, plane->width, channels,
            match->channels);
    for (int32_t x = 0; x < plane->width; ++x)
        average_line(
            narrow + (size_t)x * channels, match->height, narrow_row,
            otx_plane_at(plane, x, 0), plane->height, plane->row_floats,
            match->channels);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

static void
subtract_mean(otx_plane *plane, const double *mean)
{
    for (int32_t y = 0; y < plane->height; ++y)
        for (int32_t x = 0; x < plane->width; ++x)
            for (int32_t k = 0; k < plane->channels; ++k)
            {
                float *value = otx_plane_at(plane, x, y) + k;

                *value = (float)((double)*value - mean[k]);
            }
}

static void
fill_apron(otx_plane *plane)
{
    for (int32_t y = -OTX_PLANE_APRON; y < plane->height + OTX_PLANE_APRON; ++y)
        for (int32_t x = -OTX_PLANE_APRON; x < plane->width + OTX_PLANE_APRON;
             ++x)
        {
            const int32_t i = otx_view_fold(x, plane->width, plane->wrap_x);
            const int32_t j = otx_view_fold(y, plane->height, plane->wrap_y);

            if (i != x || j != y)
                memcpy(
                    otx_plane_at(plane, x, y), otx_plane_at(plane, i, j),
                    OTX_PLANE_LANES * sizeof(float));
        }
}

/* One channel, or the sum of squares for `channel` == channels. */
static void
fill_component(const otx_plane *plane, int32_t channel, float *rows)
{
    const size_t stride = otx_fft_stride(plane->fft);

    memset(rows, 0, (size_t)plane->fft_height * stride * sizeof *rows);
    if (channel == plane->channels)
        for (int32_t y = 0; y < plane->fft_height; ++y)
            for (int32_t x = 0; x < plane->fft_width; ++x)
                rows[(size_t)y * stride + (size_t)x] = (float)plane->beyond;
    rows += (size_t)plane->pad_y * stride + (size_t)plane->pad_x;
    for (int32_t y = 0; y < plane->height; ++y)
        for (int32_t x = 0; x < plane->width; ++x)
        {
            const float *p = otx_plane_at(plane, x, y);

            rows[(size_t)y * stride + (size_t)x] =
                channel < plane->channels
                    ? p[channel]
                    : p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3];
        }
}

static otx_status
transform_components(otx_run *run, otx_plane *plane)
{
    const otx_fft *fft = plane->fft;
    const size_t floats = otx_fft_spectrum_floats(fft);
    const float unit =
        (float)(1.0 / ((double)plane->fft_width * plane->fft_height));
    float *scratch = OTX_NEW(run->scratch, float, otx_fft_scratch_floats(fft));
    float *rows = OTX_NEW(
        run->scratch, float, (size_t)plane->fft_height *otx_fft_stride(fft));

    OTX_TRY(otx_run_ok(run));
    for (int32_t c = 0; c <= plane->channels; ++c)
    {
        plane->spectra[c] = OTX_NEW(run->arena, float, floats);
        OTX_TRY(otx_run_ok(run));
        fill_component(plane, c, rows);
        otx_fft_forward(
            fft, c < plane->channels ? -2.0f * unit : unit, rows, scratch,
            plane->spectra[c]);
    }
    return OSDTEX_OK;
}

static otx_status
make_spectra(otx_run *run, otx_plane *plane)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_status status;
    otx_fft *fft;

    OTX_TRY(otx_fft_create(
        run, run->arena, plane->fft_width, plane->fft_height, &fft));
    plane->fft = fft;
    status = transform_components(run, plane);
    otx_arena_release(run->scratch, mark);
    return status;
}

otx_status
otx_plane_create(
    otx_run *run, const otx_image *match, bool wrap_x, bool wrap_y,
    int32_t level, const double *mean, otx_vec2 overhang, double beyond,
    bool searched, otx_plane *out)
{
    otx_plane plane = {
        .width = side_at_level(match->width, level),
        .height = side_at_level(match->height, level),
        .channels = match->channels,
        .level = level,
        .wrap_x = wrap_x,
        .wrap_y = wrap_y,
        .beyond = beyond,
    };

    plane.pixel.x = (double)match->width / plane.width;
    plane.pixel.y = (double)match->height / plane.height;
    plane.row_floats =
        (size_t)(plane.width + 2 * OTX_PLANE_APRON) * OTX_PLANE_LANES;
    plane.pixels = OTX_ZNEW(
        run->arena, float,
        (size_t)(plane.height + 2 * OTX_PLANE_APRON) * plane.row_floats);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(resample(run, match, &plane));
    subtract_mean(&plane, mean);
    fill_apron(&plane);
    /* What reaches over one rim wraps into the zeros before the other. */
    plane.pad_x = wrap_x ? 0 : (int32_t)ceil(overhang.x / plane.pixel.x) + 1;
    plane.pad_y = wrap_y ? 0 : (int32_t)ceil(overhang.y / plane.pixel.y) + 1;
    plane.fft_width =
        wrap_x ? plane.width : otx_fft_good_size(plane.width + plane.pad_x);
    plane.fft_height =
        wrap_y ? plane.height : otx_fft_good_size(plane.height + plane.pad_y);
    if (searched)
        OTX_TRY(make_spectra(run, &plane));
    *out = plane;
    return OSDTEX_OK;
}

/* bake.c -- blocks on all threads, written in order.
 *
 * While one batch of blocks is made and taken, the one before is put: writing
 * is one more index of the loop, and the first to be taken. */
#include "bake/bake.h"

#include "mapping/source.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "bake";

enum
{
    BLOCK_TEXELS = OTX_MIP_BLOCK * OTX_MIP_BLOCK
};

/* Blocks of a mip level from `first` on, in slots from `slot` on. */
typedef struct batch
{
    int64_t first;
    int32_t count;
    int32_t slot;
} batch;

typedef struct job
{
    const otx_bake *bake;
    const otx_mip *mip;
    const otx_bake_sink *sink;
    int32_t level_count; /* that are baked */
    int32_t batch;       /* blocks of one, at most */
    batch done, next;
} job;

static otx_status
put_batch(const job *j)
{
    for (int32_t i = 0; i < j->done.count; ++i)
    {
        const int64_t index = j->done.first + i;

        OTX_TRY(j->sink->put(
            j->sink->user, j->done.slot + i, j->mip->level,
            (int32_t)(index % j->mip->columns),
            (int32_t)(index / j->mip->columns)));
    }
    return OSDTEX_OK;
}

/* A plane for each kind of map. */
static bool
make_planes(
    const otx_bake *bake, otx_arena *scratch,
    float *planes[OTX_COMPANION_COUNT])
{
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        const bool is_there =
            bake->maps.texels.channels > 0 && bake->maps.first[k] >= 0;
        const int32_t channels = otx_companion_channels((otx_companion_kind)k);

        planes[k] =
            is_there ? OTX_NEW(scratch, float, BLOCK_TEXELS *(size_t)channels)
                     : NULL;
        if (is_there && !planes[k])
            return false;
    }
    return true;
}

/* False when memory is out. */
static bool
bake_block(
    const job *j, const otx_bake_block *block, otx_arena *scratch,
    float *pixels, float *const planes[OTX_COMPANION_COUNT])
{
    const otx_bake *bake = j->bake;

    if (bake->maps_alone)
        return otx_texel_bake_maps(
            &bake->maps, j->mip, block->x, block->y, scratch, planes);
    return pixels && otx_texel_bake(
                         &bake->source,
                         bake->maps.texels.channels > 0 ? &bake->maps : NULL,
                         j->mip, block->x, block->y, scratch, pixels, planes);
}

static otx_status
make_block(job *j, int32_t i, otx_worker *worker)
{
    const int32_t channels = j->bake->source.channels;
    const int64_t index = j->next.first + i;
    float *pixels =
        j->bake->maps_alone
            ? NULL
            : OTX_NEW(worker->scratch, float, BLOCK_TEXELS *(size_t)channels);
    otx_bake_block block = {
        .level = j->mip->level,
        .x = (int32_t)(index % j->mip->columns),
        .y = (int32_t)(index / j->mip->columns),
        .pixels = pixels};
    float *planes[OTX_COMPANION_COUNT];

    if (!make_planes(j->bake, worker->scratch, planes) ||
        !bake_block(j, &block, worker->scratch, pixels, planes))
        return OSDTEX_ERROR_MEMORY;
    block.width = otx_mip_block_size(j->mip, block.x);
    block.height = otx_mip_block_size(j->mip, block.y);
    block.stride = (ptrdiff_t)block.width * channels;
    for (int32_t k = 0; k < OTX_COMPANION_COUNT; ++k)
    {
        block.maps[k] = planes[k];
        block.map_strides[k] = (ptrdiff_t)block.width *
                               otx_companion_channels((otx_companion_kind)k);
    }
    j->sink->take(j->sink->user, j->next.slot + i, worker->index, &block);
    return OSDTEX_OK;
}

/* Index 0 puts what is done; the others each make one block. */
static otx_status
work(void *context, int64_t index, otx_worker *worker)
{
    job *j = context;

    return index == 0 ? put_batch(j)
                      : make_block(j, (int32_t)index - 1, worker);
}

/* How far the tile is: level 0 is about three quarters of the work, and so on.
 */
static double
fraction_of(const job *j, int64_t block)
{
    const double blocks = (double)j->mip->columns * j->mip->columns;
    const double whole = 1.0 - pow(0.25, j->level_count);
    const double at = pow(0.25, j->mip->level - j->sink->first_level);
    const double done = (1.0 - at + 0.75 * at * (double)block / blocks) / whole;

    return fmin(j->sink->begin + j->sink->share * done, 1.0);
}

/* Makes the next batch, and puts the one before. */
static otx_status
run_batch(otx_run *run, job *j)
{
    otx_status status;

    if (j->sink->put_by_caller)
    {
        OTX_TRY(put_batch(j));
        j->done.count = 0;
    }
    status = otx_pool_for(run->pool, j->next.count + 1, work, j);
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(run, STAGE) : status;
}

static otx_status
bake_page(otx_run *run, job *j)
{
    const int64_t blocks = (int64_t)j->mip->columns * j->mip->columns;

    for (int64_t first = 0; first < blocks || j->done.count > 0;)
    {
        const int64_t left = blocks - first;

        j->next.first = first;
        j->next.count = left < j->batch ? (int32_t)left : j->batch;
        OTX_TRY(otx_progress(run, STAGE, fraction_of(j, first)));
        OTX_TRY(run_batch(run, j));
        first += j->next.count;

        const batch swap = j->done;

        j->done = j->next;
        j->next = swap;
    }
    return OSDTEX_OK;
}

static int32_t
level_count(const otx_layout *layout, const otx_bake_sink *sink)
{
    const int32_t left =
        otx_pyramid_count(layout->side, layout->side) - sink->first_level;

    return sink->level_count > 0 && sink->level_count < left ? sink->level_count
                                                             : left;
}

static otx_status
bake_levels(
    otx_run *run, const otx_bake *bake, int32_t tile, const otx_bake_sink *sink)
{
    const otx_layout *layout = bake->source.layout;
    otx_mip mip = {.layout = layout, .tile = tile};
    job *j = OTX_ZNEW(run->scratch, job, 1);

    OTX_TRY(otx_run_ok(run));
    j->batch = otx_bake_slots(bake) / 2;
    j->next.slot = j->batch;
    j->bake = bake;
    j->sink = sink;
    j->mip = &mip;
    j->level_count = level_count(layout, sink);
    OTX_TRY(otx_mip_find_rims(
        run, run->scratch, layout, tile, &mip.rims, &mip.rim_count));
    if (bake->seam_blend > 0.0)
        OTX_TRY(otx_mip_find_seams(
            run, run->scratch, layout, bake->source.mapping->face_patch, tile,
            &mip.seams, &mip.seam_count));
    for (int32_t l = 0; l < j->level_count; ++l)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);

        mip.level = sink->first_level + l;
        mip.blend = 0.5 * bake->seam_blend * pow(0.5, mip.level);
        OTX_TRY(otx_mip_build(run, run->scratch, &mip));
        OTX_TRY(bake_page(run, j));
        otx_arena_release(run->scratch, mark);
    }
    return OSDTEX_OK;
}

int32_t
otx_bake_slots(const otx_bake *bake)
{
    const int32_t own = bake->source.channels;
    const int32_t maps = bake->maps.texels.channels;

    if (bake->maps_alone || maps == 0)
        return OTX_BAKE_SLOTS;
    /* Heights are as wide as two others. */
    return OTX_BAKE_SLOTS / 2 * own /
           (own + maps + otx_map_source_welds(&bake->maps)) * 2;
}

otx_status
otx_bake_tile(
    otx_run *run, const otx_bake *bake, int32_t tile, const otx_bake_sink *sink)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_status status = bake_levels(run, bake, tile, sink);

    otx_arena_release(run->scratch, mark);
    return status;
}

/* Of the colours of all exemplars: with alpha when one has it. */
static int32_t
color_channels(const otx_exemplar *exemplars, int32_t count)
{
    int32_t most = 0;

    for (int32_t k = 0; k < count; ++k)
        if (exemplars[k].linear.channels > most)
            most = exemplars[k].linear.channels;
    return most;
}

static int32_t
channels_of(otx_texel_kind kind, const otx_exemplar *exemplars, int32_t count)
{
    if (kind == OTX_TEXEL_COLOR)
        return color_channels(exemplars, count);
    return kind == OTX_TEXEL_SOURCE ? 4 : 3;
}

/* Of all exemplars, channel by channel. What one without alpha lacks is 1. */
static void
find_range(
    const otx_exemplar *exemplars, int32_t count, int32_t channels, float *low,
    float *high)
{
    for (int32_t c = 0; c < channels; ++c)
    {
        low[c] = INFINITY;
        high[c] = -INFINITY;
        for (int32_t k = 0; k < count; ++k)
        {
            const otx_image *image = &exemplars[k].linear;
            const int64_t texels = (int64_t)image->width * image->height;

            for (int64_t i = 0; i < texels; ++i)
            {
                const float value = c < image->channels
                                        ? image->pixels[i * image->channels + c]
                                        : 1.0f;

                low[c] = value < low[c] ? value : low[c];
                high[c] = value > high[c] ? value : high[c];
            }
        }
    }
}

static otx_status
make_texture(otx_run *run, const otx_exemplar *from, otx_texture *out)
{
    OTX_TRY(otx_texture_create(
        run, run->arena, &from->linear, from->wrap_x, from->wrap_y, out));
    return from->slices ? otx_texture_add_slices(
                              run, run->arena, from->slices->linear,
                              from->slices->count, out)
                        : OSDTEX_OK;
}

otx_status
otx_bake_create(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_layout *layout, const otx_bake_options *options, otx_bake *out)
{
    const int32_t count = otx_source_count(mapping);
    const bool has_color =
        options->kind == OTX_TEXEL_COLOR && !options->maps_alone;

    *out = (otx_bake){
        .maps_alone = options->maps_alone,
        .seam_blend =
            options->kind == OTX_TEXEL_COLOR ? options->seam_blend : 0.0,
        .source = {
            .mapping = mapping,
            .show = otx_show_of(mapping),
            .layout = layout,
            .exemplars = exemplars,
            .kind = options->kind,
            .channels = channels_of(options->kind, exemplars, count),
        }};
    if (has_color)
        find_range(
            exemplars, count, out->source.channels, out->source.low,
            out->source.high);
    for (int32_t k = 0; has_color && k < count; ++k)
        OTX_TRY(make_texture(run, &exemplars[k], &out->source.textures[k]));
    if (options->maps && options->kind == OTX_TEXEL_COLOR)
        return otx_map_source_create(
            run, mapping, exemplars, layout, options->maps,
            options->normals_y_down, &out->maps);
    return OSDTEX_OK;
}

void
otx_bake_copy(const otx_bake_block *block, const otx_image *image)
{
    const int32_t bottom =
        image->height - block->y * OTX_MIP_BLOCK - block->height;
    const size_t row =
        (size_t)block->width * (size_t)image->channels * sizeof(float);

    for (int32_t y = 0; y < block->height; ++y)
        memcpy(
            otx_image_at(image, block->x * OTX_MIP_BLOCK, bottom + y),
            block->pixels + y * block->stride, row);
}

const char *
otx_bake_kind_name(otx_texel_kind kind)
{
    static const char *const names[OTX_TEXEL_KIND_COUNT] = {
        "color", "patch", "uv", "stretch", "seam", "source", "slice"};

    return names[kind];
}

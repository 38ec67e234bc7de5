/* bend.c -- relaxation of a patch as it is placed [Soler02, sec. 4.4].
 *
 * The best match of the mask is often not the best once the patch has been
 * bent, so several placements are relaxed and compared by what is left along
 * the border. The winner's bend goes into the chart: from there on the patch
 * is a chart like any other, rigidly placed. */
#include "patch/bend.h"

#include "base/random.h"
#include "relax/nudge.h"

#include <string.h>

enum
{
    STAGE_NUDGE = 0x6e756467
};

/* Chart to exemplar. */
static void
place_chart(const otx_chart *chart, otx_match placed, otx_vec2 *uv)
{
    const otx_vec2 turn = otx_vec2_polar(placed.angle);

    for (int32_t v = 0; v < chart->vert_count; ++v)
        uv[v] = otx_vec2_add(otx_vec2_mul(turn, chart->flat[v]), placed.shift);
}

/* Exemplar to chart. */
static void
keep_bend(otx_chart *chart, otx_match placed, const otx_vec2 *uv)
{
    const otx_vec2 back = otx_vec2_polar(-placed.angle);

    for (int32_t v = 0; v < chart->vert_count; ++v)
        chart->flat[v] = otx_vec2_mul(back, otx_vec2_sub(uv[v], placed.shift));
}

otx_status
otx_bend_relax(
    const otx_mosaic *m, int32_t index, const otx_match *placed, int32_t count,
    otx_chart_space *space, otx_arena *scratch, otx_match *best)
{
    const otx_arena_mark mark = otx_arena_here(scratch);
    otx_node *node = &m->forest.nodes[index];
    const int32_t verts = node->chart.vert_count;
    otx_vec2 *uv = OTX_NEW(scratch, otx_vec2, verts);
    otx_vec2 *kept = OTX_NEW(scratch, otx_vec2, verts);
    otx_nudge_request request = {
        .surface = m->job.surface,
        .exemplar = otx_supply_of(m, node)->exemplar,
        .texels = m->job.texels,
        .face_patch = m->cover.face_patch,
        .uvs = m->cover.uvs,
        .exemplars = m->job.exemplars,
        .patch_exemplar = m->cover.patch_exemplar,
    };
    double least = INFINITY;

    if (!uv || !kept)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < count; ++i)
    {
        const uint64_t element = (uint64_t)index * 16u + (uint64_t)i;
        double error;

        request.seed = otx_random_bits(m->job.run->seed, STAGE_NUDGE, element);
        place_chart(&node->chart, placed[i], uv);
        OTX_TRY(otx_nudge_run(
            &request, &node->cluster, &node->chart, space->vert_slot, scratch,
            uv, &error));
        if (!(error < least))
            continue;
        least = error;
        *best = placed[i];
        memcpy(kept, uv, (size_t)verts * sizeof *uv);
    }
    best->error = least;
    keep_bend(&node->chart, *best, kept);
    otx_arena_release(scratch, mark);
    return OSDTEX_OK;
}

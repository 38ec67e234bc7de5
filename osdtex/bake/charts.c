/* charts.c -- cut, pack, coordinates. */
#include "bake/charts.h"

#include "bake/chart_cut.h"
#include "bake/chart_pack.h"
#include "image/udim.h"

#include <string.h>

static const char STAGE[] = "bake";

enum
{
    MARGIN_LEAST = 4,
    MARGIN_SHARE = 256 /* of a tile's side to a margin that is not given */
};

static int32_t
margin_of(const otx_atlas_options *options)
{
    int32_t margin = MARGIN_LEAST;

    if (options->margin > 0)
        return options->margin;
    while (2 * margin * MARGIN_SHARE <= options->side)
        margin *= 2;
    return margin;
}

/* Chart of each face of the cage, -1 on holes. */
static int32_t *
charts_of_faces(otx_run *run, const otx_cage *cage, const otx_chart_cut *cut)
{
    int32_t *owner = OTX_NEW(run->scratch, int32_t, cage->face_count);

    for (int32_t f = 0; owner && f < cage->face_count; ++f)
        owner[f] = -1;
    for (int32_t i = 0; owner && i < cut->chart_count; ++i)
        for (int32_t k = cut->first[i]; k < cut->first[i + 1]; ++k)
            owner[cut->faces[k]] = i;
    return owner;
}

static otx_status
list_rims(
    otx_run *run, const otx_level *level, const otx_chart_cut *cut,
    const int32_t *owner, otx_chart_rims *out)
{
    int32_t *first = OTX_NEW(run->scratch, int32_t, cut->chart_count + 1);
    otx_vec2 *ends =
        OTX_NEW(run->scratch, otx_vec2, 2 * (size_t)level->corner_count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < cut->chart_count; ++i)
    {
        first[i] = count;
        for (int32_t j = cut->first[i]; j < cut->first[i + 1]; ++j)
        {
            const int32_t f = cut->faces[j], at = level->face_first[f];
            const int32_t n = otx_level_face_size(level, f);

            for (int32_t k = 0; k < n; ++k)
            {
                const int32_t g = otx_level_neighbour(level, f, k);

                if (g >= 0 && owner[g] == i)
                    continue;
                ends[2 * count] = cut->flat[at + k];
                ends[2 * count + 1] = cut->flat[at + (k + 1) % n];
                ++count;
            }
        }
    }
    first[cut->chart_count] = count;
    *out = (otx_chart_rims){cut->chart_count, first, ends};
    return OSDTEX_OK;
}

static void
put_uv(
    const otx_chart_place *place, double scale, int32_t side, otx_vec2 flat,
    float uv[2])
{
    const otx_vec2 at = otx_vec2_add(
        place->shift, otx_vec2_scale(scale, otx_vec2_mul(place->turn, flat)));

    uv[0] = (float)(place->tile % OTX_UDIM_COLUMNS + at.x / side);
    uv[1] = (float)(place->tile / OTX_UDIM_COLUMNS + at.y / side);
}

/* One coordinate for each vertex of a chart. */
static otx_status
put_uvs(
    otx_run *run, const otx_level *level, const otx_chart_cut *cut,
    const otx_chart_packing *packing, int32_t side, otx_atlas *out)
{
    int32_t *chart = OTX_NEW(run->scratch, int32_t, level->vert_count);
    int32_t *index = OTX_NEW(run->scratch, int32_t, level->vert_count);
    int32_t *corners = OTX_ZNEW(run->arena, int32_t, level->corner_count);
    float *uvs = OTX_ZNEW(run->arena, float, 2 * (size_t)level->corner_count);
    int32_t count = 1; /* the first is that of holes */

    OTX_TRY(otx_run_ok(run));
    memset(chart, -1, (size_t)level->vert_count * sizeof *chart);
    out->uvs =
        OTX_ZNEW(run->arena, float, 2 * ((size_t)level->corner_count + 1));
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < cut->chart_count; ++i)
        for (int32_t j = cut->first[i]; j < cut->first[i + 1]; ++j)
            for (int32_t c = level->face_first[cut->faces[j]];
                 c < level->face_first[cut->faces[j] + 1]; ++c)
            {
                const int32_t v = level->face_verts[c];

                if (chart[v] != i)
                {
                    chart[v] = i;
                    index[v] = count++;
                    put_uv(
                        &packing->places[i], packing->scale, side, cut->flat[c],
                        out->uvs + 2 * (size_t)index[v]);
                }
                corners[c] = index[v];
                memcpy(
                    uvs + 2 * (size_t)c, out->uvs + 2 * (size_t)index[v],
                    2 * sizeof *uvs);
            }
    out->uv_count = count;
    out->corner_index = corners;
    out->corner_uvs = uvs;
    return OSDTEX_OK;
}

/* Of the tiles' area, what faces of the cage take. */
static double
use_of(const otx_level *level, const otx_atlas *atlas)
{
    double sum = 0.0;

    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const int32_t first = level->face_first[f];
        const int32_t n = otx_level_face_size(level, f);

        for (int32_t k = 0; k < n; ++k)
        {
            const float *a = atlas->corner_uvs + 2 * (size_t)(first + k);
            const float *b =
                atlas->corner_uvs + 2 * (size_t)(first + (k + 1) % n);

            sum += 0.5 * ((double)a[0] * b[1] - (double)a[1] * b[0]);
        }
    }
    return sum / atlas->tile_count;
}

static otx_status
make(
    otx_run *run, const otx_surface *surface, const otx_atlas_options *options,
    otx_atlas *out)
{
    const otx_level *level = &surface->levels[0];
    const double room = options->side - 2.0 * out->margin - 8.0;
    const double most = options->texels_per_unit > 0.0
                            ? room / options->texels_per_unit
                            : (double)INFINITY;
    otx_chart_packing packing;
    otx_chart_rims rims;
    otx_chart_cut cut;
    int32_t *owner;

    OTX_TRY(otx_chart_cut_make(run, surface, most, &cut));
    owner = charts_of_faces(run, surface->cage, &cut);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(list_rims(run, level, &cut, owner, &rims));
    OTX_TRY(otx_chart_pack(
        run, &rims, options->side, out->margin, options->texels_per_unit,
        &packing));
    out->texels_per_unit = packing.scale;
    out->tile_count = packing.tile_count;
    OTX_TRY(put_uvs(run, level, &cut, &packing, options->side, out));
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
        "%d charts use %.0f %% of %d tile%s; their stretch is %.3f (RMS), "
        "margins are %d texels, %.4g texels per scene unit",
        cut.chart_count, 100.0 * use_of(level, out), out->tile_count,
        out->tile_count == 1 ? "" : "s", cut.stretch, out->margin,
        out->texels_per_unit);
    return OSDTEX_OK;
}

otx_status
otx_charts_make(
    otx_run *run, const otx_surface *surface, const otx_atlas_options *options,
    otx_atlas *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);

    *out = (otx_atlas){0};
    OTX_TRY(otx_atlas_check(run, options));
    out->margin = margin_of(options);
    OTX_TRY(make(run, surface, options, out));
    otx_arena_release(run->scratch, mark);
    return otx_atlas_check_tiles(run, out);
}

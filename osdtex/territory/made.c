/* made.c -- what was made of charts' texels, as a field of sources. */
#include "territory/made.h"

/* The field, as it is made up. */
typedef struct field_maker
{
    const otx_target_set *h;
    otx_source_chart *charts;
    otx_source_texel *texels;
    int32_t *face_chart;
    float *places, *metric;
} field_maker;

/* Marks the faces of a core that have a texel that was made; where all of it
 * was, those that are smaller than a texel, too. */
static void
mark_faces(field_maker *m, int32_t k)
{
    const otx_plot *plot = &m->h->plots[k];
    const int64_t count = (int64_t)plot->width * plot->height;

    for (int32_t i = 0; m->h->whole && i < plot->chart->core_count; ++i)
        m->face_chart[plot->chart->faces[i]] = k;
    for (int64_t i = 0; i < count; ++i)
        if (m->h->targets[k].kinds[i] == OTX_SYNTH_FREE)
            m->face_chart[plot->chart
                              ->faces[plot->facets[i] / OTX_PLOT_FACETS]] = k;
}

/* A face that is made in part is shown by its chart as a whole: what of it was
 * frozen shows there what its UVs say. */
static void
give_face(field_maker *m, int32_t k, int32_t slot)
{
    const otx_level *leaf = otx_surface_leaf(m->h->mapping->surface);
    const otx_plot *plot = &m->h->plots[k];
    const int32_t face = plot->chart->faces[slot];
    const int32_t facets = otx_facet_count(leaf, face);
    float *place = m->places + 2 * (size_t)leaf->face_first[face];
    float *metric = m->metric + 3 * (size_t)face;

    if (m->face_chart[face] != k)
        return;
    for (int32_t c = 0; c < facets + 2; ++c)
    {
        const otx_vec2 p = otx_plot_corner(plot, slot, c);

        place[2 * c] = (float)p.x;
        place[2 * c + 1] = (float)p.y;
    }
    metric[0] = metric[2] = 1.0f;
    for (int32_t i = 0; i < facets; ++i)
    {
        otx_plot_facet f;

        if (!otx_plot_facet_of(
                plot, m->h->mapping->surface, m->h->texels, slot, i, &f))
            continue;
        for (int c = 0; c < 3; ++c)
            metric[c] += (float)(f.metric[c] - metric[c]) / (float)(i + 1);
    }
}

static void
give_texels(field_maker *m, int32_t k)
{
    const otx_target *t = &m->h->targets[k];
    otx_source_chart *chart = &m->charts[k];
    otx_source_texel *to = m->texels + chart->first;

    for (int64_t i = 0; i < (int64_t)chart->width * chart->height; ++i)
        if (t->kinds[i] != OTX_SYNTH_VOID)
            to[i] = (otx_source_texel){
                t->matches[i].x * (float)chart->unit.x,
                t->matches[i].y * (float)chart->unit.y, t->matches[i].c,
                t->matches[i].s};
}

/* Sizes and places of the charts; the number of texels. */
static int64_t
size_charts(field_maker *m)
{
    const otx_target_set *h = m->h;
    int64_t first = 0;

    for (int32_t k = 0; k < h->territory.count; ++k)
    {
        const int32_t from = h->territory.exemplar[k];
        const otx_image *image = &h->exemplars[from].lab;

        m->charts[k] = (otx_source_chart){
            .first = first,
            .unit = {1.0 / image->width, 1.0 / image->height},
            .exemplar = from};
        if (h->targets[k].free == 0)
            continue;
        m->charts[k].width = h->plots[k].width;
        m->charts[k].height = h->plots[k].height;
        first += (int64_t)m->charts[k].width * m->charts[k].height;
    }
    return first;
}

otx_status
otx_made_hand_out(const otx_target_set *h, const otx_source_field **out)
{
    const otx_level *leaf = otx_surface_leaf(h->mapping->surface);
    otx_arena *arena = h->run->arena;
    otx_source_field *field = OTX_NEW(arena, otx_source_field, 1);
    field_maker m = {
        .h = h,
        .charts = OTX_NEW(arena, otx_source_chart, h->territory.count),
        .face_chart = OTX_NEW(arena, int32_t, leaf->face_count),
        .places = OTX_ZNEW(arena, float, 2 * (int64_t)leaf->corner_count),
        .metric = OTX_ZNEW(arena, float, 3 * (int64_t)leaf->face_count)};

    OTX_TRY(otx_run_ok(h->run));
    m.texels = OTX_ZNEW(arena, otx_source_texel, size_charts(&m));
    OTX_TRY(otx_run_ok(h->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        m.face_chart[f] = -1;
    for (int32_t k = 0; k < h->territory.count; ++k)
    {
        if (h->targets[k].free == 0)
            continue;
        mark_faces(&m, k);
        give_texels(&m, k);
        for (int32_t slot = 0; slot < h->plots[k].chart->core_count; ++slot)
            give_face(&m, k, slot);
    }
    *field = (otx_source_field){h->territory.count, m.charts, m.texels,
                                m.face_chart,       m.places, m.metric};
    *out = field;
    return OSDTEX_OK;
}

/* heal.c -- seams mended: charts, synthesis, and what comes of it. */
#include "heal/heal.h"

#include "heal/plot.h"
#include "mapping/seam.h"
#include "synth/synth.h"

#include <string.h>

enum
{
    CORE = 288 /* texels across, of what a chart makes */
};

/* A chart's target: what otx_synth_chart borrows. */
typedef struct target
{
    uint8_t *kinds;
    float *metric;
    otx_synth_match *matches;
    otx_synth_place *places;
    int64_t free; /* texels to make */
} target;

typedef struct healer
{
    otx_run *run;
    const otx_mapping *mapping;
    const otx_exemplar *exemplars;
    const otx_heal_options *options;
    double texels; /* per scene unit */
    uint8_t *seam; /* [leaf edge_count] */
    otx_territory territory;
    otx_plot *plots;  /* [territory.count] */
    target *targets;  /* likewise */
    int32_t exemplar; /* at hand */
} healer;

/* Where two exemplars meet is no seam to mend. */
static otx_status
list_seams(healer *h, otx_heal_figures *figures)
{
    const otx_level *leaf = otx_surface_leaf(h->mapping->surface);
    otx_seam_list seams;

    h->seam = OTX_ZNEW(h->run->scratch, uint8_t, leaf->edge_count);
    if (!h->seam)
        return otx_fail_memory(h->run, "heal");
    OTX_TRY(otx_seam_collect(h->run, h->mapping, h->exemplars, &seams));
    for (int32_t i = 0; i < seams.edge_count; ++i)
        h->seam[seams.edges[i]] = !seams.transition[i];
    figures->seam_length = seams.total_length - seams.transition_length;
    return OSDTEX_OK;
}

static otx_status
plot_chart(healer *h, int32_t k)
{
    const otx_surface *surface = h->mapping->surface;

    OTX_TRY(
        otx_plot_build(h->run, surface, &h->territory.charts[k], &h->plots[k]));
    otx_plot_mark(surface, h->seam, 0.5 * h->options->band, &h->plots[k]);
    return OSDTEX_OK;
}

/* Where a facet's UVs are, texels of the exemplar, and the rotation to there;
 * false where they are reversed. */
typedef struct lookup
{
    otx_vec2 at, dx, dy; /* of the plot's origin, and per texel */
    otx_vec2 turn;       /* from the metric's frame */
} lookup;

static bool
look_up(const healer *h, const otx_plot_facet *f, lookup *out)
{
    const otx_image *image = &h->exemplars[h->exemplar].lab;
    const double *m = f->metric;
    const double det = m[0] * m[2] - m[1] * m[1];

    *out = (lookup){{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    for (int k = 0; k < 3; ++k)
    {
        const float *uv = h->mapping->uvs + 2 * (size_t)f->facet.corners[k];
        const otx_vec2 at = {
            (double)uv[0] * image->width, (double)uv[1] * image->height};

        out->at = otx_vec2_add(out->at, otx_vec2_scale(f->at[k], at));
        out->dx = otx_vec2_add(out->dx, otx_vec2_scale(f->dx[k], at));
        out->dy = otx_vec2_add(out->dy, otx_vec2_scale(f->dy[k], at));
    }
    if (!(otx_vec2_cross(out->dx, out->dy) > 0.0) || !(det > 0.0))
        return false;

    /* The nearest rotation to (dx dy) M^-1, whose scale does not matter. */
    const otx_vec2 x = otx_vec2_sub(
        otx_vec2_scale(m[2], out->dx), otx_vec2_scale(m[1], out->dy));
    const otx_vec2 y = otx_vec2_sub(
        otx_vec2_scale(m[0], out->dy), otx_vec2_scale(m[1], out->dx));
    const otx_vec2 turn = {x.x + y.y, x.y - y.x};
    const double length = otx_vec2_length(turn);

    if (!(length > 0.0))
        return false;
    out->turn = otx_vec2_scale(1.0 / length, turn);
    return true;
}

/* The chart that makes a face, when it is another one than k. */
static int32_t
owner_of(const healer *h, int32_t k, int32_t face)
{
    const int32_t owner = h->territory.owner[face];

    return owner >= 0 && owner != k && h->plots[owner].width > 0 &&
                   h->territory.exemplar[owner] == h->exemplar
               ? owner
               : -1;
}

/* Where a texel of a collar lies in its owner's plot; false where that does not
 * make it. */
static bool
place_texel(
    const healer *h, int32_t owner, const otx_plot_facet *here,
    const otx_plot_facet *there, const double at[3], otx_synth_place *out)
{
    const otx_plot *plot = &h->plots[owner];
    otx_vec2 p = {0.0, 0.0};
    /* Both turn to the facet's own frame. */
    const otx_vec2 turn = otx_vec2_mul(
        (otx_vec2){there->rotation.x, -there->rotation.y}, here->rotation);

    for (int k = 0; k < 3; ++k)
        p = otx_vec2_add(p, otx_vec2_scale(at[k], there->p[k]));
    *out = (otx_synth_place){
        owner, (float)p.x, (float)p.y, (float)turn.x, (float)turn.y};

    const int32_t x = (int32_t)floor(p.x), y = (int32_t)floor(p.y);

    return x >= 0 && y >= 0 && x < plot->width && y < plot->height &&
           plot->near[(int64_t)y * plot->width + x];
}

static void
fill_texel(
    const healer *h, int32_t k, int32_t x, int32_t y, const otx_plot_facet *f,
    const otx_plot_facet *there, int32_t owner, const lookup *look)
{
    const otx_plot *plot = &h->plots[k];
    const int64_t i = (int64_t)y * plot->width + x;
    const bool own = h->territory.owner[f->facet.face] == k;
    target *t = &h->targets[k];
    double at[3];

    otx_plot_at(f, x, y, at);
    for (int c = 0; c < 3; ++c)
        t->metric[3 * i + c] = (float)f->metric[c];
    t->matches[i] = (otx_synth_match){
        (float)(look->at.x + (x + 0.5) * look->dx.x + (y + 0.5) * look->dy.x),
        (float)(look->at.y + (x + 0.5) * look->dx.y + (y + 0.5) * look->dy.y),
        (float)look->turn.x, (float)look->turn.y};
    t->kinds[i] = own && plot->near[i] ? OTX_SYNTH_FREE : OTX_SYNTH_FROZEN;
    t->free += t->kinds[i] == OTX_SYNTH_FREE;
    if (owner >= 0 && place_texel(h, owner, f, there, at, &t->places[i]))
        t->kinds[i] = OTX_SYNTH_COLLAR;
}

/* The texels of one facet. */
static void
fill_facet(const healer *h, int32_t k, int32_t slot, int32_t index)
{
    const otx_surface *surface = h->mapping->surface;
    const otx_plot *plot = &h->plots[k];
    const int32_t face = plot->chart->faces[slot];
    int32_t owner = owner_of(h, k, face);
    otx_plot_facet f, there;
    int32_t box[4];
    lookup look;

    if (otx_source_of(h->mapping, face) != h->exemplar ||
        !otx_seam_covered(h->mapping, face) ||
        !otx_plot_facet_of(plot, surface, h->texels, slot, index, &f) ||
        !look_up(h, &f, &look))
        return;
    if (owner >= 0 && !otx_plot_facet_of(
                          &h->plots[owner], surface, h->texels,
                          h->territory.slot[face], index, &there))
        owner = -1;
    otx_plot_box(plot, &f, box);
    for (int32_t y = box[1]; y < box[3]; ++y)
        for (int32_t x = box[0]; x < box[2]; ++x)
            if (plot->facets[(int64_t)y * plot->width + x] ==
                otx_plot_id(slot, index))
                fill_texel(h, k, x, y, &f, &there, owner, &look);
}

static otx_status
fill_chart(healer *h, int32_t k)
{
    const otx_plot *plot = &h->plots[k];
    const otx_level *leaf = otx_surface_leaf(h->mapping->surface);
    const int64_t count = (int64_t)plot->width * plot->height;
    otx_arena *arena = h->run->scratch;
    target *t = &h->targets[k];

    t->kinds = OTX_ZNEW(arena, uint8_t, count);
    t->metric = OTX_ZNEW(arena, float, 3 * count);
    t->matches = OTX_ZNEW(arena, otx_synth_match, count);
    t->places = OTX_ZNEW(arena, otx_synth_place, count);
    OTX_TRY(otx_run_ok(h->run));
    for (int32_t slot = 0; slot < plot->chart->face_count && count > 0; ++slot)
        for (int32_t i = 0; i < otx_facet_count(leaf, plot->chart->faces[slot]);
             ++i)
            fill_facet(h, k, slot, i);
    return OSDTEX_OK;
}

static otx_status
synthesise(healer *h, int32_t chart_count, const otx_synth_chart *charts)
{
    const otx_exemplar *from = &h->exemplars[h->exemplar];
    otx_synth_options options = otx_synth_mending();
    otx_pattern pattern;

    options.levels = h->options->levels;
    options.coarse_radius = h->options->coarse_radius;
    options.starts = h->options->starts;
    options.seed = h->run->seed + (uint64_t)h->exemplar;
    options.stage = "heal";
    OTX_TRY(otx_pattern_build(
        h->run, h->run->scratch,
        &(otx_pattern_input){
            .lab = &from->lab,
            .wrap_x = from->wrap_x,
            .wrap_y = from->wrap_y,
            .edge = 0.7,
            .levels = options.levels},
        &pattern));
    return otx_synth_run(h->run, &pattern, charts, chart_count, &options);
}

/* All charts of one exemplar, made together. Those of others stand between
 * them without a texel, so that numbers stay. */
static otx_status
heal_exemplar(healer *h)
{
    const int32_t count = h->territory.count;
    otx_synth_chart *charts = OTX_ZNEW(h->run->scratch, otx_synth_chart, count);
    int64_t free = 0;

    if (!charts)
        return otx_fail_memory(h->run, "heal");
    for (int32_t k = 0; k < count; ++k)
        if (h->territory.exemplar[k] == h->exemplar)
        {
            OTX_TRY(fill_chart(h, k));
            free += h->targets[k].free;
        }
    for (int32_t k = 0; k < count; ++k)
        if (h->targets[k].free > 0 && h->territory.exemplar[k] == h->exemplar)
            charts[k] = (otx_synth_chart){
                .width = h->plots[k].width,
                .height = h->plots[k].height,
                .kinds = h->targets[k].kinds,
                .metric = h->targets[k].metric,
                .places = h->targets[k].places,
                .matches = h->targets[k].matches};
    return free > 0 ? synthesise(h, count, charts) : OSDTEX_OK;
}

/* What the healed faces show, as it is made up. */
typedef struct field_maker
{
    const healer *h;
    otx_source_chart *charts;
    otx_source_texel *texels;
    int32_t *face_chart;
    float *places, *metric;
} field_maker;

/* Marks the faces of a core that have a texel that was made. */
static void
mark_faces(field_maker *m, int32_t k)
{
    const otx_plot *plot = &m->h->plots[k];
    const int64_t count = (int64_t)plot->width * plot->height;

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
    const target *t = &m->h->targets[k];
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
    const healer *h = m->h;
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

static otx_status
hand_out(const healer *h, const otx_source_field **out)
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

static otx_status
heal(healer *h, const otx_source_field **out, otx_heal_figures *figures)
{
    const int32_t radius = h->options->coarse_radius;
    const otx_territory_options territory = {
        .texels = h->texels,
        .side = CORE,
        .collar = (double)(radius << (h->options->levels - 1)) + 4.0};

    OTX_TRY(list_seams(h, figures));
    if (!(figures->seam_length > 0.0))
        return OSDTEX_OK;
    OTX_TRY(otx_territory_build(h->run, h->mapping, &territory, &h->territory));
    h->plots = OTX_ZNEW(h->run->scratch, otx_plot, h->territory.count);
    h->targets = OTX_ZNEW(h->run->scratch, target, h->territory.count);
    OTX_TRY(otx_run_ok(h->run));
    for (int32_t k = 0; k < h->territory.count; ++k)
        OTX_TRY(plot_chart(h, k));
    for (h->exemplar = 0; h->exemplar < otx_source_count(h->mapping);
         ++h->exemplar)
        OTX_TRY(heal_exemplar(h));
    for (int32_t k = 0; k < h->territory.count; ++k)
    {
        figures->charts += h->targets[k].free > 0;
        figures->texels += h->targets[k].free;
    }
    figures->area = h->texels * h->texels * h->mapping->surface->area;
    return hand_out(h, out);
}

otx_status
otx_heal_run(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_heal_options *options, const otx_source_field **out,
    otx_heal_figures *figures)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    healer h = {
        .run = run,
        .mapping = mapping,
        .exemplars = exemplars,
        .options = options,
        .texels = otx_seam_texels_per_unit(mapping, exemplars)};
    otx_status status;

    *out = NULL;
    *figures = (otx_heal_figures){0};
    status = heal(&h, out, figures);
    otx_arena_release(run->scratch, mark);
    return status;
}

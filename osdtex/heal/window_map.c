/* window_map.c -- how far what each face shows is from the exemplar. */
#include "heal/window_map.h"

#include "heal/gate.h"

enum
{
    CORE = 288 /* texels across */
};

#define COLLAR 40.0 /* texels; half a window, and more */
#define LEAST 1e-6  /* an exemplar that is all the same has no distances */

typedef struct map_maker
{
    otx_target_set set;
    otx_judged *judged; /* [territory.count] */
    otx_window_map *out;
    int64_t windows, above;
    double sum;
} map_maker;

/* The match of a texel that shows `uvs` at the corners of its facet. */
static otx_synth_match
match_of(
    const map_maker *m, const otx_plot_facet *f, const double at[3],
    const otx_vec2 uvs[3])
{
    const otx_image *image = &m->set.exemplars[m->set.exemplar].lab;
    otx_vec2 p = {0.0, 0.0}, dx = p, dy = p;

    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 q = {uvs[k].x * image->width, uvs[k].y * image->height};

        p = otx_vec2_add(p, otx_vec2_scale(at[k], q));
        dx = otx_vec2_add(dx, otx_vec2_scale(f->dx[k], q));
        dy = otx_vec2_add(dy, otx_vec2_scale(f->dy[k], q));
    }

    /* The search begins at the angle, it need not be exact. */
    const otx_vec2 turn = {dx.x + dy.y, dx.y - dy.x};
    const double length = otx_vec2_length(turn);

    return (otx_synth_match){
        (float)p.x, (float)p.y, length > 0.0 ? (float)(turn.x / length) : 1.0f,
        length > 0.0 ? (float)(turn.y / length) : 0.0f};
}

/* A texel of a face that was made shows what the field says most of. */
static void
read_texel(const map_maker *m, int32_t k, int64_t i)
{
    const otx_mapping *mapping = m->set.mapping;
    const otx_plot *plot = &m->set.plots[k];
    const int32_t slot = plot->facets[i] / OTX_PLOT_FACETS;
    const int32_t face = plot->chart->faces[slot];
    otx_source_term terms[OTX_SOURCE_FIELD_TERMS];
    otx_plot_facet f;
    double at[3];
    int best = 0;

    if (mapping->field->face_chart[face] < 0 ||
        !otx_plot_facet_of(
            plot, mapping->surface, m->set.texels, slot,
            plot->facets[i] % OTX_PLOT_FACETS, &f))
        return;
    otx_plot_at(&f, (int32_t)(i % plot->width), (int32_t)(i / plot->width), at);
    otx_source_field_look(mapping->field, face, f.facet.corners, at, terms);
    for (int t = 1; t < OTX_SOURCE_FIELD_TERMS; ++t)
        if (terms[t].weight > terms[best].weight)
            best = t;
    if (terms[best].weight > 0.0)
        m->set.targets[k].matches[i] = match_of(m, &f, at, terms[best].uvs);
}

static void
read_field(const map_maker *m, int32_t k)
{
    const otx_plot *plot = &m->set.plots[k];
    const int64_t count = (int64_t)plot->width * plot->height;

    for (int64_t i = 0; m->set.mapping->field && i < count; ++i)
        if (m->set.targets[k].kinds[i] != OTX_SYNTH_VOID)
            read_texel(m, k, i);
}

static void
add_windows(map_maker *m, const otx_judged *j, double itself)
{
    for (int64_t i = 0; i < (int64_t)j->width * j->height; ++i)
        if (j->distances[i] >= 0.0f)
        {
            ++m->windows;
            m->above += j->distances[i] > itself;
            m->sum += j->distances[i] / itself;
        }
}

/* Each face of the core has what its middle has. */
static void
give_faces(map_maker *m, int32_t k, double itself)
{
    const otx_level *leaf = otx_surface_leaf(m->set.mapping->surface);
    const otx_plot *plot = &m->set.plots[k];
    const otx_judged *j = &m->judged[k];

    for (int32_t slot = 0; slot < plot->chart->core_count; ++slot)
    {
        const int32_t face = plot->chart->faces[slot];
        const int32_t size = otx_level_face_size(leaf, face);
        otx_vec2 middle = {0.0, 0.0};

        for (int32_t c = 0; c < size; ++c)
            middle = otx_vec2_add(
                middle,
                otx_vec2_scale(1.0 / size, otx_plot_corner(plot, slot, c)));

        const int32_t x = (int32_t)(middle.x / (double)j->step_x);
        const int32_t y = (int32_t)(middle.y / (double)j->step_y);

        if (x < 0 || y < 0 || x >= j->width || y >= j->height)
            continue;

        const float d = j->distances[(int64_t)y * j->width + x];

        m->out->faces[face] = d >= 0.0f ? d / (float)itself : -1.0f;
    }
}

static otx_status
map_exemplar(map_maker *m)
{
    otx_target_set *set = &m->set;
    const int32_t levels = otx_judge_options_default().level + 1;
    otx_pattern pattern;
    double itself;

    for (int32_t k = 0; k < set->territory.count; ++k)
        if (set->territory.exemplar[k] == set->exemplar)
        {
            OTX_TRY(otx_target_fill(set, k));
            read_field(m, k);
        }
    OTX_TRY(otx_target_pattern(set, levels, &pattern));
    OTX_TRY(otx_gate_judge_exemplar(set, &pattern, &itself));
    OTX_TRY(otx_gate_look(set, &pattern, m->judged));
    for (int32_t k = 0; k < set->territory.count && itself > LEAST; ++k)
        if (m->judged[k].width > 0)
        {
            add_windows(m, &m->judged[k], itself);
            give_faces(m, k, itself);
        }
    return OSDTEX_OK;
}

static otx_status
make(map_maker *m)
{
    otx_target_set *set = &m->set;
    const int32_t faces = otx_surface_leaf(set->mapping->surface)->face_count;

    m->out->faces = OTX_NEW(set->run->arena, float, faces);
    OTX_TRY(otx_run_ok(set->run));
    for (int32_t f = 0; f < faces; ++f)
        m->out->faces[f] = -1.0f;
    OTX_TRY(otx_target_set_lay_out(set, CORE, COLLAR));
    m->judged = OTX_NEW(set->run->scratch, otx_judged, set->territory.count);
    OTX_TRY(otx_run_ok(set->run));
    for (set->exemplar = 0; set->exemplar < otx_source_count(set->mapping);
         ++set->exemplar)
        OTX_TRY(map_exemplar(m));
    if (m->windows > 0)
    {
        m->out->mean = m->sum / (double)m->windows;
        m->out->share_above = (double)m->above / (double)m->windows;
    }
    return OSDTEX_OK;
}

otx_status
otx_window_map_make(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_window_map *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    map_maker m = {
        .set =
            {.run = run,
             .mapping = mapping,
             .exemplars = exemplars,
             .texels = otx_seam_texels_per_unit(mapping, exemplars)},
        .out = out};
    otx_status status;

    *out = (otx_window_map){NULL, 0.0, 0.0};
    status = make(&m);
    otx_arena_release(run->scratch, mark);
    return status;
}

/* spare.c -- what placed patches could show of faces that are others'. */
#include "patch/spare.h"
#include "patch/first.h"
#include "patch/follow.h"
#include "patch/given_patches.h"

/* Collar faces that are squeezed or stretched more than this are not offered:
 * they would show. */
static const double OFFER_STRETCH = 1.5;

/* Weight of a squared turn against the guide, of a squared strain 1. */
static const double TURN_COST = 0.4;

/* A face that reaches over the rim is pushed back inside, where it keeps this
 * share of its area; the relaxation evens that out. */
static const double HELD_SHARE = 0.6;

/* Share of a patch's size around it that its neighbours may count on. */
static const double SPARE_SHARE = 0.35;

otx_status
otx_spares_create(otx_mosaic *m)
{
    const otx_patch_settings *s = &m->job.settings;
    const int32_t count = m->job.leaves.level->face_count;
    bool ends = false;

    /* Of those that are asked for anywhere. */
    for (int32_t k = 0; k < m->job.exemplar_count; ++k)
        ends |= m->supplies.items[k].area > 0.0 &&
                !(m->job.exemplars[k].wrap_x && m->job.exemplars[k].wrap_y);
    if (!ends || s->mode != OTX_PATCH_BEST || s->cut != OTX_PATCH_ON ||
        s->relax == OTX_PATCH_RELAX_LOOP)
        return OSDTEX_OK;
    m->spares.patch = OTX_NEW(m->job.run->arena, int32_t, count);
    m->spares.index = OTX_NEW(m->job.run->arena, int32_t, count);
    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t f = 0; f < count; ++f)
        m->spares.patch[f] = -1;
    return OSDTEX_OK;
}

static double
inside(double x, bool wrap, double size)
{
    return wrap ? x : fmin(fmax(x, 0.5), size - 0.5);
}

static otx_vec2
place(const otx_node *node, otx_vec2 flat)
{
    return otx_vec2_add(
        otx_vec2_mul(otx_vec2_polar(node->placed.angle), flat),
        node->placed.shift);
}

otx_vec2
otx_spare_place(const otx_mosaic *m, const otx_node *node, otx_vec2 flat)
{
    const otx_exemplar *e = otx_supply_of(m, node)->exemplar;
    const otx_vec2 p = place(node, flat);

    return (otx_vec2){
        inside(p.x, e->wrap_x, e->match.width),
        inside(p.y, e->wrap_y, e->match.height)};
}

/* Twice the area of a fan triangle. */
static double
area_of(const otx_vec2 p[3])
{
    return otx_vec2_cross(otx_vec2_sub(p[1], p[0]), otx_vec2_sub(p[2], p[0]));
}

bool
otx_spare_is_inside(const otx_mosaic *m, const otx_node *node, int32_t i)
{
    const otx_chart *chart = &node->chart;
    const int32_t *corners = chart->corners + chart->first[i];
    const int32_t sides = chart->first[i + 1] - chart->first[i];

    for (int32_t k = 1; k + 1 < sides; ++k)
    {
        const int32_t v[3] = {corners[0], corners[k], corners[k + 1]};
        otx_vec2 laid[3], held[3];

        for (int j = 0; j < 3; ++j)
        {
            laid[j] = place(node, chart->flat[v[j]]);
            held[j] = otx_spare_place(m, node, chart->flat[v[j]]);
        }
        if (!(area_of(held) >= HELD_SHARE * area_of(laid)))
            return false;
    }
    return true;
}

/* Core faces that the patch has itself lie inside but for rounding. */
static bool
may_show(
    const otx_mosaic *m, const otx_node *node, int32_t i, const double s[2])
{
    const int32_t face = node->chart.faces[i];

    if (i < node->chart.core_count && m->cover.face_patch[face] == node->patch)
        return true;
    return s[1] > 1.0 / OFFER_STRETCH && s[0] <= OFFER_STRETCH &&
           otx_spare_is_inside(m, node, i);
}

float
otx_spare_cost(const otx_mosaic *m, const otx_node *node, int32_t i)
{
    const otx_chart *chart = &node->chart;
    const int32_t face = chart->faces[i];
    const float foreign = otx_supply_cost(m, node, face);
    double s[2], turn = 0.0;

    if (foreign < 0.0f || otx_given_holds(&m->job, face) ||
        (node->patch != 0 && otx_first_holds(m, face)))
        return -1.0f;
    otx_chart_face_stretch(chart, m->job.surface, m->job.texels, i, s);
    if (!may_show(m, node, i, s))
        return -1.0f;
    if (otx_supply_of(m, node)->guide)
        turn = otx_follow_deviation(m, node, i);
    s[0] = fmax(s[0], 0.1);
    s[1] = fmax(s[1], 0.1);
    return foreign +
           (float)(log(s[0]) * log(s[0]) + log(s[1]) * log(s[1]) + TURN_COST * turn * turn);
}

/* Of several patches the one that the face is nearest to. */
static bool
is_nearer(const otx_mosaic *m, int32_t face, float reach)
{
    const int32_t patch = m->spares.patch[face];

    return patch < 0 || reach < m->forest.nodes[m->forest.patch_node[patch]]
                                    .chart.reach[m->spares.index[face]];
}

void
otx_spare_note(otx_mosaic *m, const otx_node *node)
{
    const otx_chart *chart = &node->chart;
    const double reach = SPARE_SHARE * otx_forest_size(m, node);

    if (!m->spares.patch)
        return;
    for (int32_t i = chart->core_count; i < chart->face_count; ++i)
    {
        const int32_t face = chart->faces[i];

        if (chart->reach[i] > reach || m->cover.face_patch[face] >= 0 ||
            !is_nearer(m, face, chart->reach[i]) ||
            otx_spare_cost(m, node, i) < 0.0f)
            continue;
        m->spares.patch[face] = node->patch;
        m->spares.index[face] = i;
    }
}

const otx_node *
otx_spare_find(
    const otx_mosaic *m, const otx_node *node, int32_t face, int32_t *index)
{
    const int32_t patch = m->spares.patch ? m->spares.patch[face] : -1;
    const otx_node *other;

    if (patch < 0)
        return NULL;
    other = &m->forest.nodes[m->forest.patch_node[patch]];
    *index = m->spares.index[face];
    return other->supply == node->supply ? other : NULL;
}

/* surface_patch.c -- grows a chart, sews it, and lays it out along the field.
 */
#include "method/lapped/growth.h"

#include "flatten/aligned.h"
#include "flatten/stretch.h"

/* How much further than the outline a chart reaches, so that the outline is
 * still inside after the solve. */
static const double REACH = 1.25;
/* Areas in the plane to those on the surface, as slits are sewn. */
static const double SEW_BEFORE = 2.2, SEW_AFTER = 3.0;
/* Singular values beyond which a face is left to other pastes. */
static const double STRETCH_MOST = 1.7;
/* Over how many texels a chart fades at a border that cuts its patch off. */
static const double RIM = 4.0;

otx_vec3
otx_lapped_point(const otx_lapped *l, const otx_sample_place *sample)
{
    otx_vec3 sum = {0, 0, 0};

    for (int k = 0; k < 3; ++k)
        sum = otx_vec3_mix(
            1.0, sum, sample->at[k],
            otx_vec3_load(
                l->surface->points, l->leaf->face_verts[sample->corners[k]]));
    return sum;
}

static otx_status
solve(otx_growth *g)
{
    const otx_lapped *l = g->l;
    otx_lapped_chart *c = g->chart;
    const otx_rigid_mesh mesh = {
        c->face_count, c->vert_count,      c->first,  c->corners,
        c->verts,      l->surface->points, l->texels, l->surface->density};

    c->rights = OTX_NEW(g->arena, otx_vec3, c->face_count);
    if (!c->rights)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < c->face_count; ++i)
        c->rights[i] =
            otx_connection_lift(&l->connection, c->faces[i], g->headings[i]);
    return otx_aligned_solve(g->arena, &mesh, c->rights, g->worker, c->flat);
}

/* Whether all triangles of chart face i are near to an isometry. */
static bool
keeps_shape(const otx_growth *g, int32_t i)
{
    const otx_lapped *l = g->l;
    const otx_lapped_chart *c = g->chart;
    const int32_t face = c->faces[i];
    const int32_t shift = c->first[i] - l->leaf->face_first[face];
    const double texels = otx_lapped_texels(l, face);

    for (int32_t t = 0; t < otx_facet_count(l->leaf, face); ++t)
    {
        const otx_facet facet = otx_facet_at(l->leaf, face, t);
        double sigma[2];
        otx_vec2 u[3];
        otx_vec3 p[3];

        for (int k = 0; k < 3; ++k)
        {
            const int32_t v = c->corners[facet.corners[k] + shift];

            u[k] = c->flat[v];
            p[k] = otx_vec3_scale(
                texels, otx_vec3_load(l->surface->points, c->verts[v]));
        }
        otx_stretch_singular(p, u, sigma);
        if (!(sigma[0] <= STRETCH_MOST && sigma[1] >= 1.0 / STRETCH_MOST))
            return false;
    }
    return true;
}

/* Faces of the chart that lost their shape are left out; the seed's stays. */
static void
drop_stretched(otx_growth *g)
{
    otx_lapped_chart *c = g->chart;
    int32_t count = 0, end = 0;

    for (int32_t i = 0; i < c->face_count; ++i)
    {
        const int32_t first = c->first[i], size = c->first[i + 1] - first;

        g->space->face_slot[c->faces[i]] = -1;
        if (i > 0 && !keeps_shape(g, i))
            continue;
        for (int32_t k = 0; k < size; ++k)
            c->corners[end + k] = c->corners[first + k];
        g->space->face_slot[c->faces[i]] = count;
        c->faces[count] = c->faces[i];
        c->rights[count] = c->rights[i];
        c->first[count++] = end;
        end += size;
    }
    c->face_count = count;
    c->first[count] = end;
}

/* Moves the seed's point back to the middle. */
static void
centre(const otx_growth *g)
{
    const otx_sample_place *s = &g->seed->place;
    otx_lapped_chart *c = g->chart;
    otx_vec2 at = {0, 0};

    for (int k = 0; k < 3; ++k)
    {
        const int32_t v = g->l->leaf->face_verts[s->corners[k]];

        at = otx_vec2_add(
            at, otx_vec2_scale(s->at[k], c->flat[g->space->vert_slot[v]]));
    }
    for (int32_t v = 0; v < c->vert_count; ++v)
        c->flat[v] = otx_vec2_sub(c->flat[v], at);
}

static otx_status
lay_out(otx_growth *g)
{
    int32_t added;

    OTX_TRY(otx_growth_run(g));
    OTX_TRY(otx_growth_sew(g, SEW_BEFORE, &added));
    OTX_TRY(solve(g));
    OTX_TRY(otx_growth_sew(g, SEW_AFTER, &added));
    if (added > 0)
        OTX_TRY(solve(g));
    centre(g);
    drop_stretched(g);
    return OSDTEX_OK;
}

/* Of all faces that were ever in the chart. */
static void
forget_slots(const otx_growth *g, int32_t face_count)
{
    const otx_lapped_chart *c = g->chart;

    for (int32_t i = 0; i < face_count; ++i)
        g->space->face_slot[c->faces[i]] = -1;
    for (int32_t v = 0; v < c->vert_count; ++v)
        g->space->vert_slot[c->verts[v]] = -1;
}

otx_status
otx_lapped_unfold(
    const otx_lapped *l, const otx_lapped_room *room,
    const otx_lapped_seed *seed, double reach, otx_lapped_chart *out)
{
    otx_growth g = {
        .l = l,
        .seed = seed,
        .space = room->space,
        .worker = room->worker,
        .arena = room->arena,
        .chart = out,
        .hull = REACH * reach,
    };

    *out = (otx_lapped_chart){0};
    OTX_TRY(lay_out(&g));
    forget_slots(&g, out->face_count);
    return OSDTEX_OK;
}

/* ---- rims ---- */

/* Whether an edge of the plane runs inside of the outline. */
static bool
cuts(const otx_radial *outline, otx_vec2 a, otx_vec2 b)
{
    enum
    {
        STEPS = 8
    };

    for (int i = 0; i <= STEPS; ++i)
        if (otx_radial_alpha(
                outline, otx_vec2_lerp(a, b, (double)i / STEPS), 0.0) > 0.0)
            return true;
    return false;
}

/* Whether edge k of a chart face ends the chart, not the surface. */
static bool
is_border(
    const otx_lapped *l, const otx_lapped_space *space,
    const otx_lapped_chart *c, int32_t i, int32_t k)
{
    const int32_t other = otx_level_neighbour(l->leaf, c->faces[i], k);

    return other >= 0 && !l->leaf->face_hole[other] &&
           space->face_slot[other] < 0;
}

/* Lengths from the border over edges, in texels, shorter each round. */
static bool
shorten(const otx_lapped_chart *c, double *reach)
{
    bool changed = false;

    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t k = c->first[i]; k < c->first[i + 1]; ++k)
        {
            const int32_t next = k + 1 < c->first[i + 1] ? k + 1 : c->first[i];
            const int32_t a = c->corners[k], b = c->corners[next];
            const double side =
                otx_vec2_length(otx_vec2_sub(c->flat[a], c->flat[b]));

            changed = changed || reach[a] + side < reach[b] ||
                      reach[b] + side < reach[a];
            reach[b] = fmin(reach[b], reach[a] + side);
            reach[a] = fmin(reach[a], reach[b] + side);
        }
    return changed;
}

otx_status
otx_lapped_rim(
    const otx_lapped *l, const otx_lapped_room *room, const otx_radial *outline,
    otx_lapped_chart *c)
{
    int32_t *slots = room->space->face_slot;
    double *reach = OTX_NEW(room->arena, double, c->vert_count);

    c->rim = OTX_NEW(room->arena, float, c->vert_count);
    if (!reach || !c->rim)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t v = 0; v < c->vert_count; ++v)
        reach[v] = RIM;
    for (int32_t i = 0; i < c->face_count; ++i)
        slots[c->faces[i]] = i;
    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t k = c->first[i]; k < c->first[i + 1]; ++k)
        {
            const int32_t next = k + 1 < c->first[i + 1] ? k + 1 : c->first[i];
            const int32_t a = c->corners[k], b = c->corners[next];

            if (is_border(l, room->space, c, i, k - c->first[i]) &&
                cuts(outline, c->flat[a], c->flat[b]))
                reach[a] = reach[b] = 0.0;
        }
    while (shorten(c, reach))
        ;
    for (int32_t i = 0; i < c->face_count; ++i)
        slots[c->faces[i]] = -1;
    for (int32_t v = 0; v < c->vert_count; ++v)
        c->rim[v] = (float)(reach[v] / RIM);
    return OSDTEX_OK;
}

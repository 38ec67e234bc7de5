/* spread.c -- what vertices show, at the texels of charts. */
#include "method/vertex/turk.h"

#include "base/csr.h"

/* Vertices by the cells of a grid, which are hashed. */
typedef struct hashed
{
    const otx_turk *turk;
    double cell;    /* scene units */
    int32_t slots;  /* a power of two */
    int32_t *first; /* [slots + 2] into verts */
    int32_t *verts;
} hashed;

static int32_t
slot_of(const hashed *h, int64_t x, int64_t y, int64_t z)
{
    return (
        int32_t)(((uint64_t)x * 73856093u ^ (uint64_t)y * 19349663u ^ (uint64_t)z * 83492791u) & (uint64_t)(h->slots - 1));
}

static int32_t
slot_at(const hashed *h, otx_vec3 p)
{
    return slot_of(
        h, (int64_t)floor(p.x / h->cell), (int64_t)floor(p.y / h->cell),
        (int64_t)floor(p.z / h->cell));
}

static otx_status
hash_vertices(const otx_turk *t, double cell, hashed *h)
{
    const otx_turk_mesh *mesh = &t->meshes[0];

    *h = (hashed){t, cell, 1024, NULL, NULL};
    while (h->slots < mesh->count && h->slots < 1 << 28)
        h->slots *= 2;
    h->first = OTX_ZNEW(t->run->scratch, int32_t, (int64_t)h->slots + 2);
    h->verts = OTX_NEW(t->run->scratch, int32_t, mesh->count);
    OTX_TRY(otx_run_ok(t->run));
    for (int32_t v = 0; v < mesh->count; ++v)
        otx_csr_count(
            h->first, slot_at(h, otx_vec3_load(t->surface->points, v)), 1);
    otx_csr_sum(h->first, h->slots);
    for (int32_t v = 0; v < mesh->count; ++v)
        h->verts[otx_csr_place(
            h->first, slot_at(h, otx_vec3_load(t->surface->points, v)))] = v;
    return OSDTEX_OK;
}

/* The nearest vertex of the same side. */
typedef struct nearest
{
    otx_vec3 at, normal;
    int32_t vertex;
    double square;
} nearest;

static void
look_in(const hashed *h, int32_t slot, nearest *n)
{
    for (int32_t i = h->first[slot]; i < h->first[slot + 1]; ++i)
    {
        const int32_t v = h->verts[i];
        const otx_vec3 d =
            otx_vec3_sub(otx_vec3_load(h->turk->surface->points, v), n->at);
        const double square = otx_vec3_dot(d, d);

        if (square > n->square ||
            (square == n->square && v >= n->vertex && n->vertex >= 0) ||
            otx_vec3_dot(
                otx_vec3_load(h->turk->surface->normals, v), n->normal) < 0.0)
            continue;
        n->square = square;
        n->vertex = v;
    }
}

static void
look_around(const hashed *h, nearest *n)
{
    const int64_t x = (int64_t)floor(n->at.x / h->cell);
    const int64_t y = (int64_t)floor(n->at.y / h->cell);
    const int64_t z = (int64_t)floor(n->at.z / h->cell);

    for (int64_t k = -1; k <= 1; ++k)
        for (int64_t j = -1; j <= 1; ++j)
            for (int64_t i = -1; i <= 1; ++i)
                look_in(h, slot_of(h, x + i, y + j, z + k), n);
}

typedef struct plane
{
    otx_vec3 corners[3];
    otx_vec3 x, y, normal;
    double unit; /* texels to a scene unit */
} plane;

static plane
frame_of(const otx_vertex *v, const otx_plot_facet *f)
{
    const otx_surface *surface = v->mapping.surface;
    const int32_t *face_verts = otx_surface_leaf(surface)->face_verts;
    int32_t verts[3];
    plane out;

    for (int k = 0; k < 3; ++k)
    {
        verts[k] = face_verts[f->facet.corners[k]];
        out.corners[k] = otx_vec3_load(surface->points, verts[k]);
    }
    out.x = otx_vec3_unit(otx_vec3_sub(out.corners[1], out.corners[0]));
    out.normal = otx_vec3_unit(
        otx_vec3_cross(out.x, otx_vec3_sub(out.corners[2], out.corners[0])));
    out.y = otx_vec3_cross(out.normal, out.x);
    out.unit = v->set.texels * otx_surface_density(surface, verts, 3);
    return out;
}

static void
show(
    const hashed *h, const otx_plot_facet *f, const plane *frame,
    const double at[3], const float *field, otx_synth_match *out)
{
    const otx_turk_mesh *mesh = &h->turk->meshes[0];
    const int32_t width = h->turk->pattern.width;
    nearest n = {.normal = frame->normal, .vertex = -1, .square = INFINITY};

    for (int k = 0; k < 3; ++k)
        n.at = otx_vec3_add(n.at, otx_vec3_scale(at[k], frame->corners[k]));
    look_around(h, &n);
    if (n.vertex < 0)
        return;

    const otx_vec3 d = otx_vec3_scale(
        frame->unit,
        otx_vec3_sub(n.at, otx_vec3_load(h->turk->surface->points, n.vertex)));
    const otx_vec2 flat = otx_vec2_mul(
        (otx_vec2){otx_vec3_dot(d, frame->x), otx_vec3_dot(d, frame->y)},
        (otx_vec2){f->rotation.x, -f->rotation.y});
    const otx_vec2 step =
        otx_vec2_mul((otx_vec2){(double)field[0], (double)field[1]}, flat);
    const int32_t pixel = mesh->pixels[n.vertex];

    *out = (otx_synth_match){
        (float)(pixel % width + 0.5 + step.x),
        (float)(pixel / width + 0.5 + step.y), field[0], field[1]};
}

static void
spread_facet(
    const hashed *h, otx_vertex *v, int32_t k, int32_t slot, int32_t index)
{
    const otx_plot *plot = &v->set.plots[k];
    const otx_target *target = &v->set.targets[k];
    otx_plot_facet f;
    plane frame;
    int32_t box[4];

    if (!otx_plot_facet_of(
            plot, v->mapping.surface, v->set.texels, slot, index, &f))
        return;
    frame = frame_of(v, &f);
    otx_plot_box(plot, &f, box);
    for (int32_t y = box[1]; y < box[3]; ++y)
        for (int32_t x = box[0]; x < box[2]; ++x)
        {
            const int64_t i = (int64_t)y * plot->width + x;
            double at[3];

            if (plot->facets[i] != otx_plot_id(slot, index) ||
                target->kinds[i] == OTX_SYNTH_VOID)
                continue;
            otx_plot_at(&f, x, y, at);
            show(h, &f, &frame, at, target->field + 2 * i, &target->matches[i]);
        }
}

otx_status
otx_turk_spread(const otx_turk *t, otx_vertex *v)
{
    const otx_level *leaf = otx_surface_leaf(v->mapping.surface);
    hashed h;

    OTX_TRY(hash_vertices(
        t, fmax(2.0 / t->texels, 1.5 * t->surface->mean_edge_length), &h));
    for (int32_t k = 0; k < v->set.territory.count; ++k)
    {
        const otx_chart *chart = &v->set.territory.charts[k];

        OTX_TRY(
            otx_progress(v->run, "spread", (double)k / v->set.territory.count));
        for (int32_t slot = 0; slot < chart->face_count; ++slot)
            for (int32_t i = 0; i < otx_facet_count(leaf, chart->faces[slot]);
                 ++i)
                spread_facet(&h, v, k, slot, i);
    }
    return OSDTEX_OK;
}

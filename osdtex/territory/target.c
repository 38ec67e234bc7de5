/* target.c -- the texels of charts, as synthesis takes them. */
#include "territory/target.h"

#include "mapping/seam.h"

#include <string.h>

otx_status
otx_target_set_lay_out(otx_target_set *set, double side, double collar)
{
    otx_run *run = set->run;
    const otx_territory_options options = {set->texels, side, collar};
    otx_territory *territory = &set->territory;

    OTX_TRY(otx_territory_build(run, set->mapping, &options, territory));
    set->plots = OTX_ZNEW(run->scratch, otx_plot, territory->count);
    set->targets = OTX_ZNEW(run->scratch, otx_target, territory->count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t k = 0; k < territory->count; ++k)
        OTX_TRY(otx_plot_build(
            run, set->mapping->surface, &territory->charts[k], &set->plots[k]));
    return OSDTEX_OK;
}

/* Where a facet's UVs are, texels of the exemplar, and the rotation to there.
 */
typedef struct lookup
{
    otx_vec2 at, dx, dy; /* of the plot's origin, and per texel */
    otx_vec2 turn;       /* from the metric's frame */
    otx_vec2 field;      /* that it should be by the guide */
} lookup;

/* The rotation from the metric's frame to the exemplar by which its direction
 * lies along the guide's. */
static otx_vec2
follow(const otx_target_set *h, const otx_plot_facet *f)
{
    const float *points = h->mapping->surface->points;
    const int32_t *verts = otx_surface_leaf(h->mapping->surface)->face_verts;
    const otx_vec3 origin = otx_vec3_load(points, verts[f->facet.corners[0]]);
    const otx_vec3 a =
        otx_vec3_sub(otx_vec3_load(points, verts[f->facet.corners[1]]), origin);
    const otx_vec3 b =
        otx_vec3_sub(otx_vec3_load(points, verts[f->facet.corners[2]]), origin);
    const otx_vec3 x = otx_vec3_unit(a);
    const otx_vec3 y = otx_vec3_unit(otx_vec3_cross(otx_vec3_cross(a, b), a));
    const otx_vec3 d = h->guide->directions[f->facet.face];
    const otx_vec2 along = otx_vec2_mul(
        (otx_vec2){otx_vec3_dot(d, x), otx_vec3_dot(d, y)},
        (otx_vec2){f->rotation.x, -f->rotation.y});
    const double length = otx_vec2_length(along);

    if (!(length > 0.0))
        return (otx_vec2){1.0, 0.0};
    return otx_vec2_mul(
        otx_vec2_polar(h->guide->angle),
        (otx_vec2){along.x / length, -along.y / length});
}

/* False where UVs are reversed, or there are none; the place then is the same
 * throughout. */
static bool
look_up(const otx_target_set *h, const otx_plot_facet *f, lookup *out)
{
    const otx_image *image = &h->exemplars[h->exemplar].lab;
    const double *m = f->metric;
    const double det = m[0] * m[2] - m[1] * m[1];

    *out = (lookup){{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}};
    if (h->guide && !(h->loose && h->loose[f->facet.face]))
        out->field = follow(h, f);
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
owner_of(const otx_target_set *h, int32_t k, int32_t face)
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
    const otx_target_set *h, int32_t owner, const otx_plot_facet *here,
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
           (h->whole || plot->near[(int64_t)y * plot->width + x]);
}

static void
fill_texel(
    const otx_target_set *h, int32_t k, int32_t x, int32_t y,
    const otx_plot_facet *f, const otx_plot_facet *there, int32_t owner,
    const lookup *look)
{
    const otx_plot *plot = &h->plots[k];
    const int64_t i = (int64_t)y * plot->width + x;
    const bool own = h->territory.owner[f->facet.face] == k;
    otx_target *t = &h->targets[k];
    double at[3];

    otx_plot_at(f, x, y, at);
    for (int c = 0; c < 3; ++c)
        t->metric[3 * i + c] = (float)f->metric[c];
    t->matches[i] = (otx_synth_match){
        (float)(look->at.x + (x + 0.5) * look->dx.x + (y + 0.5) * look->dy.x),
        (float)(look->at.y + (x + 0.5) * look->dx.y + (y + 0.5) * look->dy.y),
        (float)look->turn.x, (float)look->turn.y};
    if (t->field)
    {
        t->field[2 * i] = (float)look->field.x;
        t->field[2 * i + 1] = (float)look->field.y;
    }
    t->kinds[i] =
        own && (h->whole || plot->near[i]) ? OTX_SYNTH_FREE : OTX_SYNTH_FROZEN;
    t->free += t->kinds[i] == OTX_SYNTH_FREE;
    if (owner >= 0 && place_texel(h, owner, f, there, at, &t->places[i]))
        t->kinds[i] = OTX_SYNTH_COLLAR;
}

/* The texels of one facet. */
static void
fill_facet(const otx_target_set *h, int32_t k, int32_t slot, int32_t index)
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
        (!look_up(h, &f, &look) && !h->whole))
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

otx_status
otx_target_fill(otx_target_set *h, int32_t k)
{
    const otx_plot *plot = &h->plots[k];
    const otx_level *leaf = otx_surface_leaf(h->mapping->surface);
    const int64_t count = (int64_t)plot->width * plot->height;
    otx_arena *arena = h->run->scratch;
    otx_target *t = &h->targets[k];

    if (!t->kinds)
    {
        t->kinds = OTX_NEW(arena, uint8_t, count);
        t->metric = OTX_ZNEW(arena, float, 3 * count);
        t->matches = OTX_ZNEW(arena, otx_synth_match, count);
        t->places = OTX_ZNEW(arena, otx_synth_place, count);
        if (h->guide)
            t->field = OTX_ZNEW(arena, float, 2 * count);
        OTX_TRY(otx_run_ok(h->run));
    }
    memset(t->kinds, OTX_SYNTH_VOID, (size_t)count);
    t->free = 0;
    for (int32_t slot = 0; slot < plot->chart->face_count && count > 0; ++slot)
        for (int32_t i = 0; i < otx_facet_count(leaf, plot->chart->faces[slot]);
             ++i)
            fill_facet(h, k, slot, i);
    return OSDTEX_OK;
}

/* The match of a place in the chart that owns it, as this one sees it. */
static bool
read_place(
    const otx_target_set *h, const otx_synth_place *place, otx_synth_match *out)
{
    const otx_plot *plot = &h->plots[place->chart];
    const otx_target *t = &h->targets[place->chart];
    const int64_t i =
        (int64_t)floorf(place->y) * plot->width + (int64_t)floorf(place->x);
    const float dx = place->x - floorf(place->x) - 0.5f;
    const float dy = place->y - floorf(place->y) - 0.5f;

    if (t->kinds[i] != OTX_SYNTH_FREE)
        return false;

    const float *m = t->metric + 3 * i;
    const otx_synth_match from = t->matches[i];
    const float sx = m[0] * dx + m[1] * dy, sy = m[1] * dx + m[2] * dy;

    *out = (otx_synth_match){
        from.x + from.c * sx - from.s * sy, from.y + from.s * sx + from.c * sy,
        from.c * place->c - from.s * place->s,
        from.s * place->c + from.c * place->s};
    return true;
}

void
otx_target_read_collar(otx_target_set *h, int32_t k)
{
    const int64_t count = (int64_t)h->plots[k].width * h->plots[k].height;
    otx_target *t = &h->targets[k];

    for (int64_t i = 0; t->kinds && i < count; ++i)
        if (t->kinds[i] == OTX_SYNTH_COLLAR)
            read_place(h, &t->places[i], &t->matches[i]);
}

void
otx_target_charts(const otx_target_set *h, otx_synth_chart *out)
{
    for (int32_t k = 0; k < h->territory.count; ++k)
    {
        const otx_target *t = &h->targets[k];

        out[k] = (otx_synth_chart){0};
        if (t->free > 0 && h->territory.exemplar[k] == h->exemplar)
            out[k] = (otx_synth_chart){
                .width = h->plots[k].width,
                .height = h->plots[k].height,
                .kinds = t->kinds,
                .metric = t->metric,
                .places = t->places,
                .field = t->field,
                .matches = t->matches};
    }
}

otx_status
otx_target_pattern(const otx_target_set *set, int32_t levels, otx_pattern *out)
{
    const otx_exemplar *from = &set->exemplars[set->exemplar];

    return otx_pattern_build(
        set->run, set->run->scratch,
        &(otx_pattern_input){
            .lab = &from->lab,
            .wrap_x = from->wrap_x,
            .wrap_y = from->wrap_y,
            .edge = 0.7,
            .levels = levels},
        out);
}

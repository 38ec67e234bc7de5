/* demand.c -- which of several exemplars each leaf face is asked to show. */
#include "method/demand.h"

#include "image/udim.h"
#include "image/view.h"
#include "method/density.h"

#include <stdio.h>
#include <string.h>

static const char STAGE[] = "mask";

/* How far beyond the picture UVs may lie: rounding. */
static const double UV_SLACK = 1e-4;
/* How far a number may be off for being rounded. */
static const double NUMBER_SLACK = 1e-3;

/* A face without area at the border of a tile is in that before; less than half
 * a leaf face of any use. */
static const double BORDER_SLACK = 1e-6;

/* "'a', 'b', 'c'" of the cage's materials; "..." for what has no room. */
static void
list_materials(const otx_cage *cage, char *text, size_t bytes)
{
    size_t at = 0;

    text[0] = '\0';
    for (int32_t i = 0; i < cage->material_count && at + 96 < bytes; ++i)
        at += (size_t)snprintf(
            text + at, bytes - at, "%s'%.60s'", i > 0 ? ", " : "",
            cage->material_names[i]);
    if (at + 96 >= bytes)
        snprintf(text + at, bytes - at, ", ...");
}

static otx_status
refuse_material(otx_run *run, const otx_cage *cage, const char *material)
{
    const otx_where where = {cage->path, 0, -1, -1};
    char known[512];

    if (!cage->face_material || cage->material_count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "no face has the material '%.60s': the cage has none (usemtl)",
            material);
    list_materials(cage, known, sizeof known);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
        "no face has the material '%.60s'; there are %s", material, known);
}

otx_status
otx_demand_material(
    otx_run *run, const otx_surface *surface, const char *material,
    int32_t index, uint8_t *demand)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_cage *cage = surface->cage;
    bool found = false;

    for (int32_t f = 0; cage->face_material && f < leaf->face_count; ++f)
    {
        const int32_t of = cage->face_material[leaf->face_cage[f]];

        if (of < 0 || strcmp(cage->material_names[of], material) != 0)
            continue;
        demand[f] = (uint8_t)index;
        found = true;
    }
    return found ? OSDTEX_OK : refuse_material(run, cage, material);
}

otx_status
otx_demand_faces(
    otx_run *run, const otx_surface *surface, const uint8_t *faces,
    int32_t count, uint8_t *demand)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t f = 0; f < surface->cage->face_count; ++f)
        if (faces[f] >= count)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE,
                (otx_where){surface->cage->path, 0, f, -1},
                "face %d asks for exemplar %d, but there are %d", (int)f,
                faces[f] + 1, (int)count);
    for (int32_t f = 0; f < leaf->face_count; ++f)
        demand[f] = faces[leaf->face_cage[f]];
    return OSDTEX_OK;
}

/* -- pictures ------------------------------------------------------------ */

static void
add_weights(const otx_image *mask, otx_vec2 uv, double weights[4])
{
    float color[OTX_IMAGE_MAX_CHANNELS];
    double sum = 0.0;

    otx_view_value(
        otx_view_of(mask, false, false),
        (otx_vec2){uv.x * mask->width, uv.y * mask->height}, color);
    for (int k = 0; k < 3; ++k)
    {
        const double w = fmin(fmax(color[k], 0.0), 1.0);

        weights[k + 1] += w;
        sum += w;
    }
    weights[0] += fmax(0.0, 1.0 - sum);
}

/* NaN where a corner has none. */
static otx_vec2
corner_uv(const otx_surface *surface, int32_t corner)
{
    const int32_t index = surface->face_uvs[corner];
    const float *uv;

    if (index < 0)
        return (otx_vec2){NAN, NAN};
    uv = surface->uvs + 2 * (size_t)index;
    return (otx_vec2){uv[0], uv[1]};
}

static otx_vec2
middle_uv(const otx_surface *surface, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const double share = 1.0 / otx_level_face_size(leaf, face);
    otx_vec2 middle = {0.0, 0.0};

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
        middle =
            otx_vec2_add(middle, otx_vec2_scale(share, corner_uv(surface, c)));
    return middle;
}

/* A corner of a leaf face that is not within [0, columns] x [0, rows]; -1
 * none. */
static int32_t
find_outside(
    const otx_surface *surface, int32_t face, double columns, double rows)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        const otx_vec2 uv = corner_uv(surface, c);

        /* Written so that NaN is not. */
        if (!(uv.x >= -UV_SLACK && uv.x <= columns + UV_SLACK &&
              uv.y >= -UV_SLACK && uv.y <= rows + UV_SLACK))
            return c;
    }
    return -1;
}

/* The exemplar that a leaf face asks for. */
static int32_t
weigh_face(
    const otx_surface *surface, const otx_image *image, otx_vec2 origin,
    int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_vec2 middle = otx_vec2_sub(middle_uv(surface, face), origin);
    double weights[4] = {0.0};
    int32_t best = 0;

    add_weights(image, middle, weights);
    /* Half way, since faces that share a corner share what it shows. */
    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
        add_weights(
            image,
            otx_vec2_lerp(
                otx_vec2_sub(corner_uv(surface, c), origin), middle, 0.5),
            weights);
    for (int32_t k = 1; k < 4; ++k)
        if (weights[k] > weights[best])
            best = k;
    return best;
}

static otx_where
where_of(const otx_surface *surface, int32_t face)
{
    const otx_cage *cage = surface->cage;
    const int32_t parent = otx_surface_leaf(surface)->face_cage[face];

    return (otx_where){
        cage->path, cage->face_line ? cage->face_line[parent] : 0, parent, -1};
}

/* A corner that lies where no picture is. */
static otx_status
refuse_uv(
    otx_run *run, const otx_surface *surface, int32_t face, int32_t corner,
    bool has_tiles)
{
    const otx_where where = where_of(surface, face);
    const otx_vec2 uv = corner_uv(surface, corner);

    if (!isfinite(uv.x) || !isfinite(uv.y))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "face %d has no UVs, so the mask says nothing of it; give all "
            "faces UVs, or say where exemplars go by materials",
            (int)where.face);
    if (has_tiles)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "face %d has UVs near (%g, %g), outside of the UDIM tiles 1001 to "
            "9999; move them to u from 0 to 10 and v from 0",
            (int)where.face, uv.x, uv.y);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
        "face %d has UVs near (%g, %g), outside of 0 to 1, where the mask has "
        "no picture; give one for each UDIM tile, named as mask.<UDIM>.exr, or "
        "move the UVs to the unit square",
        (int)where.face, uv.x, uv.y);
}

static otx_status
refuse_color(
    otx_run *run, const otx_surface *surface, int32_t face, int32_t asked,
    const otx_demand_mask *mask, int32_t count)
{
    static const char *const colours[] = {"black", "red", "green", "blue"};
    const int32_t parent = otx_surface_leaf(surface)->face_cage[face];

    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE,
        (otx_where){mask->path, 0, parent, -1},
        "the mask is %s on face %d and asks for exemplar %d, but there are %d",
        colours[asked], (int)parent, (int)asked + 1, (int)count);
}

static otx_status
need_uvs(otx_run *run, const otx_surface *surface, const char *path)
{
    if (surface->uv_count > 0)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE,
        (otx_where){surface->cage->path, 0, -1, -1},
        "the cage has no UVs, so the mask '%.200s' lies nowhere; give it UVs, "
        "or say where exemplars go by materials",
        path);
}

/* Of [0, columns] along one axis: what ends at the border of a tile is in the
 * one before. */
static int32_t
place_along(double x, int32_t columns)
{
    const double place = ceil(x - BORDER_SLACK) - 1.0;

    return (int32_t)fmin(fmax(place, 0.0), columns - 1.0);
}

otx_status
otx_demand_tiles(
    otx_run *run, const otx_surface *surface, const char *path, uint16_t *tiles)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    OTX_TRY(need_uvs(run, surface, path));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t outside =
            leaf->face_hole[f]
                ? -1
                : find_outside(surface, f, OTX_UDIM_COLUMNS, OTX_UDIM_ROWS);
        otx_vec2 middle;

        tiles[f] = 0;
        if (outside >= 0)
            return refuse_uv(run, surface, f, outside, true);
        if (leaf->face_hole[f])
            continue;
        middle = middle_uv(surface, f);
        tiles[f] = (uint16_t)otx_udim_tile(
            place_along(middle.x, OTX_UDIM_COLUMNS),
            place_along(middle.y, OTX_UDIM_ROWS));
        if (tiles[f] > OTX_UDIM_LAST)
            return refuse_uv(run, surface, f, leaf->face_first[f], true);
    }
    return OSDTEX_OK;
}

/* Whether a mask's picture says anything of a face. */
static bool
is_about(const otx_demand_mask *mask, const otx_level *leaf, int32_t face)
{
    return !leaf->face_hole[face] &&
           (!mask->tiles || mask->tiles[face] == mask->tile);
}

otx_status
otx_demand_picture(
    otx_run *run, const otx_surface *surface, const otx_demand_mask *mask,
    int32_t count, uint8_t *demand)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_vec2 origin = {0.0, 0.0};

    OTX_TRY(need_uvs(run, surface, mask->path));
    if (mask->tiles)
        origin =
            (otx_vec2){otx_udim_column(mask->tile), otx_udim_row(mask->tile)};
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        int32_t outside = -1, asked;

        if (!is_about(mask, leaf, f))
            continue;
        if (!mask->tiles)
            outside = find_outside(surface, f, 1.0, 1.0);
        if (outside >= 0)
            return refuse_uv(run, surface, f, outside, false);
        asked = weigh_face(surface, mask->image, origin, f);
        if (asked >= count)
            return refuse_color(run, surface, f, asked, mask, count);
        demand[f] = (uint8_t)asked;
    }
    return OSDTEX_OK;
}

/* What a picture of numbers says at a place of it. */
static double
number_at(const otx_image *image, otx_vec2 uv)
{
    float v[OTX_IMAGE_MAX_CHANNELS];

    otx_view_value(
        otx_view_of(image, false, false),
        (otx_vec2){uv.x * image->width, uv.y * image->height}, v);
    return image->channels < 3 ? (double)v[0]
                               : ((double)v[0] + v[1] + v[2]) / 3.0;
}

static otx_status
add_numbers(
    otx_run *run, const otx_surface *surface, const otx_demand_mask *mask,
    int32_t face, otx_vec2 origin, double *sums, int32_t *counts)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    for (int32_t c = leaf->face_first[face]; c < leaf->face_first[face + 1];
         ++c)
    {
        const double value =
            number_at(mask->image, otx_vec2_sub(corner_uv(surface, c), origin));

        /* Written so that NaN is refused. */
        if (!(value >= -NUMBER_SLACK && value <= 1.0 + NUMBER_SLACK))
            return otx_fail(
                run, OSDTEX_ERROR_FORMAT, STAGE,
                (otx_where){mask->path, 0, leaf->face_cage[face], -1},
                "the picture says %g on face %d, and places along a stack go "
                "from 0 to 1; scale it to that",
                value, (int)leaf->face_cage[face]);
        sums[leaf->face_verts[c]] += fmin(fmax(value, 0.0), 1.0);
        ++counts[leaf->face_verts[c]];
    }
    return OSDTEX_OK;
}

otx_status
otx_demand_values(
    otx_run *run, const otx_surface *surface, const otx_demand_mask *mask,
    double *sums, int32_t *counts)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_vec2 origin = {0.0, 0.0};

    OTX_TRY(need_uvs(run, surface, mask->path));
    if (mask->tiles)
        origin =
            (otx_vec2){otx_udim_column(mask->tile), otx_udim_row(mask->tile)};
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        int32_t outside = -1;

        if (!is_about(mask, leaf, f))
            continue;
        if (!mask->tiles)
            outside = find_outside(surface, f, 1.0, 1.0);
        if (outside >= 0)
            return refuse_uv(run, surface, f, outside, false);
        OTX_TRY(add_numbers(run, surface, mask, f, origin, sums, counts));
    }
    return OSDTEX_OK;
}

/* -- constraints --------------------------------------------------------- */

bool
otx_demand_in(const otx_constraint_set *set)
{
    for (int32_t i = 0; set && i < set->count; ++i)
        if (set->items[i].has_material || set->items[i].exemplar > 0)
            return true;
    return false;
}

/* How much a constraint asks for exemplar k. A material lies between the two
 * that are nearest to it. */
static double
weight_of(const otx_constraint *item, int32_t k, int32_t count)
{
    if (item->exemplar > 0)
        return item->exemplar == k + 1 ? 1.0 : 0.0;
    return fmax(0.0, 1.0 - fabs(item->material * (count - 1) - k));
}

/* The same constraints, which ask for one exemplar as a material from 0 to 1.
 *
 *   items  [set->count]
 *
 * False when none of them asks for it. */
static bool
weigh_items(
    const otx_constraint_set *set, int32_t k, int32_t count,
    otx_constraint *items)
{
    bool any = false;

    for (int32_t i = 0; i < set->count; ++i)
    {
        const otx_constraint *item = &set->items[i];

        items[i] = *item;
        items[i].has_material = item->has_material || item->exemplar > 0;
        items[i].material = weight_of(item, k, count);
        any |= items[i].has_material && items[i].material > 0.0;
    }
    return any;
}

/* What faces of the cage ask for themselves, -1 nothing; the last holds. */
static int32_t *
list_asked(
    otx_run *run, const otx_cage *cage, const otx_constraint_set *set,
    int32_t count)
{
    int32_t *asked = OTX_NEW(run->scratch, int32_t, cage->face_count);

    for (int32_t f = 0; asked && f < cage->face_count; ++f)
        asked[f] = -1;
    for (int32_t i = 0; asked && i < set->count; ++i)
    {
        const otx_constraint *item = &set->items[i];

        if (item->face < 0 || item->face >= cage->face_count)
            continue;
        if (item->exemplar > 0)
            asked[item->face] = item->exemplar - 1;
        else if (item->has_material)
            asked[item->face] =
                (int32_t)floor(item->material * (count - 1) + 0.5);
    }
    return asked;
}

static double
face_mean(const otx_level *leaf, int32_t face, const double *values)
{
    const int32_t size = otx_level_face_size(leaf, face);
    double sum = 0.0;

    for (int32_t k = 0; k < size; ++k)
        sum += values[leaf->face_verts[leaf->face_first[face] + k]];
    return sum / size;
}

/* What the faces weigh while exemplars are gone through. */
typedef struct contest
{
    double *most; /* [leaf face_count] of one exemplar */
    double *sum;  /* [leaf face_count] of all but the first */
    uint8_t *demand;
} contest;

/* Exemplar k takes the faces on which it weighs no less than those before. */
static otx_status
weigh_faces(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, int32_t k, const contest *c)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_level *leaf = otx_surface_leaf(surface);
    double *values;

    OTX_TRY(otx_density_spread(
        run, surface, constraints, OTX_CONSTRAINT_MATERIAL, &values));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const double weight = face_mean(leaf, f, values);

        c->sum[f] += weight;
        if (weight < c->most[f])
            continue;
        c->most[f] = weight;
        c->demand[f] = (uint8_t)k;
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

/* The first one has what the others leave of 1: all, where nothing is asked. */
static void
settle(const otx_level *leaf, const int32_t *asked, const contest *c)
{
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t held = asked[leaf->face_cage[f]];

        if (held >= 0)
            c->demand[f] = (uint8_t)held;
        else if (1.0 - c->sum[f] > c->most[f])
            c->demand[f] = 0;
    }
}

static otx_status
hold_contest(
    otx_run *run, const otx_surface *surface, const otx_constraint_set *set,
    int32_t count, const contest *c)
{
    otx_constraint *items = OTX_NEW(run->scratch, otx_constraint, set->count);
    otx_constraint_set weighed = *set;
    int32_t *asked;

    OTX_TRY(otx_run_ok(run));
    weighed.items = items;
    for (int32_t k = 1; k < count; ++k)
        if (weigh_items(set, k, count, items))
            OTX_TRY(weigh_faces(run, surface, &weighed, k, c));
    asked = list_asked(run, surface->cage, set, count);
    OTX_TRY(otx_run_ok(run));
    settle(otx_surface_leaf(surface), asked, c);
    return OSDTEX_OK;
}

otx_status
otx_demand_constraints(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, int32_t count, uint8_t *demand)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const int32_t faces = otx_surface_leaf(surface)->face_count;
    const contest c = {
        OTX_ZNEW(run->scratch, double, faces),
        OTX_ZNEW(run->scratch, double, faces), demand};

    OTX_TRY(hold_contest(run, surface, constraints, count, &c));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

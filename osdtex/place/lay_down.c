/* lay_down.c -- one picture at one spot. */
#include "place/laying.h"

#include <string.h>

static const char STAGE[] = "place";

/* Beyond this a picture is told to be stretched, and is not scattered. */
static const double STRETCH_GOOD = 1.05;
/* Areas to that of the picture: surface that ends, and that comes twice. */
static const double COVERED_LEAST = 0.999, COVERED_MOST = 1.01;
/* Length of a direction's part along the surface below which it has none. */
static const double ALONG_LEAST = 1e-2;

const char *
otx_laying_name(const otx_laying *p, const otx_place_item *item)
{
    const char *path = p->list->pictures[item->picture].source_path;
    const char *slash = path ? strrchr(path, '/') : NULL;

    return slash ? slash + 1 : path ? path : "picture";
}

otx_where
otx_laying_where(const otx_laying *p, int32_t face)
{
    return (otx_where){p->list->path, 0, face, -1};
}

static otx_vec3
normal_at(const otx_surface *surface, const otx_spot *spot)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    otx_vec3 p[3];

    for (int k = 0; k < 3; ++k)
        p[k] =
            otx_vec3_load(surface->points, leaf->face_verts[spot->corners[k]]);
    return otx_vec3_unit(
        otx_vec3_cross(otx_vec3_sub(p[1], p[0]), otx_vec3_sub(p[2], p[0])));
}

/* The part of a direction along the surface, of length 1; 0 where it has none.
 */
static otx_vec3
along_surface(otx_vec3 direction, otx_vec3 n)
{
    const otx_vec3 unit = otx_vec3_unit(direction);
    const otx_vec3 along = otx_vec3_mix(1.0, unit, -otx_vec3_dot(unit, n), n);

    return otx_vec3_length(along) > ALONG_LEAST ? otx_vec3_unit(along)
                                                : (otx_vec3){0, 0, 0};
}

/* Which way is up at a spot; false where what is asked for stands on it. */
static bool
choose_up(
    const otx_laying *p, const otx_place_item *item, const otx_spot *spot,
    double turn, otx_vec3 *out)
{
    static const otx_vec3 Y = {0, 1, 0}, Z = {0, 0, 1};
    const otx_vec3 n = normal_at(p->surface, spot);
    otx_vec3 up = along_surface(item->has_up ? item->up : Y, n);

    if (!item->has_up && !(otx_vec3_length(up) > 0.0))
        up = along_surface(Z, n);
    *out = otx_vec3_mix(cos(turn), up, sin(turn), otx_vec3_cross(n, up));
    return otx_vec3_length(up) > 0.0;
}

static otx_status
refuse_up(const otx_laying *p, const otx_place_item *item, const otx_spot *spot)
{
    return otx_fail(
        p->run, OSDTEX_ERROR_ARGUMENT, STAGE,
        otx_laying_where(
            p, otx_surface_leaf(p->surface)->face_cage[spot->face]),
        "placed %d, '%.80s': \"up\" points straight out of the surface there; "
        "give a direction along it",
        (int)item->number, otx_laying_name(p, item));
}

double
otx_laying_aspect(const otx_laying *p, const otx_place_item *item)
{
    const otx_image *image = &p->list->pictures[item->picture].linear;

    return item->height > 0.0 ? item->height / item->width
                              : (double)image->height / image->width;
}

/* The picture about its anchor; mirrored, that lies on the other side. */
static otx_footprint_box
box_of(const otx_laying *p, const otx_place_item *item)
{
    const double aspect = otx_laying_aspect(p, item);
    const double left = item->mirror ? 1.0 - item->anchor.x : item->anchor.x;

    return (otx_footprint_box){
        {-left, -item->anchor.y * aspect},
        {1.0 - left, (1.0 - item->anchor.y) * aspect}};
}

static bool
touches_box(const otx_footprint *f, int32_t slot, const otx_footprint_box *box)
{
    otx_vec2 low = {(double)INFINITY, (double)INFINITY};
    otx_vec2 high = {-(double)INFINITY, -(double)INFINITY};

    for (int32_t i = f->first[slot]; i < f->first[slot + 1]; ++i)
    {
        const otx_vec2 at = f->flat[f->corners[i]];

        low = (otx_vec2){fmin(low.x, at.x), fmin(low.y, at.y)};
        high = (otx_vec2){fmax(high.x, at.x), fmax(high.y, at.y)};
    }
    return low.x < box->high.x && high.x > box->low.x && low.y < box->high.y &&
           high.y > box->low.y;
}

static void
put_uv(
    const otx_laying *p, const otx_place_item *item, otx_vec2 flat, float uv[2])
{
    const otx_footprint_box box = box_of(p, item);
    const double u = flat.x - box.low.x;

    uv[0] = (float)(item->mirror ? 1.0 - u : u);
    uv[1] = (float)((flat.y - box.low.y) / otx_laying_aspect(p, item));
}

/* Keeps the faces that the picture lies on. */
static otx_status
keep(otx_laying *p, int32_t index, const otx_spot *spot, const otx_footprint *f)
{
    const otx_place_item *item = &p->list->items[index];
    const otx_footprint_box box = box_of(p, item);
    otx_arena *scratch = p->run->scratch;
    otx_laid *out = &p->laid[p->laid_count];

    *out = (otx_laid){
        .item = index,
        .faces = OTX_NEW(scratch, int32_t, f->face_count),
        .first = OTX_NEW(scratch, int32_t, f->face_count + 1),
        .uvs = OTX_NEW(scratch, float, 2 * (int64_t)f->first[f->face_count]),
        .point = spot->point,
        .radius = 0.5 * item->width * hypot(1.0, otx_laying_aspect(p, item))};
    OTX_TRY(otx_run_ok(p->run));
    out->first[0] = 0;
    for (int32_t i = 0; i < f->face_count; ++i)
    {
        int32_t end = out->first[out->face_count];

        if (!touches_box(f, i, &box))
            continue;
        for (int32_t k = f->first[i]; k < f->first[i + 1]; ++k, ++end)
            put_uv(p, item, f->flat[f->corners[k]], out->uvs + 2 * (size_t)end);
        out->faces[out->face_count++] = f->faces[i];
        out->first[out->face_count] = end;
    }
    ++p->laid_count;
    return OSDTEX_OK;
}

/* How far the anchor is from where it was to be, in texels. */
static double
offset_of(const otx_laying *p, const otx_laid *l, const otx_spot *spot)
{
    const otx_level *leaf = otx_surface_leaf(p->surface);
    const otx_place_item *item = &p->list->items[l->item];
    const otx_image *image = &p->list->pictures[item->picture].linear;
    otx_vec2 at = {0, 0};
    int32_t slot = 0;

    while (slot < l->face_count && l->faces[slot] != spot->face)
        ++slot;
    for (int k = 0; k < 3 && slot < l->face_count; ++k)
    {
        const float *uv =
            l->uvs +
            2 * ((size_t)l->first[slot] +
                 (size_t)(spot->corners[k] - leaf->face_first[spot->face]));

        at = otx_vec2_add(
            at, otx_vec2_scale(spot->at[k], (otx_vec2){uv[0], uv[1]}));
    }
    return hypot(
        (at.x - item->anchor.x) * image->width,
        (at.y - item->anchor.y) * image->height);
}

static void
count_in(
    otx_laying *p, const otx_place_item *item, const otx_spot *spot,
    const otx_footprint *f)
{
    const otx_laid *l = &p->laid[p->laid_count - 1];
    const double area = item->width * item->width * otx_laying_aspect(p, item);
    otx_place_figures *figures = &p->figures;

    p->weight += area;
    ++figures->count;
    figures->faces += l->face_count;
    figures->stretch_p95 = fmax(figures->stretch_p95, f->stretch_p95);
    figures->stretch_mean +=
        area / p->weight * (f->stretch_mean - figures->stretch_mean);
    figures->offset = fmax(figures->offset, offset_of(p, l, spot));
}

/* What does not hold of a layout is an error, or said. */
static otx_status
check(
    const otx_laying *p, const otx_place_item *item, const otx_spot *spot,
    const otx_footprint *f)
{
    const otx_where at = otx_laying_where(
        p, otx_surface_leaf(p->surface)->face_cage[spot->face]);
    const double height = item->width * otx_laying_aspect(p, item);

    if (f->is_cut || f->covered > COVERED_MOST ||
        !(f->stretch_p95 < (double)INFINITY))
        return otx_fail(
            p->run, OSDTEX_ERROR_LIMIT, STAGE, at,
            "placed %d, '%.80s': the surface has no room for %.4g x %.4g "
            "units there, where they would lie over themselves; give a smaller "
            "\"width\", or another place",
            (int)item->number, otx_laying_name(p, item), item->width, height);
    if (f->stretch_p95 > STRETCH_GOOD)
        otx_note(
            p->run, OSDTEX_SEVERITY_WARNING, STAGE, at,
            "placed %d, '%.80s': the surface bends so much that the picture is "
            "stretched by %.3f (95th percentile); about %.3g units of width "
            "would keep it within %.2f",
            (int)item->number, otx_laying_name(p, item), f->stretch_p95,
            item->width * sqrt((STRETCH_GOOD - 1.0) / (f->stretch_p95 - 1.0)),
            STRETCH_GOOD);
    if (f->covered < COVERED_LEAST)
        otx_note(
            p->run, OSDTEX_SEVERITY_WARNING, STAGE, at,
            "placed %d, '%.80s': %.1f %% of the picture hang over the "
            "surface's border, and are cut off",
            (int)item->number, otx_laying_name(p, item),
            100.0 * (1.0 - f->covered));
    return OSDTEX_OK;
}

static bool
is_good(const otx_footprint *f)
{
    return !f->is_cut && f->covered > COVERED_LEAST &&
           f->covered < COVERED_MOST && f->stretch_p95 <= STRETCH_GOOD;
}

otx_status
otx_laying_lay_down(
    otx_laying *p, int32_t index, const otx_spot *spot, double turn,
    bool only_good, bool *kept)
{
    const otx_place_item *item = &p->list->items[index];
    otx_footprint_ask ask = {
        .surface = p->surface,
        .spot = *spot,
        .width = item->width,
        .box = box_of(p, item)};
    otx_footprint f;
    otx_status status;
    otx_arena *arena;

    *kept = false;
    if (!choose_up(p, item, spot, turn, &ask.up))
        return only_good ? OSDTEX_OK : refuse_up(p, item, spot);
    arena = otx_arena_create(p->run->allocator);
    if (!arena)
        return otx_fail_memory(p->run, STAGE);
    status = otx_loop_result(
        p->run, STAGE, otx_footprint_lay(arena, &ask, &p->space, &f));
    if (status == OSDTEX_OK && !only_good)
        status = check(p, item, spot, &f);
    if (status == OSDTEX_OK && (!only_good || is_good(&f)))
    {
        *kept = true;
        status = keep(p, index, spot, &f);
        if (status == OSDTEX_OK)
            count_in(p, item, spot, &f);
    }
    otx_arena_destroy(arena);
    return status;
}

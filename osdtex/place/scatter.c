/* scatter.c -- as many of a picture as there is room for, anywhere. */
#include "place/laying.h"

#include "base/random.h"

static const char STAGE[] = "place";

/* Half diagonals between the middles of scattered pictures, of their sum. */
static const double APART = 0.9;

enum
{
    TRIES = 40, /* for each picture */
    RANDOM_STAGE = 0x70
};

static otx_status
sum_areas(otx_laying *p)
{
    const otx_level *leaf = otx_surface_leaf(p->surface);
    const float *points = p->surface->points;
    double sum = 0.0;

    if (p->areas)
        return OSDTEX_OK;
    p->areas = OTX_NEW(p->run->scratch, double, leaf->face_count);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t *v = leaf->face_verts + leaf->face_first[f];
        const otx_vec3 o = otx_vec3_load(points, v[0]);

        for (int32_t k = 1;
             !leaf->face_hole[f] && k + 1 < otx_level_face_size(leaf, f); ++k)
            sum += otx_vec3_length(otx_vec3_cross(
                otx_vec3_sub(otx_vec3_load(points, v[k]), o),
                otx_vec3_sub(otx_vec3_load(points, v[k + 1]), o)));
        p->areas[f] = sum;
    }
    return OSDTEX_OK;
}

/* A face by its share of the area. */
static int32_t
face_by_area(const otx_laying *p, double share)
{
    int32_t low = 0, high = otx_surface_leaf(p->surface)->face_count - 1;
    const double wanted = share * p->areas[high];

    while (low < high)
    {
        const int32_t middle = low + (high - low) / 2;

        if (p->areas[middle] > wanted)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static bool
is_free(const otx_laying *p, const otx_place_item *item, otx_vec3 point)
{
    const double radius =
        0.5 * item->width * hypot(1.0, otx_laying_aspect(p, item));

    for (int32_t i = 0; i < p->laid_count; ++i)
        if (otx_vec3_length(otx_vec3_sub(p->laid[i].point, point)) <
            APART * (p->laid[i].radius + radius))
            return false;
    return true;
}

/* Turned by chance where nothing is asked, and only where there is room for it
 * as it is. */
otx_status
otx_laying_scatter(otx_laying *p, int32_t index)
{
    const otx_place_item *item = &p->list->items[index];
    const uint64_t seed =
        otx_random_bits(p->run->seed, RANDOM_STAGE, (uint64_t)item->number);
    int32_t placed = 0;

    OTX_TRY(sum_areas(p));
    for (int32_t i = 0; i < TRIES * item->scatter && placed < item->scatter;
         ++i)
    {
        const uint64_t k = 4 * (uint64_t)i;
        const double by[2] = {
            otx_random_unit(seed, RANDOM_STAGE, k),
            otx_random_unit(seed, RANDOM_STAGE, k + 1)};
        const int32_t face =
            face_by_area(p, otx_random_unit(seed, RANDOM_STAGE, k + 2));
        const otx_spot spot = otx_spot_within(p->surface, face, by);
        const double turn =
            item->has_up
                ? 0.0
                : 2.0 * OTX_PI * otx_random_unit(seed, RANDOM_STAGE, k + 3);
        bool kept;

        OTX_TRY(otx_pulse(p->run));
        if (!is_free(p, item, spot.point))
            continue;
        OTX_TRY(otx_laying_lay_down(
            p, index, &spot, item->turn + turn, true, &kept));
        placed += kept;
    }
    if (placed < item->scatter)
        otx_note(
            p->run, OSDTEX_SEVERITY_WARNING, STAGE, otx_laying_where(p, -1),
            "placed %d, '%.80s': there was room for %d of %d; a smaller "
            "\"width\" gives more",
            (int)item->number, otx_laying_name(p, item), (int)placed,
            (int)item->scatter);
    return OSDTEX_OK;
}

/* show.c -- what a face shows at a point. */
#include "mapping/show.h"

#include "image/view.h"

/* Beyond the sides of a triangle weights do not become negative. */
static double
weight_at(const otx_lookup *items, const int32_t local[3], const double at[3])
{
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
        sum += at[k] * items[local[k]].weight;
    return sum > 0.0 ? sum : 0.0;
}

otx_vec2
otx_show_mix(
    const otx_show_view *show, const otx_show_place *place,
    const otx_show_term *term, const double w[3])
{
    const int32_t first = show->face_first[place->face];
    otx_vec2 sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
    {
        const int32_t corner = place->corners[k];
        const float *uv = term->items ? term->items[corner - first].uv
                                      : show->uvs + 2 * (size_t)corner;

        sum = otx_vec2_add(sum, otx_vec2_scale(w[k], (otx_vec2){uv[0], uv[1]}));
    }
    return sum;
}

otx_show_term
otx_show_term_at(
    const otx_show_view *show, const otx_show_place *place, int32_t exemplar,
    int32_t index)
{
    const otx_lookups *l = show->lookups;
    const int32_t first = show->face_first[place->face];
    const int32_t size = show->face_first[place->face + 1] - first;
    otx_show_term term = {.weight = 1.0, .exemplar = exemplar};
    int32_t local[3];

    if (otx_show_is_layered(show, place->face))
    {
        term.items = l->items + l->first[place->face] + (ptrdiff_t)index * size;
        for (int k = 0; k < 3; ++k)
            local[k] = place->corners[k] - first;
        term.weight = weight_at(term.items, local, place->at);
        if (term.items->fragment >= 0)
        {
            term.exemplar = l->fragments[term.items->fragment].exemplar;
            term.mask = l->fragments[term.items->fragment].mask;
        }
    }
    term.uv = otx_show_mix(show, place, &term, place->at);
    return term;
}

void
otx_show_add(
    otx_layering layering, const float *values, int32_t channels, double weight,
    double alpha, otx_show_sum *sum)
{
    const double below =
        layering == OTX_LAYERING_OVER ? 1.0 - weight * alpha : 1.0;

    for (int32_t c = 0; c < channels; ++c)
        sum->value[c] = below * sum->value[c] + weight * values[c];
    sum->weight = below * sum->weight + weight;
}

void
otx_show_finish(
    otx_layering layering, const otx_show_sum *sum, int32_t channels,
    float *out)
{
    const double whole = layering == OTX_LAYERING_OVER ? 1.0 : sum->weight;

    for (int32_t c = 0; c < channels; ++c)
        out[c] = whole > 0.0 ? (float)(sum->value[c] / whole) : 0.0f;
}

/* What a picture shows around a term's place, filtered over its footprint. */
static void
probe(
    const otx_show_view *show, const otx_texture *texture,
    const otx_show_place *place, const otx_show_term *term, double share,
    float *values)
{
    otx_texture_probes probes = {.count = 1};

    if (place->dx)
        probes = otx_texture_measure(
            texture,
            otx_vec2_scale(share, otx_show_mix(show, place, term, place->dx)),
            otx_vec2_scale(share, otx_show_mix(show, place, term, place->dy)));
    otx_texture_probe(texture, &probes, term->uv, values);
}

/* The values of a map in the frame of the place. */
static void
carry_over(
    const otx_show_view *show, const otx_show_place *place,
    const otx_show_term *term, float *values)
{
    const otx_carry *carry = show->carry;
    otx_carry_matrix m;
    otx_vec2 uvs[3];

    for (int k = 0; k < 3; ++k)
    {
        const double corner[3] = {k == 0, k == 1, k == 2};

        uvs[k] = otx_show_mix(show, place, term, corner);
    }
    m = otx_carry_matrix_of(
        carry, place->corners, uvs, term->exemplar, place->dx, place->dy);
    otx_carry_values(
        carry, &m, otx_carry_scale(carry, place->corners, place->at),
        term->exemplar, values);
}

void
otx_show_color(
    const otx_show_view *show, const otx_texture *textures,
    const otx_show_place *place, int32_t exemplar, double share,
    int32_t channels, float *color)
{
    const int32_t count = otx_show_term_count(show, place->face);
    const bool layered = otx_show_is_layered(show, place->face);
    const otx_layering layering = otx_show_layering(show);
    otx_show_sum sum = {{0.0}, 0.0};

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_show_term term = otx_show_term_at(show, place, exemplar, i);
        const otx_texture *texture = &textures[term.exemplar];
        float mask[OTX_IMAGE_MAX_CHANNELS] = {1.0f};

        if (!(term.weight > 0.0))
            continue;
        probe(show, texture, place, &term, share, color);
        for (int32_t c = texture->pyramid.levels[0].channels; c < channels; ++c)
            color[c] = 1.0f;
        if (show->carry)
            carry_over(show, place, &term, color);
        if (!layered)
            return;
        if (term.mask)
            probe(show, term.mask, place, &term, share, mask);
        otx_show_add(
            layering, color, channels, term.weight * mask[0],
            channels == 4 && !show->carry ? color[3] : 1.0, &sum);
    }
    otx_show_finish(layering, &sum, channels, color);
}

void
otx_show_lab(
    const otx_show_view *show, const otx_exemplar *exemplars,
    const otx_show_place *place, int32_t exemplar, float lab[3])
{
    const int32_t count = otx_show_term_count(show, place->face);
    const otx_layering layering = otx_show_layering(show);
    otx_show_sum sum = {{0.0}, 0.0};

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_show_term term = otx_show_term_at(show, place, exemplar, i);
        const otx_exemplar *from = &exemplars[term.exemplar];
        float mask[OTX_IMAGE_MAX_CHANNELS] = {1.0f};
        const otx_vec2 texel = {
            term.uv.x * from->lab.width, term.uv.y * from->lab.height};

        if (!(term.weight > 0.0))
            continue;
        otx_view_value(
            otx_view_of(&from->lab, from->wrap_x, from->wrap_y), texel, lab);
        if (!term.items)
            return;
        if (term.mask)
            otx_texture_probe(
                term.mask, &(otx_texture_probes){.count = 1}, term.uv, mask);
        otx_show_add(layering, lab, 3, term.weight * mask[0], 1.0, &sum);
    }
    otx_show_finish(layering, &sum, 3, lab);
}

/* show.c -- what a face shows at a point. */
#include "mapping/show.h"

#include "image/view.h"
#include "mapping/show_decals.h"

/* Less light than this that comes through is none. */
static const double THROUGH_LEAST = 1e-5;

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

    for (int k = 0; k < 3 && term->made; ++k)
        sum = otx_vec2_add(sum, otx_vec2_scale(w[k], term->uvs[k]));
    for (int k = 0; k < 3 && !term->made; ++k)
    {
        const int32_t corner = place->corners[k];
        const float *uv = term->items ? term->items[corner - first].uv
                                      : show->uvs + 2 * (size_t)corner;

        sum = otx_vec2_add(sum, otx_vec2_scale(w[k], (otx_vec2){uv[0], uv[1]}));
    }
    return sum;
}

/* What a source field shows around a place. Where that is nothing, the face's
 * own UVs are looked up. */
typedef struct made_terms
{
    otx_source_term around[OTX_SOURCE_FIELD_TERMS];
    bool nothing;
} made_terms;

static void
look_around(
    const otx_show_view *show, const otx_show_place *place, made_terms *out)
{
    double sum = 0.0;

    otx_source_field_look(
        show->field, place->face, place->corners, place->at, out->around);
    for (int i = 0; i < OTX_SOURCE_FIELD_TERMS; ++i)
        sum += out->around[i].weight;
    out->nothing = !(sum > 0.0);
}

static otx_show_term
made_term(
    const otx_show_view *show, const otx_show_place *place, int32_t exemplar,
    const made_terms *made, int32_t index)
{
    const otx_source_field *field = show->field;
    otx_show_term term = {.weight = index == 0, .exemplar = exemplar};

    if (!made->nothing)
    {
        term.weight = made->around[index].weight;
        term.exemplar = field->charts[field->face_chart[place->face]].exemplar;
        term.made = true;
        for (int k = 0; k < 3; ++k)
            term.uvs[k] = made->around[index].uvs[k];
    }
    if (term.weight > 0.0)
        term.uv = otx_show_mix(show, place, &term, place->at);
    return term;
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

    if (otx_show_is_made(show, place->face))
    {
        made_terms made;

        look_around(show, place, &made);
        return made_term(show, place, exemplar, &made, index);
    }
    if (otx_show_has_lookups(show, place->face))
    {
        term.items = l->items + l->first[place->face] + (ptrdiff_t)index * size;
        for (int k = 0; k < 3; ++k)
            local[k] = place->corners[k] - first;
        term.weight = weight_at(term.items, local, place->at);
        if (term.items->fragment >= 0)
        {
            term.fragment = &l->fragments[term.items->fragment];
            term.exemplar = term.fragment->exemplar;
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

/* From UVs of the exemplar to the plane of a fragment's mask: their scale. */
static otx_vec2
mask_scale(const otx_fragment *fragment)
{
    const double u = (double)fragment->frame[2];
    const double v = (double)fragment->frame[3];

    return u > 0.0 && v > 0.0 ? (otx_vec2){1.0 / u, 1.0 / v}
                              : (otx_vec2){1.0, 1.0};
}

static otx_vec2
times(otx_vec2 a, otx_vec2 b)
{
    return (otx_vec2){a.x * b.x, a.y * b.y};
}

/* What a mask leaves at a place of its plane, of which the footprint has the
 * sides dx and dy. */
static double
mask_at(const otx_fragment *fragment, otx_vec2 at, otx_vec2 dx, otx_vec2 dy)
{
    float value[OTX_IMAGE_MAX_CHANNELS];
    otx_texture_probes probes;

    if (fragment->outline)
        return otx_radial_alpha(
            fragment->outline, at,
            fmax(otx_vec2_length(dx), otx_vec2_length(dy)));
    probes = otx_texture_measure(fragment->mask, dx, dy);
    otx_texture_probe(fragment->mask, &probes, at, value);
    return (double)value[0];
}

/* What the mask of a term leaves of it, filtered over its footprint. */
static double
masked(
    const otx_show_view *show, const otx_show_place *place,
    const otx_show_term *term, double share)
{
    const otx_fragment *fragment = term->fragment;
    otx_vec2 dx = {0.0, 0.0}, dy = {0.0, 0.0};

    if (!fragment || (!fragment->mask && !fragment->outline))
        return 1.0;

    const otx_vec2 scale = mask_scale(fragment);
    const otx_vec2 origin = {
        (double)fragment->frame[0], (double)fragment->frame[1]};

    if (place->dx)
    {
        dx = otx_vec2_scale(share, otx_show_mix(show, place, term, place->dx));
        dy = otx_vec2_scale(share, otx_show_mix(show, place, term, place->dy));
    }
    return mask_at(
        fragment, times(scale, otx_vec2_sub(term->uv, origin)),
        times(scale, dx), times(scale, dy));
}

double
otx_show_along(const otx_show_view *show, const otx_show_place *place)
{
    double sum = 0.0;

    for (int k = 0; k < 3; ++k)
        sum += place->at[k] *
               (double)show->along[show->face_verts[place->corners[k]]];
    return sum;
}

/* Between two slices of a stack, channel by channel. */
static void
mix_into(float *values, const float *next, double share, int32_t channels)
{
    for (int32_t c = 0; c < channels; ++c)
        values[c] += (float)share * (next[c] - values[c]);
}

static void
probe_slices(
    const otx_texture *texture, double along, const otx_texture_probes *probes,
    otx_vec2 uv, float *values)
{
    const otx_texture_between b =
        otx_texture_slices_at(texture->slice_count, along);
    const otx_texture *slices = texture->slices + b.first;
    float next[OTX_IMAGE_MAX_CHANNELS];

    otx_texture_probe(slices, probes, uv, values);
    if (!(b.share > 0.0))
        return;
    otx_texture_probe(slices + 1, probes, uv, next);
    mix_into(values, next, b.share, slices->pyramid.levels[0].channels);
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
    if (show->along && texture->slice_count > 0)
        probe_slices(
            texture, otx_show_along(show, place), &probes, term->uv, values);
    else
        otx_texture_probe(texture, &probes, term->uv, values);
}

/* The values of a map in the frame of the place. */
static void
carry_over(
    const otx_show_view *show, const otx_show_place *place,
    const otx_show_term *term, float *values)
{
    const otx_carry *carry = show->carry;
    otx_carry_matrix m = {1.0, 0.0, 0.0, 1.0};
    otx_vec2 uvs[3];

    /* Heights have no direction. */
    for (int k = 0; carry->normal >= 0 && k < 3; ++k)
    {
        const double corner[3] = {k == 0, k == 1, k == 2};

        uvs[k] = otx_show_mix(show, place, term, corner);
    }
    if (carry->normal >= 0)
        m = otx_carry_matrix_of(
            carry, place->corners, uvs, term->exemplar, place->dx, place->dy);
    otx_carry_values(
        carry, &m, otx_carry_scale(carry, place->corners, place->at),
        term->exemplar, values);
}

/* What a term shows, and a map of it in the frame of the place. Channels that a
 * picture does not have are opaque. */
static void
probe_term(
    const otx_show_view *show, const otx_texture *textures,
    const otx_show_place *place, const otx_show_term *term, double share,
    int32_t channels, float *color)
{
    const otx_texture *texture = &textures[term->exemplar];

    probe(show, texture, place, term, share, color);
    for (int32_t c = texture->pyramid.levels[0].channels; c < channels; ++c)
        color[c] = 1.0f;
    if (show->carry)
        carry_over(show, place, term, color);
}

/* Maps are not multiplied by an alpha. */
static double
alpha_of(const otx_show_view *show, const float *color, int32_t channels)
{
    return channels == 4 && !show->carry ? (double)color[3] : 1.0;
}

/* From the top down, as far as light comes. */
static void
show_over(
    const otx_show_view *show, const otx_texture *textures,
    const otx_show_place *place, int32_t exemplar, double share,
    int32_t channels, float *color)
{
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0};
    double through = 1.0;

    for (int32_t i = otx_show_term_count(show, place->face) - 1;
         i >= 0 && through > THROUGH_LEAST; --i)
    {
        const otx_show_term term = otx_show_term_at(show, place, exemplar, i);
        const double weight =
            term.weight > 0.0 ? term.weight * masked(show, place, &term, share)
                              : 0.0;

        if (!(weight > 0.0))
            continue;
        probe_term(show, textures, place, &term, share, channels, color);
        for (int32_t c = 0; c < channels; ++c)
            sum[c] += through * weight * (double)color[c];
        through *= 1.0 - weight * alpha_of(show, color, channels);
    }
    for (int32_t c = 0; c < channels; ++c)
        color[c] = (float)sum[c];
}

/* What the method made. */
static void
color_below(
    const otx_show_view *show, const otx_texture *textures,
    const otx_show_place *place, int32_t exemplar, double share,
    int32_t channels, float *color)
{
    const int32_t count = otx_show_term_count(show, place->face);
    const bool layered = otx_show_is_layered_below(show, place->face);
    const bool is_made = otx_show_is_made(show, place->face);
    otx_show_sum sum = {{0.0}, 0.0};
    made_terms made;

    if (layered && otx_show_layering(show, place->face) == OTX_LAYERING_OVER)
    {
        show_over(show, textures, place, exemplar, share, channels, color);
        return;
    }
    if (is_made)
        look_around(show, place, &made);
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_show_term term =
            is_made ? made_term(show, place, exemplar, &made, i)
                    : otx_show_term_at(show, place, exemplar, i);

        if (!(term.weight > 0.0))
            continue;
        probe_term(show, textures, place, &term, share, channels, color);
        if (!layered)
            return;
        otx_show_add(
            OTX_LAYERING_MEAN, color, channels,
            term.weight * masked(show, place, &term, share),
            alpha_of(show, color, channels), &sum);
    }
    otx_show_finish(OTX_LAYERING_MEAN, &sum, channels, color);
}

void
otx_show_color(
    const otx_show_view *show, const otx_texture *textures,
    const otx_show_place *place, int32_t exemplar, double share,
    int32_t channels, float *color)
{
    color_below(show, textures, place, exemplar, share, channels, color);
    if (!show->carry && otx_decals_has(show->decals, place->face))
        otx_show_decals_color(show, place, share, channels, color);
}

static void
look_up_lab(
    const otx_show_view *show, const otx_show_place *place,
    const otx_exemplar *from, otx_vec2 texel, float lab[3])
{
    const otx_image *images = &from->lab;
    otx_texture_between b = {0, 0.0};
    float next[3];

    if (show->along && from->slices)
    {
        images = from->slices->lab;
        b = otx_texture_slices_at(
            from->slices->count, otx_show_along(show, place));
    }
    otx_view_value(
        otx_view_of(images + b.first, from->wrap_x, from->wrap_y), texel, lab);
    if (!(b.share > 0.0))
        return;
    otx_view_value(
        otx_view_of(images + b.first + 1, from->wrap_x, from->wrap_y), texel,
        next);
    mix_into(lab, next, b.share, 3);
}

static void
lab_below(
    const otx_show_view *show, const otx_exemplar *exemplars,
    const otx_show_place *place, int32_t exemplar, float lab[3])
{
    const int32_t count = otx_show_term_count(show, place->face);
    const otx_layering layering = otx_show_layering(show, place->face);
    const bool is_made = otx_show_is_made(show, place->face);
    otx_show_sum sum = {{0.0}, 0.0};
    made_terms made;

    if (is_made)
        look_around(show, place, &made);
    for (int32_t i = 0; i < count; ++i)
    {
        const otx_show_term term =
            is_made ? made_term(show, place, exemplar, &made, i)
                    : otx_show_term_at(show, place, exemplar, i);
        const otx_exemplar *from = &exemplars[term.exemplar];
        const otx_vec2 texel = {
            term.uv.x * from->lab.width, term.uv.y * from->lab.height};

        if (!(term.weight > 0.0))
            continue;
        look_up_lab(show, place, from, texel, lab);
        if (!otx_show_is_layered_below(show, place->face))
            return;
        otx_show_add(
            layering, lab, 3, term.weight * masked(show, place, &term, 0.0),
            1.0, &sum);
    }
    otx_show_finish(layering, &sum, 3, lab);
}

void
otx_show_lab(
    const otx_show_view *show, const otx_exemplar *exemplars,
    const otx_show_place *place, int32_t exemplar, float lab[3])
{
    lab_below(show, exemplars, place, exemplar, lab);
    if (otx_decals_has(show->decals, place->face))
        otx_show_decals_lab(show, place, lab);
}

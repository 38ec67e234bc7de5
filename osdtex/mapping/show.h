/* show.h -- what a face shows at a point.
 *
 * This is the one place that knows it: bakes, pictures, the figures of seams
 * and those of windows all ask here. A face shows what its UVs look up in the
 * exemplar of its patch, or where it has lookups (mapping/lookups.h) all of
 * them together: their mean, or one over the other, in premultiplied
 * scene-linear colour; where it was made texel by texel
 * (mapping/source_field.h) the mean of the texels around. Over all of it lie
 * decals (mapping/decals.h).
 * See docs/notes/show.md. */
#ifndef OTX_MAPPING_SHOW_H
#define OTX_MAPPING_SHOW_H

#include "mapping/carry.h"
#include "mapping/mapping.h"
#include "mapping/source.h"

/* A place in a triangle of a face. */
typedef struct otx_show_place
{
    int32_t face;
    const int32_t *corners; /* [3] of the level */
    const double *at;       /* [3] barycentric, sum 1; may lie outside */
    /* [3] each, sum 0: the change from a sample to the next along the two axes
     * of whatever is filled; NULL: no footprint. */
    const double *dx, *dy;
} otx_show_place;

/* One of the things that a face shows at a place. */
typedef struct otx_show_term
{
    otx_vec2 uv;   /* in the exemplar */
    double weight; /* without its mask */
    int32_t exemplar;
    const otx_fragment *fragment; /* NULL: the face's own exemplar, opaque */
    const otx_lookup *items;      /* its corners; NULL: the face's own UVs */
    bool made;                    /* or these, of a source field: */
    otx_vec2 uvs[3];              /* at the place's corners */
} otx_show_term;

/* A mapping as it is asked, which it borrows. */
typedef struct otx_show_view
{
    const float *uvs;           /* [corner_count * 2] */
    const int32_t *face_first;  /* [face_count + 1] */
    const otx_lookups *lookups; /* NULL nowhere */
    /* What is looked up are the maps of materials: how their values come into
     * the frame that a place's dx and dy are in, which it must have. NULL:
     * colours. */
    const otx_carry *carry;
    const otx_source_field *field; /* NULL nowhere */
    /* Of stacks, by the vertices of corners; NULL both. */
    const float *along;        /* [vert_count] */
    const int32_t *face_verts; /* [corner_count] */
    const otx_decals *decals;  /* over all of it; NULL none */
} otx_show_view;

static inline otx_show_view
otx_show_of(const otx_mapping *mapping)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);

    return (otx_show_view){
        mapping->uvs,   leaf->face_first, mapping->lookups, NULL,
        mapping->field, mapping->along,   leaf->face_verts, mapping->decals};
}

/* Whether a face shows what was made texel by texel. */
static inline bool
otx_show_is_made(const otx_show_view *show, int32_t face)
{
    return show->field && show->field->face_chart[face] >= 0;
}

/* Whether it has lookups of its own. */
static inline bool
otx_show_has_lookups(const otx_show_view *show, int32_t face)
{
    const otx_lookups *l = show->lookups;

    return l && l->first[face + 1] > l->first[face];
}

/* Whether what a method made of a face is more than what the face's own UVs
 * look up in one picture. */
static inline bool
otx_show_is_layered_below(const otx_show_view *show, int32_t face)
{
    return show->along || otx_show_has_lookups(show, face) ||
           otx_show_is_made(show, face);
}

/* Whether a face shows anything but what its own UVs look up in one picture. */
static inline bool
otx_show_is_layered(const otx_show_view *show, int32_t face)
{
    return otx_show_is_layered_below(show, face) ||
           otx_decals_has(show->decals, face);
}

static inline otx_layering
otx_show_layering(const otx_show_view *show, int32_t face)
{
    return show->lookups && !otx_show_is_made(show, face)
               ? show->lookups->layering
               : OTX_LAYERING_MEAN;
}

/* How many terms a face has, at least 1. */
static inline int32_t
otx_show_term_count(const otx_show_view *show, int32_t face)
{
    const otx_lookups *l = show->lookups;
    const int32_t size = show->face_first[face + 1] - show->face_first[face];

    if (otx_show_is_made(show, face))
        return OTX_SOURCE_FIELD_TERMS;
    return otx_show_has_lookups(show, face)
               ? (int32_t)((l->first[face + 1] - l->first[face]) / size)
               : 1;
}

/* Term `index` of a face at a place.
 *
 *   exemplar  that the face's patch is from */
otx_show_term otx_show_term_at(
    const otx_show_view *show, const otx_show_place *place, int32_t exemplar,
    int32_t index);

/* Where along the axis of a stack a place is; the view has one. */
double otx_show_along(const otx_show_view *show, const otx_show_place *place);

/* UVs of a term, weighted by barycentric coordinates or their changes. */
otx_vec2 otx_show_mix(
    const otx_show_view *show, const otx_show_place *place,
    const otx_show_term *term, const double w[3]);

/* Terms going together, channel by channel. Zero-initialise. */
typedef struct otx_show_sum
{
    double value[OTX_IMAGE_MAX_CHANNELS];
    double weight;
} otx_show_sum;

/* Puts a term's values over, or beside, those that are there.
 *
 *   weight  with its mask
 *   alpha   of the values; 1 where they have none */
void otx_show_add(
    otx_layering layering, const float *values, int32_t channels, double weight,
    double alpha, otx_show_sum *sum);

/* What the sum comes to. Where nothing covers the place, or all weights of a
 * mean are 0, it is 0. */
void otx_show_finish(
    otx_layering layering, const otx_show_sum *sum, int32_t channels,
    float *out);

/* Colour around a place of a face, filtered over `share` of its footprint:
 * `channels` of them, of which a picture that has fewer lacks alpha and is
 * opaque. Of maps all values, carried over and not yet of length 1.
 *
 *   textures  by exemplar: their colours, or their maps
 *   exemplar  that the face's patch is from */
void otx_show_color(
    const otx_show_view *show, const otx_texture *textures,
    const otx_show_place *place, int32_t exemplar, double share,
    int32_t channels, float *color);

/* CIELAB at a place, unfiltered. What goes together is mixed in Lab: for
 * colours that differ little, which is where it matters whether a seam is
 * seen, that is what mixing light comes to. */
void otx_show_lab(
    const otx_show_view *show, const otx_exemplar *exemplars,
    const otx_show_place *place, int32_t exemplar, float lab[3]);

#endif

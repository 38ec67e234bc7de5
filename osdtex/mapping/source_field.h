/* source_field.h -- faces that show places of an exemplar texel by texel.
 *
 * A healed band, or a whole surface that was synthesised, has no UVs at its
 * corners that say what it shows: every texel of it has a place in the exemplar
 * and an angle. Texels lie in charts, which are pieces of the surface laid
 * out in the plane; a face says which chart it shows and where its corners are
 * there. What a texel shows around it is its place gone on with, so where
 * neighbours agree a lookup is as sharp as one by UVs, and where they do not
 * they are mixed over the one texel between their middles. */
#ifndef OTX_MAPPING_SOURCE_FIELD_H
#define OTX_MAPPING_SOURCE_FIELD_H

#include "math/vec.h"

#include <stdbool.h>

enum
{
    OTX_SOURCE_FIELD_TERMS = 4 /* lookups at a place */
};

/* The place that a texel's middle shows, in UV, and the rotation from the
 * surface to the exemplar; (0, 0) where it shows nothing. */
typedef struct otx_source_texel
{
    float u, v;
    float c, s; /* cosine and sine */
} otx_source_texel;

typedef struct otx_source_chart
{
    int32_t width, height;
    int64_t first;    /* of its texels, rows from the bottom */
    otx_vec2 unit;    /* UV of a texel of the exemplar */
    int32_t exemplar; /* that all of it is from */
} otx_source_chart;

typedef struct otx_source_field
{
    int32_t chart_count;
    const otx_source_chart *charts;
    const otx_source_texel *texels;
    const int32_t *face_chart; /* [leaf face_count], -1: shows its UVs */
    const float *places; /* [leaf corner_count * 2] in the face's chart, texels
                          * with middles at halves */
    /* [leaf face_count * 3] (xx, xy, yy): steps in the chart to steps on the
     * surface, texels of the exemplar. */
    const float *metric;
} otx_source_field;

/* What one of the texels around a place goes on to. */
typedef struct otx_source_term
{
    otx_vec2 uvs[3]; /* at the three corners */
    double weight;   /* 0: it is another's, or nothing */
} otx_source_term;

/* The terms at a place of a face that has a chart. Texels that agree are one
 * term; weights sum to 1, or are all 0 where nothing is there.
 *
 *   corners  [3] of the level
 *   at       [3] barycentric, sum 1 */
void otx_source_field_look(
    const otx_source_field *field, int32_t face, const int32_t corners[3],
    const double at[3], otx_source_term out[OTX_SOURCE_FIELD_TERMS]);

/* Whether it is of a whole surface, so that next to nothing shows its UVs.
 *
 *   face_hole  [face_count] */
bool otx_source_field_is_whole(
    const otx_source_field *field, const uint8_t *face_hole,
    int32_t face_count);

#endif

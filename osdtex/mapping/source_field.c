/* source_field.c -- faces that show places of an exemplar texel by texel. */
#include "mapping/source_field.h"

/* Share of the faces that are made where a whole surface is; a face that no
 * chart can lay out is left. */
#define WHOLE 0.95
#define AGREED 0.5 /* texels between two that go on to one place */

static otx_vec2
place_of(const otx_source_field *field, int32_t corner)
{
    const float *at = field->places + 2 * (size_t)corner;

    return (otx_vec2){(double)at[0], (double)at[1]};
}

static int32_t
held(double at, int32_t side)
{
    const int32_t i = (int32_t)floor(at);

    return i < 0 ? 0 : i >= side ? side - 1 : i;
}

/* What is `step` texels of the chart from a texel's middle. */
static otx_vec2
go_on(
    const otx_source_texel *texel, const float *metric, otx_vec2 unit,
    otx_vec2 step)
{
    const otx_vec2 on = {
        (double)metric[0] * step.x + (double)metric[1] * step.y,
        (double)metric[1] * step.x + (double)metric[2] * step.y};
    const otx_vec2 by =
        otx_vec2_mul((otx_vec2){(double)texel->c, (double)texel->s}, on);

    return (otx_vec2){
        (double)texel->u + unit.x * by.x, (double)texel->v + unit.y * by.y};
}

static bool
agree(const otx_source_term *a, const otx_source_term *b, otx_vec2 unit)
{
    for (int k = 0; k < 3; ++k)
        if (!(fabs(a->uvs[k].x - b->uvs[k].x) < AGREED * unit.x) ||
            !(fabs(a->uvs[k].y - b->uvs[k].y) < AGREED * unit.y))
            return false;
    return true;
}

/* Texels that agree with one before them leave it their weight. */
static void
gather(otx_vec2 unit, otx_source_term terms[OTX_SOURCE_FIELD_TERMS])
{
    for (int i = 1; i < OTX_SOURCE_FIELD_TERMS; ++i)
        for (int j = 0; j < i; ++j)
            if (terms[i].weight > 0.0 && terms[j].weight > 0.0 &&
                agree(&terms[i], &terms[j], unit))
            {
                const bool later = terms[i].weight > terms[j].weight;
                const double sum = terms[i].weight + terms[j].weight;

                terms[i].weight = later ? sum : 0.0;
                terms[j].weight = later ? 0.0 : sum;
            }
}

static void
normalise(otx_source_term terms[OTX_SOURCE_FIELD_TERMS])
{
    double sum = 0.0;

    for (int i = 0; i < OTX_SOURCE_FIELD_TERMS; ++i)
        sum += terms[i].weight;
    for (int i = 0; i < OTX_SOURCE_FIELD_TERMS && sum > 0.0; ++i)
        terms[i].weight /= sum;
}

void
otx_source_field_look(
    const otx_source_field *field, int32_t face, const int32_t corners[3],
    const double at[3], otx_source_term out[OTX_SOURCE_FIELD_TERMS])
{
    const otx_source_chart *chart = &field->charts[field->face_chart[face]];
    const float *metric = field->metric + 3 * (size_t)face;
    otx_vec2 places[3], sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
    {
        places[k] = place_of(field, corners[k]);
        sum = otx_vec2_add(sum, otx_vec2_scale(at[k], places[k]));
    }
    for (int i = 0; i < OTX_SOURCE_FIELD_TERMS; ++i)
    {
        const int32_t x = held(sum.x - 0.5 + i % 2, chart->width);
        const int32_t y = held(sum.y - 0.5 + i / 2, chart->height);
        const otx_vec2 middle = {x + 0.5, y + 0.5};
        const otx_source_texel *texel =
            &field->texels[chart->first + (int64_t)y * chart->width + x];
        const double wx = 1.0 - fabs(sum.x - middle.x);
        const double wy = 1.0 - fabs(sum.y - middle.y);

        out[i].weight = wx > 0.0 && wy > 0.0 ? wx * wy : 0.0;
        if (texel->c == 0.0f && texel->s == 0.0f)
            out[i].weight = 0.0;
        for (int k = 0; k < 3; ++k)
            out[i].uvs[k] = go_on(
                texel, metric, chart->unit, otx_vec2_sub(places[k], middle));
    }
    gather(chart->unit, out);
    normalise(out);
}

bool
otx_source_field_is_whole(
    const otx_source_field *field, const uint8_t *face_hole, int32_t face_count)
{
    int64_t all = 0, made = 0;

    for (int32_t f = 0; f < face_count; ++f)
    {
        all += !face_hole[f];
        made += !face_hole[f] && field->face_chart[f] >= 0;
    }
    return (double)made > WHOLE * (double)all;
}

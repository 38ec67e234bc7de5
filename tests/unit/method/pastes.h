/* pastes.h -- pieces of an exemplar on a surface, one by one. */
#ifndef OTX_TESTS_PASTES_H
#define OTX_TESTS_PASTES_H

#include "grid.h"
#include "unit/cluster/sheets.h"

#include "method/lapped/growth.h"
#include "method/lapped/radial_cut.h"

/* A surface that nothing is pasted on yet. */
typedef struct paste_bench
{
    otx_run *run;
    otx_surface surface;
    otx_exemplar *exemplar;
    otx_figures figures;
    otx_map_request request;
    otx_job job;
    otx_lapped l;
    otx_lapped_space space;
} paste_bench;

/* With `texels` to a scene unit. */
static inline paste_bench *
paste_bench_create(otx_run *run, otx_surface surface, double texels)
{
    paste_bench *b = OTX_ZNEW(run->arena, paste_bench, 1);
    const otx_level *leaf;
    otx_lapped *l = &b->l;

    b->run = run;
    b->surface = surface;
    b->exemplar = test_exemplar_create(run->arena, 64, 64, true, 3);
    b->request.scale = 64.0 / texels;
    b->job = (otx_job){
        .run = run,
        .surface = &b->surface,
        .exemplars = b->exemplar,
        .exemplar_count = 1,
        .request = &b->request,
        .figures = &b->figures};
    leaf = otx_surface_leaf(&b->surface);
    *l = (otx_lapped){
        .job = &b->job,
        .run = run,
        .surface = &b->surface,
        .leaf = leaf,
        .exemplar = b->exemplar,
        .texels = texels};
    b->space = (otx_lapped_space){
        OTX_NEW(run->arena, int32_t, leaf->face_count),
        OTX_NEW(run->arena, int32_t, leaf->vert_count)};
    memset(b->space.face_slot, -1, (size_t)leaf->face_count * 4);
    memset(b->space.vert_slot, -1, (size_t)leaf->vert_count * 4);
    assert_int_equal(
        otx_connection_build(
            run, &b->surface, b->surface.level_count - 1, &l->connection),
        OSDTEX_OK);
    assert_int_equal(
        otx_samples_create(run, &b->surface, texels, 2.0, &l->samples),
        OSDTEX_OK);
    return b;
}

/* A round piece. */
static inline otx_radial
paste_circle(double radius, double feather)
{
    otx_radial r = {.feather = (float)feather};

    for (int32_t i = 0; i < OTX_RADIAL_ANGLES; ++i)
        r.radius[i] = (float)radius;
    otx_radial_bound(&r);
    return r;
}

/* A seed in the middle of facet 0 of a face, the picture's u along the frame
 * of that face. */
static inline otx_lapped_seed
paste_seed(const paste_bench *b, int32_t face)
{
    const otx_facet facet = otx_facet_at(b->l.leaf, face, 0);

    return (otx_lapped_seed){
        face,
        {{facet.corners[0], facet.corners[1], facet.corners[2]},
         {0.5, 0.25, 0.25}},
        {1.0, 0.0}};
}

static inline otx_lapped_room
paste_room(paste_bench *b)
{
    return (otx_lapped_room){&b->space, b->run->arena, NULL};
}

/* Where a sample of a chart's face lies in its plane. */
static inline otx_vec2
paste_place(
    const otx_lapped *l, const otx_lapped_chart *chart, int32_t slot,
    const otx_sample_place *sample)
{
    const int32_t shift =
        chart->first[slot] - l->leaf->face_first[chart->faces[slot]];
    otx_vec2 at = {0, 0};

    for (int k = 0; k < 3; ++k)
        at = otx_vec2_add(
            at, otx_vec2_scale(
                    sample->at[k],
                    chart->flat[chart->corners[sample->corners[k] + shift]]));
    return at;
}

static inline otx_lapped_chart
paste_unfold(paste_bench *b, int32_t face, const otx_radial *outline)
{
    const otx_lapped_seed seed = paste_seed(b, face);
    const otx_lapped_room room = paste_room(b);
    otx_lapped_chart chart;

    assert_int_equal(
        otx_lapped_unfold(&b->l, &room, &seed, (double)outline->most, &chart),
        OSDTEX_OK);
    return chart;
}

/* One piece about the middle, as large as that. */
static inline void
paste_whole(
    const paste_bench *b, const otx_radial *outline, otx_lapped_paste *p)
{
    p->size = 1.0;
    p->pieces = OTX_ZNEW(b->run->arena, otx_lapped_piece, 1);
    p->piece_count = 1;
    p->pieces[0].cut = OTX_NEW(b->run->arena, otx_radial, 1);
    *p->pieces[0].cut = *outline;
}

/* All slots are free again. */
static inline void
paste_check_space(const paste_bench *b)
{
    for (int32_t f = 0; f < b->l.leaf->face_count; ++f)
        assert_int_equal(b->space.face_slot[f], -1);
    for (int32_t v = 0; v < b->l.leaf->vert_count; ++v)
        assert_int_equal(b->space.vert_slot[v], -1);
}

/* Corners name the vertices of their leaves, and no leaf comes twice. */
static inline void
paste_check_chart(const paste_bench *b, const otx_lapped_chart *c)
{
    const otx_level *leaf = b->l.leaf;
    uint8_t *seen = OTX_ZNEW(b->run->arena, uint8_t, leaf->face_count);

    for (int32_t i = 0; i < c->face_count; ++i)
    {
        const int32_t face = c->faces[i];

        assert_false(seen[face]);
        seen[face] = 1;
        assert_int_equal(
            c->first[i + 1] - c->first[i], otx_level_face_size(leaf, face));
        for (int32_t k = c->first[i]; k < c->first[i + 1]; ++k)
            assert_int_equal(
                c->verts[c->corners[k]],
                leaf->face_verts[leaf->face_first[face] + k - c->first[i]]);
    }
}

/* The area of a face in the plane to that on the surface. */
static inline double
paste_area_ratio(const paste_bench *b, const otx_lapped_chart *c, int32_t i)
{
    const int32_t face = c->faces[i], first = c->first[i];
    const double texels = otx_lapped_texels(&b->l, face);
    const otx_vec2 o = c->flat[c->corners[first]];
    double area = 0.0;

    for (int32_t k = first + 1; k + 1 < c->first[i + 1]; ++k)
        area += 0.5 * otx_vec2_cross(
                          otx_vec2_sub(c->flat[c->corners[k]], o),
                          otx_vec2_sub(c->flat[c->corners[k + 1]], o));
    return area / (b->l.connection.areas[face] * texels * texels);
}

/* How often the plane is covered where a chart lies, more than once, as a
 * share of the chart; by cells of a texel. */
static inline double
paste_overlap(const otx_lapped_chart *c, double reach)
{
    int64_t once = 0, more = 0;

    for (double y = -reach; y < reach; y += 1.0)
        for (double x = -reach; x < reach; x += 1.0)
        {
            int32_t hits = 0;

            for (int32_t i = 0; i < c->face_count; ++i)
            {
                bool inside = true;

                for (int32_t k = c->first[i]; k < c->first[i + 1]; ++k)
                {
                    const int32_t next =
                        k + 1 < c->first[i + 1] ? k + 1 : c->first[i];
                    const otx_vec2 a = c->flat[c->corners[k]];
                    const otx_vec2 d =
                        otx_vec2_sub(c->flat[c->corners[next]], a);

                    inside = inside &&
                             otx_vec2_cross(
                                 d, otx_vec2_sub((otx_vec2){x, y}, a)) > 0.0;
                }
                hits += inside;
            }
            once += hits > 0;
            more += hits > 1;
        }
    return once ? (double)more / (double)once : 0.0;
}

#endif

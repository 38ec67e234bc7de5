/* texel.c -- samples to colours.
 *
 * On the surface, a texel is the mean of n x n samples, each filtered in the
 * exemplar over its share of the texel. A texel that several charts reach into
 * belongs to the one with most samples; the others' samples are taken from
 * what that chart's surface shows there. Beyond the rims texels show where a
 * walk from the nearest rim ends, and far beyond, the rim itself. */
#include "bake/texel.h"

#include "bake/join.h"
#include "bake/mixture.h"
#include "mapping/source.h"

#include <string.h>

enum
{
    PIECES = 1024, /* kept between samples; a power of two */
    STEPS = 96,    /* of a walk */
    CELL = 8,      /* texels of a far cell's side */
    SAMPLES_MAX = 4,
    SIDE_MAX = OTX_PAGE_BLOCK + 2 * OTX_PAGE_APRON,
    CELLS = (SIDE_MAX + CELL - 1) / CELL /* a row */
};

/* How far facets may be apart on what they share, in texels of the exemplar:
 * rounding, and the bend of a curved surface within a texel. */
static const double AGREED = 0.0625;

/* Squared distance from a rim of what its texels look at: one from the rim, one
 * from the texels of a lookup on it and one from what sharpens these, the
 * latter two across corners. */
static const float RIM_APRON_SQ = 12.0f;

/* A block at work, with an apron of texels around it. */
typedef struct block
{
    const otx_texel_source *source;
    const otx_page *page;
    int32_t width, height; /* without the apron */
    int32_t left, below;   /* of the apron; 0 at the picture's border */
    otx_raster raster;     /* with it */
    float *pixels, *sharp; /* likewise; those that are sharpened */
    int32_t *owners;       /* charts, -1 beyond the rims */
    otx_raster_near near_rim, near_seam;
    otx_texel_piece *pieces; /* [PIECES], by hash of their id */
    const int32_t *rims;     /* [rim_count] near the block */
    int64_t rim_count;
    int32_t far_rim;
} block;

/* ---- pieces ---------------------------------------------------------------
 */

static otx_vec2
corner_uv(const otx_texel_source *source, int32_t corner)
{
    const float *uv = source->mapping->uvs + 2 * (size_t)corner;

    return (otx_vec2){uv[0], uv[1]};
}

/* Weighted by barycentric coordinates or their changes. */
static otx_vec2
mix_uv(
    const otx_texel_source *source, const otx_facet *facet, const double w[3])
{
    otx_vec2 sum = {0.0, 0.0};

    for (int k = 0; k < 3; ++k)
        sum = otx_vec2_add(
            sum, otx_vec2_scale(w[k], corner_uv(source, facet->corners[k])));
    return sum;
}

/* Barycentric coordinates over the texels of a page. */
static void
set_coordinates(const otx_page *page, otx_texel_piece *piece)
{
    otx_vec2 p[3];

    for (int k = 0; k < 3; ++k)
        p[k] = otx_page_texel(page, piece->facet.corners[k]);

    const double area2 =
        otx_vec2_cross(otx_vec2_sub(p[1], p[0]), otx_vec2_sub(p[2], p[0]));

    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 a = p[(k + 1) % 3], b = p[(k + 2) % 3];

        piece->at[k] = otx_vec2_cross(a, b) / area2;
        piece->dx[k] = (a.y - b.y) / area2;
        piece->dy[k] = (b.x - a.x) / area2;
    }
}

static const otx_texture *
texture_of(const otx_texel_source *source, int32_t face)
{
    return &source->textures[otx_source_of(source->mapping, face)];
}

/* A picture without alpha is opaque beside one that has it. */
static void
probe(
    const otx_texel_source *source, const otx_texture *texture,
    const otx_texture_probes *probes, otx_vec2 uv, float *color)
{
    otx_texture_probe(texture, probes, uv, color);
    if (texture->pyramid.levels[0].channels < source->channels)
        color[3] = 1.0f;
}

static int64_t
facet_id(int32_t face, int32_t index)
{
    return (int64_t)face << 16 | index;
}

static void
set_piece(const block *b, int64_t id, otx_texel_piece *piece)
{
    const otx_texel_source *source = b->source;
    const otx_level *leaf = otx_surface_leaf(source->layout->surface);
    const double share = 1.0 / b->raster.n;

    piece->id = id;
    piece->facet = otx_facet_at(leaf, (int32_t)(id >> 16), id & 0xFFFF);
    piece->chart = source->layout->chart[piece->facet.face];
    piece->texture = texture_of(source, piece->facet.face);
    set_coordinates(b->page, piece);
    piece->uv = mix_uv(source, &piece->facet, piece->at);
    piece->uv_dx = mix_uv(source, &piece->facet, piece->dx);
    piece->uv_dy = mix_uv(source, &piece->facet, piece->dy);
    piece->probes =
        otx_texture_measure(piece->texture, piece->uv_dx, piece->uv_dy);
    piece->is_plain = piece->probes.count == 1 && piece->probes.level == 0 &&
                      piece->probes.fraction == 0.0 &&
                      !otx_mixture_has(source->mapping, piece->facet.face);
    if (!piece->is_plain)
        piece->probes = otx_texture_measure(
            piece->texture, otx_vec2_scale(share, piece->uv_dx),
            otx_vec2_scale(share, piece->uv_dy));
}

static inline const otx_texel_piece *
piece_of(block *b, int64_t id)
{
    otx_texel_piece *piece =
        &b->pieces[((id >> 16) * 2 + (id & 1)) & (PIECES - 1)];

    if (piece->id != id)
        set_piece(b, id, piece);
    return piece;
}

/* ---- places ---------------------------------------------------------------
 */

static otx_walk
place_at(const otx_texel_piece *piece, otx_vec2 texel)
{
    otx_walk walk = {.facet = piece->facet};

    for (int k = 0; k < 3; ++k)
    {
        walk.at[k] =
            piece->at[k] + texel.x * piece->dx[k] + texel.y * piece->dy[k];
        walk.dx[k] = piece->dx[k];
        walk.dy[k] = piece->dy[k];
    }
    return walk;
}

/* Where a walk from a piece to a texel position ends. */
static otx_walk
walk_to(const block *b, const otx_texel_piece *piece, otx_vec2 texel)
{
    const otx_layout *layout = b->source->layout;
    otx_walk walk = place_at(piece, texel);

    otx_walk_on(layout->surface, layout->covered, STEPS, &walk);
    return walk;
}

static const otx_texel_piece *
rim_piece(block *b, const otx_page_rim *r)
{
    const otx_level *leaf = otx_surface_leaf(b->source->layout->surface);
    int32_t side;
    const otx_facet facet = otx_facet_at_edge(leaf, r->face, r->edge, &side);

    return piece_of(b, facet_id(facet.face, facet.index));
}

/* The point of a rim nearest to a texel position. */
static otx_walk
place_on_rim(block *b, int32_t rim, otx_vec2 texel)
{
    otx_vec2 ends[2];

    otx_page_ends(b->page, &b->page->rims[rim], ends);
    return place_at(
        rim_piece(b, &b->page->rims[rim]),
        otx_vec2_lerp(
            ends[0], ends[1], otx_raster_nearest(ends[0], ends[1], texel)));
}

/* ---- numbers --------------------------------------------------------------
 */

/* Lengths, on the surface, of the steps of a unit in the exemplar: singular
 * values of the map from the exemplar (in scene units) to the surface. */
static void
stretch_of(const otx_texel_source *source, const otx_facet *facet, double s[2])
{
    const otx_surface *surface = source->layout->surface;
    const int32_t *verts = otx_surface_leaf(surface)->face_verts;
    const otx_vec2 unit = otx_source_unit(
        source->mapping, source->exemplars,
        otx_source_of(source->mapping, facet->face));
    otx_vec3 p[3];
    otx_vec2 q[3];

    for (int k = 0; k < 3; ++k)
    {
        const otx_vec2 uv = corner_uv(source, facet->corners[k]);

        p[k] = otx_vec3_load(surface->points, verts[facet->corners[k]]);
        q[k] = (otx_vec2){uv.x * unit.x, uv.y * unit.y};
    }

    const otx_vec2 q1 = otx_vec2_sub(q[1], q[0]), q2 = otx_vec2_sub(q[2], q[0]);
    const otx_vec3 p1 = otx_vec3_sub(p[1], p[0]), p2 = otx_vec3_sub(p[2], p[0]);
    const double area2 = otx_vec2_cross(q1, q2);

    s[0] = s[1] = 0.0;
    if (!(fabs(area2) > 0.0))
        return;

    const otx_vec3 du = otx_vec3_mix(q2.y / area2, p1, -q1.y / area2, p2);
    const otx_vec3 dv = otx_vec3_mix(-q2.x / area2, p1, q1.x / area2, p2);
    const double a = otx_vec3_dot(du, du), c = otx_vec3_dot(dv, dv);
    const double half = 0.5 * (a + c), mixed = otx_vec3_dot(du, dv);
    const double root =
        sqrt(fmax(0.25 * (a - c) * (a - c) + mixed * mixed, 0.0));

    s[0] = sqrt(half + root);
    s[1] = sqrt(fmax(half - root, 0.0));
}

static void
numbers_at(const otx_texel_source *source, const otx_walk *walk, float *color)
{
    const int32_t face = walk->facet.face;
    otx_vec2 uv;
    double s[2];

    color[0] = color[1] = 0.0f;
    switch (source->kind)
    {
    case OTX_TEXEL_PATCH:
        color[0] = (float)source->mapping->face_patch[face];
        color[1] =
            (float)otx_surface_leaf(source->layout->surface)->face_cage[face];
        return;
    case OTX_TEXEL_UV:
        uv = mix_uv(source, &walk->facet, walk->at);
        color[0] = (float)uv.x;
        color[1] = (float)uv.y;
        return;
    case OTX_TEXEL_STRETCH:
        stretch_of(source, &walk->facet, s);
        color[0] = (float)sqrt(0.5 * (s[0] * s[0] + s[1] * s[1]));
        color[1] = s[1] > 0.0 ? (float)(s[0] / s[1]) : 0.0f;
        return;
    default:
        return;
    }
}

/* ---- colours --------------------------------------------------------------
 */

/* Color of a whole texel around a place. */
static void
color_at(const block *b, const otx_walk *walk, double share, float *color)
{
    const otx_texel_source *source = b->source;

    if (source->kind != OTX_TEXEL_COLOR)
    {
        numbers_at(source, walk, color);
        color[2] = 0.0f;
        return;
    }

    const otx_texture *texture = texture_of(source, walk->facet.face);

    if (otx_mixture_has(source->mapping, walk->facet.face))
    {
        otx_mixture_color(source, texture, walk, share, color);
        return;
    }

    const otx_texture_probes probes = otx_texture_measure(
        texture, otx_vec2_scale(share, mix_uv(source, &walk->facet, walk->dx)),
        otx_vec2_scale(share, mix_uv(source, &walk->facet, walk->dy)));

    probe(
        source, texture, &probes, mix_uv(source, &walk->facet, walk->at),
        color);
}

/* The exemplar's UV at a texel position, by the plane of a piece. */
static otx_vec2
piece_uv(const otx_texel_piece *piece, otx_vec2 at)
{
    return (otx_vec2){
        piece->uv.x + at.x * piece->uv_dx.x + at.y * piece->uv_dy.x,
        piece->uv.y + at.x * piece->uv_dx.y + at.y * piece->uv_dy.y};
}

/* Color of a sample on the surface. */
static void
sample_color(
    const block *b, const otx_texel_piece *piece, otx_vec2 at, float *color)
{
    if (otx_mixture_has(b->source->mapping, piece->facet.face))
    {
        const otx_walk walk = place_at(piece, at);

        otx_mixture_color(
            b->source, piece->texture, &walk, 1.0 / b->raster.n, color);
        return;
    }
    probe(
        b->source, piece->texture, &piece->probes, piece_uv(piece, at), color);
}

static int64_t
sample_id(const block *b, int32_t x, int32_t y, int32_t s)
{
    const int32_t n = b->raster.n, i = x * n + s % n, j = y * n + s / n;

    return b->raster
        .facets[(size_t)j * (size_t)(b->raster.width * n) + (size_t)i];
}

/* The chart with most samples in a texel, and the first sample that has it;
 * -1 where no face reaches. Of equal ones the first. */
static int32_t
owner_of(const block *b, int32_t x, int32_t y, int32_t *first)
{
    const int32_t samples = b->raster.n * b->raster.n;
    const int32_t *chart = b->source->layout->chart;
    int32_t charts[SAMPLES_MAX * SAMPLES_MAX];
    int32_t best = -1, best_count = 0;
    bool alike = true;

    for (int32_t s = 0; s < samples; ++s)
    {
        const int64_t id = sample_id(b, x, y, s);

        charts[s] = id < 0 ? -1 : chart[id >> 16];
        alike = alike && charts[s] == charts[0];
    }
    if (alike)
        return charts[0];
    for (int32_t s = 0; s < samples; ++s)
    {
        int32_t count = 0;

        if (charts[s] < 0 || charts[s] == best)
            continue;
        for (int32_t t = s; t < samples; ++t)
            count += charts[t] == charts[s];
        if (count > best_count)
        {
            best = charts[s];
            best_count = count;
            *first = s;
        }
    }
    return best;
}

/* What runs through a texel that one chart owns. */
typedef enum texel_state
{
    TEXEL_WHOLE,  /* nothing, and one lookup shows it: a close view */
    TEXEL_SMOOTH, /* nothing */
    TEXEL_TORN    /* a seam, or a rim */
} texel_state;

/* By whether all facets in the texel agree on what is at its centre.
 *
 *   first  a sample on the texel's chart
 *   uv     out: what is at the centre, in the exemplar */
static texel_state
state_of(block *b, int32_t x, int32_t y, int32_t first, otx_vec2 *uv)
{
    const otx_vec2 centre = otx_raster_texel(&b->raster, x, y);
    const otx_texel_piece *piece = piece_of(b, sample_id(b, x, y, first));
    const otx_texture *texture = piece->texture;
    const otx_image *image = &texture->pyramid.levels[0];
    const int32_t chart = piece->chart;
    bool is_plain = piece->is_plain;
    int64_t seen = piece->id;

    *uv = piece_uv(piece, centre);
    for (int32_t s = 0; s < b->raster.n * b->raster.n; ++s)
    {
        const int64_t id = sample_id(b, x, y, s);

        if (id == seen)
            continue;
        if (id < 0)
            return TEXEL_TORN;
        seen = id;
        piece = piece_of(b, id);
        is_plain = is_plain && piece->is_plain;

        const otx_vec2 d = otx_vec2_sub(piece_uv(piece, centre), *uv);

        if (piece->chart != chart || piece->texture != texture ||
            !(fabs(d.x) * image->width < AGREED) ||
            !(fabs(d.y) * image->height < AGREED))
            return TEXEL_TORN;
    }
    return is_plain ? TEXEL_WHOLE : TEXEL_SMOOTH;
}

static bool
contains(const otx_texel_piece *piece, otx_vec2 at)
{
    for (int k = 0; k < 3; ++k)
        if (piece->at[k] + at.x * piece->dx[k] + at.y * piece->dy[k] < 0.0)
            return false;
    return true;
}

/* The facet at a place within a texel, of those that its samples have: first
 * that of the sample nearest to it. */
static int64_t
facet_near(block *b, int32_t x, int32_t y, otx_vec2 at)
{
    const int32_t n = b->raster.n, samples = n * n;
    const int32_t i = (int32_t)((at.x - b->raster.origin.x - x) * n);
    const int32_t j = (int32_t)((at.y - b->raster.origin.y - y) * n);
    const int64_t nearest = sample_id(b, x, y, j * n + i);

    for (int32_t s = 0; s < samples; ++s)
    {
        const int64_t id = sample_id(b, x, y, (j * n + i + s) % samples);

        if (id >= 0 && contains(piece_of(b, id), at))
            return id;
    }
    return nearest;
}

/* A texel that faces reach into: `chart` is its owner's, which sample `first`
 * has. Where a seam runs through it more samples are taken, so that each side
 * has its share. */
static void
texel_color(
    block *b, int32_t x, int32_t y, int32_t chart, int32_t first, float *out)
{
    otx_vec2 uv;
    const texel_state state = state_of(b, x, y, first, &uv);
    const int32_t n = state == TEXEL_TORN ? SAMPLES_MAX : b->raster.n;
    const int64_t home = sample_id(b, x, y, first);
    const int32_t channels = b->source->channels;
    float color[OTX_IMAGE_MAX_CHANNELS];
    double sum[OTX_IMAGE_MAX_CHANNELS] = {0.0};

    if (state == TEXEL_WHOLE)
    {
        probe(
            b->source, texture_of(b->source, (int32_t)(home >> 16)),
            &(otx_texture_probes){.count = 1}, uv, out);
        return;
    }
    for (int32_t s = 0; s < n * n; ++s)
    {
        const otx_vec2 at = {
            b->raster.origin.x + x + (s % n + 0.5) / n,
            b->raster.origin.y + y + (s / n + 0.5) / n};
        const int64_t id =
            n == b->raster.n ? sample_id(b, x, y, s) : facet_near(b, x, y, at);

        if (id >= 0 && b->source->layout->chart[id >> 16] == chart)
            sample_color(b, piece_of(b, id), at, color);
        else
        {
            const otx_walk walk = walk_to(b, piece_of(b, home), at);

            color_at(b, &walk, 1.0 / n, color);
        }
        for (int32_t c = 0; c < channels; ++c)
            sum[c] += color[c];
    }
    for (int32_t c = 0; c < channels; ++c)
        out[c] = (float)(sum[c] / (n * n));
}

/* ---- seams ----------------------------------------------------------------
 */

/* What the patch on the other side of a seam would show at a texel, had it
 * gone on; false where the texel is of neither patch.
 *
 *   patch  of the texel
 */
static bool
color_across(
    block *b, const otx_page_rim *seam, int32_t patch, otx_vec2 at,
    float *color)
{
    const otx_layout *layout = b->source->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const int32_t *patches = b->source->mapping->face_patch;
    const int32_t other = otx_level_neighbour(leaf, seam->face, seam->edge);
    otx_walk walk = place_at(rim_piece(b, seam), at);

    if (patch == patches[seam->face])
    {
        const int32_t side = otx_facet_side(&walk.facet, seam->edge);

        if (!otx_walk_cross(layout->surface, layout->covered, side, &walk))
            return false;
    }
    else if (patch != patches[other])
        return false;
    color_at(b, &walk, 1.0, color);
    return true;
}

/* Mixes a texel with what is across a seam `distance_sq` away: half and half
 * on it, nothing at the end of the blend. */
static void
blend(
    block *b, const otx_page_rim *seam, double distance_sq, int32_t patch,
    otx_vec2 at, float *color)
{
    const double t = 0.5 * (1.0 - sqrt(distance_sq) / b->page->blend);
    float across[OTX_IMAGE_MAX_CHANNELS];

    if (!(t > 0.0) || !color_across(b, seam, patch, at, across))
        return;
    for (int32_t c = 0; c < b->source->channels; ++c)
        color[c] = (float)((1.0 - t) * color[c] + t * across[c]);
}

/* Blends a texel on the surface. */
static void
blend_texel(block *b, int32_t x, int32_t y, int32_t first, float *color)
{
    const size_t i = (size_t)y * (size_t)b->raster.width + (size_t)x;
    const int64_t id = sample_id(b, x, y, first);

    if (b->near_seam.edges[i] >= 0)
        blend(
            b, &b->page->seams[b->near_seam.edges[i]], b->near_seam.distance[i],
            b->source->mapping->face_patch[id >> 16],
            otx_raster_texel(&b->raster, x, y), color);
}

/* Whether patches meet at a rim, of which a texel's centre is within a texel.
 */
static bool
is_at_seam(const block *b, int32_t x, int32_t y)
{
    const size_t i = (size_t)y * (size_t)b->raster.width + (size_t)x;
    const int32_t *patch = b->source->mapping->face_patch;
    const otx_level *leaf = otx_surface_leaf(b->source->layout->surface);

    if (b->near_rim.edges[i] < 0 || !(b->near_rim.distance[i] < 1.0f))
        return false;

    const otx_page_rim *r = &b->page->rims[b->near_rim.edges[i]];
    const int32_t other = otx_level_neighbour(leaf, r->face, r->edge);

    return other >= 0 && b->source->layout->covered[other] &&
           patch[other] != patch[r->face];
}

/* Whether samples of a texel lie in different patches of one chart. */
static bool
has_seam(const block *b, int32_t x, int32_t y)
{
    const int32_t *patch = b->source->mapping->face_patch;
    int32_t seen = -1;

    for (int32_t s = 0; s < b->raster.n * b->raster.n; ++s)
    {
        const int64_t id = sample_id(b, x, y, s);

        if (id < 0)
            continue;
        if (seen >= 0 && patch[id >> 16] != seen)
            return true;
        seen = patch[id >> 16];
    }
    return false;
}

/* The same where numbers are baked: at the centre, never averaged. */
static void
texel_numbers(block *b, int32_t x, int32_t y, int32_t first, float *out)
{
    const otx_texel_piece *home = piece_of(b, sample_id(b, x, y, first));
    const otx_walk walk = walk_to(b, home, otx_raster_texel(&b->raster, x, y));

    numbers_at(b->source, &walk, out);
    if (b->source->kind == OTX_TEXEL_SEAM)
        out[0] = has_seam(b, x, y) || is_at_seam(b, x, y) ? 1.0f : 0.0f;
    out[2] = 1.0f;
}

/* ---- beyond the rims ------------------------------------------------------
 */

/* The nearest of the rims around, for texels beyond all gutters. */
static int32_t
nearest_rim(const block *b, otx_vec2 texel)
{
    double best_sq = INFINITY;
    int32_t best = b->far_rim;

    for (int64_t i = 0; i < b->rim_count; ++i)
    {
        otx_vec2 ends[2];

        otx_page_ends(b->page, &b->page->rims[b->rims[i]], ends);

        const otx_vec2 d = otx_vec2_sub(
            texel,
            otx_vec2_lerp(
                ends[0], ends[1], otx_raster_nearest(ends[0], ends[1], texel)));
        const double sq = otx_vec2_dot(d, d);

        if (sq < best_sq)
        {
            best_sq = sq;
            best = b->rims[i];
        }
    }
    return best;
}

/* Blends a texel of a gutter, where the rim is a seam: it shows what is across,
 * and gets its share of what this side would show. */
static void
blend_beyond(block *b, int32_t rim, int32_t x, int32_t y, float *color)
{
    const otx_level *leaf = otx_surface_leaf(b->source->layout->surface);
    const otx_page_rim *r = &b->page->rims[rim];
    const int32_t *patches = b->source->mapping->face_patch;
    const int32_t other = otx_level_neighbour(leaf, r->face, r->edge);
    const size_t i = (size_t)y * (size_t)b->raster.width + (size_t)x;

    if (b->page->seam_count > 0 && other >= 0 &&
        b->source->layout->covered[other] && patches[other] != patches[r->face])
        blend(
            b, r, b->near_rim.distance[i], patches[other],
            otx_raster_texel(&b->raster, x, y), color);
}

static void
beyond_color(block *b, int32_t x, int32_t y, int32_t *cells, float *out)
{
    const otx_vec2 at = otx_raster_texel(&b->raster, x, y);
    const int32_t near =
        b->near_rim.edges[(size_t)y * (size_t)b->raster.width + (size_t)x];
    int32_t *cell = &cells[y / CELL * CELLS + x / CELL];
    otx_walk walk;

    if (near >= 0)
        walk = walk_to(b, rim_piece(b, &b->page->rims[near]), at);
    else
    {
        if (*cell == -2)
            *cell = nearest_rim(
                b, otx_raster_texel(
                       &b->raster, x / CELL * CELL + CELL / 2,
                       y / CELL * CELL + CELL / 2));
        if (*cell < 0)
        {
            memset(out, 0, (size_t)b->source->channels * sizeof *out);
            return;
        }
        walk = place_on_rim(b, *cell, at);
    }
    color_at(b, &walk, 1.0, out);
    if (near >= 0)
        blend_beyond(b, near, x, y, out);
    if (b->source->kind == OTX_TEXEL_SEAM)
        out[0] = is_at_seam(b, x, y) ? 1.0f : 0.0f;
}

/* ---- blocks ---------------------------------------------------------------
 */

int32_t
otx_texel_samples(const otx_texel_source *source, int32_t level)
{
    (void)source;
    return level < 2 ? 2 : SAMPLES_MAX;
}

static int64_t
draw_faces(block *b, int64_t block_index)
{
    const otx_layout *layout = b->source->layout;
    const otx_level *leaf = otx_surface_leaf(layout->surface);
    const otx_bin *bin = &b->page->faces;
    int64_t overlaps = 0;

    for (int64_t i = bin->first[block_index]; i < bin->first[block_index + 1];
         ++i)
    {
        const int32_t face =
            layout
                ->tile_faces[layout->tile_first[b->page->tile] + bin->items[i]];

        for (int32_t k = 0; k < otx_facet_count(leaf, face); ++k)
        {
            const otx_facet facet = otx_facet_at(leaf, face, k);
            const otx_vec2 p[3] = {
                otx_page_texel(b->page, facet.corners[0]),
                otx_page_texel(b->page, facet.corners[1]),
                otx_page_texel(b->page, facet.corners[2])};

            overlaps += otx_raster_triangle(&b->raster, p, facet_id(face, k));
        }
    }
    return overlaps;
}

static void
draw_rims(block *b)
{
    for (int64_t i = 0; i < b->rim_count; ++i)
    {
        otx_vec2 ends[2];

        otx_page_ends(b->page, &b->page->rims[b->rims[i]], ends);
        otx_raster_edge(
            &b->raster, ends, b->page->gutter, b->rims[i], &b->near_rim);
    }
}

static void
draw_seams(block *b, int64_t block_index)
{
    const otx_bin *bin = &b->page->near_seams;

    for (int64_t i = bin->first[block_index]; i < bin->first[block_index + 1];
         ++i)
    {
        otx_vec2 ends[2];

        otx_page_ends(b->page, &b->page->seams[bin->items[i]], ends);
        otx_raster_edge(
            &b->raster, ends, b->page->blend, bin->items[i], &b->near_seam);
    }
}

static void
shade_texel(block *b, int32_t x, int32_t y, int32_t *cells)
{
    const size_t i = (size_t)y * (size_t)b->raster.width + (size_t)x;
    float *out = b->pixels + i * (size_t)b->source->channels;
    int32_t first = 0;
    const int32_t chart = owner_of(b, x, y, &first);

    b->owners[i] = chart;
    if (chart < 0)
        beyond_color(b, x, y, cells, out);
    else if (b->source->kind == OTX_TEXEL_COLOR)
    {
        texel_color(b, x, y, chart, first, out);
        blend_texel(b, x, y, first, out);
    }
    else
        texel_numbers(b, x, y, first, out);
}

/* Whether lookups come close to texels: they do to those of level 0. */
static bool
is_fitted(const block *b)
{
    return b->page->level == 0 && b->source->kind == OTX_TEXEL_COLOR;
}

/* Whether a texel is of the block, or of its apron and looked at: by the
 * texels at the block's border, of which those by a rim look farther. */
static bool
is_needed(const block *b, int32_t x, int32_t y)
{
    const size_t i = (size_t)y * (size_t)b->raster.width + (size_t)x;
    const int32_t dx = x - b->left, dy = y - b->below;

    return (dx >= -1 && dx <= b->width && dy >= -1 && dy <= b->height) ||
           (b->near_rim.edges[i] >= 0 &&
            b->near_rim.distance[i] < RIM_APRON_SQ);
}

static void
shade(block *b)
{
    int32_t cells[CELLS * CELLS];

    for (size_t i = 0; i < sizeof cells / sizeof *cells; ++i)
        cells[i] = -2; /* not looked for yet */
    for (int32_t y = 0; y < b->raster.height; ++y)
        for (int32_t x = 0; x < b->raster.width; ++x)
            if (is_needed(b, x, y))
                shade_texel(b, x, y, cells);
            else
                b->owners[y * b->raster.width + x] = -1;
}

/* The block's place and size, and the apron that is looked at, too. */
static void
place_block(block *b, int32_t x, int32_t y)
{
    const otx_page *page = b->page;
    const int32_t top = page->side - y * OTX_PAGE_BLOCK;
    const int32_t apron = is_fitted(b) ? OTX_PAGE_APRON : 0;
    const int32_t left = x * OTX_PAGE_BLOCK;

    b->width = otx_texel_block_width(page, x);
    b->height = otx_texel_block_width(page, y);
    b->left = left > 0 ? apron : 0;
    b->below = top > b->height ? apron : 0;
    b->raster = (otx_raster){
        .origin = {left - b->left, top - b->height - b->below},
        .width =
            b->width + b->left + (left + b->width < page->side ? apron : 0),
        .height = b->height + b->below + (y > 0 ? apron : 0),
        .n = otx_texel_samples(b->source, page->level),
    };
}

static bool
begin(block *b, int32_t x, int32_t y, otx_arena *scratch)
{
    const otx_page *page = b->page;
    const int64_t index = (int64_t)y * page->columns + x;

    place_block(b, x, y);
    b->rims = page->near_rims.items + page->near_rims.first[index];
    b->rim_count =
        page->near_rims.first[index + 1] - page->near_rims.first[index];
    b->far_rim = page->far_rim[index];

    const size_t texels = (size_t)b->raster.width * (size_t)b->raster.height;

    b->pieces = OTX_NEW(scratch, otx_texel_piece, PIECES);
    b->owners = OTX_NEW(scratch, int32_t, texels);
    b->pixels = OTX_ZNEW(scratch, float, texels *(size_t)b->source->channels);
    b->sharp = OTX_NEW(scratch, float, texels *(size_t)b->source->channels);
    if (!b->pieces || !b->owners || !b->pixels || !b->sharp ||
        !otx_raster_begin(scratch, &b->raster) ||
        !otx_raster_near_begin(scratch, &b->raster, &b->near_rim) ||
        !otx_raster_near_begin(scratch, &b->raster, &b->near_seam))
        return false;
    for (int32_t i = 0; i < PIECES; ++i)
        b->pieces[i].id = -1;
    return true;
}

/* Texels as lookups want them, without the apron. */
static void
fit(const block *b, float *pixels)
{
    const int32_t channels = b->source->channels, width = b->raster.width;
    otx_sharpen_grid grid = {
        width, b->raster.height, channels, b->pixels, b->owners};
    const otx_join join = {
        b->source->mapping, b->source->textures, b->page, &b->raster,
        &b->near_rim,       &b->near_seam,       &grid,   b->source->low,
        b->source->high,
    };
    otx_join_edge edge = {.rim = -1};

    otx_sharpen_texels(&grid, 0, 0, width, b->raster.height, b->sharp);
    grid.pixels = b->sharp;
    for (int32_t y = b->below; y < b->below + b->height; ++y)
        for (int32_t x = b->left; x < b->left + b->width; ++x)
        {
            otx_join_texel(&join, x, y, &edge, pixels);
            pixels += channels;
        }
}

/* Only texels that are fitted have an apron. */
static void
finish(const block *b, float *pixels)
{
    const size_t values = (size_t)b->raster.width * (size_t)b->raster.height *
                          (size_t)b->source->channels;

    if (is_fitted(b))
        fit(b, pixels);
    else
        memcpy(pixels, b->pixels, values * sizeof *pixels);
}

bool
otx_texel_block(
    const otx_texel_source *source, const otx_page *page, int32_t x, int32_t y,
    otx_arena *scratch, float *pixels, int64_t *overlaps)
{
    block b = {.source = source, .page = page};

    if (!begin(&b, x, y, scratch))
        return false;
    *overlaps += draw_faces(&b, (int64_t)y * page->columns + x);
    draw_rims(&b);
    draw_seams(&b, (int64_t)y * page->columns + x);
    shade(&b);
    finish(&b, pixels);
    return true;
}

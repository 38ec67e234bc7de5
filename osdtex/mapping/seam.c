/* seam.c -- finds seams by comparing UVs across edges, and samples them.
 *
 * Patch labels play no part: two patches that happen to agree along an edge
 * are continuous there, and a chart that is torn inside one patch is not. */
#include "mapping/seam.h"

#include <assert.h>

void
otx_seam_corners(
    const otx_level *level, int32_t edge, int32_t face, int32_t corners[2])
{
    const int32_t first = level->face_first[face];
    const int32_t size = otx_level_face_size(level, face);
    int32_t k = 0;

    while (k + 1 < size && level->face_edges[first + k] != edge)
        ++k;
    assert(level->face_edges[first + k] == edge);

    const int32_t from = first + k;
    const int32_t to = first + (k + 1 == size ? 0 : k + 1);
    const bool along =
        level->face_verts[from] == level->edge_verts[2 * (size_t)edge];

    corners[0] = along ? from : to;
    corners[1] = along ? to : from;
}

bool
otx_seam_continuous(
    const otx_exemplar *exemplar, const otx_vec2 a[2], const otx_vec2 b[2])
{
    const double width = exemplar->match.width;
    const double height = exemplar->match.height;
    otx_vec2 shift = otx_vec2_sub(b[0], a[0]);

    shift.x = exemplar->wrap_x ? width * round(shift.x / width) : 0.0;
    shift.y = exemplar->wrap_y ? height * round(shift.y / height) : 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const otx_vec2 d = otx_vec2_sub(otx_vec2_sub(b[k], a[k]), shift);

        /* Written so that NaN is a seam. */
        if (!(fabs(d.x) <= OTX_SEAM_TOLERANCE &&
              fabs(d.y) <= OTX_SEAM_TOLERANCE))
            return false;
    }
    return true;
}

int32_t
otx_seam_sample_count(double length)
{
    if (!(length > 2.0))
        return 2;
    return length < OTX_SEAM_SAMPLES_MAX ? (int32_t)ceil(length)
                                         : OTX_SEAM_SAMPLES_MAX;
}

/* The two texels around a coordinate and the weight of the second. */
typedef struct tap
{
    size_t index[2];
    float weight;
} tap;

static tap
tap_at(double position, int32_t size, bool wrap)
{
    const double below = floor(position - 0.5);
    tap t = {.weight = (float)(position - 0.5 - below)};

    for (int k = 0; k < 2; ++k)
    {
        double i = below + k;

        if (wrap)
            i -= size * floor(i / size);
        /* Written so that NaN reads the first texel. */
        i = i > 0.0 ? i : 0.0;
        t.index[k] = (size_t)(i < size - 1 ? i : size - 1);
    }
    return t;
}

/* Mixes the four texels around a place, three channels. */
static inline void
mix(const float *below[2], const float *above[2], float u, float v, float *out)
{
    for (int c = 0; c < 3; ++c)
    {
        const float b = below[0][c] + u * (below[1][c] - below[0][c]);
        const float a = above[0][c] + u * (above[1][c] - above[0][c]);

        out[c] = b + v * (a - b);
    }
}

static void
sample(
    const otx_image *image, bool wrap_x, bool wrap_y, otx_vec2 p, float *color)
{
    const tap x = tap_at(p.x, image->width, wrap_x);
    const tap y = tap_at(p.y, image->height, wrap_y);
    const size_t stride = 3 * (size_t)image->width;
    const float *row[2] = {
        image->pixels + y.index[0] * stride,
        image->pixels + y.index[1] * stride};
    const float *below[2] = {row[0] + 3 * x.index[0], row[0] + 3 * x.index[1]};
    const float *above[2] = {row[1] + 3 * x.index[0], row[1] + 3 * x.index[1]};

    mix(below, above, x.weight, y.weight, color);
}

/* The same half a texel inside the picture, where nothing wraps or clamps:
 * most of the time of a seam cut is spent here. */
static inline void
sample_inside(const otx_image *image, otx_vec2 p, float *color)
{
    const double x = p.x - 0.5, y = p.y - 0.5;
    const int32_t i = (int32_t)x, j = (int32_t)y;
    const float *at = otx_image_at(image, i, j);
    const float *up = at + 3 * (size_t)image->width;
    const float *below[2] = {at, at + 3};
    const float *above[2] = {up, up + 3};

    mix(below, above, (float)(x - i), (float)(y - j), color);
}

/* Whether all four texels around a place are in the picture. */
static bool
inside(const otx_image *image, otx_vec2 p)
{
    return p.x >= 0.5 && p.y >= 0.5 && p.x < image->width - 0.5 &&
           p.y < image->height - 0.5;
}

void
otx_seam_sample(
    const otx_image *image, bool wrap_x, bool wrap_y, const otx_vec2 side[2],
    double offset, int32_t count, float *colors)
{
    const otx_vec2 along = otx_vec2_sub(side[1], side[0]);
    const double length = otx_vec2_length(along);
    const double step = length > 0.0 ? offset / length : 0.0;
    otx_vec2 start =
        otx_vec2_add(side[0], (otx_vec2){-step * along.y, step * along.x});

    if (wrap_x)
        start.x -= image->width * floor(start.x / image->width);
    if (wrap_y)
        start.y -= image->height * floor(start.y / image->height);

    const bool fast =
        inside(image, start) && inside(image, otx_vec2_add(start, along));

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_vec2 p =
            otx_vec2_add(start, otx_vec2_scale((i + 0.5) / count, along));
        float *color = colors + 3 * (size_t)i;

        if (fast)
            sample_inside(image, p, color);
        else
            sample(image, wrap_x, wrap_y, p, color);
    }
}

double
otx_seam_density(const otx_mapping *mapping, const otx_exemplar *exemplars)
{
    return exemplars->match.width / mapping->scale;
}

bool
otx_seam_covered(const otx_mapping *mapping, int32_t face)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const size_t first = 2 * (size_t)leaf->face_first[face];
    const size_t end = 2 * (size_t)leaf->face_first[face + 1];

    if (leaf->face_hole[face] || mapping->face_patch[face] < 0)
        return false;
    for (size_t k = first; k < end; ++k)
        if (!isfinite(mapping->uvs[k]))
            return false;
    return true;
}

otx_vec2
otx_seam_texel(
    const otx_mapping *mapping, const otx_exemplar *exemplar, int32_t corner)
{
    const float *uv = mapping->uvs + 2 * (size_t)corner;

    return (otx_vec2){
        (double)uv[0] * exemplar->match.width,
        (double)uv[1] * exemplar->match.height};
}

/* What the search for seams reads, and the list as it grows. */
typedef struct search
{
    const otx_mapping *mapping;
    const otx_exemplar *exemplars;
    const otx_level *leaf;
    const uint8_t *covered; /* [face_count] */
    double density;
    int32_t *edges;
    uint8_t *transition;
    double *lengths;
    int32_t *sample_first;
    float *samples;
} search;

/*   from  the exemplars of the two sides */
static void
edge_sides(
    const search *s, int32_t edge, otx_vec2 sides[2][2],
    const otx_exemplar *from[2])
{
    for (int f = 0; f < 2; ++f)
    {
        const int32_t face = s->leaf->edge_faces[2 * (size_t)edge + f];
        int32_t corners[2];

        from[f] = &s->exemplars[otx_source_of(s->mapping, face)];
        otx_seam_corners(s->leaf, edge, face, corners);
        for (int k = 0; k < 2; ++k)
            sides[f][k] = otx_seam_texel(s->mapping, from[f], corners[k]);
    }
}

/* Lists the seams; their samples are only counted. */
static otx_status
find_seams(otx_run *run, search *s, otx_seam_list *out)
{
    int64_t samples = 0;

    s->sample_first[0] = 0;
    for (int32_t e = 0; e < s->leaf->edge_count; ++e)
    {
        const int32_t *faces = s->leaf->edge_faces + 2 * (size_t)e;
        const otx_exemplar *from[2];
        otx_vec2 sides[2][2];

        if (faces[1] < 0 || !s->covered[faces[0]] || !s->covered[faces[1]])
            continue;

        const double length =
            s->density * otx_seam_edge_length(s->mapping->surface, e);

        out->interior_length += length;
        edge_sides(s, e, sides, from);
        if (from[0] == from[1] &&
            otx_seam_continuous(from[0], sides[0], sides[1]))
            continue;
        samples += otx_seam_sample_count(length);
        if (samples > INT32_MAX)
            return otx_fail(
                run, OSDTEX_ERROR_LIMIT, "measure", OTX_NOWHERE,
                "the seams have more than 2^31 texels; choose a larger scale");
        out->total_length += length;
        out->transition_length += from[0] != from[1] ? length : 0.0;
        s->transition[out->edge_count] = from[0] != from[1];
        s->edges[out->edge_count] = e;
        s->lengths[out->edge_count] = length;
        s->sample_first[++out->edge_count] = (int32_t)samples;
    }
    return OSDTEX_OK;
}

static otx_status
sample_seam(void *context, int64_t index, otx_worker *worker)
{
    const search *s = context;
    const int32_t first = s->sample_first[index];
    const int32_t count = s->sample_first[index + 1] - first;
    float *colors = OTX_NEW(worker->scratch, float, 6 * (int64_t)count);
    const otx_exemplar *from[2];
    otx_vec2 sides[2][2];

    if (!colors)
        return OSDTEX_ERROR_MEMORY;
    edge_sides(s, s->edges[index], sides, from);
    for (int f = 0; f < 2; ++f)
        otx_seam_sample(
            &from[f]->lab, from[f]->wrap_x, from[f]->wrap_y, sides[f], 0.0,
            count, colors + 3 * (size_t)(f * count));
    for (int32_t i = 0; i < count; ++i)
    {
        const float *a = colors + 3 * (size_t)i;
        const float *b = a + 3 * (size_t)count;
        const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};

        s->samples[first + i] =
            (float)sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    }
    return OSDTEX_OK;
}

static otx_status
sample_seams(otx_run *run, search *s, otx_seam_list *out)
{
    s->samples = OTX_NEW(run->arena, float, s->sample_first[out->edge_count]);
    out->samples = s->samples;
    if (!s->samples ||
        otx_pool_for(run->pool, out->edge_count, sample_seam, s) != OSDTEX_OK)
        return otx_fail_memory(run, "measure");
    return OSDTEX_OK;
}

/* Fills `covered` and the arrays of the list at their largest. */
static bool
prepare(otx_run *run, search *s, otx_seam_list *out)
{
    const int64_t edge_count = s->leaf->edge_count;
    uint8_t *covered = OTX_NEW(run->scratch, uint8_t, s->leaf->face_count);

    out->edges = s->edges = OTX_NEW(run->arena, int32_t, edge_count);
    out->transition = s->transition = OTX_NEW(run->arena, uint8_t, edge_count);
    out->lengths = s->lengths = OTX_NEW(run->arena, double, edge_count);
    out->sample_first = s->sample_first =
        OTX_NEW(run->arena, int32_t, edge_count + 1);
    if (!covered || !s->edges || !s->transition || !s->lengths ||
        !s->sample_first)
        return false;
    for (int32_t f = 0; f < s->leaf->face_count; ++f)
        covered[f] = otx_seam_covered(s->mapping, f);
    s->covered = covered;
    return true;
}

otx_status
otx_seam_collect(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_seam_list *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    search s = {
        .mapping = mapping,
        .exemplars = exemplars,
        .leaf = otx_surface_leaf(mapping->surface),
        .density = otx_seam_density(mapping, exemplars),
    };

    *out = (otx_seam_list){0};

    otx_status status = prepare(run, &s, out) ? find_seams(run, &s, out)
                                              : otx_fail_memory(run, "measure");

    if (status == OSDTEX_OK)
        status = sample_seams(run, &s, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

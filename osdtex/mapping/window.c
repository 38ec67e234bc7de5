/* window.c -- cuts windows out of the surface and finds them in the exemplar.
 *
 * A window is SIDE * SIDE texels of the plane into which the faces around a
 * point are unfolded, hinge by hinge, nearest first; where curvature makes
 * faces overlap the first one counts. The search is exhaustive at a quarter of
 * the resolution, then local at full resolution for the best few angles. */
#include "mapping/window.h"

#include "image/view.h"
#include "mapping/show.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    SIDE = 24,   /* texels */
    QUARTER = 4, /* texels of a coarse texel */
    COARSE = 9,  /* coarse texels across a turned window, odd */
    PAD = COARSE / 2,
    ANGLES = 36,     /* over the full turn */
    KEPT = 8,        /* angles refined */
    FACES_MAX = 512, /* unfolded at most; windows that need more are left out */
    CORNERS_MAX = 16,
    TRIES = 8 /* places tried for each interior window */
};

static const double reach = 0.7072 * SIDE; /* half a diagonal */

typedef struct hinge
{
    int32_t face, edge;
    otx_vec2 ends[2]; /* of the edge, in the order of edge_verts, texels */
} hinge;

typedef struct window
{
    int32_t filled;
    int32_t source; /* the exemplar that its first face shows */
    bool crosses_seam;
    uint8_t valid[SIDE * SIDE];
    float colors[SIDE * SIDE][3];
    /* Means over QUARTER * QUARTER texels from each texel on. */
    uint8_t mean_valid[SIDE * SIDE];
    float means[SIDE * SIDE][3];
    int32_t hinge_count;
    hinge hinges[FACES_MAX];
} window;

/* A place in the exemplar and how well a window fits there. */
typedef struct pose
{
    otx_vec2 centre; /* texels */
    double angle;
    double error; /* mean square Lab distance */
} pose;

typedef struct lookup
{
    const otx_mapping *mapping;
    otx_show_view show;
    const otx_exemplar *exemplars;
    const otx_level *leaf;
    double texels_per_unit;
    otx_image coarse[OTX_EXEMPLARS_MAX]; /* a quarter of each one's Lab, PAD
                                          * texels of its continuation around */
    const uint8_t *seam_edge;            /* [edge_count] */
    const int32_t *seeds; /* edges at whose middles windows are */
    double *distances;    /* RMS, of sigma */
} lookup;

static otx_vec3
vertex(const lookup *l, int32_t vert)
{
    return otx_vec3_load(l->mapping->surface->points, vert);
}

/* Lays the corners of a face beside its hinge. */
static void
unfold(const lookup *l, const hinge *h, int32_t size, otx_vec2 *out)
{
    const int32_t first = l->leaf->face_first[h->face];
    const int32_t *verts = l->leaf->face_verts + first;
    int32_t corners[2];

    otx_seam_corners(l->leaf, h->edge, h->face, corners);

    const otx_vec3 from = vertex(l, l->leaf->face_verts[corners[0]]);
    const otx_vec3 to = vertex(l, l->leaf->face_verts[corners[1]]);
    const otx_vec3 x = otx_vec3_unit(otx_vec3_sub(to, from));
    otx_vec3 normal = {0.0, 0.0, 0.0};

    for (int32_t k = 1; k + 1 < size; ++k)
        normal = otx_vec3_add(
            normal,
            otx_vec3_cross(
                otx_vec3_sub(vertex(l, verts[k]), vertex(l, verts[0])),
                otx_vec3_sub(vertex(l, verts[k + 1]), vertex(l, verts[0]))));

    const otx_vec3 y = otx_vec3_cross(otx_vec3_unit(normal), x);
    const otx_vec2 along = otx_vec2_sub(h->ends[1], h->ends[0]);
    const double length = otx_vec2_length(along);
    const otx_vec2 turn =
        otx_vec2_scale(length > 0.0 ? l->texels_per_unit / length : 0.0, along);

    for (int32_t k = 0; k < size; ++k)
    {
        const otx_vec3 d = otx_vec3_sub(vertex(l, verts[k]), from);

        out[k] = otx_vec2_add(
            h->ends[0],
            otx_vec2_mul(
                turn, (otx_vec2){otx_vec3_dot(d, x), otx_vec3_dot(d, y)}));
    }
}

static double
segment_distance(otx_vec2 a, otx_vec2 b)
{
    const otx_vec2 d = otx_vec2_sub(b, a);
    const double square = otx_vec2_dot(d, d);
    double t = square > 0.0 ? -otx_vec2_dot(a, d) / square : 0.0;

    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return otx_vec2_length(otx_vec2_lerp(a, b, t));
}

/* Colours the texels of the window that lie in a triangle of a face.
 *
 *   corners  of the level */
static void
fill_triangle(
    const lookup *l, window *w, int32_t face, const otx_vec2 p[3],
    const int32_t corners[3])
{
    const otx_vec2 e1 = otx_vec2_sub(p[1], p[0]);
    const otx_vec2 e2 = otx_vec2_sub(p[2], p[0]);
    const double area2 = otx_vec2_cross(e1, e2);

    if (!(area2 > 0.0))
        return;
    for (int32_t i = 0; i < SIDE * SIDE; ++i)
    {
        const otx_vec2 at = {
            i % SIDE + 0.5 - SIDE / 2 - p[0].x,
            i / SIDE + 0.5 - SIDE / 2 - p[0].y};
        const double s = otx_vec2_cross(at, e2) / area2;
        const double t = otx_vec2_cross(e1, at) / area2;
        const double weights[3] = {1.0 - s - t, s, t};
        const otx_show_place place = {face, corners, weights, NULL, NULL};

        if (w->valid[i] || s < 0.0 || t < 0.0 || s + t > 1.0)
            continue;
        w->valid[i] = 1;
        ++w->filled;
        otx_show_lab(&l->show, l->exemplars, &place, w->source, w->colors[i]);
    }
}

static void
fill_face(
    const lookup *l, window *w, int32_t face, int32_t size,
    const otx_vec2 *corners)
{
    const int32_t first = l->leaf->face_first[face];

    for (int32_t k = 1; k + 1 < size; ++k)
    {
        const otx_vec2 p[3] = {corners[0], corners[k], corners[k + 1]};
        const int32_t of[3] = {first, first + k, first + k + 1};

        fill_triangle(l, w, face, p, of);
    }
}

static bool
is_unfolded(const window *w, int32_t face)
{
    for (int32_t i = 0; i < w->hinge_count; ++i)
        if (w->hinges[i].face == face)
            return true;
    return false;
}

/* Queues the faces across the edges that come near the window. False when
 * there are too many. */
static bool
hinge_neighbours(
    const lookup *l, window *w, int32_t face, int32_t size,
    const otx_vec2 *corners)
{
    for (int32_t k = 0; k < size; ++k)
    {
        const int32_t corner = l->leaf->face_first[face] + k;
        const int32_t edge = l->leaf->face_edges[corner];
        const int32_t other = otx_level_neighbour(l->leaf, face, k);
        const otx_vec2 a = corners[k], b = corners[(k + 1) % size];
        const bool along = l->leaf->face_verts[corner] ==
                           l->leaf->edge_verts[2 * (size_t)edge];

        if (segment_distance(a, b) > reach)
            continue;
        w->crosses_seam |= l->seam_edge[edge] != 0;
        if (other < 0 || !otx_seam_covered(l->mapping, other) ||
            is_unfolded(w, other))
            continue;
        if (w->hinge_count == FACES_MAX)
            return false;
        w->hinges[w->hinge_count++] =
            (hinge){other, edge, {along ? a : b, along ? b : a}};
    }
    return true;
}

static void
average(window *w)
{
    for (int32_t y = 0; y + QUARTER <= SIDE; ++y)
        for (int32_t x = 0; x + QUARTER <= SIDE; ++x)
        {
            const int32_t at = y * SIDE + x;
            bool valid = true;

            for (int32_t i = 0; i < QUARTER * QUARTER; ++i)
            {
                const int32_t from = at + i / QUARTER * SIDE + i % QUARTER;

                valid &= w->valid[from] != 0;
                for (int c = 0; c < 3; ++c)
                    w->means[at][c] += w->colors[from][c] / (QUARTER * QUARTER);
            }
            w->mean_valid[at] = valid;
        }
}

/* Cuts the window around the middle of `edge`. False where the surface does
 * not fill three quarters of it. */
static bool
cut_window(const lookup *l, int32_t edge, window *w)
{
    const int32_t *faces = l->leaf->edge_faces + 2 * (size_t)edge;
    const double half = 0.5 * l->texels_per_unit *
                        otx_seam_edge_length(l->mapping->surface, edge);

    memset(w, 0, offsetof(window, hinges));
    w->source = otx_source_of(l->mapping, faces[0]);
    for (int k = 0; k < 2 && faces[k] >= 0; ++k)
        w->hinges[w->hinge_count++] =
            (hinge){faces[k], edge, {{-half, 0.0}, {half, 0.0}}};
    for (int32_t i = 0; i < w->hinge_count; ++i)
    {
        const hinge *h = &w->hinges[i];
        const int32_t size = otx_level_face_size(l->leaf, h->face);
        otx_vec2 corners[CORNERS_MAX];

        if (size > CORNERS_MAX ||
            otx_source_of(l->mapping, h->face) != w->source)
            return false;
        unfold(l, h, size, corners);
        fill_face(l, w, h->face, size, corners);
        if (!hinge_neighbours(l, w, h->face, size, corners))
            return false;
    }
    average(w);
    return 4 * w->filled >= 3 * SIDE * SIDE;
}

/* One coarse texel of a turned window. */
typedef struct sample
{
    ptrdiff_t offset; /* from the centre, floats of the coarse picture */
    const float *color;
} sample;

static int32_t
turn_window(
    const window *w, const otx_image *coarse, double angle,
    sample out[COARSE * COARSE])
{
    const otx_vec2 back = otx_vec2_polar(-angle);
    int32_t count = 0;

    for (int32_t i = 0; i < COARSE * COARSE; ++i)
    {
        const int32_t x = i % COARSE - COARSE / 2;
        const int32_t y = i / COARSE - COARSE / 2;
        const otx_vec2 from = otx_vec2_mul(
            back, (otx_vec2){QUARTER * (double)x, QUARTER * (double)y});
        /* First texel of the block that is centred there. */
        const int32_t fx = (int32_t)lround(from.x) + (SIDE - QUARTER) / 2;
        const int32_t fy = (int32_t)lround(from.y) + (SIDE - QUARTER) / 2;

        if (fx < 0 || fy < 0 || fx + QUARTER > SIDE || fy + QUARTER > SIDE ||
            !w->mean_valid[fy * SIDE + fx])
            continue;
        out[count++] = (sample){
            ((ptrdiff_t)y * coarse->width + x) * 3, w->means[fy * SIDE + fx]};
    }
    return count;
}

/* Adds the border to a coarse picture, so that the search need not wrap. */
static otx_status
pad_coarse(
    otx_run *run, const otx_exemplar *from, const otx_image *inner,
    otx_image *out)
{
    OTX_TRY(otx_image_create(
        run, run->scratch, inner->width + 2 * PAD, inner->height + 2 * PAD, 3,
        out));
    for (int32_t y = 0; y < out->height; ++y)
        for (int32_t x = 0; x < out->width; ++x)
            memcpy(
                otx_image_at(out, x, y),
                otx_image_at(
                    inner, otx_view_fold(x - PAD, inner->width, from->wrap_x),
                    otx_view_fold(y - PAD, inner->height, from->wrap_y)),
                3 * sizeof(float));
    return OSDTEX_OK;
}

/* Sum of squares around one coarse texel, given up once it passes `limit`. */
static double
coarse_error(
    const float *centre, const sample *samples, int32_t count, double limit)
{
    double sum = 0.0;

    for (int32_t i = 0; i < count && sum < limit; ++i)
    {
        const float *a = centre + samples[i].offset;
        const float *b = samples[i].color;
        const float d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};

        sum += (double)(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    }
    return sum;
}

static pose
search_angle(const lookup *l, const window *w, double angle)
{
    sample samples[COARSE * COARSE];
    const otx_image *coarse = &l->coarse[w->source];
    const int32_t count = turn_window(w, coarse, angle, samples);
    double least = HUGE_VAL;
    int32_t at_x = 0, at_y = 0;

    for (int32_t y = 0; y < coarse->height - 2 * PAD; ++y)
        for (int32_t x = 0; x < coarse->width - 2 * PAD; ++x)
        {
            const double error = coarse_error(
                otx_image_at(coarse, x + PAD, y + PAD), samples, count, least);

            if (error < least)
            {
                least = error;
                at_x = x;
                at_y = y;
            }
        }
    return (pose){
        {QUARTER * (at_x + 0.5), QUARTER * (at_y + 0.5)},
        angle,
        count > 0 ? least / count : HUGE_VAL};
}

/* Mean square over every `stride`-th texel across and up. */
static double
pose_error(const lookup *l, const window *w, pose at, int32_t stride)
{
    const otx_exemplar *from = &l->exemplars[w->source];
    const otx_vec2 turn = otx_vec2_polar(at.angle);
    double sum = 0.0;
    int32_t count = 0;

    for (int32_t y = 0; y < SIDE; y += stride)
        for (int32_t x = 0; x < SIDE; x += stride)
        {
            const otx_vec2 off = {x + 0.5 - SIDE / 2, y + 0.5 - SIDE / 2};
            float color[3];

            if (!w->valid[y * SIDE + x])
                continue;
            otx_view_value(
                otx_view_of(&from->lab, from->wrap_x, from->wrap_y),
                otx_vec2_add(at.centre, otx_vec2_mul(turn, off)), color);
            ++count;
            for (int c = 0; c < 3; ++c)
            {
                const double d = (double)color[c] - w->colors[y * SIDE + x][c];

                sum += d * d;
            }
        }
    return sum / count;
}

/* Takes the best of the poses on a grid around `best`. */
static pose
search_around(
    const lookup *l, const window *w, pose best, int32_t steps, double step,
    double turn)
{
    const pose centre = best;

    for (int32_t a = -2; a <= 2; ++a)
        for (int32_t y = -steps; y <= steps; ++y)
            for (int32_t x = -steps; x <= steps; ++x)
            {
                pose p = {
                    {centre.centre.x + x * step, centre.centre.y + y * step},
                    centre.angle + a * turn,
                    0.0};

                p.error = pose_error(l, w, p, 3);
                if (p.error < best.error)
                    best = p;
            }
    return best;
}

static pose
refine(const lookup *l, const window *w, pose p)
{
    const double degree = OTX_PI / 180.0;

    p.error = pose_error(l, w, p, 3);
    p = search_around(l, w, p, 3, 1.0, 2.5 * degree);
    p = search_around(l, w, p, 1, 0.5, 1.0 * degree);
    p = search_around(l, w, p, 1, 0.25, 0.5 * degree);
    p = search_around(l, w, p, 1, 0.125, 0.25 * degree);
    p.error = pose_error(l, w, p, 1);
    return p;
}

static int
compare_poses(const void *a, const void *b)
{
    const pose *p = a, *q = b;

    if (p->error != q->error)
        return p->error < q->error ? -1 : 1;
    return (p->angle > q->angle) - (p->angle < q->angle);
}

static otx_status
look_up(void *context, int64_t index, otx_worker *worker)
{
    const lookup *l = context;
    window *w = OTX_NEW(worker->scratch, window, 1);
    pose poses[ANGLES];
    double least = HUGE_VAL, sigma;

    if (!w)
        return OSDTEX_ERROR_MEMORY;
    cut_window(l, l->seeds[index], w);
    for (int k = 0; k < ANGLES; ++k)
        poses[k] = search_angle(l, w, 2.0 * OTX_PI * k / ANGLES);
    qsort(poses, ANGLES, sizeof *poses, compare_poses);
    for (int k = 0; k < KEPT; ++k)
        least = fmin(least, refine(l, w, poses[k]).error);
    sigma = l->exemplars[w->source].lab_sigma;
    l->distances[index] = sigma > 0.0 ? sqrt(least) / sigma : 0.0;
    return OSDTEX_OK;
}

/* Interior edges whose windows are whole and meet no seam, `count` at most,
 * spread over the edges. */
static int32_t
seed_interior(const lookup *l, window *w, int32_t count, int32_t *seeds)
{
    const int64_t tries = (int64_t)TRIES * count;
    int32_t found = 0;

    for (int64_t i = 0; i < tries && found < count; ++i)
    {
        /* Every TRIES-th place first, so that few tries cover all. */
        const int64_t place = i % count * TRIES + i / count;
        const int32_t edge = (int32_t)(place * l->leaf->edge_count / tries);
        const int32_t *faces = l->leaf->edge_faces + 2 * (size_t)edge;

        if (faces[1] >= 0 && otx_seam_covered(l->mapping, faces[0]) &&
            otx_seam_covered(l->mapping, faces[1]) && cut_window(l, edge, w) &&
            !w->crosses_seam)
            seeds[found++] = edge;
    }
    return found;
}

static int32_t
seed_seams(
    const lookup *l, window *w, const otx_seam_list *seams, int32_t count,
    int32_t *seeds)
{
    int32_t found = 0;

    count = count < seams->edge_count ? count : seams->edge_count;
    for (int64_t i = 0; i < count; ++i)
    {
        const int32_t edge = seams->edges[i * seams->edge_count / count];

        if (cut_window(l, edge, w))
            seeds[found++] = edge;
    }
    return found;
}

static int
compare_doubles(const void *a, const void *b)
{
    const double *p = a, *q = b;

    return (*p > *q) - (*p < *q);
}

/* Looks the seeds up; p50 and p90. */
static otx_status
look_up_all(
    otx_run *run, lookup *l, const int32_t *seeds, int32_t count,
    double quantiles[2])
{
    quantiles[0] = quantiles[1] = 0.0;
    l->seeds = seeds;
    l->distances = OTX_NEW(run->scratch, double, count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_loop_result(
        run, "measure", otx_pool_for(run->pool, count, look_up, l)));
    if (count == 0)
        return OSDTEX_OK;
    qsort(l->distances, (size_t)count, sizeof(double), compare_doubles);
    quantiles[0] = l->distances[(count - 1) / 2];
    quantiles[1] = l->distances[(9 * (int64_t)count + 9) / 10 - 1];
    return OSDTEX_OK;
}

static otx_status
make_coarse(otx_run *run, lookup *l)
{
    for (int32_t k = 0; k < otx_source_count(l->mapping); ++k)
    {
        const otx_exemplar *from = &l->exemplars[k];
        otx_image half, quarter;

        OTX_TRY(otx_image_halve(run, run->scratch, &from->lab, &half));
        OTX_TRY(otx_image_halve(run, run->scratch, &half, &quarter));
        OTX_TRY(pad_coarse(run, from, &quarter, &l->coarse[k]));
    }
    return OSDTEX_OK;
}

static otx_status
measure(
    otx_run *run, lookup *l, const otx_seam_list *seams, int32_t count,
    otx_window_figures *out)
{
    uint8_t *seam_edge = OTX_ZNEW(run->scratch, uint8_t, l->leaf->edge_count);
    int32_t *seeds = OTX_NEW(run->scratch, int32_t, count);
    window *w = OTX_NEW(run->scratch, window, 1);
    double seam[2], interior[2];

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < seams->edge_count; ++i)
        seam_edge[seams->edges[i]] = 1;
    l->seam_edge = seam_edge;
    OTX_TRY(make_coarse(run, l));
    out->seam_count = seed_seams(l, w, seams, count, seeds);
    OTX_TRY(look_up_all(run, l, seeds, out->seam_count, seam));
    OTX_TRY(otx_progress(run, "measure", 0.75));
    out->interior_count = seed_interior(l, w, count, seeds);
    OTX_TRY(look_up_all(run, l, seeds, out->interior_count, interior));
    out->seam_p50 = seam[0];
    out->seam_p90 = seam[1];
    out->interior_p50 = interior[0];
    out->interior_p90 = interior[1];
    return OSDTEX_OK;
}

otx_status
otx_window_measure(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    const otx_seam_list *seams, int32_t count, otx_window_figures *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    lookup l = {
        .mapping = mapping,
        .show = otx_show_of(mapping),
        .exemplars = exemplars,
        .leaf = otx_surface_leaf(mapping->surface),
        .texels_per_unit = otx_seam_texels_per_unit(mapping, exemplars),
    };

    l.show.decals = NULL; /* they are not meant to look like the exemplar */
    *out = (otx_window_figures){0};

    const otx_status status = measure(run, &l, seams, count, out);

    otx_arena_release(run->scratch, mark);
    return status;
}

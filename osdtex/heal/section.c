/* section.c -- seams in pieces that are mended, or left, each for itself. */
#include "heal/section.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* The seams at a vertex; more than two are a junction. */
typedef struct meeting
{
    int32_t count;
    int32_t seams[2]; /* as the list counts them */
} meeting;

static meeting *
find_meetings(otx_run *run, const otx_level *leaf, const otx_seam_list *seams)
{
    meeting *out = OTX_ZNEW(run->scratch, meeting, leaf->vert_count);

    for (int32_t i = 0; out && i < seams->edge_count; ++i)
        for (int k = 0; k < 2; ++k)
        {
            meeting *m =
                &out[leaf->edge_verts[2 * (size_t)seams->edges[i] + k]];

            if (m->count < 2)
                m->seams[m->count] = i;
            ++m->count;
        }
    return out;
}

/* Joins the two seams of a vertex unless they get too long. */
static void
join(
    const otx_seam_list *seams, const meeting *m, double longest,
    int32_t *parent, double *lengths)
{
    if (m->count != 2 ||
        seams->transition[m->seams[0]] != seams->transition[m->seams[1]])
        return;

    const int32_t a = otx_union_find_root(parent, m->seams[0]);
    const int32_t b = otx_union_find_root(parent, m->seams[1]);
    const double length = lengths[a] + lengths[b];

    if (a == b || length > longest)
        return;
    otx_union_find_join(parent, a, b);
    lengths[otx_union_find_root(parent, a)] = length;
}

otx_status
otx_section_find(
    otx_run *run, const otx_level *leaf, const otx_seam_list *seams,
    double longest, otx_section_list *out)
{
    const int32_t n = seams->edge_count;
    const meeting *meetings = find_meetings(run, leaf, seams);
    int32_t *parent = OTX_NEW(run->scratch, int32_t, n);

    out->count = 0;
    out->of_edge = OTX_NEW(run->scratch, int32_t, leaf->edge_count);
    out->lengths = OTX_NEW(run->scratch, double, n);
    double *lengths = OTX_NEW(run->scratch, double, n);
    int32_t *number = OTX_NEW(run->scratch, int32_t, n);
    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < n; ++i)
    {
        parent[i] = i;
        lengths[i] = seams->lengths[i];
    }
    for (int32_t v = 0; v < leaf->vert_count; ++v)
        join(seams, &meetings[v], longest, parent, lengths);
    memset(out->of_edge, 0xff, (size_t)leaf->edge_count * sizeof *out->of_edge);
    for (int32_t i = 0; i < n; ++i)
    {
        const int32_t root = otx_union_find_root(parent, i);

        if (seams->transition[i])
            continue;
        if (root == i)
        {
            out->lengths[out->count] = lengths[i];
            number[i] = out->count++;
        }
        out->of_edge[seams->edges[i]] = number[root];
    }
    return OSDTEX_OK;
}

/* A seam edge in a plot. */
typedef struct segment
{
    int32_t section, order;
    otx_vec2 a, b;
} segment;

static int
compare(const void *a, const void *b)
{
    const segment *p = a, *q = b;

    if (p->section != q->section)
        return p->section < q->section ? -1 : 1;
    return (p->order > q->order) - (p->order < q->order);
}

static otx_status
list_segments(
    const otx_target_set *set, int32_t k, const otx_section_list *list,
    segment **out, int32_t *count)
{
    const otx_level *leaf = otx_surface_leaf(set->mapping->surface);
    const otx_plot *plot = &set->plots[k];
    int64_t corners = 0;

    for (int32_t slot = 0; slot < plot->chart->face_count; ++slot)
        corners += otx_level_face_size(leaf, plot->chart->faces[slot]);
    *out = OTX_NEW(set->run->scratch, segment, corners);
    *count = 0;
    if (!*out)
        return otx_fail_memory(set->run, "heal");
    for (int32_t slot = 0; slot < plot->chart->face_count; ++slot)
    {
        const int32_t face = plot->chart->faces[slot];
        const int32_t size = otx_level_face_size(leaf, face);

        for (int32_t i = 0; i < size; ++i)
        {
            const int32_t edge = leaf->face_edges[leaf->face_first[face] + i];

            if (list->of_edge[edge] >= 0)
            {
                (*out)[*count] = (segment){
                    list->of_edge[edge], *count, otx_plot_corner(plot, slot, i),
                    otx_plot_corner(plot, slot, (i + 1) % size)};
                ++*count;
            }
        }
    }
    qsort(*out, (size_t)*count, sizeof **out, compare);
    return OSDTEX_OK;
}

static int32_t
cell(double v, int32_t side)
{
    return v < 0.0 ? 0 : v > side ? side : (int32_t)v;
}

static double
distance_to(const segment *s, otx_vec2 p)
{
    const otx_vec2 d = otx_vec2_sub(s->b, s->a), from = otx_vec2_sub(p, s->a);
    const double square = otx_vec2_dot(d, d);
    double t = square > 0.0 ? otx_vec2_dot(from, d) / square : 0.0;

    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return otx_vec2_length(otx_vec2_sub(from, otx_vec2_scale(t, d)));
}

/* Marks the windows within reach of a segment; new ones are added.
 *
 *   marks  [windows] the last section that has counted each */
static void
add_segment(
    const segment *s, const otx_judged *j, double reach, int32_t *marks,
    otx_section_sum *sum)
{
    const double sx = j->step_x, sy = j->step_y;
    const int32_t x0 = cell((fmin(s->a.x, s->b.x) - reach) / sx, j->width);
    const int32_t x1 =
        cell((fmax(s->a.x, s->b.x) + reach) / sx + 1.0, j->width);
    const int32_t y0 = cell((fmin(s->a.y, s->b.y) - reach) / sy, j->height);
    const int32_t y1 =
        cell((fmax(s->a.y, s->b.y) + reach) / sy + 1.0, j->height);

    for (int32_t y = y0; y < y1; ++y)
        for (int32_t x = x0; x < x1; ++x)
        {
            const int64_t i = (int64_t)y * j->width + x;

            if (j->distances[i] < 0.0f || marks[i] == s->section ||
                distance_to(s, (otx_vec2){(x + 0.5) * sx, (y + 0.5) * sy}) >
                    reach)
                continue;
            marks[i] = s->section;
            sum->sum += j->distances[i];
            ++sum->count;
        }
}

/* Which windows are in reach of a section; -1 of none. */
static otx_status
mark_windows(
    const otx_target_set *set, int32_t k, const otx_judged *judged,
    const otx_section_list *list, double reach, otx_section_sum *sums,
    int32_t **out)
{
    const int64_t windows = (int64_t)judged->width * judged->height;
    otx_section_sum none = {0.0, 0};
    segment *segments;
    int32_t count;

    *out = OTX_NEW(set->run->scratch, int32_t, windows);
    if (!*out)
        return otx_fail_memory(set->run, "heal");
    memset(*out, 0xff, (size_t)windows * sizeof **out);
    OTX_TRY(list_segments(set, k, list, &segments, &count));
    for (int32_t i = 0; i < count; ++i)
        add_segment(
            &segments[i], judged, reach, *out,
            sums ? &sums[segments[i].section] : &none);
    return OSDTEX_OK;
}

otx_status
otx_section_measure(
    const otx_target_set *set, int32_t k, const otx_judged *judged,
    const otx_section_list *list, double reach, otx_section_sum *sums)
{
    const otx_arena_mark mark = otx_arena_here(set->run->scratch);
    int32_t *marks;
    const otx_status status =
        mark_windows(set, k, judged, list, reach, sums, &marks);

    otx_arena_release(set->run->scratch, mark);
    return status;
}

otx_status
otx_section_beyond(
    const otx_target_set *set, int32_t k, const otx_judged *judged,
    const otx_section_list *list, double reach, double *out, int64_t *count)
{
    const otx_arena_mark mark = otx_arena_here(set->run->scratch);
    const int64_t windows = (int64_t)judged->width * judged->height;
    int32_t *marks;
    const otx_status status =
        mark_windows(set, k, judged, list, reach, NULL, &marks);

    *count = 0;
    for (int64_t i = 0; !status && i < windows; ++i)
        if (marks[i] < 0 && judged->distances[i] >= 0.0f)
            out[(*count)++] = judged->distances[i];
    otx_arena_release(set->run->scratch, mark);
    return status;
}

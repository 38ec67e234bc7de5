/* laid_out.c -- charts once they are laid out. */
#include "method/lapped/lapped.h"

#include <string.h>

otx_lapped_facet
otx_lapped_facet_at(
    const otx_lapped *l, const otx_lapped_chart *chart, int32_t slot,
    int32_t index)
{
    const int32_t face = chart->faces[slot];
    const otx_facet facet = otx_facet_at(l->leaf, face, index);
    const int32_t shift = chart->first[slot] - l->leaf->face_first[face];
    const int32_t count = otx_samples_facet(&l->samples, face);
    const otx_vec2 o = chart->flat[chart->corners[facet.corners[0] + shift]];
    const otx_vec2 a = chart->flat[chart->corners[facet.corners[1] + shift]];
    const otx_vec2 b = chart->flat[chart->corners[facet.corners[2] + shift]];

    return (otx_lapped_facet){
        o,
        otx_vec2_sub(a, o),
        otx_vec2_sub(b, o),
        l->samples.lattice[l->samples.steps[face]],
        count,
        l->samples.first[face] + (int64_t)count * index};
}

/* How near a side comes to the middle. */
static double
side_distance(otx_vec2 a, otx_vec2 b)
{
    const otx_vec2 d = otx_vec2_sub(b, a);
    const double t = -otx_vec2_dot(a, d) / fmax(otx_vec2_dot(d, d), 1e-12);

    return otx_vec2_length(otx_vec2_lerp(a, b, fmin(fmax(t, 0.0), 1.0)));
}

/* Whether some of chart face i is nearer to the middle than `reach`. The middle
 * itself is in the seed's face. */
static bool
comes_within(const otx_lapped_chart *c, int32_t i, double reach)
{
    for (int32_t k = c->first[i]; k < c->first[i + 1]; ++k)
    {
        const int32_t next = k + 1 < c->first[i + 1] ? k + 1 : c->first[i];

        if (side_distance(c->flat[c->corners[k]], c->flat[c->corners[next]]) <
            reach)
            return true;
    }
    return false;
}

/* Leaves out the vertices of no face. */
static otx_status
drop_vertices(otx_arena *arena, otx_lapped_chart *c)
{
    int32_t *number = OTX_ZNEW(arena, int32_t, c->vert_count);
    int32_t count = 0;

    if (!number)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t k = 0; k < c->first[c->face_count]; ++k)
        number[c->corners[k]] = 1;
    for (int32_t v = 0; v < c->vert_count; ++v)
        if (number[v])
        {
            c->verts[count] = c->verts[v];
            c->flat[count] = c->flat[v];
            number[v] = count++;
        }
    for (int32_t k = 0; k < c->first[c->face_count]; ++k)
        c->corners[k] = number[c->corners[k]];
    c->vert_count = count;
    return OSDTEX_OK;
}

otx_status
otx_lapped_trim(otx_arena *arena, double reach, otx_lapped_chart *c)
{
    int32_t count = 0, end = 0;

    for (int32_t i = 0; i < c->face_count; ++i)
    {
        const int32_t first = c->first[i], size = c->first[i + 1] - first;

        if (i > 0 && !comes_within(c, i, reach))
            continue;
        memmove(
            c->corners + end, c->corners + first,
            (size_t)size * sizeof *c->corners);
        c->faces[count] = c->faces[i];
        c->rights[count] = c->rights[i];
        c->first[count++] = end;
        end += size;
    }
    c->face_count = count;
    c->first[count] = end;
    return drop_vertices(arena, c);
}

static void *
copy(otx_arena *arena, const void *from, int32_t count, size_t size)
{
    void *out = otx_arena_alloc(arena, (size_t)count, size);

    if (out && count > 0)
        memcpy(out, from, (size_t)count * size);
    return out;
}

otx_status
otx_lapped_keep(
    otx_arena *arena, const otx_lapped_chart *from, otx_lapped_chart *out)
{
    const int32_t faces = from->face_count, verts = from->vert_count;

    *out = (otx_lapped_chart){
        .face_count = faces,
        .vert_count = verts,
        .faces = copy(arena, from->faces, faces, sizeof *from->faces),
        .first = copy(arena, from->first, faces + 1, sizeof *from->first),
        .corners = copy(
            arena, from->corners, from->first[faces], sizeof *from->corners),
        .verts = copy(arena, from->verts, verts, sizeof *from->verts),
        .flat = copy(arena, from->flat, verts, sizeof *from->flat),
        .rights = copy(arena, from->rights, faces, sizeof *from->rights),
        .rim = copy(arena, from->rim, verts, sizeof *from->rim)};
    return otx_arena_failed(arena) ? OSDTEX_ERROR_MEMORY : OSDTEX_OK;
}

double
otx_lapped_alpha(const otx_lapped_paste *paste, otx_vec2 at)
{
    double alpha = 0.0;

    for (int32_t i = 0; i < paste->piece_count && alpha < 1.0; ++i)
    {
        const otx_lapped_piece *piece = &paste->pieces[i];

        alpha = fmax(
            alpha,
            otx_radial_alpha(piece->cut, otx_vec2_sub(at, piece->middle), 0.0));
    }
    return alpha;
}

/* assign.c -- labels of half-edges, chosen face by face. */
#include "method/tile/assign.h"
#include "base/random.h"

#include <string.h>

enum
{
    EDGE_STAGE = 0x7469a001,
    FACE_STAGE = 0x7469a002,
    VERT_STAGE = 0x7469a003,
    FREE_MAX = 2 * OTX_TILE_LAYOUT_MAX_BOUNDARIES,
    TRIES = 4,  /* names that are compared for a face: two sides may move */
    REPAIRS = 3 /* passes over equal neighbours, at most */
};

typedef struct assigner
{
    const otx_assign_input *input;
    uint64_t seed;
    int32_t types; /* of a side, 2 * boundaries */
    int32_t span;  /* types that a free side chooses from */
    int32_t step;  /* between them: 2 where the parity is given */
    /* Types that side i may take when it is free, the first once more behind
     * the last. */
    uint8_t free_types[4][FREE_MAX + 1];
    int32_t half; /* see otx_tile_layout_half */
    int32_t corners;
    bool exact;          /* few enough names for one bit each */
    uint8_t *edge_types; /* [edge_count] 1 + type that the first face sees,
                          * 0: not decided */
    uint64_t *vert_seen; /* [vert_count] bits of tiles around a vertex */
    uint32_t *uses;      /* [name count] */
    int32_t *suspects;   /* [face_count] faces that may equal a neighbour */
    int32_t suspect_count;
    int32_t weights[4];        /* of the sides in a tile's number */
    int32_t corner_weights[4]; /* of the corners */
    int32_t *names;
} assigner;

/* What is known of a face before its tile is chosen. */
typedef struct face_view
{
    int32_t verts[4]; /* from the tile's corner 0 on */
    int32_t edges[4];
    int32_t sides[4];      /* type, -1 not decided */
    int32_t corner_number; /* what the corners add to the tile's number */
} face_view;

/* Corner 0 fits any vertex; the others are whole windows, which fit where the
 * tiles agree. */
static inline int32_t
vert_corner(const assigner *a, int32_t vert)
{
    const uint64_t random =
        otx_random_bits(a->seed, VERT_STAGE, (uint64_t)vert) >> 40;

    if (!a->input->whole || !a->input->whole[vert])
        return 0;
    return 1 + (int32_t)(random * (uint64_t)(a->corners - 1) >> 24);
}

/* The bit of a name around a vertex. Where there are more than 64 names some
 * share one, and are avoided together. */
static inline uint64_t
bit_of(const assigner *a, int32_t number)
{
    const uint32_t n = (uint32_t)number;

    return (uint64_t)1 << (a->exact ? n : n * 0x9E3779B1u >> 26);
}

/* The type that the second face of an edge sees, -1 when there was no first. */
static inline int32_t
given_type(uint8_t stored)
{
    return stored == 0 ? -1 : ((int32_t)stored - 1) ^ 1;
}

static inline void
view_face(const assigner *a, int32_t face, face_view *f)
{
    const otx_level *level = a->input->level;
    const int32_t *verts = level->face_verts + 4 * (size_t)face;
    const int32_t *edges = level->face_edges + 4 * (size_t)face;
    const int32_t turns = a->input->turns ? a->input->turns[face] : 0;

    f->corner_number = 0;
    for (int32_t i = 0; i < 4; ++i)
    {
        const int32_t from = (i + turns) & 3;

        f->verts[i] = verts[from];
        f->edges[i] = edges[from];
        f->sides[i] = given_type(a->edge_types[edges[from]]);
        if (a->corners > 1)
            f->corner_number +=
                vert_corner(a, verts[from]) * a->corner_weights[i];
    }
}

/* The candidates of a face: types drawn for its free sides, of which the first
 * two may also be the next type. What stands behind them moves nothing. */
typedef struct candidates
{
    int32_t number;   /* with the types drawn */
    int32_t sides[4]; /* those types; given ones as they are */
    int32_t moved[4]; /* free sides, which may move */
    int32_t types[4]; /* to these types */
    int32_t steps[4]; /* by which the number changes then */
} candidates;

static inline void
draw(const assigner *a, uint64_t random, const face_view *f, candidates *out)
{
    int32_t slot = 0;

    out->number = f->corner_number;
    for (int32_t m = 0; m < 2; ++m)
        out->moved[m] = out->types[m] = out->steps[m] = 0;
    for (int32_t i = 0; i < 4; ++i)
    {
        const bool is_free = f->sides[i] < 0;
        const uint64_t d =
            (random >> (16 * i) & 0xffff) * (uint64_t)a->span >> 16;
        const int32_t type = a->free_types[i][d];
        const int32_t next = a->free_types[i][d + 1];

        out->sides[i] = is_free ? type : f->sides[i];
        out->number += out->sides[i] * a->weights[i];
        out->moved[slot] = i;
        out->types[slot] = next;
        out->steps[slot] = is_free ? (next - type) * a->weights[i] : 0;
        slot += is_free;
    }
}

/* The candidate that is not around any of the vertices and is used least; the
 * first of several. True when it is around one of them all the same. */
static inline bool
choose(const assigner *a, uint64_t seen, candidates *c)
{
    uint64_t best_score = UINT64_MAX;
    int32_t best = 0;

    for (int32_t k = 0; k < TRIES; ++k)
    {
        const int32_t number =
            c->number + (k & 1 ? c->steps[0] : 0) + (k & 2 ? c->steps[1] : 0);
        const uint64_t is_seen = (seen & bit_of(a, number)) != 0;
        const uint64_t score = a->uses[number] + (is_seen << 40);

        best = score < best_score ? k : best;
        best_score = score < best_score ? score : best_score;
    }
    for (int32_t m = 0; m < 2; ++m)
    {
        const bool moves = best >> m & 1;
        const int32_t side = c->moved[m];

        c->sides[side] = moves ? c->types[m] : c->sides[side];
        c->number += moves ? c->steps[m] : 0;
    }
    return best_score >> 40 != 0;
}

/* Names for all faces, spreading them. Faces that had to take a name that is
 * around them go to the list of suspects: of two equal neighbours, the later
 * one is on it. */
static void
spread(assigner *a)
{
    const otx_level *level = a->input->level;

    for (int32_t face = 0; face < level->face_count; ++face)
    {
        uint64_t seen = 0, bit;
        candidates c;
        face_view f;

        if (level->face_hole && level->face_hole[face])
        {
            a->names[face] = -1;
            continue;
        }
        view_face(a, face, &f);
        draw(a, otx_random_bits(a->seed, FACE_STAGE, (uint64_t)face), &f, &c);
        for (int32_t i = 0; i < 4; ++i)
            seen |= a->vert_seen[f.verts[i]];
        a->suspects[a->suspect_count] = face;
        a->suspect_count += choose(a, seen, &c);
        bit = bit_of(a, c.number);
        for (int32_t i = 0; i < 4; ++i)
        {
            if (f.sides[i] < 0)
                a->edge_types[f.edges[i]] = (uint8_t)(c.sides[i] + 1);
            a->vert_seen[f.verts[i]] |= bit;
        }
        ++a->uses[c.number];
        a->names[face] = c.number;
    }
}

/* Names for all faces, every edge at random: the face that comes first draws
 * for its side. */
static void
draw_all(assigner *a)
{
    const otx_level *level = a->input->level;

    for (int32_t face = 0; face < level->face_count; ++face)
    {
        face_view f;

        a->names[face] = -1;
        if (level->face_hole && level->face_hole[face])
            continue;
        view_face(a, face, &f);
        for (int32_t i = 0; i < 4; ++i)
        {
            const uint64_t random =
                otx_random_bits(a->seed, EDGE_STAGE, (uint64_t)f.edges[i]);

            if (f.sides[i] >= 0)
                continue;
            f.sides[i] =
                a->free_types[i][(random >> 40) * (uint64_t)a->span >> 24];
            a->edge_types[f.edges[i]] = (uint8_t)(f.sides[i] + 1);
        }
        a->names[face] = f.corner_number;
        for (int32_t i = 0; i < 4; ++i)
            a->names[face] += f.sides[i] * a->weights[i];
    }
}

/* --------------------------------------------------------------- repairs */

/* The face beyond an edge, -1 where there is none. */
static inline int32_t
neighbour(const otx_level *level, int32_t face, int32_t edge)
{
    const int32_t *faces = level->edge_faces + 2 * (size_t)edge;

    return faces[0] ^ faces[1] ^ face;
}

/* Whether `number` is that of a face across an edge, but for `but`. Without
 * branches: which neighbour is equal cannot be foreseen. */
static bool
is_beside(const assigner *a, int32_t face, int32_t number, int32_t but)
{
    const otx_level *level = a->input->level;

    bool found = false;

    for (int32_t i = 0; i < 4; ++i)
    {
        const int32_t other = neighbour(
            level, face, level->face_edges[4 * (size_t)face + (size_t)i]);
        const int32_t name = a->names[other < 0 ? face : other];

        found |= (other >= 0) & (other != but) & (name == number);
    }
    return found;
}

/* Side of the tile on `face` that lies on `edge`. */
static int32_t
side_on(const assigner *a, int32_t face, int32_t edge)
{
    const int32_t *edges = a->input->level->face_edges + 4 * (size_t)face;
    const int32_t turns = a->input->turns ? a->input->turns[face] : 0;
    int32_t i = 0;

    while (i < 3 && edges[i] != edge)
        ++i;
    return (i - turns) & 3;
}

/* Changes side `i` of `face` from type `old` to `type`, and the face beyond
 * with it; false where one of them would then equal a neighbour. */
static bool
change_side(assigner *a, int32_t face, int32_t i, int32_t old, int32_t type)
{
    const otx_level *level = a->input->level;
    const int32_t turns = a->input->turns ? a->input->turns[face] : 0;
    const int32_t edge =
        level->face_edges[4 * (size_t)face + (size_t)((i + turns) & 3)];
    const int32_t other = neighbour(level, face, edge);
    const int32_t mine = a->names[face] + (type - old) * a->weights[i];
    int32_t theirs = -1;

    if (other >= 0 && a->names[other] >= 0)
        theirs = a->names[other] +
                 ((type ^ 1) - (old ^ 1)) * a->weights[side_on(a, other, edge)];
    if (mine == theirs || is_beside(a, face, mine, other) ||
        (theirs >= 0 && is_beside(a, other, theirs, face)))
        return false;
    a->names[face] = mine;
    if (theirs >= 0)
        a->names[other] = theirs;
    return true;
}

/* Whether it came to differ from its neighbours. */
static bool
mend_face(assigner *a, int32_t face)
{
    const otx_tile_name name =
        otx_tile_layout_name(a->input->layout, a->names[face]);

    for (int32_t i = 0; i < 4; ++i)
        for (int32_t d = 0; d < a->span; ++d)
        {
            const int32_t type = a->free_types[i][d];

            if (type != name.sides[i] &&
                change_side(a, face, i, name.sides[i], type))
                return true;
        }
    return false;
}

/* No change makes two neighbours equal, so a face that differs from its own
 * stays so and leaves the list. */
static void
mend(assigner *a)
{
    for (int32_t pass = 0; pass < REPAIRS; ++pass)
    {
        int32_t left = 0;

        for (int32_t i = 0; i < a->suspect_count; ++i)
        {
            const int32_t face = a->suspects[i];

            a->suspects[left] = face;
            left +=
                is_beside(a, face, a->names[face], face) && !mend_face(a, face);
        }
        a->suspect_count = left;
    }
}

/* Type `draw` (0 .. span - 1) of a free side. */
static int32_t
free_type(const assigner *a, int32_t side, int32_t draw)
{
    int32_t type = draw;

    if (!a->input->layout->oriented)
        return type;
    if (a->step == 2)
        type = 2 * draw + (side >> 1);
    return side & 1 ? type + a->input->layout->boundaries : type;
}

static void
set_free_types(assigner *a)
{
    for (int32_t i = 0; i < 4; ++i)
        for (int32_t d = 0; d <= a->span; ++d)
            a->free_types[i][d] =
                (uint8_t)free_type(a, i, d == a->span ? 0 : d);
}

/* A tile's number is a sum over its sides and corners. */
static void
set_weights(assigner *a)
{
    const int32_t v = a->corners;

    for (int32_t i = 0; i < 4; ++i)
    {
        a->weights[i] = v * v * (i & 1 ? 1 : a->types) * (i > 1 ? a->half : 1);
        a->corner_weights[i] = (i & 1 ? 1 : v) * (i > 1 ? a->half : 1);
    }
}

otx_status
otx_assign_names(otx_run *run, const otx_assign_input *input, int32_t *names)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_tile_layout *layout = input->layout;
    const int32_t half = otx_tile_layout_half(layout);
    const bool parity = layout->oriented && input->upright;
    assigner a = {
        .input = input,
        .seed = run->seed,
        .types = otx_tile_layout_types(layout),
        .half = half,
        .corners = layout->corners,
        .exact = (int64_t)half * half <= 64,
        .edge_types = OTX_ZNEW(run->scratch, uint8_t, input->level->edge_count),
        .vert_seen = OTX_ZNEW(run->scratch, uint64_t, input->level->vert_count),
        .uses = OTX_ZNEW(run->scratch, uint32_t, (size_t)half * (size_t)half),
        .suspects = OTX_NEW(run->scratch, int32_t, input->level->face_count),
        .names = names,
    };

    OTX_TRY(otx_run_ok(run));
    a.span = layout->oriented ? layout->boundaries : a.types;
    a.step = parity ? 2 : 1;
    if (parity)
        a.span /= 2;
    set_free_types(&a);
    set_weights(&a);
    if (input->plain)
        draw_all(&a);
    else
    {
        spread(&a);
        mend(&a);
    }
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

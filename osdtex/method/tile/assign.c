/* assign.c -- labels of half-edges, chosen face by face. */
#include "method/tile/assign.h"
#include "base/random.h"

#include <string.h>

enum
{
    EDGE_STAGE = 0x7469a001,
    FACE_STAGE = 0x7469a002,
    VERT_STAGE = 0x7469a003,
    TRIES = 4,  /* names that are compared for a face */
    REPAIRS = 3 /* passes over equal neighbours, at most */
};

static const char STAGE[] = "map";

typedef struct assigner
{
    const otx_assign_input *input;
    uint64_t seed;
    int32_t types; /* of a side, 2 * boundaries */
    int32_t span;  /* types that a free side chooses from */
    int32_t step;  /* between them: 2 where the parity is given */
    int32_t half;  /* see otx_tile_layout_half */
    int32_t corners;
    bool exact;          /* few enough names for one bit each */
    uint8_t *edge_types; /* [edge_count] 1 + type that the first face sees,
                          * 0: not decided */
    uint64_t *vert_seen; /* [vert_count] bits of tiles around a vertex */
    uint32_t *uses;      /* [name count] */
    int32_t *names;
} assigner;

/* What is known of a face before its tile is chosen. */
typedef struct face_view
{
    int32_t verts[4]; /* from the tile's corner 0 on */
    int32_t edges[4];
    int32_t sides[4]; /* type, -1 not decided */
    int32_t corners[4];
} face_view;

static inline int32_t
vert_corner(const assigner *a, int32_t vert)
{
    if (a->corners == 1)
        return 0;
    return (int32_t)((otx_random_bits(a->seed, VERT_STAGE, (uint64_t)vert) >>
                      40) *
                         (uint64_t)a->corners >>
                     24);
}

static inline int32_t
number_of(const assigner *a, const int32_t *s, const int32_t *c)
{
    const int32_t v = a->corners;
    const int32_t column = ((s[0] * a->types + s[1]) * v + c[0]) * v + c[1];
    const int32_t row = ((s[2] * a->types + s[3]) * v + c[2]) * v + c[3];

    return column + row * a->half;
}

/* The bit of a name around a vertex. Where there are more than 64 names some
 * share one, and are avoided together. */
static inline uint64_t
bit_of(const assigner *a, int32_t number)
{
    const uint32_t n = (uint32_t)number;

    return (uint64_t)1 << (a->exact ? n : n * 0x9E3779B1u >> 26);
}

static inline void
view_face(const assigner *a, int32_t face, face_view *f)
{
    const otx_level *level = a->input->level;
    const int32_t *verts = level->face_verts + 4 * (size_t)face;
    const int32_t *edges = level->face_edges + 4 * (size_t)face;
    const int32_t turns = a->input->turns ? a->input->turns[face] : 0;

    for (int32_t i = 0; i < 4; ++i)
    {
        const int32_t from = (i + turns) & 3;

        f->verts[i] = verts[from];
        f->edges[i] = edges[from];
        f->sides[i] = ((int32_t)a->edge_types[edges[from]] - 1) ^ 1;
        if (a->edge_types[edges[from]] == 0)
            f->sides[i] = -1;
        f->corners[i] = vert_corner(a, verts[from]);
    }
}

/* Type `draw` (0 .. span - 1) of a free side. */
static inline int32_t
free_type(const assigner *a, int32_t side, int32_t draw)
{
    int32_t type = draw;

    if (!a->input->layout->oriented)
        return type;
    if (a->step == 2)
        type = 2 * draw + (side >> 1);
    return side & 1 ? type + a->input->layout->boundaries : type;
}

/* Fills the free sides for the `k`th of TRIES candidates: the draws of the
 * face, of which some are moved on by one. */
static inline void
complete(
    const assigner *a, uint64_t random, int32_t k, const face_view *f,
    int32_t sides[4])
{
    int32_t bit = 0;

    for (int32_t i = 0; i < 4; ++i)
    {
        int32_t draw;

        sides[i] = f->sides[i];
        if (sides[i] >= 0)
            continue;
        draw =
            (int32_t)((random >> (16 * i) & 0xffff) * (uint64_t)a->span >> 16) +
            (k >> bit++ & 1);
        sides[i] = free_type(a, i, draw >= a->span ? draw - a->span : draw);
    }
}

/* The candidate that is not around any of the vertices and is used least. */
static inline int32_t
choose(const assigner *a, uint64_t random, const face_view *f, int32_t sides[4])
{
    uint64_t seen = 0, best_score = UINT64_MAX;
    int32_t best = 0;

    for (int32_t i = 0; i < 4; ++i)
        seen |= a->vert_seen[f->verts[i]];
    for (int32_t k = 0; k < TRIES; ++k)
    {
        int32_t tried[4], number;
        uint64_t score;

        complete(a, random, k, f, tried);
        number = number_of(a, tried, f->corners);
        score = a->uses[number] +
                ((seen & bit_of(a, number)) ? (uint64_t)1 << 40 : 0);
        if (score < best_score)
        {
            best_score = score;
            best = number;
            memcpy(sides, tried, sizeof tried);
        }
    }
    return best;
}

/* Names for all faces, spreading them. */
static void
spread(assigner *a)
{
    const otx_level *level = a->input->level;

    for (int32_t face = 0; face < level->face_count; ++face)
    {
        const uint64_t random =
            otx_random_bits(a->seed, FACE_STAGE, (uint64_t)face);
        int32_t sides[4], number;
        uint64_t bit;
        face_view f;

        if (level->face_hole && level->face_hole[face])
        {
            a->names[face] = -1;
            continue;
        }
        view_face(a, face, &f);
        number = choose(a, random, &f, sides);
        bit = bit_of(a, number);
        for (int32_t i = 0; i < 4; ++i)
        {
            if (f.sides[i] < 0)
                a->edge_types[f.edges[i]] = (uint8_t)(sides[i] + 1);
            a->vert_seen[f.verts[i]] |= bit;
        }
        ++a->uses[number];
        a->names[face] = number;
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
            f.sides[i] = free_type(
                a, i, (int32_t)((random >> 40) * (uint64_t)a->span >> 24));
            a->edge_types[f.edges[i]] = (uint8_t)(f.sides[i] + 1);
        }
        a->names[face] = number_of(a, f.sides, f.corners);
    }
}

/* --------------------------------------------------------------- repairs */

static inline int32_t
neighbour(const otx_level *level, int32_t face, int32_t edge)
{
    const int32_t *faces = level->edge_faces + 2 * (size_t)edge;

    return faces[0] == face ? faces[1] : faces[0];
}

/* Whether `number` is that of a face across an edge, but for `but`. */
static bool
is_beside(const assigner *a, int32_t face, int32_t number, int32_t but)
{
    const otx_level *level = a->input->level;

    for (int32_t i = 0; i < 4; ++i)
    {
        const int32_t other = neighbour(
            level, face, level->face_edges[4 * (size_t)face + (size_t)i]);

        if (other >= 0 && other != but && a->names[other] == number)
            return true;
    }
    return false;
}

/* The name of `face` when its side on `edge` becomes `type`. */
static int32_t
renamed(const assigner *a, int32_t face, int32_t edge, int32_t type)
{
    otx_tile_name name = otx_tile_layout_name(a->input->layout, a->names[face]);
    const int32_t turns = a->input->turns ? a->input->turns[face] : 0;

    for (int32_t i = 0; i < 4; ++i)
        if (a->input->level
                ->face_edges[4 * (size_t)face + (size_t)((i + turns) & 3)] ==
            edge)
            name.sides[i] = type;
    return number_of(a, name.sides, name.corners);
}

/* Tries another type on side `i` of `face`; true when neither it nor the face
 * beyond then equals a neighbour. */
static bool
change_side(assigner *a, int32_t face, int32_t i, int32_t draw)
{
    const otx_level *level = a->input->level;
    const int32_t turns = a->input->turns ? a->input->turns[face] : 0;
    const int32_t edge =
        level->face_edges[4 * (size_t)face + (size_t)((i + turns) & 3)];
    const int32_t other = neighbour(level, face, edge);
    const int32_t type = free_type(a, i, draw);
    const int32_t mine = renamed(a, face, edge, type);
    const int32_t theirs = other >= 0 && other != face && a->names[other] >= 0
                               ? renamed(a, other, edge, type ^ 1)
                               : -1;

    if (other == face || mine == theirs || is_beside(a, face, mine, other) ||
        (theirs >= 0 && is_beside(a, other, theirs, face)))
        return false;
    a->names[face] = mine;
    if (theirs >= 0)
        a->names[other] = theirs;
    return true;
}

static void
mend_face(assigner *a, int32_t face)
{
    for (int32_t i = 0; i < 4; ++i)
        for (int32_t draw = 0; draw < a->span; ++draw)
            if (change_side(a, face, i, draw))
                return;
}

static void
mend(assigner *a)
{
    const int32_t count = a->input->level->face_count;
    bool found = true;

    for (int32_t pass = 0; pass < REPAIRS && found; ++pass)
    {
        found = false;
        for (int32_t face = 0; face < count; ++face)
            if (a->names[face] >= 0 && is_beside(a, face, a->names[face], face))
            {
                found = true;
                mend_face(a, face);
            }
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
        .names = names,
    };

    if (!a.edge_types || !a.vert_seen || !a.uses)
        return otx_fail_memory(run, STAGE);
    a.span = layout->oriented ? layout->boundaries : a.types;
    a.step = parity ? 2 : 1;
    if (parity)
        a.span /= 2;
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

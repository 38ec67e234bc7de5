/* model_layers.c -- faces of a model that lie over others. */
#include "api/model_layers.h"

#include <string.h>

/* Faces by their corners. */
typedef struct table
{
    int32_t size;   /* a power of two */
    int32_t *faces; /* -1 free */
} table;

typedef struct folding
{
    otx_run *run;
    const otx_scene *from;
    const uint8_t *over;
    int32_t *below;  /* [face_count] the face that it lies over; -1 none */
    int32_t *layers; /* [face_count] how many lie over it */
    int32_t folded;  /* faces that lie over another */
} folding;

/* ---- which lies over which ---- */

static int32_t
size_of(const otx_scene *scene, int32_t face)
{
    return scene->face_first[face + 1] - scene->face_first[face];
}

static uint32_t
hash_of(const otx_scene *scene, int32_t face)
{
    uint32_t hash = 2166136261u;

    for (int32_t c = scene->face_first[face]; c < scene->face_first[face + 1];
         ++c)
        hash = (hash ^ (uint32_t)scene->face_verts[c]) * 16777619u;
    return hash ^ hash >> 15;
}

static bool
same_corners(const otx_scene *scene, int32_t a, int32_t b)
{
    return size_of(scene, a) == size_of(scene, b) &&
           memcmp(
               scene->face_verts + scene->face_first[a],
               scene->face_verts + scene->face_first[b],
               (size_t)size_of(scene, a) * sizeof *scene->face_verts) == 0;
}

/* The place of the face with these corners, or where it would be. */
static int32_t *
find(const table *t, const otx_scene *scene, int32_t face)
{
    uint32_t at = hash_of(scene, face) & (uint32_t)(t->size - 1);

    while (t->faces[at] >= 0 && !same_corners(scene, t->faces[at], face))
        at = (at + 1) & (uint32_t)(t->size - 1);
    return &t->faces[at];
}

static otx_status
find_layers(folding *f)
{
    const otx_scene *scene = f->from;
    table t = {4, NULL};

    while (t.size < 2 * (int64_t)scene->face_count && t.size < 1 << 30)
        t.size *= 2;
    t.faces = OTX_NEW(f->run->scratch, int32_t, t.size);
    f->below = OTX_NEW(f->run->scratch, int32_t, scene->face_count);
    f->layers = OTX_ZNEW(f->run->scratch, int32_t, scene->face_count);
    OTX_TRY(otx_run_ok(f->run));
    memset(t.faces, -1, (size_t)t.size * sizeof *t.faces);
    for (int32_t face = 0; face < scene->face_count; ++face)
    {
        int32_t *place;

        f->below[face] = -1;
        if (scene->face_texture[face] < 0)
            continue;
        place = find(&t, scene, face);
        if (*place < 0 && !f->over[face])
            *place = face;
        else if (*place >= 0 && f->over[face])
        {
            f->below[face] = *place;
            ++f->layers[*place];
            ++f->folded;
        }
    }
    return OSDTEX_OK;
}

/* ---- the scene without them ---- */

/* Arrays of the faces that stay. */
typedef struct kept_faces
{
    int32_t face_count, corner_count;
    int32_t *first, *verts, *textures;
    float *uvs;
    uint8_t *holes;  /* NULL none */
    int32_t *number; /* [face_count of before] -1: it lies over another */
} kept_faces;

static otx_status
allocate(const folding *f, kept_faces *k)
{
    const otx_scene *s = f->from;
    otx_arena *arena = f->run->arena;
    const int32_t faces = s->face_count - f->folded;

    k->first = OTX_ZNEW(arena, int32_t, (size_t)faces + 1);
    k->verts = OTX_NEW(arena, int32_t, s->corner_count);
    k->uvs = OTX_NEW(arena, float, 2 * (size_t)s->corner_count);
    k->textures = OTX_NEW(arena, int32_t, faces);
    k->holes = s->face_hole ? OTX_NEW(arena, uint8_t, faces) : NULL;
    k->number = OTX_NEW(f->run->scratch, int32_t, s->face_count);
    return otx_run_ok(f->run);
}

static void
keep_face(const otx_scene *s, int32_t face, kept_faces *k)
{
    const int32_t from = s->face_first[face], size = size_of(s, face);

    memcpy(
        k->verts + k->corner_count, s->face_verts + from,
        (size_t)size * sizeof *k->verts);
    memcpy(
        k->uvs + 2 * (size_t)k->corner_count, s->uvs + 2 * (size_t)from,
        2 * (size_t)size * sizeof *k->uvs);
    k->textures[k->face_count] = s->face_texture[face];
    if (k->holes)
        k->holes[k->face_count] = s->face_hole[face];
    k->corner_count += size;
    k->number[face] = k->face_count++;
    k->first[k->face_count] = k->corner_count;
}

static otx_status
keep_faces(const folding *f, kept_faces *k)
{
    *k = (kept_faces){0};
    OTX_TRY(allocate(f, k));
    for (int32_t face = 0; face < f->from->face_count; ++face)
    {
        k->number[face] = -1;
        if (f->below[face] < 0)
            keep_face(f->from, face, k);
    }
    return OSDTEX_OK;
}

/* ---- lookups ---- */

static void
put_lookup(
    const otx_scene *s, int32_t face, int32_t fragment, otx_lookup *items)
{
    for (int32_t k = 0; k < size_of(s, face); ++k)
    {
        const float *uv = s->uvs + 2 * (size_t)(s->face_first[face] + k);

        items[k] = (otx_lookup){{uv[0], uv[1]}, 1.0f, fragment};
    }
}

/* Fragment i is all of texture i. */
static otx_status
put_fragments(otx_run *run, int32_t count, otx_lookups *lookups)
{
    otx_fragment *list = OTX_ZNEW(run->arena, otx_fragment, count);

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count; ++i)
        list[i] = (otx_fragment){.exemplar = i, .patch = -1};
    lookups->fragment_count = count;
    lookups->fragments = list;
    lookups->layering = OTX_LAYERING_OVER;
    return OSDTEX_OK;
}

static otx_status
make_lookups(const folding *f, const kept_faces *k, otx_scene *scene)
{
    const otx_scene *s = f->from;
    otx_arena *arena = f->run->arena;
    otx_lookups *lookups = OTX_ZNEW(arena, otx_lookups, 1);
    int64_t *first = OTX_ZNEW(arena, int64_t, (size_t)k->face_count + 1);
    int64_t *at = OTX_NEW(f->run->scratch, int64_t, s->face_count);
    otx_lookup *items;

    OTX_TRY(otx_run_ok(f->run));
    for (int32_t face = 0; face < s->face_count; ++face)
        if (k->number[face] >= 0)
        {
            const int32_t i = k->number[face];

            at[face] = first[i];
            first[i + 1] =
                first[i] + (f->layers[face] > 0 ? (f->layers[face] + 1) *
                                                      (int64_t)size_of(s, face)
                                                : 0);
        }
    items = OTX_NEW(arena, otx_lookup, first[k->face_count]);
    OTX_TRY(otx_run_ok(f->run));
    for (int32_t face = 0; face < s->face_count; ++face)
    {
        const int32_t base = f->below[face] < 0 ? face : f->below[face];

        if (f->layers[base] == 0)
            continue;
        put_lookup(
            s, face, base == face ? -1 : s->face_texture[face],
            items + at[base]);
        at[base] += size_of(s, face);
    }
    lookups->first = first;
    lookups->items = items;
    scene->lookups = lookups;
    return put_fragments(f->run, s->texture_count, lookups);
}

/* Alpha beside what has none; grey becomes colour. */
static otx_status
widen(otx_run *run, otx_image *image)
{
    const otx_image from = *image;
    const size_t count = (size_t)from.width * (size_t)from.height;

    if (from.channels == 4)
        return OSDTEX_OK;
    OTX_TRY(
        otx_image_create(run, run->arena, from.width, from.height, 4, image));
    for (size_t i = 0; i < count; ++i)
    {
        const float *texel = from.pixels + i * (size_t)from.channels;

        for (int c = 0; c < 3; ++c)
            image->pixels[4 * i + (size_t)c] = texel[from.channels < 3 ? 0 : c];
        image->pixels[4 * i + 3] = from.channels == 2 ? texel[1] : 1.0f;
    }
    return OSDTEX_OK;
}

otx_status
otx_model_layers_fold(
    otx_run *run, const uint8_t *over, otx_scene_texture *textures,
    otx_scene *scene)
{
    const otx_scene before = *scene;
    folding f = {.run = run, .from = &before, .over = over};
    kept_faces k;

    OTX_TRY(find_layers(&f));
    if (f.folded == 0)
        return OSDTEX_OK;
    OTX_TRY(keep_faces(&f, &k));
    OTX_TRY(make_lookups(&f, &k, scene));
    scene->face_count = k.face_count;
    scene->corner_count = k.corner_count;
    scene->face_first = k.first;
    scene->face_verts = k.verts;
    scene->uvs = k.uvs;
    scene->face_texture = k.textures;
    scene->face_hole = k.holes;
    for (int32_t t = 0; t < scene->texture_count; ++t)
        OTX_TRY(widen(run, &textures[t].image));
    return OSDTEX_OK;
}

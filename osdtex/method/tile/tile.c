/* tile.c -- settings, the level of the tiles, and UVs on the leaves. */
#include "method/tile/tile.h"
#include "method/tile/assign.h"
#include "method/tile/orient.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIELD(member) offsetof(otx_tile_settings, member)

static const char STAGE[] = "map";

static const char *const RULES[] = {"spread", "plain", NULL};
static const char *const DIRECTIONS[] = {"loops", "x", "y", "z", NULL};

static const otx_option OPTIONS[] = {
    {"level", OTX_OPTION_INTEGER, FIELD(level), -1, OTX_LEVEL_MAX, -1, NULL,
     "Subdivision level whose quads get one tile each; -1 chooses by the "
     "scale"},
    {"rule", OTX_OPTION_CHOICE, FIELD(rule), 0, 0, OTX_TILE_SPREAD, RULES,
     "spread: no tile beside the same one, all used alike; plain: every edge "
     "at random, as published"},
    {"direction", OTX_OPTION_CHOICE, FIELD(direction), 0, 0, OTX_TILE_LOOPS,
     DIRECTIONS,
     "Oriented tiles: rows follow the edge loops, or columns rise along an "
     "axis"},
    {"half_turns", OTX_OPTION_SWITCH, FIELD(half_turns), 0, 1, 1, NULL,
     "Oriented tiles: edges may also be seen upside down, which gives more "
     "tiles to choose from"},
};

enum
{
    OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0]
};

/* ------------------------------------------------------------- the level */

static bool
has_quads_only(const otx_level *level)
{
    for (int32_t f = 0; f < level->face_count; ++f)
        if (otx_level_face_size(level, f) != 4)
            return false;
    return true;
}

/* The first level without faces that are no quads; -1 none. */
static int32_t
first_quad_level(const otx_surface *surface)
{
    for (int32_t l = 0; l < surface->level_count; ++l)
        if (has_quads_only(&surface->levels[l]))
            return l;
    return -1;
}

static otx_status
quad_level(otx_run *run, const otx_surface *surface, int32_t *out)
{
    const otx_cage *cage = surface->cage;
    const otx_where where = {cage->path, 0, -1, -1};

    *out = first_quad_level(surface);
    if (*out >= 0)
        return OSDTEX_OK;
    if (cage->scheme == OTX_SCHEME_CATMARK ||
        cage->scheme == OTX_SCHEME_BILINEAR)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
            "the cage has faces that are no quads; one subdivision step makes "
            "quads of them: give {level} 1 or more");
    return otx_fail(
        run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
        "tiles need quads, and this surface has faces that are none; subdivide "
        "it with {scheme} catmark, or with bilinear, which keeps its shape, or "
        "use another method");
}

static double
mean_edge(const otx_surface *surface, int32_t level)
{
    const otx_level *l = &surface->levels[level];
    double sum = 0.0;

    for (int32_t e = 0; e < l->edge_count; ++e)
        sum += otx_vec3_length(otx_vec3_sub(
            otx_vec3_load(surface->points, l->edge_verts[2 * (size_t)e]),
            otx_vec3_load(surface->points, l->edge_verts[2 * (size_t)e + 1])));
    return l->edge_count > 0 ? sum / l->edge_count : 0.0;
}

otx_status
otx_tile_level(
    otx_run *run, const otx_surface *surface, const otx_tile_layout *layout,
    const otx_tile_settings *settings, double scale, int32_t *out)
{
    const double wanted =
        scale * otx_tile_layout_side(layout) / layout->source_width;
    double best = INFINITY;
    int32_t first;

    OTX_TRY(quad_level(run, surface, &first));
    if (settings->level >= surface->level_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "tiles at level %d need a surface that is subdivided as often, and "
            "it has levels 0 to %d; give {level}",
            (int)settings->level, (int)surface->level_count - 1);
    if (settings->level >= 0 && settings->level < first)
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE,
            otx_where_file(surface->cage->path),
            "level %d has faces that are no quads; lay the tiles at level %d "
            "or finer",
            (int)settings->level, (int)first);
    *out = settings->level;
    if (settings->level >= 0)
        return OSDTEX_OK;
    for (int32_t level = first; level < surface->level_count; ++level)
    {
        const double off = fabs(log(mean_edge(surface, level) / wanted));

        if (off < best)
        {
            best = off;
            *out = level;
        }
    }
    otx_note(
        run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
        "tiles are laid at level %d, whose edges of %g scene units are nearest "
        "to the tiles' %g",
        (int)*out, mean_edge(surface, *out), wanted);
    return OSDTEX_OK;
}

/* ----------------------------------------------------------- assignment */

/* Turns for pictures that have a direction, and for corners that are whole. */
static otx_status
orient(
    otx_run *run, const otx_surface *surface, int32_t level,
    const otx_tile_layout *layout, const otx_tile_settings *settings,
    uint8_t *turns)
{
    if (!layout->oriented)
        return layout->corners > 1
                   ? otx_orient_walk(run, &surface->levels[level], turns)
                   : OSDTEX_OK;
    if (settings->direction == OTX_TILE_LOOPS)
        return otx_orient_loops(run, surface, level, turns);
    return otx_orient_axis(
        run, surface, level, settings->direction - OTX_TILE_ALONG_X, turns);
}

otx_status
otx_tile_assign(
    otx_run *run, const otx_surface *surface, int32_t level,
    const otx_tile_layout *layout, const otx_tile_settings *settings,
    int32_t **names, uint8_t **turns)
{
    const otx_level *l = &surface->levels[level];
    otx_assign_input input = {
        .level = l,
        .layout = layout,
        .plain = settings->rule == OTX_TILE_PLAIN,
        .upright = settings->half_turns == 0,
    };
    uint8_t *whole;

    *names = OTX_NEW(run->arena, int32_t, l->face_count);
    *turns = OTX_ZNEW(run->arena, uint8_t, l->face_count);
    OTX_TRY(otx_run_ok(run));
    if (layout->oriented || layout->corners > 1)
        input.turns = *turns;
    OTX_TRY(orient(run, surface, level, layout, settings, *turns));
    if (layout->corners > 1)
    {
        input.whole = whole = OTX_NEW(run->scratch, uint8_t, l->vert_count);
        OTX_TRY(otx_run_ok(run));
        otx_orient_find_whole(l, *turns, whole);
    }
    return otx_assign_names(run, &input, *names);
}

/* ------------------------------------------------------------------ UVs */

/* Where the corners of a level's faces lie in their tile, in units of its
 * side, and which face has the tile. */
typedef struct placing
{
    const otx_level *level;
    otx_vec2 *places; /* [corner_count] */
    int32_t *owners;  /* [face_count] */
} placing;

static const otx_vec2 UNIT[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

static otx_status
place_quads(
    otx_run *run, const otx_level *level, const uint8_t *turns, placing *out)
{
    *out = (placing){
        level, OTX_NEW(run->scratch, otx_vec2, level->corner_count),
        OTX_NEW(run->scratch, int32_t, level->face_count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        out->owners[f] = f;
        for (int32_t i = 0; i < 4; ++i)
            out->places[4 * (size_t)f + (size_t)((i + turns[f]) & 3)] = UNIT[i];
    }
    return OSDTEX_OK;
}

/* Where vertex `vert` of the next level lies in `face`. */
static otx_vec2
place_of(const placing *p, int32_t face, int32_t vert)
{
    const size_t first = 4 * (size_t)face;
    const otx_vec2 *q = p->places + first;

    for (int32_t i = 0; i < 4; ++i)
    {
        if (p->level->face_verts[first + (size_t)i] == vert)
            return q[i];
        if (p->level
                ->edge_child_vert[p->level->face_edges[first + (size_t)i]] ==
            vert)
            return otx_vec2_lerp(q[i], q[(i + 1) & 3], 0.5);
    }
    return otx_vec2_lerp(q[0], q[2], 0.5);
}

/* Carries places to the next level: linear inside a tile. */
static otx_status
place_children(
    otx_run *run, const placing *parent, const otx_level *level, placing *out)
{
    *out = (placing){
        level, OTX_NEW(run->scratch, otx_vec2, level->corner_count),
        OTX_NEW(run->scratch, int32_t, level->face_count)};
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const int32_t from = level->face_parent[f];

        out->owners[f] = parent->owners[from];
        for (size_t c = 4 * (size_t)f; c < 4 * (size_t)f + 4; ++c)
            out->places[c] = place_of(parent, from, level->face_verts[c]);
    }
    return OSDTEX_OK;
}

static otx_status
missing_tile(otx_run *run, const otx_exemplar *exemplar, int32_t face)
{
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE,
        (otx_where){exemplar->source_path, 0, face, -1},
        "the tiled texture was made for another mesh, level, seed or setting "
        "and lacks a tile that is needed here; make it again with {for}");
}

/* UVs of the leaves from their places in the tiles `names`. */
static otx_status
write_uvs(
    otx_run *run, const otx_exemplar *exemplar, const placing *leaves,
    const int32_t *names, otx_mapping *out)
{
    const otx_tile_layout *layout = &exemplar->tiles;
    const double side = otx_tile_layout_side(layout);
    const double u = 1.0 / exemplar->linear.width;
    const double v = 1.0 / exemplar->linear.height;

    for (int32_t f = 0; f < leaves->level->face_count; ++f)
    {
        const int32_t owner = leaves->owners[f];
        float *uv = out->uvs + 8 * (size_t)f;
        int32_t cell, x, y;

        out->face_patch[f] = names[owner] >= 0 ? owner : -1;
        if (names[owner] < 0)
        {
            memset(uv, 0, 8 * sizeof *uv);
            continue;
        }
        cell = otx_tile_layout_cell(layout, names[owner]);
        if (cell < 0)
            return missing_tile(run, exemplar, owner);
        otx_tile_layout_origin(layout, cell, &x, &y);
        for (size_t i = 0; i < 4; ++i)
        {
            const otx_vec2 p = leaves->places[4 * (size_t)f + i];

            uv[2 * i] = (float)((x + layout->gutter + side * p.x) * u);
            uv[2 * i + 1] = (float)((y + layout->gutter + side * p.y) * v);
        }
    }
    return OSDTEX_OK;
}

static otx_status
place_all(
    otx_run *run, const otx_exemplar *exemplar, const otx_surface *surface,
    int32_t level, const int32_t *names, const uint8_t *turns, otx_mapping *out)
{
    placing places;

    OTX_TRY(place_quads(run, &surface->levels[level], turns, &places));
    for (int32_t k = level + 1; k < surface->level_count; ++k)
    {
        placing next;

        OTX_TRY(place_children(run, &places, &surface->levels[k], &next));
        places = next;
    }
    return write_uvs(run, exemplar, &places, names, out);
}

static otx_status
tiles(
    const otx_job *job, const otx_tile_layout *layout, int32_t **names,
    int32_t *count)
{
    int32_t level;
    uint8_t *turns;

    OTX_TRY(otx_tile_level(
        job->run, job->surface, layout, job->settings, job->request->scale,
        &level));
    *count = job->surface->levels[level].face_count;
    return otx_tile_assign(
        job->run, job->surface, level, layout, job->settings, names, &turns);
}

static void
report(otx_figures *figures, const otx_surface *surface, int32_t level)
{
    for (int32_t l = 0; l < surface->level_count; ++l)
        otx_figures_item(
            figures, "patches_by_level", "patches",
            l == level ? surface->levels[l].face_count : 0);
}

static otx_status
map(const otx_job *job, otx_mapping *out)
{
    otx_run *run = job->run;
    const otx_surface *surface = job->surface;
    const otx_exemplar *exemplar = job->exemplars;
    const otx_level *leaf = otx_surface_leaf(surface);
    const otx_tile_layout *layout = &exemplar->tiles;
    int32_t level, *names;
    uint8_t *turns;

    if (layout->cell == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE,
            otx_where_file(exemplar->source_path),
            "this method needs a tiled texture; make one from the picture with "
            "osdtex tiles");
    OTX_TRY(otx_tile_level(
        run, surface, layout, job->settings, job->request->scale, &level));
    *out = (otx_mapping){
        .surface = surface,
        .scale = mean_edge(surface, level) * exemplar->linear.width /
                 otx_tile_layout_side(layout),
        .uvs = OTX_NEW(run->arena, float, 2 * (size_t)leaf->corner_count),
        .face_patch = OTX_NEW(run->arena, int32_t, leaf->face_count),
        .patch_count = surface->levels[level].face_count,
    };
    OTX_TRY(otx_run_ok(run));
    otx_figures_stage(job->figures, "assign");
    OTX_TRY(otx_tile_assign(
        run, surface, level, layout, job->settings, &names, &turns));
    report(job->figures, surface, level);
    otx_figures_stage(job->figures, "place");
    return place_all(run, exemplar, surface, level, names, turns, out);
}

/* A tiled texture is for nothing else, where there are quads. */
static otx_status
applicable(const otx_job *job, otx_suitability *out)
{
    if (job->exemplars->tiles.cell == 0)
        return OSDTEX_OK;
    out->score = first_quad_level(job->surface) >= 0 ? 1.0 : 0.0;
    snprintf(
        out->why, sizeof out->why, "the exemplar is a tiled texture%s",
        out->score > 0.0
            ? ""
            : ", but the surface has faces that are no quads at every level");
    return OSDTEX_OK;
}

extern const otx_method otx_method_tile;

const otx_method otx_method_tile = {
    .name = "tile",
    .summary = "Lays one tile of a tiled texture on every quad; the tiles meet "
               "exactly, and another tiled texture fits the same UVs.",
    .source = "Akleman et al.: seamless texturing of quadrilateral meshes with "
              "tiled textures",
    .options = OPTIONS,
    .option_count = OPTION_COUNT,
    .settings_bytes = sizeof(otx_tile_settings),
    .applicable = applicable,
    .map = map,
    .tiles = tiles,
};

/* tileset.c -- from options to a picture of tiles. */
#include "tiling/tileset.h"
#include "tiling/ramp.h"
#include "tiling/template.h"
#include "tiling/tile_maps.h"
#include "tiling/vertex_check.h"

#include <math.h>
#include <string.h>

enum
{
    DEFAULT_CELL = 128,
    PIECE = 8,  /* tiles between two looks at the clock */
    PATCH = 24, /* texels on a side of the patches that mend seams */
    LOOK = 16,  /* of the windows that are looked up in the exemplar */
    SPARE = 6,  /* texels that whole corners have beyond the core */
    RAY = 2     /* texels beside a ray that a corner keeps, see corner.c */
};

static const char STAGE[] = "tiles";

static bool
is_power_of_two(int32_t value)
{
    return value > 0 && (value & (value - 1)) == 0;
}

otx_strip_sizes
otx_tileset_sizes(const otx_tile_layout *layout)
{
    const int32_t side = otx_tile_layout_side(layout);
    const int32_t core = layout->gutter + RAY;
    const bool whole = layout->corners > 1 && side >= 8 * SPARE;
    const int32_t most = side / 20, reach = side / 4;
    const int32_t sew = core + (whole && most < SPARE ? SPARE : most);

    return (otx_strip_sizes){
        .side = side,
        .gutter = layout->gutter,
        .core = core,
        .hold = whole ? core + SPARE / 2 : core,
        .sew = sew,
        .reach = reach > sew ? reach : sew,
    };
}

static otx_status
check_options(otx_run *run, const otx_tileset_options *o)
{
    if (o->boundaries < 1 || o->boundaries > 3)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a tiled texture has 1, 2 or 3 boundaries, not %d",
            (int)o->boundaries);
    if (o->corners < 1 || o->corners > OTX_TILE_LAYOUT_MAX_CORNERS)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a tiled texture has 1 to %d kinds of corners, not %d",
            (int)OTX_TILE_LAYOUT_MAX_CORNERS, (int)o->corners);
    if (o->cell != 0 &&
        (!is_power_of_two(o->cell) || o->cell < OTX_TILE_LAYOUT_MIN_CELL ||
         o->cell > OTX_TILE_LAYOUT_MAX_CELL))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the tile size is a power of two from %d to %d texels, not %d",
            (int)OTX_TILE_LAYOUT_MIN_CELL, (int)OTX_TILE_LAYOUT_MAX_CELL,
            (int)o->cell);
    if (!is_power_of_two(o->gutter))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the gutter is a power of two of texels, such as 4, not %d",
            (int)o->gutter);
    if (o->edge_count > o->boundaries * (o->oriented ? 2 : 1))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "there are %d edge templates for %d boundaries; give one for each "
            "at most",
            (int)o->edge_count, (int)o->boundaries * (o->oriented ? 2 : 1));
    return OSDTEX_OK;
}

/* The largest cell up to the usual one of which one and a half fit into the
 * picture, so that there is something to choose. */
static int32_t
default_cell(const otx_exemplar *exemplar)
{
    const int32_t side = exemplar->linear.width < exemplar->linear.height
                             ? exemplar->linear.width
                             : exemplar->linear.height;
    int32_t cell = DEFAULT_CELL;

    while (cell > OTX_TILE_LAYOUT_MIN_CELL && 3 * cell > 2 * side)
        cell /= 2;
    return cell;
}

static otx_status
check_fit(
    otx_run *run, const otx_exemplar *exemplar, const otx_tile_layout *layout)
{
    const int32_t side = otx_tile_layout_side(layout);
    const int32_t width = exemplar->linear.width;
    const int32_t height = exemplar->linear.height;

    if (8 * layout->gutter > layout->cell)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a gutter of %d texels leaves too little of tiles of %d; the tile "
            "size must be 8 gutters or more",
            (int)layout->gutter, (int)layout->cell);
    if (side > width || side > height)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE,
            otx_where_file(exemplar->source_path),
            "the picture has %d x %d texels and a tile needs %d x %d of them; "
            "take smaller tiles ({tile-size}) or a larger picture",
            (int)width, (int)height, (int)side, (int)side);
    return OSDTEX_OK;
}

static bool
is_inside(const otx_exemplar *e, otx_vec2 p, double reach)
{
    return (e->wrap_x || (p.x >= reach && p.x <= e->linear.width - reach)) &&
           (e->wrap_y || (p.y >= reach && p.y <= e->linear.height - reach));
}

/* Templates of the user must lie in the picture. */
static otx_status
check_templates(
    otx_run *run, const otx_exemplar *exemplar,
    const otx_tileset_options *options, const otx_strip_sizes *sizes)
{
    if (options->has_corner &&
        !(options->corner.x >= sizes->sew &&
          options->corner.x <= exemplar->linear.width - sizes->sew &&
          options->corner.y >= sizes->sew &&
          options->corner.y <= exemplar->linear.height - sizes->sew))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the corner template needs %d texels of picture on all sides",
            (int)sizes->sew);
    for (int32_t i = 0; i < options->edge_count; ++i)
    {
        const otx_tileset_edge *e = &options->edges[i];
        const double step = e->length > 0.0 ? e->length / sizes->side : 1.0;
        const otx_vec2 turn = otx_vec2_polar(e->angle);

        for (int32_t k = 0; k < 4; ++k)
        {
            const otx_vec2 corner = {
                step * sizes->side * (k & 1 ? 0.5 : -0.5),
                step * sizes->reach * (k & 2 ? 1.0 : -1.0)};
            const otx_vec2 p =
                otx_vec2_add(e->middle, otx_vec2_mul(turn, corner));

            /* Written so that NaN is refused too. */
            if (!is_inside(exemplar, p, 0.0))
                return otx_fail(
                    run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                    "edge template %d leaves the picture; it covers %.0f x "
                    "%.0f texels around its middle",
                    (int)i + 1, step * sizes->side, 2.0 * step * sizes->reach);
        }
    }
    return OSDTEX_OK;
}

/* Normals that are mixed have no frame to be turned by. */
static otx_status
check_maps(
    otx_run *run, const otx_exemplar *exemplar,
    const otx_tileset_options *options)
{
    if (!options->ramp || !otx_companions_are_there(&exemplar->companions))
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE,
        otx_where_file(exemplar->source_path),
        "cross-faded tiles mix pieces that lie at all turns, which maps of a "
        "material cannot be; cut them ({blend} cut)");
}

otx_status
otx_tileset_plan(
    otx_run *run, const otx_exemplar *exemplar,
    const otx_tileset_options *options, otx_tile_layout *out)
{
    OTX_TRY(check_options(run, options));
    *out = (otx_tile_layout){
        .boundaries = options->boundaries * (options->oriented ? 2 : 1),
        .corners = options->corners,
        .cell = options->cell ? options->cell : default_cell(exemplar),
        .gutter = options->gutter,
        .oriented = options->oriented,
        .source_width = exemplar->linear.width,
        .seed = run->seed,
        .name_count = options->names ? options->name_count : 0,
        .names = options->names,
    };
    return check_fit(run, exemplar, out);
}

/* ------------------------------------------------------------- all tiles */

/* Measured on the photographs of docs/notes/tile.md: more of anything costs
 * more time than it brings. */
const otx_interior_options otx_tileset_interior = {
    .windows = 4,
    .side_windows = 0,
    .rounds = 1,
    .patchwork = {.spots = 60, .patches = 3},
};

/* Where patches for the inside may come from: the windows' region. */
static otx_status
open_patches(
    otx_run *run, const otx_texel_pool *pool, const otx_ring_search *search,
    otx_patch_search *out)
{
    const int32_t spare = search->kit->sizes.side - PATCH;
    const int32_t most_x = otx_texel_pool_places_x(pool, PATCH);
    const int32_t most_y = otx_texel_pool_places_y(pool, PATCH);
    otx_patch_bounds b = {search->x0, search->y0, most_x, most_y};

    if (b.x1 > search->x1 + spare)
        b.x1 = search->x1 + spare;
    if (b.y1 > search->y1 + spare)
        b.y1 = search->y1 + spare;
    return otx_patch_search_create(
        run, pool, PATCH, &b, search->turns_step, out);
}

/* What vertices and insides are compared with: anything, turned any way. */
static otx_status
open_looks(otx_run *run, const otx_texel_pool *pool, otx_patch_search *out)
{
    const otx_patch_bounds all = {
        0, 0, otx_texel_pool_places_x(pool, LOOK),
        otx_texel_pool_places_y(pool, LOOK)};

    return otx_patch_search_create(run, pool, LOOK, &all, 1, out);
}

typedef struct filler
{
    const otx_run *run;
    const otx_ring_search *search;
    const otx_patch_search *patches;
    const otx_texel_pool *pool;
    otx_tileset *set;
    bool ramp;
    otx_texel_map texels;   /* of the whole picture */
    otx_quilt_seams *seams; /* [tile_count] */
    int32_t first;          /* tile of the piece at hand */
} filler;

static void
keep_texels(const otx_texel_map *tile, int32_t x, int32_t y, otx_texel_map *all)
{
    const size_t width = (size_t)tile->width;

    for (int32_t row = 0; row < tile->height; ++row)
        memcpy(
            all->texels + (size_t)(y + row) * (size_t)all->width + (size_t)x,
            tile->texels + (size_t)row * width, width * sizeof *tile->texels);
}

/* Colours of the texels; where there is none the image stays as it is. */
static void
paint(const otx_texel_pool *pool, const otx_texel_map *map, otx_image *image)
{
    const size_t channels = (size_t)pool->channels;
    const size_t count = (size_t)map->width * (size_t)map->height;

    for (size_t i = 0; i < count; ++i)
        if (map->texels[i] != OTX_TEXEL_NONE)
            memcpy(
                image->pixels + i * channels,
                pool->linear + (size_t)map->texels[i] * channels,
                channels * sizeof(float));
}

static otx_status
fill_tile(void *context, int64_t index, otx_worker *worker)
{
    filler *f = context;
    const otx_tile_layout *layout = &f->set->layout;
    const int32_t cell = f->first + (int32_t)index;
    const otx_tile_name name = otx_tile_layout_name(
        layout, layout->names ? layout->names[cell] : cell);
    otx_run run = *f->run;
    otx_texel_map map;
    int32_t x, y;

    run.arena = run.scratch = worker->scratch;
    run.pool = NULL;
    otx_tile_layout_origin(layout, cell, &x, &y);
    if (f->ramp)
        return otx_ramp_paint(&run, f->search, &name, x, y, &f->set->linear);
    OTX_TRY(otx_texel_map_create(
        &run, run.scratch, layout->cell, layout->cell, &map));
    OTX_TRY(otx_interior_build(
        &run, f->search, &name, f->patches, &otx_tileset_interior, &map,
        &f->seams[cell]));
    keep_texels(&map, x, y, &f->texels);
    return OSDTEX_OK;
}

/* In pieces, so that the user can watch and cancel. */
static otx_status
fill_all(otx_run *run, filler *f)
{
    const int32_t count = f->set->tile_count;

    for (f->first = 0; f->first < count; f->first += PIECE)
    {
        const int32_t left = count - f->first;

        OTX_TRY(otx_progress(run, STAGE, (double)f->first / count));
        OTX_TRY(
            otx_pool_for(run->pool, left < PIECE ? left : PIECE, fill_tile, f));
    }
    return otx_progress(run, STAGE, 1.0);
}

static void
sum_up(const otx_frame_kit *kit, const filler *f, otx_tileset *set)
{
    const int32_t strips =
        4 * kit->boundary_count * kit->corner_count * kit->corner_count;
    double length = 0.0;

    for (int32_t i = 0; i < kit->corner_count; ++i)
        set->corner_seam += kit->corners[i].seam / kit->corner_count;
    for (int32_t i = 0; i < strips; ++i)
        set->strip_seam += kit->strips[i].seam / strips;
    for (int32_t i = 0; i < set->tile_count; ++i)
    {
        set->inner_seam += f->seams[i].mean * (double)f->seams[i].length;
        length += (double)f->seams[i].length;
    }
    if (length > 0.0)
        set->inner_seam /= length;
    set->random_pair = f->pool->random_pair;
}

/* What goes into the header. Blended texels are not looked up. */
static otx_status
judge(
    otx_run *run, const otx_patch_search *looks, const filler *f,
    otx_tileset *set)
{
    const double unit = set->random_pair > 0.0 ? 1.0 / set->random_pair : 0.0;
    otx_vertex_figures seen;

    set->layout.figures = (otx_tile_figures){-1.0, -1.0, -1.0};
    if (f->ramp)
        return OSDTEX_OK;
    OTX_TRY(otx_vertex_check(run, looks, &set->layout, &f->texels, &seen));
    set->layout.figures = (otx_tile_figures){
        .inner_cut = unit * set->inner_seam,
        .vertex_window = seen.vertex < 0.0 ? -1.0 : unit * seen.vertex,
        .inner_window = seen.inside < 0.0 ? -1.0 : unit * seen.inside,
    };
    return OSDTEX_OK;
}

/* Black, so that cells without a tile are. */
static otx_status
create_picture(otx_run *run, const otx_exemplar *exemplar, otx_tileset *set)
{
    otx_tile_layout *layout = &set->layout;

    OTX_TRY(otx_tile_layout_arrange(run, layout));
    set->tile_count =
        layout->names ? layout->name_count : layout->columns * layout->rows;
    OTX_TRY(otx_image_create(
        run, run->arena, layout->columns * layout->cell,
        layout->rows * layout->cell, exemplar->linear.channels, &set->linear));
    memset(
        set->linear.pixels, 0,
        (size_t)set->linear.width * (size_t)set->linear.height *
            (size_t)set->linear.channels * sizeof(float));
    return OSDTEX_OK;
}

/* A picture of no texels as large as the set's. */
static otx_status
create_texels(otx_run *run, const otx_image *image, otx_texel_map *out)
{
    OTX_TRY(otx_texel_map_create(
        run, run->arena, image->width, image->height, out));
    memset(
        out->texels, 0xff,
        (size_t)out->width * (size_t)out->height * sizeof *out->texels);
    return OSDTEX_OK;
}

static void
close_arena(void *arena)
{
    otx_arena_destroy(arena);
}

/* An arena that dies with the scratch mark: templates outlive many marks. */
static otx_status
open_arena(otx_run *run, otx_arena **out)
{
    *out = otx_arena_create(run->allocator);
    if (!*out)
        return otx_fail_memory(run, STAGE);
    if (otx_arena_defer(run->scratch, close_arena, *out))
        return OSDTEX_OK;
    otx_arena_destroy(*out);
    return otx_fail_memory(run, STAGE);
}

otx_status
otx_tileset_make(
    otx_run *run, const otx_exemplar *exemplar,
    const otx_tileset_options *options, otx_tileset *out)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_frame_kit kit = {0};
    otx_patch_search looks, patches;
    otx_ring_search search;
    otx_texel_pool pool;
    otx_run own = *run;
    filler f;

    *out = (otx_tileset){0};
    OTX_TRY(otx_tileset_plan(run, exemplar, options, &out->layout));
    kit.sizes = otx_tileset_sizes(&out->layout);
    kit.boundary_count = out->layout.boundaries;
    kit.corner_count = out->layout.corners;
    OTX_TRY(check_maps(run, exemplar, options));
    OTX_TRY(check_templates(run, exemplar, options, &kit.sizes));
    OTX_TRY(create_picture(run, exemplar, out));
    OTX_TRY(open_arena(run, &own.arena));
    OTX_TRY(otx_texel_pool_create(
        run, own.arena, exemplar, &exemplar->match,
        otx_template_extra(&kit.sizes, options), &pool));
    OTX_TRY(open_looks(&own, &pool, &looks));
    OTX_TRY(otx_template_kit(&own, &pool, &looks, options, &out->layout, &kit));
    OTX_TRY(otx_ring_search_create(
        &own, &pool, &kit, &out->layout, &options->background, &search));
    OTX_TRY(open_patches(&own, &pool, &search, &patches));
    f = (filler){
        .run = run,
        .search = &search,
        .patches = &patches,
        .pool = &pool,
        .set = out,
        .ramp = options->ramp,
        .seams = OTX_ZNEW(own.arena, otx_quilt_seams, out->tile_count),
    };
    if (!f.seams)
        return otx_fail_memory(run, STAGE);
    OTX_TRY(create_texels(&own, &out->linear, &f.texels));
    OTX_TRY(fill_all(run, &f));
    paint(&pool, &f.texels, &out->linear);
    OTX_TRY(otx_tile_maps_make(run, &pool, &f.texels, &out->companions));
    sum_up(&kit, &f, out);
    OTX_TRY(judge(run, &looks, &f, out));
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

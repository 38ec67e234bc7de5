/* tile_report.c -- tiles where they meet, and how they are used, as JSON. */
#include "api/tile_report.h"

#include "image/pyramid.h"
#include "mapping/tile_check.h"

#include <string.h>

enum
{
    SAMPLES = 17 /* along an edge between two tiles */
};

static void
set_int(json_t *object, const char *key, int64_t value)
{
    json_object_set_new(object, key, json_integer((json_int_t)value));
}

/* Null where the file does not say. */
static void
set_figure(json_t *object, const char *key, double value)
{
    json_object_set_new(
        object, key, value >= 0.0 ? json_real(value) : json_null());
}

/* One object for each mip level. */
static otx_status
add_levels(otx_run *run, const osdtex_mapping *mapping, json_t *list)
{
    const otx_exemplar *exemplar = &mapping->exemplar->exemplar;
    const otx_image *picture = &exemplar->linear;
    const int32_t count = otx_pyramid_count(picture->width, picture->height);
    otx_image *levels = OTX_NEW(run->arena, otx_image, count);

    OTX_TRY(otx_run_ok(run));
    levels[0] = *picture;
    OTX_TRY(otx_tile_layout_levels(
        run, run->arena, &exemplar->tiles, picture, levels + 1));
    for (int32_t l = 0; l < count; ++l)
    {
        json_t *level = json_object();
        otx_tile_match match;

        json_array_append_new(list, level);
        OTX_TRY(otx_tile_check_match(
            run, &mapping->mapping, &levels[l], SAMPLES, &match));
        json_object_set_new(level, "edge_max", json_real(match.edge));
        json_object_set_new(level, "corner_max", json_real(match.corner));
    }
    return OSDTEX_OK;
}

static otx_status
add_use(otx_run *run, const osdtex_mapping *mapping, json_t *tiles)
{
    otx_tile_use use;

    OTX_TRY(otx_tile_check_use(
        run, &mapping->mapping, &mapping->exemplar->exemplar.tiles, &use));
    set_int(tiles, "count", use.tiles);
    set_int(tiles, "used", use.used);
    set_int(tiles, "faces_least", use.least);
    set_int(tiles, "faces_most", use.most);
    json_object_set_new(tiles, "faces_mean", json_real(use.mean));
    set_int(tiles, "edges", use.edges);
    set_int(tiles, "edges_between_equals", use.equal);
    set_int(tiles, "vertices", use.vertices);
    set_int(tiles, "vertices_with_equals", use.equal_at);
    return OSDTEX_OK;
}

otx_status
otx_tile_report_add(otx_run *run, const osdtex_mapping *mapping, json_t *root)
{
    const otx_tile_layout *layout = &mapping->exemplar->exemplar.tiles;
    json_t *tiles, *levels;

    if (layout->cell == 0)
        return OSDTEX_OK;
    tiles = json_object();
    levels = json_array();
    json_object_set_new(root, "tiles", tiles);
    json_object_set_new(tiles, "mismatch_by_mip_level", levels);
    OTX_TRY(otx_run_ok(run));
    set_int(tiles, "boundaries", layout->boundaries);
    set_int(tiles, "corners", layout->corners);
    set_int(tiles, "tile_size", layout->cell);
    set_int(tiles, "gutter", layout->gutter);
    set_int(tiles, "exact_levels", otx_tile_layout_exact_levels(layout));
    set_figure(tiles, "inner_cut", layout->figures.inner_cut);
    set_figure(tiles, "vertex_window", layout->figures.vertex_window);
    set_figure(tiles, "inner_window", layout->figures.inner_window);
    json_object_set_new(tiles, "oriented", json_boolean(layout->oriented));
    OTX_TRY(add_use(run, mapping, tiles));
    return add_levels(run, mapping, levels);
}

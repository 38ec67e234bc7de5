/* tile_layout.c -- names, places, levels and the line in the file's header. */
#include "image/tile_layout.h"
#include "image/pyramid.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char STAGE[] = "tiles";

otx_tile_name
otx_tile_layout_name(const otx_tile_layout *layout, int32_t number)
{
    const int32_t types = otx_tile_layout_types(layout);
    const int32_t half = otx_tile_layout_half(layout);
    int32_t digits[2] = {number % half, number / half};
    otx_tile_name name;

    for (int32_t i = 0; i < 2; ++i)
    {
        name.corners[2 * i + 1] = digits[i] % layout->corners;
        digits[i] /= layout->corners;
        name.corners[2 * i] = digits[i] % layout->corners;
        digits[i] /= layout->corners;
        name.sides[2 * i + 1] = digits[i] % types;
        name.sides[2 * i] = digits[i] / types;
    }
    return name;
}

int32_t
otx_tile_layout_cell(const otx_tile_layout *layout, int32_t number)
{
    int32_t low = 0, high = layout->name_count;

    if (!layout->names)
        return number;
    while (low < high)
    {
        const int32_t middle = low + (high - low) / 2;

        if (layout->names[middle] < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < layout->name_count && layout->names[low] == number ? low : -1;
}

int32_t
otx_tile_layout_exact_levels(const otx_tile_layout *layout)
{
    int32_t count = 1;

    while ((1 << count) <= 2 * layout->gutter)
        ++count;
    return count;
}

otx_status
otx_tile_layout_arrange(otx_run *run, otx_tile_layout *layout)
{
    const int32_t most = OTX_TILE_LAYOUT_MAX_SIDE / layout->cell;
    const int64_t half = otx_tile_layout_half(layout);
    int64_t columns = half, rows = half;

    if (layout->names)
    {
        for (columns = 1; columns * columns < layout->name_count;)
            columns *= 2;
        rows = (layout->name_count + columns - 1) / columns;
    }
    layout->columns = (int32_t)columns;
    layout->rows = (int32_t)rows;
    if (columns <= most && rows <= most)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_LIMIT, STAGE, OTX_NOWHERE,
        "%lld x %lld tiles of %d texels make a picture of more than %d texels "
        "a side; take smaller tiles, fewer boundaries or corners, or only the "
        "tiles that one mesh needs ({for})",
        (long long)columns, (long long)rows, (int)layout->cell,
        (int)OTX_TILE_LAYOUT_MAX_SIDE);
}

/* ---------------------------------------------------------------- levels */

/* Mean of the block of texels of `image` that texel (x, y) of a level of
 * blocks of `size` covers. Values of half files have 11 bits, so these sums
 * are exact in double and do not depend on the order. */
static void
average(
    const otx_image *image, int32_t x, int32_t y, int32_t size, double *mean)
{
    const int32_t x_end = x + size < image->width ? x + size : image->width;
    const int32_t y_end = y + size < image->height ? y + size : image->height;
    const double share = 1.0 / ((double)(x_end - x) * (double)(y_end - y));

    for (int32_t c = 0; c < image->channels; ++c)
        mean[c] = 0.0;
    for (int32_t j = y; j < y_end; ++j)
        for (int32_t i = x; i < x_end; ++i)
            for (int32_t c = 0; c < image->channels; ++c)
                mean[c] += otx_image_at(image, i, j)[c];
    for (int32_t c = 0; c < image->channels; ++c)
        mean[c] *= share;
}

typedef struct level_job
{
    const otx_tile_layout *layout;
    const otx_image *image;
    const double *mean; /* of the whole picture */
    otx_image *level;
    int32_t number;
} level_job;

/* Whether texel (x, y) of the level touches the rim of a cell. */
static bool
on_rim(const level_job *job, int32_t x, int32_t y)
{
    const int32_t side = job->layout->cell >> job->number;

    if (side <= 2)
        return true;
    return x % side == 0 || x % side == side - 1 || y % side == 0 ||
           y % side == side - 1;
}

static otx_status
level_row(void *context, int64_t index, otx_worker *worker)
{
    const level_job *job = context;
    const int32_t y = (int32_t)index, size = 1 << job->number;
    const bool exact = job->number < otx_tile_layout_exact_levels(job->layout);
    double mean[OTX_IMAGE_MAX_CHANNELS];

    (void)worker;
    for (int32_t x = 0; x < job->level->width; ++x)
    {
        const bool flat = !exact && on_rim(job, x, y);
        float *texel = otx_image_at(job->level, x, y);

        if (!flat)
            average(job->image, x * size, y * size, size, mean);
        for (int32_t c = 0; c < job->level->channels; ++c)
            texel[c] = (float)(flat ? job->mean[c] : mean[c]);
    }
    return OSDTEX_OK;
}

otx_status
otx_tile_layout_levels(
    otx_run *run, otx_arena *arena, const otx_tile_layout *layout,
    const otx_image *image, otx_image *levels)
{
    const int32_t count = otx_pyramid_count(image->width, image->height);
    const int32_t side =
        image->width > image->height ? image->width : image->height;
    double mean[OTX_IMAGE_MAX_CHANNELS];

    average(image, 0, 0, side, mean);
    for (int32_t l = 1; l < count; ++l)
    {
        otx_image *level = &levels[l - 1];
        level_job job = {layout, image, mean, level, l};

        OTX_TRY(otx_image_create(
            run, arena, otx_pyramid_side(image->width, l),
            otx_pyramid_side(image->height, l), image->channels, level));
        OTX_TRY(otx_pool_for(run->pool, level->height, level_row, &job));
    }
    return OSDTEX_OK;
}

/* ------------------------------------------------------------------ text */

/* The numbers of the line, in their order. */
enum
{
    BOUNDARIES,
    CORNERS,
    CELL,
    GUTTER,
    COLUMNS,
    ROWS,
    ORIENTED,
    SOURCE,
    SEED,
    INNER_CUT,
    VERTEX_WINDOW,
    INNER_WINDOW,
    NAMES,
    FIELD_COUNT
};

enum
{
    FIGURE_UNIT = 10000,
    FIGURE_MAX = 100
};

static const char *const FIELDS[FIELD_COUNT] = {
    "boundaries",    "corners",      "cell",         "gutter", "columns",
    "rows",          "oriented",     "source-width", "seed",   "inner-cut",
    "vertex-window", "inner-window", "names",
};

/* Figures are stored as ten-thousandths and one, 0 where not known. */
static uint64_t
from_figure(double value)
{
    return value >= 0.0 && value < FIGURE_MAX
               ? (uint64_t)(FIGURE_UNIT * value + 0.5) + 1
               : 0;
}

static double
to_figure(uint64_t stored)
{
    return stored == 0 ? -1.0 : (double)(stored - 1) / FIGURE_UNIT;
}

const char *
otx_tile_layout_print(otx_arena *arena, const otx_tile_layout *l)
{
    const size_t names = l->names ? (size_t)l->name_count : 0;
    const size_t room = 512 + names * 12;
    const uint64_t values[FIELD_COUNT] = {
        [BOUNDARIES] = (uint64_t)l->boundaries,
        [CORNERS] = (uint64_t)l->corners,
        [CELL] = (uint64_t)l->cell,
        [GUTTER] = (uint64_t)l->gutter,
        [COLUMNS] = (uint64_t)l->columns,
        [ROWS] = (uint64_t)l->rows,
        [ORIENTED] = l->oriented,
        [SOURCE] = (uint64_t)l->source_width,
        [SEED] = l->seed,
        [INNER_CUT] = from_figure(l->figures.inner_cut),
        [VERTEX_WINDOW] = from_figure(l->figures.vertex_window),
        [INNER_WINDOW] = from_figure(l->figures.inner_window),
        [NAMES] = names,
    };
    char *text = OTX_NEW(arena, char, room);
    size_t used = 0;

    if (!text)
        return NULL;
    for (int32_t i = 0; i < FIELD_COUNT; ++i)
        used += (size_t)snprintf(
            text + used, room - used, "%s%s=%" PRIu64, i > 0 ? " " : "",
            FIELDS[i], values[i]);
    for (size_t i = 0; i < names; ++i)
        used +=
            (size_t)snprintf(text + used, room - used, " %d", (int)l->names[i]);
    return text;
}

/* Reads digits at *text and moves it behind them. */
static bool
read_number(const char **text, uint64_t *value)
{
    const char *p = *text;

    for (*value = 0; *p >= '0' && *p <= '9' && p - *text < 20; ++p)
        *value = *value * 10 + (uint64_t)(*p - '0');
    if (p == *text)
        return false;
    *text = p;
    return true;
}

static bool
read_field(const char **text, const char *name, uint64_t *value)
{
    const size_t length = strlen(name);

    *text += strspn(*text, " ");
    if (strncmp(*text, name, length) != 0 || (*text)[length] != '=')
        return false;
    *text += length + 1;
    return read_number(text, value);
}

static bool
is_power_of_two(uint64_t value)
{
    return value > 0 && (value & (value - 1)) == 0;
}

static bool
fits(const otx_tile_layout *l, int32_t width, int32_t height)
{
    const int64_t half = otx_tile_layout_half(l);
    const int64_t cells = (int64_t)l->columns * l->rows;

    if (width != l->columns * l->cell || height != l->rows * l->cell)
        return false;
    return l->names ? l->name_count <= cells
                    : l->columns == half && l->rows == half;
}

static bool
in_range(const uint64_t *v)
{
    return v[BOUNDARIES] >= 1 &&
           v[BOUNDARIES] <= OTX_TILE_LAYOUT_MAX_BOUNDARIES && v[CORNERS] >= 1 &&
           v[CORNERS] <= OTX_TILE_LAYOUT_MAX_CORNERS &&
           is_power_of_two(v[CELL]) && v[CELL] >= OTX_TILE_LAYOUT_MIN_CELL &&
           v[CELL] <= OTX_TILE_LAYOUT_MAX_CELL && is_power_of_two(v[GUTTER]) &&
           4 * v[GUTTER] <= v[CELL] && v[COLUMNS] >= 1 &&
           v[COLUMNS] <= OTX_TILE_LAYOUT_MAX_SIDE && v[ROWS] >= 1 &&
           v[ROWS] <= OTX_TILE_LAYOUT_MAX_SIDE && v[ORIENTED] <= 1 &&
           v[SOURCE] >= 1 && v[SOURCE] <= OTX_IMAGE_MAX_SIDE &&
           v[INNER_CUT] <= FIGURE_UNIT * FIGURE_MAX &&
           v[VERTEX_WINDOW] <= FIGURE_UNIT * FIGURE_MAX &&
           v[INNER_WINDOW] <= FIGURE_UNIT * FIGURE_MAX &&
           v[NAMES] <= v[COLUMNS] * v[ROWS];
}

/* The names of a set that has only some of its tiles. */
static otx_status
read_names(
    otx_run *run, const char **text, int32_t count, otx_tile_layout *out,
    bool *good)
{
    const int64_t half = otx_tile_layout_half(out);
    int32_t *names = OTX_NEW(run->arena, int32_t, count);
    uint64_t value = 0, next = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t i = 0; i < count && *good; ++i, next = value + 1)
    {
        *text += strspn(*text, " ");
        *good = read_number(text, &value) && value >= next &&
                value < (uint64_t)(half * half);
        names[i] = (int32_t)value;
    }
    out->name_count = count;
    out->names = names;
    return OSDTEX_OK;
}

otx_status
otx_tile_layout_parse(
    otx_run *run, const char *path, const char *text, int32_t width,
    int32_t height, otx_tile_layout *out)
{
    uint64_t v[FIELD_COUNT] = {0};
    bool good = true;

    *out = (otx_tile_layout){0};
    for (int32_t i = 0; i < FIELD_COUNT && good; ++i)
        good = read_field(&text, FIELDS[i], &v[i]);
    good = good && in_range(v);
    if (good)
        *out = (otx_tile_layout){
            .boundaries = (int32_t)v[BOUNDARIES],
            .corners = (int32_t)v[CORNERS],
            .cell = (int32_t)v[CELL],
            .gutter = (int32_t)v[GUTTER],
            .columns = (int32_t)v[COLUMNS],
            .rows = (int32_t)v[ROWS],
            .oriented = v[ORIENTED] == 1,
            .source_width = (int32_t)v[SOURCE],
            .seed = v[SEED],
            .figures =
                {to_figure(v[INNER_CUT]), to_figure(v[VERTEX_WINDOW]),
                 to_figure(v[INNER_WINDOW])},
        };
    if (good && v[NAMES] > 0)
        OTX_TRY(read_names(run, &text, (int32_t)v[NAMES], out, &good));
    if (good && fits(out, width, height))
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_FORMAT, STAGE, otx_where_file(path),
        "the line that says how the picture is divided into tiles does not "
        "fit it; make the tiles again with osdtex tiles");
}

/* contact_sheet.c -- eight pictures side by side. */
#include "api/contact_sheet.h"

#include "image/lettering.h"
#include "render/worst_seam.h"

#include <string.h>

enum
{
    COLUMNS = 4,
    ROWS = 2,
    LEAST = 64 /* pixels of the sheet's sides */
};

typedef struct panel
{
    const char *name, *show, *view; /* view NULL: the sheet's */
} panel;

static const panel PANELS[COLUMNS * ROWS] = {
    {"texture", "texture", NULL},   {"patches", "patches", NULL},
    {"seams", "seams", NULL},       {"stretch", "stretch", NULL},
    {"field", "field", NULL},       {"seam 1", "texture", "seam1"},
    {"seam 2", "texture", "seam2"}, {"seam 3", "texture", "seam3"},
};

static osdtex_render_options
options_of(
    const osdtex_render_options *sheet, const panel *p, bool has_field,
    int32_t width, int32_t height)
{
    osdtex_render_options out = *sheet;

    out.width = width;
    out.height = height;
    out.show = p->show;
    if (strcmp(p->show, "field") == 0 && !has_field)
        out.show = "clay";
    if (p->view)
    {
        out.view = p->view;
        out.fov = 0.0;
        out.unlit = 1;
        out.wire = out.uv_lines = 0;
    }
    return out;
}

static void
paste(otx_image *sheet, const otx_image *picture, int32_t x, int32_t y)
{
    for (int32_t row = 0; row < picture->height; ++row)
        memcpy(
            otx_image_at(sheet, x, y + row), otx_image_at(picture, 0, row),
            (size_t)picture->width * 4 * sizeof(float));
}

/* The panel at (i, j), j from the top; left as it is where the model has fewer
 * seams. */
static otx_status
draw_panel(
    otx_run *run, const osdtex_model *model,
    const osdtex_render_options *options, otx_contact_draw *draw, int32_t seams,
    int32_t number, otx_image *sheet)
{
    const panel *p = &PANELS[number];
    const int32_t i = number % COLUMNS, j = ROWS - 1 - number / COLUMNS;
    const int32_t x = sheet->width * i / COLUMNS;
    const int32_t y = sheet->height * j / ROWS;
    const int32_t width = sheet->width * (i + 1) / COLUMNS - x;
    const int32_t height = sheet->height * (j + 1) / ROWS - y;
    const osdtex_render_options own =
        options_of(options, p, model->guide != NULL, width, height);
    const int32_t scale = 1 + height / 200;
    otx_image picture;

    if (!p->view || otx_worst_seam_rank(p->view) <= seams)
    {
        OTX_TRY(draw(run, model, &own, &picture));
        paste(sheet, &picture, x, y);
    }
    otx_lettering_write(
        sheet, x + 3 * scale, y + height - 3 * scale, scale,
        strcmp(own.show, p->show) == 0 ? p->name : own.show);
    return OSDTEX_OK;
}

otx_status
otx_contact_sheet_make(
    otx_run *run, const osdtex_model *model,
    const osdtex_render_options *options, otx_contact_draw *draw,
    otx_image *out)
{
    const size_t count = (size_t)options->width * (size_t)options->height;
    int32_t seams;

    if (options->width < LEAST || options->height < LEAST ||
        options->width > OTX_IMAGE_MAX_SIDE ||
        options->height > OTX_IMAGE_MAX_SIDE)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "render", OTX_NOWHERE,
            "a contact sheet of %d x %d pixels cannot be made; choose sides "
            "from %d to %d",
            options->width, options->height, LEAST, OTX_IMAGE_MAX_SIDE);
    OTX_TRY(otx_image_create(
        run, run->arena, options->width, options->height, 4, out));
    for (size_t i = 0; i < count; ++i)
        memcpy(
            out->pixels + 4 * i, (const float[4]){0.1f, 0.1f, 0.1f, 1.0f},
            4 * sizeof(float));
    OTX_TRY(otx_worst_seam_count(run, &model->scene, 3, &seams));
    for (int32_t i = 0; i < COLUMNS * ROWS; ++i)
        OTX_TRY(draw_panel(run, model, options, draw, seams, i, out));
    return OSDTEX_OK;
}

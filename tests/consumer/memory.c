/* Textures a cube without a file:  memory */
#include <osdtex/osdtex.h>
#include <stdio.h>

enum
{
    PICTURE = 64
};

static const float points[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                               -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
static const osdtex_index sizes[] = {4, 4, 4, 4, 4, 4};
static const osdtex_index verts[] = {
    0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
static float pixels[PICTURE * PICTURE * 3];

static osdtex_status
make_cage(osdtex_context *context, osdtex_cage **cage)
{
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();

    arrays.vert_count = 8;
    arrays.face_count = 6;
    arrays.points = points;
    arrays.face_sizes = sizes;
    arrays.face_verts = verts;
    return osdtex_cage_create(context, &arrays, NULL, cage);
}

/* A checker board, scene-linear. */
static osdtex_status
make_exemplar(osdtex_context *context, osdtex_exemplar **exemplar)
{
    osdtex_image *image;
    osdtex_status status;

    for (int i = 0; i < PICTURE * PICTURE * 3; ++i)
        pixels[i] = (i / 24 + i / (24 * PICTURE)) % 2 ? 0.6f : 0.1f;
    status = osdtex_image_create(context, PICTURE, PICTURE, 3, pixels, &image);
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_create(context, image, NULL, exemplar);
    osdtex_image_destroy(image);
    return status;
}

/* Adds up what a texture shows, block by block. */
static bool
add_up(void *user, const osdtex_bake_block *block)
{
    const int count = block->width * block->height * block->channels;

    for (int i = 0; i < count; ++i)
        *(double *)user += block->pixels[i];
    return true; /* go on */
}

static osdtex_status
bake(osdtex_context *context, const osdtex_mapping *mapping)
{
    osdtex_bake_options options = osdtex_bake_options_default();
    osdtex_bake_sink sink = osdtex_bake_sink_none();
    const osdtex_texture_part color = {0, 0, 0}; /* texture, tile, level */
    osdtex_textures *textures;
    osdtex_image *image = NULL;
    osdtex_status status;
    double sum = 0.0;

    options.resolution = 256;
    sink.put = add_up;
    sink.user = &sum;
    status = osdtex_textures_create(context, mapping, &options, &textures);
    if (status == OSDTEX_OK)
        status = osdtex_textures_image(context, textures, &color, &image);
    if (status == OSDTEX_OK)
        status = osdtex_textures_bake(context, textures, &sink);
    if (status == OSDTEX_OK)
        printf(
            "%d x %d texels, mean %.3f\n", osdtex_image_describe(image)->width,
            osdtex_image_describe(image)->height, sum / (256 * 256 * 3));
    osdtex_image_destroy(image);
    osdtex_textures_destroy(textures);
    return status;
}

static osdtex_status
tell(osdtex_context *context, const osdtex_mapping *mapping)
{
    osdtex_report *report;
    osdtex_status status =
        osdtex_report_create(context, mapping, NULL, &report);
    const osdtex_report_info *info = osdtex_report_describe(report);

    for (int32_t i = 0; status == OSDTEX_OK && i < info->figure_count; ++i)
        printf(
            "%s = %g %s\n", info->figures[i].key, info->figures[i].value,
            info->figures[i].unit);
    osdtex_report_destroy(report);
    return status;
}

int
main(void)
{
    osdtex_map_options options = osdtex_map_options_default();
    osdtex_context *context = NULL;
    osdtex_cage *cage = NULL;
    osdtex_exemplar *exemplar = NULL;
    osdtex_mapping *mapping = NULL;
    osdtex_status status = osdtex_context_create(NULL, &context);

    options.level = 4; /* 1536 leaf faces */
    if (status == OSDTEX_OK)
        status = make_cage(context, &cage);
    if (status == OSDTEX_OK)
        status = make_exemplar(context, &exemplar);
    if (status == OSDTEX_OK)
        status = osdtex_map(context, cage, exemplar, &options, &mapping);
    if (status == OSDTEX_OK)
        status = bake(context, mapping);
    if (status == OSDTEX_OK)
        status = tell(context, mapping);
    if (status != OSDTEX_OK && context)
        fprintf(stderr, "%s\n", osdtex_context_error(context)->message);
    osdtex_mapping_destroy(mapping);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    osdtex_context_destroy(context);
    return status == OSDTEX_OK ? 0 : 1;
}

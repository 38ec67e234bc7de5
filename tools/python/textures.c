/* textures.c -- bakes, into arrays and files, and pictures of a mapping. */
#include "binding.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

static const char *const UVS[] = {"auto", "own", "atlas", "charts", NULL};
static const char *const EXTRAS[] = {
    "patch", "uv", "stretch", "seam", "source", "slice", NULL};
static const char *const AXES[] = {"y", "z", NULL};

#define BAKE(field) offsetof(osdtex_bake_options, field)
static const opy_option BAKE_OPTIONS[] = {
    {"resolution", OPY_INT, BAKE(resolution), NULL},
    {"uvs", OPY_CHOICE, BAKE(uvs), UVS},
    {"margin", OPY_INT, BAKE(margin), NULL},
    {"texels_per_unit", OPY_REAL, BAKE(texels_per_unit), NULL},
    {"seam_blend", OPY_REAL, BAKE(seam_blend), NULL},
    {"extras", OPY_BITS, BAKE(extras), EXTRAS},
    {"udim", OPY_INT, BAKE(udim), NULL},
    {"preview_png", OPY_SWITCH, BAKE(preview_png), NULL},
    {"up_axis", OPY_CHOICE, BAKE(up_axis), AXES},
    {"meters_per_unit", OPY_REAL, BAKE(meters_per_unit), NULL},
    {"normals", OPY_SWITCH, BAKE(normals), NULL},
    {NULL, 0, 0, NULL}};

#define RENDER(field) offsetof(osdtex_render_options, field)
static const opy_option RENDER_OPTIONS[] = {
    {"width", OPY_INT, RENDER(width), NULL},
    {"height", OPY_INT, RENDER(height), NULL},
    {"samples", OPY_INT, RENDER(samples), NULL},
    {"show", OPY_TEXT, RENDER(show), NULL},
    {"view", OPY_TEXT, RENDER(view), NULL},
    {"turn", OPY_REAL, RENDER(turn), NULL},
    {"eye", OPY_REALS3, RENDER(eye), NULL},
    {"target", OPY_REALS3, RENDER(target), NULL},
    {"fov", OPY_REAL, RENDER(fov), NULL},
    {"unlit", OPY_SWITCH, RENDER(unlit), NULL},
    {"transparent", OPY_SWITCH, RENDER(transparent), NULL},
    {"plain", OPY_SWITCH, RENDER(plain), NULL},
    {"displace", OPY_SWITCH, RENDER(displace), NULL},
    {NULL, 0, 0, NULL}};

const char *
opy_comment(PyObject *keep)
{
    char *text = keep ? opy_keep_bytes(keep, 64) : NULL;

    if (text)
        snprintf(
            text, 64, "osdtex %s, in the units of the cage", osdtex_version());
    return text;
}

PyObject *
opy_bake(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    osdtex_bake_options options = osdtex_bake_options_default();
    PyObject *path, *keep = PyList_New(0);
    const char *name, *comment = opy_comment(keep);
    bool is_written = false;
    osdtex_status status;

    options.comments = &comment;
    options.comment_count = 1;
    if (comment && PyArg_ParseTuple(args, "O:bake", &path) &&
        opy_options_read(BAKE_OPTIONS, kwargs, &options, keep) &&
        (name = opy_path_of(path, keep)) && opy_enter(c))
    {
        status = osdtex_bake(c->handle, h->handle, name, &options);
        is_written = opy_leave(c, status);
    }
    Py_XDECREF(keep);
    return is_written ? Py_NewRef(Py_None) : NULL;
}

PyObject *
opy_textures(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    osdtex_bake_options options = osdtex_bake_options_default();
    osdtex_textures *textures = NULL;
    PyObject *keep = PyList_New(0), *result = NULL;
    osdtex_status status;

    if (keep && PyArg_ParseTuple(args, ":textures") &&
        opy_options_read(BAKE_OPTIONS, kwargs, &options, keep) && opy_enter(c))
    {
        status =
            osdtex_textures_create(c->handle, h->handle, &options, &textures);
        if (opy_leave(c, status))
            result = opy_handle_new(
                c, OPY_TEXTURES, textures, osdtex_textures_describe(textures));
        else
            osdtex_textures_destroy(textures);
    }
    Py_XDECREF(keep);
    return result;
}

/* An array of floats to be filled, height x width x channels. */
static PyObject *
make_pixels(
    opy_context *c, int32_t height, int32_t width, int32_t channels,
    Py_buffer *out)
{
    PyObject *array, *bytes = PyByteArray_FromStringAndSize(NULL, 0);
    const Py_ssize_t count = (Py_ssize_t)height * width * channels;
    PyObject *flat, *view;

    if (!bytes || PyByteArray_Resize(bytes, count * 4) < 0)
    {
        Py_XDECREF(bytes);
        return NULL;
    }
    view = PyMemoryView_FromObject(bytes);
    Py_DECREF(bytes);
    flat = view ? PyObject_CallMethod(view, "cast", "s", "f") : NULL;
    Py_XDECREF(view);
    view = flat ? PyObject_CallFunctionObjArgs(c->state->asarray, flat, NULL)
                : NULL;
    Py_XDECREF(flat);
    array = view ? PyObject_CallMethod(
                       view, "reshape", "iii", (int)height, (int)width,
                       (int)channels)
                 : NULL;
    Py_XDECREF(view);
    if (array && PyObject_GetBuffer(array, out, PyBUF_WRITABLE) < 0)
        Py_CLEAR(array);
    return array;
}

/* The texture of a name, or its number; -1 and KeyError. */
static int32_t
texture_of(const opy_handle *h, const char *name)
{
    const osdtex_textures_info *info = h->info;

    for (int32_t i = 0; i < info->texture_count; ++i)
        if (strcmp(osdtex_texture_describe(h->handle, i)->name, name) == 0)
            return i;
    PyErr_Format(PyExc_KeyError, "there is no texture '%s'", name);
    return -1;
}

static int32_t
tile_of(const opy_handle *h, int udim)
{
    const osdtex_textures_info *info = h->info;

    if (udim == 0 && info->tile_count == 1)
        return 0;
    for (int32_t i = 0; i < info->tile_count; ++i)
        if (info->tiles[i] == udim)
            return i;
    if (udim == 0)
        PyErr_Format(
            PyExc_ValueError, "there are %d tiles: say which by `tile`",
            (int)info->tile_count);
    else
        PyErr_Format(PyExc_KeyError, "there is no tile %d", udim);
    return -1;
}

static PyObject *
read_part(opy_handle *h, const osdtex_texture_part *part)
{
    const osdtex_textures_info *info = h->info;
    const int32_t side =
        info->side >> part->level > 0 ? info->side >> part->level : 1;
    opy_context *c = h->context;
    osdtex_status status;
    Py_buffer pixels;
    PyObject *array = make_pixels(
        c, side, side,
        osdtex_texture_describe(h->handle, part->texture)->channels, &pixels);

    if (!array)
        return NULL;
    if (!opy_enter(c))
        Py_CLEAR(array);
    else
    {
        status = osdtex_textures_read(
            c->handle, h->handle, part, pixels.buf, (size_t)pixels.len / 4);
        if (!opy_leave(c, status))
            Py_CLEAR(array);
    }
    PyBuffer_Release(&pixels);
    return array;
}

static PyObject *
textures_read(PyObject *self, PyObject *args, PyObject *kwargs)
{
    static char *words[] = {"name", "tile", "level", NULL};
    opy_handle *h = (opy_handle *)self;
    const osdtex_textures_info *info = h->info;
    osdtex_texture_part part;
    const char *name = "color";
    int tile = 0, level = 0;

    if (!PyArg_ParseTupleAndKeywords(
            args, kwargs, "|sii:read", words, &name, &tile, &level))
        return NULL;
    if (level < 0 || level >= info->level_count)
    {
        PyErr_Format(
            PyExc_ValueError, "there are levels 0 to %d, not %d",
            (int)info->level_count - 1, level);
        return NULL;
    }
    part.texture = texture_of(h, name);
    part.tile = part.texture < 0 ? -1 : tile_of(h, tile);
    part.level = level;
    return part.tile < 0 ? NULL : read_part(h, &part);
}

static PyObject *
get_names(PyObject *self, void *unused)
{
    opy_handle *h = (opy_handle *)self;
    const osdtex_textures_info *info = h->info;
    PyObject *names = PyTuple_New(info->texture_count);

    (void)unused;
    for (int32_t i = 0; names && i < info->texture_count; ++i)
        PyTuple_SetItem(
            names, i, opy_text(osdtex_texture_describe(h->handle, i)->name));
    return names;
}

static PyObject *
get_tiles(PyObject *self, void *unused)
{
    const osdtex_textures_info *info = ((opy_handle *)self)->info;
    PyObject *tiles = PyTuple_New(info->tile_count);

    (void)unused;
    for (int32_t i = 0; tiles && i < info->tile_count; ++i)
        PyTuple_SetItem(tiles, i, PyLong_FromLong(info->tiles[i]));
    return tiles;
}

static PyObject *
get_space(PyObject *self, void *unused)
{
    (void)unused;
    return opy_text(
        osdtex_texture_describe(((opy_handle *)self)->handle, 0)->color_space);
}

static PyObject *
get_cage_uvs(PyObject *self, void *unused)
{
    const osdtex_textures_info *info = ((opy_handle *)self)->info;

    (void)unused;
    return opy_array_lend(
        (opy_handle *)self, info->cage_uvs, "f", info->uv_count, 2);
}

static PyObject *
get_face_uvs(PyObject *self, void *unused)
{
    const osdtex_textures_info *info = ((opy_handle *)self)->info;

    (void)unused;
    return opy_array_lend(
        (opy_handle *)self, info->face_uvs, "i", info->corner_count, 0);
}

/* A model of a mapping, drawn; an image. */
static osdtex_status
draw(
    opy_context *c, const osdtex_mapping *mapping,
    const osdtex_render_options *options, osdtex_image **out)
{
    osdtex_model *model = NULL;
    osdtex_status status = osdtex_model_create(c->handle, mapping, &model);

    if (status == OSDTEX_OK)
        status = osdtex_render(c->handle, model, options, out);
    osdtex_model_destroy(model);
    return status;
}

static PyObject *
copy_image(opy_context *c, const osdtex_image *image)
{
    const osdtex_image_info *info = osdtex_image_describe(image);
    Py_buffer pixels;
    PyObject *array =
        make_pixels(c, info->height, info->width, info->channels, &pixels);

    if (!array)
        return NULL;
    memcpy(pixels.buf, info->pixels, (size_t)pixels.len);
    PyBuffer_Release(&pixels);
    return array;
}

PyObject *
opy_render(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    osdtex_render_options options = osdtex_render_options_default();
    PyObject *keep = PyList_New(0), *result = NULL;
    osdtex_image *image = NULL;
    osdtex_status status;

    if (keep && PyArg_ParseTuple(args, ":render") &&
        opy_options_read(RENDER_OPTIONS, kwargs, &options, keep) &&
        opy_enter(c))
    {
        status = draw(c, h->handle, &options, &image);
        if (opy_leave(c, status))
            result = copy_image(c, image);
        osdtex_image_destroy(image);
    }
    Py_XDECREF(keep);
    return result;
}

#define IN_TEXTURES(field) OPY_AT(osdtex_textures_info, field)
static PyGetSetDef FIELDS[] = {
    {"names", get_names, NULL, "Of the textures; the colour first.", NULL},
    {"tiles", get_tiles, NULL, "UDIM numbers.", NULL},
    {"side", opy_get_int, NULL, "Texels of a tile.", IN_TEXTURES(side)},
    {"level_count", opy_get_int, NULL, "Mip levels.", IN_TEXTURES(level_count)},
    {"color_space", get_space, NULL, "Of the colour's values.", NULL},
    {"cage_uvs", get_cage_uvs, NULL, "UVs x 2, of the cage.", NULL},
    {"face_uvs", get_face_uvs, NULL, "Of each corner of the cage.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyMethodDef METHODS[] = {
    {"read", (PyCFunction)(void (*)(void))textures_read,
     METH_VARARGS | METH_KEYWORDS,
     "The texels of a tile, height x width x channels, bottom row first."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot SLOTS[] = {
    {Py_tp_doc, "A bake in memory."},
    {Py_tp_dealloc, opy_handle_dealloc},
    {Py_tp_traverse, opy_handle_traverse},
    {Py_tp_methods, METHODS},
    {Py_tp_getset, FIELDS},
    {0, NULL}};

PyType_Spec opy_textures_spec = {
    "osdtex._osdtex.Textures", sizeof(opy_handle), 0,
    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    SLOTS};

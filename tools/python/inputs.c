/* inputs.c -- cages and exemplars. */
#include "binding.h"
#include "options.h"

static const char *const SCHEMES[] = {
    "catmark", "loop", "bilinear", "none", NULL};
static const char *const BOUNDARIES[] = {
    "none", "edgeOnly", "edgeAndCorner", NULL};
static const char *const FVARS[] = {
    "none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries",
    "all",  NULL};
static const char *const EMBEDDINGS[] = {
    "hsv", "hsv-cylinder", "lab", "rgb", NULL};
static const char *const WRAPS[] = {"auto", "no", "yes", NULL};
static const char *const TILEABLES[] = {"auto", "keep", "make", NULL};
static const char *const TEXTURES[] = {
    "any", "exr", "png", "tiff", "jpeg", NULL};
static const char *const RECEIVERS[] = {
    "any", "blender", "maya", "houdini", "usd", "web", NULL};
static const char *const MAPS[] = {
    "normal", "roughness", "height", "metalness", "occlusion", NULL};

#define CAGE(field) offsetof(osdtex_cage_options, field)
static const opy_option CAGE_OPTIONS[] = {
    {"scheme", OPY_CHOICE, CAGE(scheme), SCHEMES},
    {"boundary", OPY_CHOICE, CAGE(boundary), BOUNDARIES},
    {"fvar", OPY_CHOICE, CAGE(fvar), FVARS},
    {"weld", OPY_REAL, CAGE(weld), NULL},
    {NULL, 0, 0, NULL}};

#define PICTURE(field) offsetof(osdtex_exemplar_options, field)
static const opy_option EXEMPLAR_OPTIONS[] = {
    {"from_space", OPY_TEXT, PICTURE(from), NULL},
    {"to_space", OPY_TEXT, PICTURE(to), NULL},
    {"match_space", OPY_TEXT, PICTURE(match_space), NULL},
    {"embedding", OPY_CHOICE, PICTURE(embedding), EMBEDDINGS},
    {"wrap", OPY_CHOICE, PICTURE(wrap), WRAPS},
    {"tileable", OPY_CHOICE, PICTURE(tileable), TILEABLES},
    {"receiver", OPY_CHOICE, PICTURE(receiver), RECEIVERS},
    {"textures", OPY_CHOICE, PICTURE(texture_type), TEXTURES},
    {"layer", OPY_TEXT, PICTURE(layer), NULL},
    {"maps", OPY_MAPS, PICTURE(maps), MAPS},
    {"normals_y_down", OPY_SWITCH, PICTURE(normals_y_down), NULL},
    {"height_range", OPY_REAL, PICTURE(height_range), NULL},
    {"height_middle", OPY_REAL, PICTURE(height_middle), NULL},
    {NULL, 0, 0, NULL}};

PyObject *
opy_read_cage(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_context *c = (opy_context *)self;
    osdtex_cage_options options = osdtex_cage_options_default();
    PyObject *path, *keep = PyList_New(0), *result = NULL;
    osdtex_cage *cage = NULL;
    const char *name;
    osdtex_status status;

    if (!keep || !PyArg_ParseTuple(args, "O:read_cage", &path) ||
        !opy_options_read(CAGE_OPTIONS, kwargs, &options, keep) ||
        !(name = opy_path_of(path, keep)) || !opy_enter(c))
        goto end;
    status = osdtex_cage_read(c->handle, name, &options, &cage);
    if (opy_leave(c, status))
        result = opy_handle_new(c, OPY_CAGE, cage, osdtex_cage_describe(cage));
    else
        osdtex_cage_destroy(cage);
end:
    Py_XDECREF(keep);
    return result;
}

/* An array of the caller's as contiguous memory of a type, which a buffer
 * lends. None: no elements. */
static bool
take_array(opy_state *state, PyObject *object, const char *type, Py_buffer *out)
{
    PyObject *array;
    int failed;

    out->obj = NULL;
    out->buf = NULL;
    out->len = 0;
    if (object == Py_None)
        return true;
    array = PyObject_CallFunction(state->contiguous, "Os", object, type);
    if (!array)
        return false;
    failed = PyObject_GetBuffer(array, out, PyBUF_C_CONTIGUOUS);
    Py_DECREF(array);
    return failed == 0;
}

enum
{
    POINTS,
    SIZES,
    VERTS,
    UVS,
    FACE_UVS,
    CREASE_VERTS,
    CREASE_SHARPNESS,
    CORNER_VERTS,
    CORNER_SHARPNESS,
    HOLES,
    ARRAYS
};

/* Counts that do not fit together would be read beyond their end. */
static bool
counts_fit(const Py_buffer *b)
{
    const int32_t *sizes = b[SIZES].buf;
    const Py_ssize_t count = b[SIZES].len / 4;
    int64_t corners = 0;

    for (Py_ssize_t i = 0; i < count; ++i)
        corners += sizes[i] > 0 ? sizes[i] : 0;
    if (corners == b[VERTS].len / 4 &&
        (!b[FACE_UVS].buf || b[FACE_UVS].len == b[VERTS].len) &&
        b[CREASE_VERTS].len == 2 * b[CREASE_SHARPNESS].len &&
        b[CORNER_VERTS].len == b[CORNER_SHARPNESS].len)
        return true;
    PyErr_SetString(
        PyExc_ValueError,
        "the arrays of a cage do not fit each other: a vertex for each corner, "
        "a UV for each corner, a sharpness for each crease and corner");
    return false;
}

static void
fill_arrays(const Py_buffer *b, osdtex_cage_arrays *a)
{
    a->vert_count = (osdtex_index)(b[POINTS].len / 12);
    a->face_count = (osdtex_index)(b[SIZES].len / 4);
    a->points = b[POINTS].buf;
    a->face_sizes = b[SIZES].buf;
    a->face_verts = b[VERTS].buf;
    a->uv_count = (osdtex_index)(b[UVS].len / 8);
    a->uvs = b[UVS].buf;
    a->face_uvs = b[FACE_UVS].buf;
    a->crease_count = (osdtex_index)(b[CREASE_SHARPNESS].len / 4);
    a->crease_verts = b[CREASE_VERTS].buf;
    a->crease_sharpness = b[CREASE_SHARPNESS].buf;
    a->corner_count = (osdtex_index)(b[CORNER_VERTS].len / 4);
    a->corner_verts = b[CORNER_VERTS].buf;
    a->corner_sharpness = b[CORNER_SHARPNESS].buf;
    a->hole_count = (osdtex_index)(b[HOLES].len / 4);
    a->hole_faces = b[HOLES].buf;
}

static PyObject *
make_cage(
    opy_context *c, const osdtex_cage_arrays *arrays,
    const osdtex_cage_options *options)
{
    osdtex_cage *cage = NULL;
    osdtex_status status;

    if (!opy_enter(c))
        return NULL;
    status = osdtex_cage_create(c->handle, arrays, options, &cage);
    if (opy_leave(c, status))
        return opy_handle_new(c, OPY_CAGE, cage, osdtex_cage_describe(cage));
    osdtex_cage_destroy(cage);
    return NULL;
}

PyObject *
opy_make_cage(PyObject *self, PyObject *args, PyObject *kwargs)
{
    static const char *const types[ARRAYS] = {
        "f4", "i4", "i4", "f4", "i4", "i4", "f4", "i4", "f4", "i4"};
    opy_context *c = (opy_context *)self;
    osdtex_cage_options options = osdtex_cage_options_default();
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();
    PyObject *keep = PyList_New(0), *result = NULL;
    Py_buffer buffers[ARRAYS];
    bool fits = keep && PyTuple_Size(args) == ARRAYS &&
                opy_options_read(CAGE_OPTIONS, kwargs, &options, keep);
    int count = 0;

    if (keep && PyTuple_Size(args) != ARRAYS)
        PyErr_SetString(PyExc_TypeError, "ten arrays make a cage");
    for (; fits && count < ARRAYS; ++count)
        fits = take_array(
            c->state, PyTuple_GetItem(args, count), types[count],
            &buffers[count]);
    if (fits && counts_fit(buffers))
    {
        fill_arrays(buffers, &arrays);
        result = make_cage(c, &arrays, &options);
    }
    for (int i = 0; i < count; ++i)
        if (buffers[i].obj)
            PyBuffer_Release(&buffers[i]);
    Py_XDECREF(keep);
    return result;
}

static PyObject *
wrap_exemplar(opy_context *c, osdtex_status status, osdtex_exemplar *exemplar)
{
    if (opy_leave(c, status))
        return opy_handle_new(
            c, OPY_EXEMPLAR, exemplar, osdtex_exemplar_describe(exemplar));
    osdtex_exemplar_destroy(exemplar);
    return NULL;
}

PyObject *
opy_read_exemplar(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_context *c = (opy_context *)self;
    osdtex_exemplar_options options = osdtex_exemplar_options_default();
    PyObject *path, *keep = PyList_New(0), *result = NULL;
    osdtex_exemplar *exemplar = NULL;
    const char *name;
    osdtex_status status;

    if (!keep || !PyArg_ParseTuple(args, "O:read_exemplar", &path) ||
        !opy_options_read(EXEMPLAR_OPTIONS, kwargs, &options, keep) ||
        !(name = opy_path_of(path, keep)) || !opy_enter(c))
        goto end;
    status = osdtex_exemplar_read(c->handle, name, &options, &exemplar);
    result = wrap_exemplar(c, status, exemplar);
end:
    Py_XDECREF(keep);
    return result;
}

/* Height and width of pixels, and how many channels: 1 where there is no third
 * dimension. */
static bool
shape_of(PyObject *array, int32_t shape[3])
{
    PyObject *dimensions = PyObject_GetAttrString(array, "shape");
    const Py_ssize_t count = dimensions ? PyTuple_Size(dimensions) : 0;

    shape[2] = 1;
    for (Py_ssize_t i = 0; i < count && i < 3; ++i)
        shape[i] = (int32_t)PyLong_AsLong(PyTuple_GetItem(dimensions, i));
    Py_XDECREF(dimensions);
    if (!PyErr_Occurred() && (count == 2 || count == 3))
        return true;
    if (!PyErr_Occurred())
        PyErr_SetString(
            PyExc_ValueError, "pixels are an array of height x width x "
                              "channels, bottom row first");
    return false;
}

static PyObject *
make_exemplar(
    opy_context *c, PyObject *array, const osdtex_exemplar_options *options)
{
    osdtex_exemplar *exemplar = NULL;
    osdtex_image *image = NULL;
    PyObject *result = NULL;
    int32_t shape[3];
    osdtex_status status;
    Py_buffer pixels;

    if (!shape_of(array, shape) ||
        PyObject_GetBuffer(array, &pixels, PyBUF_C_CONTIGUOUS) < 0)
        return NULL;
    if (opy_enter(c))
    {
        status = osdtex_image_create(
            c->handle, shape[1], shape[0], shape[2], pixels.buf, &image);
        if (status == OSDTEX_OK)
            status =
                osdtex_exemplar_create(c->handle, image, options, &exemplar);
        osdtex_image_destroy(image);
        result = wrap_exemplar(c, status, exemplar);
    }
    PyBuffer_Release(&pixels);
    return result;
}

PyObject *
opy_make_exemplar(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_context *c = (opy_context *)self;
    osdtex_exemplar_options options = osdtex_exemplar_options_default();
    PyObject *given, *array = NULL, *keep = PyList_New(0), *result = NULL;

    if (keep && PyArg_ParseTuple(args, "O:exemplar", &given) &&
        opy_options_read(EXEMPLAR_OPTIONS, kwargs, &options, keep))
        array = PyObject_CallFunction(c->state->contiguous, "Os", given, "f4");
    if (array)
        result = make_exemplar(c, array, &options);
    Py_XDECREF(array);
    Py_XDECREF(keep);
    return result;
}

static PyObject *
get_pixels(PyObject *self, void *unused)
{
    opy_handle *h = (opy_handle *)self;
    const osdtex_exemplar_info *info = h->info;
    PyObject *rows = opy_array_lend(
        h, info->pixels, "f", (Py_ssize_t)info->width * info->height,
        info->channels);
    PyObject *array = NULL;

    (void)unused;
    if (rows)
        array = PyObject_CallMethod(
            rows, "reshape", "iii", (int)info->height, (int)info->width,
            (int)info->channels);
    Py_XDECREF(rows);
    return array;
}

#define IN_CAGE(field) OPY_AT(osdtex_cage_info, field)
static PyGetSetDef CAGE_FIELDS[] = {
    {"path", opy_get_text, NULL, "As given; None of arrays.", IN_CAGE(path)},
    {"hash", opy_get_text, NULL, "Of the file's bytes.", IN_CAGE(hash)},
    {"vert_count", opy_get_int, NULL, "Vertices.", IN_CAGE(vert_count)},
    {"face_count", opy_get_int, NULL, "Faces.", IN_CAGE(face_count)},
    {"edge_count", opy_get_int, NULL, "Edges.", IN_CAGE(edge_count)},
    {"uv_count", opy_get_int, NULL, "0: it has no UVs.", IN_CAGE(uv_count)},
    {"crease_count", opy_get_int, NULL, "Creases.", IN_CAGE(crease_count)},
    {"component_count", opy_get_int, NULL, "Pieces.", IN_CAGE(component_count)},
    {"lower", opy_get_reals3, NULL, "Of the bounding box.", IN_CAGE(lower)},
    {"upper", opy_get_reals3, NULL, "Of the bounding box.", IN_CAGE(upper)},
    {"diagonal", opy_get_real, NULL, "Of the bounding box.", IN_CAGE(diagonal)},
    {"default_scale", opy_get_real, NULL, "What a scale of 0 means.",
     IN_CAGE(default_scale)},
    {NULL, NULL, NULL, NULL, NULL}};

#define IN_PICTURE(field) OPY_AT(osdtex_exemplar_info, field)
static PyGetSetDef EXEMPLAR_FIELDS[] = {
    {"path", opy_get_text, NULL, "As given.", IN_PICTURE(path)},
    {"hash", opy_get_text, NULL, "Of the file's bytes.", IN_PICTURE(hash)},
    {"source_space", opy_get_text, NULL, "Colour space as resolved.",
     IN_PICTURE(source_space)},
    {"linear_space", opy_get_text, NULL, "Of the pixels.",
     IN_PICTURE(linear_space)},
    {"width", opy_get_int, NULL, "Texels.", IN_PICTURE(width)},
    {"height", opy_get_int, NULL, "Texels.", IN_PICTURE(height)},
    {"channels", opy_get_int, NULL, "3 or 4.", IN_PICTURE(channels)},
    {"wrap_x", opy_get_flag, NULL, "It tiles left to right.",
     IN_PICTURE(wrap_x)},
    {"wrap_y", opy_get_flag, NULL, "It tiles bottom to top.",
     IN_PICTURE(wrap_y)},
    {"pixels", get_pixels, NULL, "Linear, bottom row first; read-only.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot CAGE_SLOTS[] = {
    {Py_tp_doc, "The artist's control mesh, validated."},
    {Py_tp_dealloc, opy_handle_dealloc},
    {Py_tp_traverse, opy_handle_traverse},
    {Py_tp_getset, CAGE_FIELDS},
    {0, NULL}};

static PyType_Slot EXEMPLAR_SLOTS[] = {
    {Py_tp_doc, "The picture of a material, its colours resolved."},
    {Py_tp_dealloc, opy_handle_dealloc},
    {Py_tp_traverse, opy_handle_traverse},
    {Py_tp_getset, EXEMPLAR_FIELDS},
    {0, NULL}};

enum
{
    FLAGS = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC |
            Py_TPFLAGS_DISALLOW_INSTANTIATION
};

PyType_Spec opy_cage_spec = {
    "osdtex._osdtex.Cage", sizeof(opy_handle), 0, FLAGS, CAGE_SLOTS};
PyType_Spec opy_exemplar_spec = {
    "osdtex._osdtex.Exemplar", sizeof(opy_handle), 0, FLAGS, EXEMPLAR_SLOTS};

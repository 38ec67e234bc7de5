/* mapping.c -- mappings: made, looked at, written, saved, measured. */
#include "binding.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

static const char *const TEXTURES[] = {
    "any", "exr", "png", "tiff", "jpeg", NULL};
static const char *const RECEIVERS[] = {
    "any", "blender", "maya", "houdini", "usd", "web", NULL};
static const char *const MAPS[] = {
    "normal", "roughness", "height", "metalness", "occlusion", NULL};

#define MAP(field) offsetof(osdtex_map_options, field)
static const opy_option MAP_OPTIONS[] = {
    {"level", OPY_LEVEL, MAP(level), NULL},
    {"scale", OPY_REAL, MAP(scale), NULL},
    {"method", OPY_TEXT, MAP(method), NULL},
    {"settings", OPY_SETTINGS, MAP(settings), NULL},
    {"seed", OPY_SEED, MAP(seed), NULL},
    {"heal", OPY_HEAL, MAP(heal), NULL},
    {"constraints", OPY_PATH, MAP(constraints), NULL},
    {"follow", OPY_TEXT, MAP(follow), NULL},
    {"exemplar_class", OPY_TEXT, MAP(exemplar_class), NULL},
    {"generators", OPY_REALS, MAP(generators), NULL},
    {"mask", OPY_PATH, MAP(mask), NULL},
    {"along", OPY_TEXT, MAP(along), NULL},
    {"place", OPY_PATH, MAP(place), NULL},
    {"first_face", OPY_INT, MAP(first_face), NULL},
    {"first_u", OPY_REAL, MAP(first_u), NULL},
    {"first_v", OPY_REAL, MAP(first_v), NULL},
    {"first_angle", OPY_REAL, MAP(first_angle), NULL},
    {NULL, 0, 0, NULL}};

#define READ(field) offsetof(osdtex_mapping_read_options, field)
static const opy_option READ_OPTIONS[] = {
    {"cage", OPY_PATH, READ(cage), NULL},
    {"exemplar", OPY_PATH, READ(exemplars), NULL},
    {"from_space", OPY_TEXT, READ(from), NULL},
    {"to_space", OPY_TEXT, READ(to), NULL},
    {"receiver", OPY_CHOICE, READ(receiver), RECEIVERS},
    {"textures", OPY_CHOICE, READ(texture_type), TEXTURES},
    {"maps", OPY_MAPS, READ(maps), MAPS},
    {"heal", OPY_HEAL, READ(heal), NULL},
    {"place", OPY_PATH, READ(place), NULL},
    {NULL, 0, 0, NULL}};

#define WRITE(field) offsetof(osdtex_write_options, field)
static const opy_option WRITE_OPTIONS[] = {
    {"normals", OPY_SWITCH, WRITE(normals), NULL},
    {"without_image", OPY_SWITCH, WRITE(without_image), NULL},
    {"resolution", OPY_INT, WRITE(resolution), NULL},
    {NULL, 0, 0, NULL}};

static const opy_option REPORT_OPTIONS[] = {
    {"windows", OPY_INT, offsetof(osdtex_report_options, windows), NULL},
    {NULL, 0, 0, NULL}};

static PyObject *
wrap_mapping(opy_context *c, osdtex_status status, osdtex_mapping *mapping)
{
    if (opy_leave(c, status))
        return opy_handle_new(
            c, OPY_MAPPING, mapping, osdtex_mapping_describe(mapping));
    osdtex_mapping_destroy(mapping);
    return NULL;
}

/* One exemplar more: itself, or (exemplar, material, scale). */
static bool
read_also_item(opy_state *state, PyObject *item, osdtex_also *out)
{
    PyObject *exemplar = item;
    opy_handle *handle;

    if (PyTuple_Check(item) &&
        !PyArg_ParseTuple(
            item, "Oz|d;an exemplar, a material of the cage or None, a scale",
            &exemplar, &out->material, &out->scale))
        return false;
    handle = opy_handle_of(state, exemplar, OPY_EXEMPLAR);
    out->exemplar = handle ? handle->handle : NULL;
    return handle != NULL;
}

/* The option `also`, taken out of the keywords. Its objects live as long as
 * those. */
static bool
take_also(
    opy_state *state, PyObject *kwargs, PyObject *keep, osdtex_map_options *out)
{
    PyObject *also = kwargs ? PyDict_GetItemString(kwargs, "also") : NULL;
    osdtex_also *list;
    Py_ssize_t count;

    if (!also)
        return true;
    if (also != Py_None)
    {
        PyObject *items = PySequence_Tuple(also);

        if (!items || PyList_Append(keep, items) < 0)
            return false;
        Py_DECREF(items); /* the list has it */
        count = PyTuple_Size(items);
        list = opy_keep_bytes(keep, (size_t)count * sizeof *list);
        for (Py_ssize_t i = 0; list && i < count; ++i)
            if (!read_also_item(state, PyTuple_GetItem(items, i), &list[i]))
                return false;
        out->also = list;
        out->also_count = (int32_t)count;
    }
    return !PyErr_Occurred() && PyDict_DelItemString(kwargs, "also") == 0;
}

/* The option `keep`, taken out of the keywords; the caller's hold it. */
static bool
take_keep(opy_state *state, PyObject *kwargs, osdtex_map_options *out)
{
    PyObject *given = PyDict_GetItemString(kwargs, "keep");
    opy_handle *handle;

    if (!given)
        return true;
    if (given != Py_None)
    {
        handle = opy_handle_of(state, given, OPY_MAPPING);
        if (!handle)
            return false;
        out->keep = handle->handle;
    }
    return PyDict_DelItemString(kwargs, "keep") == 0;
}

static PyObject *
map(opy_context *c, PyObject *args, PyObject *words, PyObject *keep)
{
    osdtex_map_options options = osdtex_map_options_default();
    osdtex_mapping *mapping = NULL;
    PyObject *given[2];
    opy_handle *cage, *exemplar;
    osdtex_status status;

    if (!PyArg_ParseTuple(args, "OO:map", &given[0], &given[1]) ||
        !(cage = opy_handle_of(c->state, given[0], OPY_CAGE)) ||
        !(exemplar = opy_handle_of(c->state, given[1], OPY_EXEMPLAR)) ||
        !take_also(c->state, words, keep, &options) ||
        !take_keep(c->state, words, &options) ||
        !opy_take_constraints(
            words, keep, &options.constraint_items,
            &options.constraint_count) ||
        !opy_options_read(MAP_OPTIONS, words, &options, keep) || !opy_enter(c))
        return NULL;
    status = osdtex_map(
        c->handle, cage->handle, exemplar->handle, &options, &mapping);
    return wrap_mapping(c, status, mapping);
}

PyObject *
opy_map(PyObject *self, PyObject *args, PyObject *kwargs)
{
    PyObject *words = kwargs ? PyDict_Copy(kwargs) : PyDict_New();
    PyObject *keep = PyList_New(0);
    PyObject *result =
        words && keep ? map((opy_context *)self, args, words, keep) : NULL;

    Py_XDECREF(words);
    Py_XDECREF(keep);
    return result;
}

PyObject *
opy_read_mapping(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_context *c = (opy_context *)self;
    osdtex_mapping_read_options options = osdtex_mapping_read_options_default();
    PyObject *path, *keep = PyList_New(0), *result = NULL;
    osdtex_mapping *mapping = NULL;
    const char *name;
    osdtex_status status;

    if (!keep || !PyArg_ParseTuple(args, "O:read_mapping", &path) ||
        !opy_options_read(READ_OPTIONS, kwargs, &options, keep) ||
        !(name = opy_path_of(path, keep)) || !opy_enter(c))
        goto end;
    status = osdtex_mapping_read(c->handle, name, &options, &mapping);
    result = wrap_mapping(c, status, mapping);
end:
    Py_XDECREF(keep);
    return result;
}

static PyObject *
mapping_write(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    osdtex_write_options options = osdtex_write_options_default();
    PyObject *path, *keep = PyList_New(0);
    const char *name, *comment;
    bool is_written = false;
    osdtex_status status;

    /* What the program says in its files. */
    comment = opy_comment(keep);
    options.comments = &comment;
    options.comment_count = 1;
    if (keep && comment && PyArg_ParseTuple(args, "O:write", &path) &&
        opy_options_read(WRITE_OPTIONS, kwargs, &options, keep) &&
        (name = opy_path_of(path, keep)) && opy_enter(c))
    {
        status = osdtex_mapping_write(c->handle, h->handle, name, &options);
        is_written = opy_leave(c, status);
    }
    Py_XDECREF(keep);
    return is_written ? Py_NewRef(Py_None) : NULL;
}

static PyObject *
mapping_save(PyObject *self, PyObject *path)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    PyObject *keep = PyList_New(0);
    const char *name;
    bool is_saved = false;
    osdtex_status status;

    if (keep && (name = opy_path_of(path, keep)) && opy_enter(c))
    {
        status = osdtex_mapping_save(c->handle, h->handle, name);
        is_saved = opy_leave(c, status);
    }
    Py_XDECREF(keep);
    return is_saved ? Py_NewRef(Py_None) : NULL;
}

static PyObject *
mapping_report(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    osdtex_report_options options = osdtex_report_options_default();
    osdtex_report *report = NULL;
    PyObject *result = NULL;
    osdtex_status status;

    if (!PyArg_ParseTuple(args, ":report") ||
        !opy_options_read(REPORT_OPTIONS, kwargs, &options, NULL) ||
        !opy_enter(c))
        return NULL;
    status = osdtex_report_create(c->handle, h->handle, &options, &report);
    if (opy_leave(c, status))
        result = PyObject_CallFunction(
            c->state->loads, "s", osdtex_report_describe(report)->json);
    osdtex_report_destroy(report);
    return result;
}

static const osdtex_surface_info *
surface_of(const opy_handle *h)
{
    return osdtex_surface_describe(osdtex_mapping_surface(h->handle));
}

static PyObject *
get_uvs(PyObject *self, void *unused)
{
    const osdtex_mapping_info *info = ((opy_handle *)self)->info;

    (void)unused;
    return opy_array_lend(
        (opy_handle *)self, info->uvs, "f", info->corner_count, 2);
}

static PyObject *
get_face_patch(PyObject *self, void *unused)
{
    const osdtex_mapping_info *info = ((opy_handle *)self)->info;

    (void)unused;
    return opy_array_lend(
        (opy_handle *)self, info->face_patch, "i", info->face_count, 0);
}

static PyObject *
get_level(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromLong(surface_of((opy_handle *)self)->level);
}

static PyObject *
get_origin(PyObject *self, void *unused)
{
    const double *o = surface_of((opy_handle *)self)->origin;

    (void)unused;
    return Py_BuildValue("(ddd)", o[0], o[1], o[2]);
}

typedef enum surface_array
{
    SURFACE_POINTS,
    SURFACE_NORMALS,
    SURFACE_FACE_FIRST,
    SURFACE_FACE_VERTS,
    SURFACE_FACE_CAGE
} surface_array;

static const surface_array WHICH[] = {
    SURFACE_POINTS, SURFACE_NORMALS, SURFACE_FACE_FIRST, SURFACE_FACE_VERTS,
    SURFACE_FACE_CAGE};

static PyObject *
get_surface(PyObject *self, void *which)
{
    opy_handle *h = (opy_handle *)self;
    const osdtex_surface_info *s = surface_of(h);

    switch (*(const surface_array *)which)
    {
    case SURFACE_POINTS:
        return opy_array_lend(h, s->points, "f", s->vert_count, 3);
    case SURFACE_NORMALS:
        return opy_array_lend(h, s->normals, "f", s->vert_count, 3);
    case SURFACE_FACE_FIRST:
        return opy_array_lend(h, s->face_first, "i", s->face_count + 1, 0);
    case SURFACE_FACE_VERTS:
        return opy_array_lend(h, s->face_verts, "i", s->corner_count, 0);
    default:
        return opy_array_lend(h, s->face_cage, "i", s->face_count, 0);
    }
}

#define IN_MAPPING(field) OPY_AT(osdtex_mapping_info, field)
#define ON_SURFACE(which) ((void *)(uintptr_t)&WHICH[which])
static PyGetSetDef FIELDS[] = {
    {"uvs", get_uvs, NULL, "Corners x 2, into the exemplar.", NULL},
    {"face_patch", get_face_patch, NULL, "Of each leaf face; -1 on holes.",
     NULL},
    {"method", opy_get_text, NULL, "Its name.", IN_MAPPING(method)},
    {"scale", opy_get_real, NULL, "As resolved, in scene units.",
     IN_MAPPING(scale)},
    {"face_count", opy_get_int, NULL, "Leaf faces.", IN_MAPPING(face_count)},
    {"corner_count", opy_get_int, NULL, "Of leaf faces.",
     IN_MAPPING(corner_count)},
    {"patch_count", opy_get_int, NULL, "Patches.", IN_MAPPING(patch_count)},
    {"exemplar_count", opy_get_int, NULL, "Exemplars.",
     IN_MAPPING(exemplar_count)},
    {"level", get_level, NULL, "Refinement steps, as resolved.", NULL},
    {"origin", get_origin, NULL, "What points are relative to.", NULL},
    {"points", get_surface, NULL, "Vertices x 3, on the limit surface.",
     ON_SURFACE(SURFACE_POINTS)},
    {"normals", get_surface, NULL, "Vertices x 3, unit.",
     ON_SURFACE(SURFACE_NORMALS)},
    {"face_first", get_surface, NULL, "Faces + 1, into corners.",
     ON_SURFACE(SURFACE_FACE_FIRST)},
    {"face_verts", get_surface, NULL, "The vertex of each corner.",
     ON_SURFACE(SURFACE_FACE_VERTS)},
    {"face_cage", get_surface, NULL, "The cage's face of each leaf face.",
     ON_SURFACE(SURFACE_FACE_CAGE)},
    {NULL, NULL, NULL, NULL, NULL}};

static PyMethodDef METHODS[] = {
    {"write", (PyCFunction)(void (*)(void))mapping_write,
     METH_VARARGS | METH_KEYWORDS, "Writes NAME.obj with its MTL and EXR."},
    {"save", mapping_save, METH_O, "Saves NAME.osdtex, to be read again."},
    {"edit", (PyCFunction)(void (*)(void))opy_edit,
     METH_VARARGS | METH_KEYWORDS, "Another one, changed in a part."},
    {"seams", (PyCFunction)(void (*)(void))opy_seams,
     METH_VARARGS | METH_KEYWORDS, "Where patches meet, and that shows."},
    {"report", (PyCFunction)(void (*)(void))mapping_report,
     METH_VARARGS | METH_KEYWORDS, "How good it is, as a dictionary."},
    {"bake", (PyCFunction)(void (*)(void))opy_bake,
     METH_VARARGS | METH_KEYWORDS, "Bakes onto the cage, into files."},
    {"textures", (PyCFunction)(void (*)(void))opy_textures,
     METH_VARARGS | METH_KEYWORDS, "Bakes onto the cage, into arrays."},
    {"render", (PyCFunction)(void (*)(void))opy_render,
     METH_VARARGS | METH_KEYWORDS, "A picture, height x width x 4."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot SLOTS[] = {
    {Py_tp_doc, "UVs into an exemplar for every leaf face of a cage."},
    {Py_tp_dealloc, opy_handle_dealloc},
    {Py_tp_traverse, opy_handle_traverse},
    {Py_tp_methods, METHODS},
    {Py_tp_getset, FIELDS},
    {0, NULL}};

PyType_Spec opy_mapping_spec = {
    "osdtex._osdtex.Mapping", sizeof(opy_handle), 0,
    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    SLOTS};

/* edit.c -- what is asked of a part of a mapping, and where its seams show. */
#include "binding.h"
#include "options.h"

#define ITEM(field) offsetof(osdtex_constraint, field)
static const opy_option ITEM_OPTIONS[] = {
    {"face", OPY_INT, ITEM(face), NULL},
    {"point", OPY_REALS3, ITEM(point), NULL},
    {"radius", OPY_REAL, ITEM(radius), NULL},
    {"direction", OPY_REALS3, ITEM(direction), NULL},
    {"scale", OPY_REAL, ITEM(scale), NULL},
    {"material", OPY_REAL, ITEM(material), NULL},
    {"exemplar", OPY_INT, ITEM(exemplar), NULL},
    {"edit", OPY_INT, ITEM(edit), NULL},
    {"reach", OPY_REAL, ITEM(reach), NULL},
    {"redo", OPY_INT, ITEM(redo), NULL},
    {NULL, 0, 0, NULL}};

/* ---- constraints ---- */

static bool
read_item(PyObject *item, PyObject *keep, osdtex_constraint *out)
{
    PyObject *material;

    *out = osdtex_constraint_none();
    if (!PyDict_Check(item))
    {
        PyErr_SetString(
            PyExc_TypeError,
            "constraints are a path, or a list of dictionaries with the keys "
            "of docs/formats-constraints.md");
        return false;
    }
    if (!opy_options_read(ITEM_OPTIONS, item, out, keep))
        return false;
    material = PyDict_GetItemString(item, "material");
    out->has_material = material && material != Py_None;
    return true;
}

static bool
read_list(
    PyObject *list, PyObject *keep, const osdtex_constraint **items,
    int32_t *count)
{
    const Py_ssize_t size = PyList_Size(list);
    osdtex_constraint *all;

    if (size > INT32_MAX)
    {
        PyErr_SetString(PyExc_ValueError, "there are too many constraints");
        return false;
    }
    all = opy_keep_bytes(keep, (size_t)size * sizeof *all);
    for (Py_ssize_t i = 0; all && i < size; ++i)
        if (!read_item(PyList_GetItem(list, i), keep, &all[i]))
            return false;
    *items = all;
    *count = (int32_t)size;
    return all != NULL;
}

bool
opy_take_constraints(
    PyObject *words, PyObject *keep, const osdtex_constraint **items,
    int32_t *count)
{
    PyObject *given = PyDict_GetItemString(words, "constraints");
    PyObject *list;
    bool is_read;

    if (!given || !PySequence_Check(given) || PyUnicode_Check(given) ||
        PyBytes_Check(given))
        return true;
    list = PySequence_List(given);
    is_read = list && PyList_Append(keep, list) == 0 &&
              read_list(list, keep, items, count) &&
              PyDict_DelItemString(words, "constraints") == 0;
    Py_XDECREF(list);
    return is_read;
}

/* ---- edits ---- */

/* What is given by keywords. */
typedef struct asked
{
    osdtex_edit_options options;
    double spot[4]; /* point and radius */
    int32_t face, seed;
} asked;

static const opy_option FACE_OPTIONS[] = {
    {"constraints", OPY_PATH, offsetof(asked, options.constraints), NULL},
    {"redo", OPY_INT, offsetof(asked, face), NULL},
    {"seed", OPY_INT, offsetof(asked, seed), NULL},
    {"reach", OPY_REAL, offsetof(asked, options.reach), NULL},
    {NULL, 0, 0, NULL}};
static const opy_option SPOT_OPTIONS[] = {
    {"constraints", OPY_PATH, offsetof(asked, options.constraints), NULL},
    {"redo", OPY_REALS, offsetof(asked, spot), NULL},
    {"seed", OPY_INT, offsetof(asked, seed), NULL},
    {"reach", OPY_REAL, offsetof(asked, options.reach), NULL},
    {NULL, 0, 0, NULL}};

/* `redo` is one constraint more. */
static bool
add_redo(const asked *a, bool is_spot, PyObject *keep, osdtex_edit_options *o)
{
    const size_t count = (size_t)o->constraint_count;
    osdtex_constraint *all = opy_keep_bytes(keep, (count + 1) * sizeof *all);

    if (!all)
        return false;
    for (size_t i = 0; i < count; ++i)
        all[i] = o->constraint_items[i];
    all[count] = osdtex_constraint_none();
    all[count].face = is_spot ? -1 : a->face;
    for (int k = 0; k < 3; ++k)
        all[count].point[k] = a->spot[k];
    all[count].radius = a->spot[3];
    all[count].redo = a->seed;
    o->constraint_items = all;
    ++o->constraint_count;
    return true;
}

static bool
read_asked(PyObject *words, PyObject *keep, osdtex_edit_options *out)
{
    PyObject *redo = PyDict_GetItemString(words, "redo");
    const bool is_spot = redo && PySequence_Check(redo);
    asked a = {.options = *out, .face = -1, .seed = 1};

    if (!opy_take_constraints(
            words, keep, &a.options.constraint_items,
            &a.options.constraint_count) ||
        !opy_options_read(
            is_spot ? SPOT_OPTIONS : FACE_OPTIONS, words, &a, keep))
        return false;
    if (a.seed < 1 || (redo && redo != Py_None && !is_spot && a.face < 0))
    {
        PyErr_SetString(
            PyExc_ValueError,
            "redo is a face of the cage, from 0, or x, y, z and a radius; and "
            "seed, from 1, which other texture is tried there");
        return false;
    }
    if (redo && redo != Py_None && !add_redo(&a, is_spot, keep, &a.options))
        return false;
    *out = a.options;
    return true;
}

static PyObject *
edit(opy_handle *h, PyObject *args, PyObject *words, PyObject *keep)
{
    opy_context *c = h->context;
    osdtex_edit_options options = osdtex_edit_options_default();
    osdtex_mapping *made = NULL;
    PyObject *given = NULL;
    osdtex_status status;

    if (!PyArg_ParseTuple(args, "|O:edit", &given) ||
        (given && PyDict_SetItemString(words, "constraints", given) < 0) ||
        !read_asked(words, keep, &options) || !opy_enter(c))
        return NULL;
    status = osdtex_mapping_edit(c->handle, h->handle, &options, &made);
    if (opy_leave(c, status))
        return opy_handle_new(
            c, OPY_MAPPING, made, osdtex_mapping_describe(made));
    osdtex_mapping_destroy(made);
    return NULL;
}

PyObject *
opy_edit(PyObject *self, PyObject *args, PyObject *kwargs)
{
    PyObject *words = kwargs ? PyDict_Copy(kwargs) : PyDict_New();
    PyObject *keep = PyList_New(0);
    PyObject *result =
        words && keep ? edit((opy_handle *)self, args, words, keep) : NULL;

    Py_XDECREF(words);
    Py_XDECREF(keep);
    return result;
}

/* ---- seams ---- */

static const opy_option SEAMS_OPTIONS[] = {
    {"places", OPY_INT, 0, NULL}, {NULL, 0, 0, NULL}};

PyObject *
opy_seams(PyObject *self, PyObject *args, PyObject *kwargs)
{
    opy_handle *h = (opy_handle *)self;
    opy_context *c = h->context;
    osdtex_seams *seams = NULL;
    int32_t places = 10;
    osdtex_status status;

    if (!PyArg_ParseTuple(args, ":seams") ||
        !opy_options_read(SEAMS_OPTIONS, kwargs, &places, NULL) ||
        !opy_enter(c))
        return NULL;
    status = osdtex_seams_create(c->handle, h->handle, places, &seams);
    if (opy_leave(c, status))
        return opy_handle_new(
            c, OPY_SEAMS, seams, osdtex_seams_describe(seams));
    osdtex_seams_destroy(seams);
    return NULL;
}

/* A column of the rows of corner and difference, without a copy. */
static PyObject *
column_of(PyObject *self, const char *format, int column)
{
    const osdtex_seams_info *info = ((opy_handle *)self)->info;
    PyObject *rows = opy_array_lend(
        (opy_handle *)self, info->seams, format, info->seam_count, 2);
    PyObject *all = PySlice_New(NULL, NULL, NULL);
    PyObject *where = all ? Py_BuildValue("(Oi)", all, column) : NULL;
    PyObject *array = rows && where ? PyObject_GetItem(rows, where) : NULL;

    Py_XDECREF(where);
    Py_XDECREF(all);
    Py_XDECREF(rows);
    return array;
}

static PyObject *
get_corners(PyObject *self, void *unused)
{
    (void)unused;
    return column_of(self, "i", 0);
}

static PyObject *
get_differences(PyObject *self, void *unused)
{
    (void)unused;
    return column_of(self, "f", 1);
}

static PyObject *
get_places(PyObject *self, void *unused)
{
    const osdtex_seams_info *info = ((opy_handle *)self)->info;
    PyObject *list = PyList_New(0);

    (void)unused;
    for (int32_t i = 0; list && i < info->place_count; ++i)
    {
        const osdtex_seam_place *p = &info->places[i];
        PyObject *place = Py_BuildValue(
            "{s(ddd)s(ddd)sdsd}", "point", p->point[0], p->point[1],
            p->point[2], "normal", p->normal[0], p->normal[1], p->normal[2],
            "length", p->length, "difference", p->difference);

        if (!place || PyList_Append(list, place) < 0)
            Py_CLEAR(list);
        Py_XDECREF(place);
    }
    return list;
}

static PyGetSetDef FIELDS[] = {
    {"corners", get_corners, NULL, "Where the edges of seams begin.", NULL},
    {"differences", get_differences, NULL,
     "Of what their sides show, 0 to 1: black beside white.", NULL},
    {"places", get_places, NULL, "Where they show most, the worst first.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot SLOTS[] = {
    {Py_tp_doc, "Where patches of a mapping meet, and how much that shows."},
    {Py_tp_dealloc, opy_handle_dealloc},
    {Py_tp_traverse, opy_handle_traverse},
    {Py_tp_getset, FIELDS},
    {0, NULL}};

PyType_Spec opy_seams_spec = {
    "osdtex._osdtex.Seams", sizeof(opy_handle), 0,
    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    SLOTS};

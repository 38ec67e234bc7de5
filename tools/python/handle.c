/* handle.c -- what all handles have in common: their life, their fields, and
 * memory that they lend as NumPy arrays. */
#include "binding.h"

#include <string.h>

/* What an object that lends memory holds: the owner in place of a handle. */
typedef struct lent
{
    PyObject_HEAD PyObject *owner;
    const void *data;
    char format[2];
    int dimensions;
    Py_ssize_t item, shape[2], strides[2];
} lent;

static void
destroy(opy_type type, void *handle)
{
    switch (type)
    {
    case OPY_CAGE:
        osdtex_cage_destroy(handle);
        return;
    case OPY_EXEMPLAR:
        osdtex_exemplar_destroy(handle);
        return;
    case OPY_MAPPING:
        osdtex_mapping_destroy(handle);
        return;
    case OPY_TEXTURES:
        osdtex_textures_destroy(handle);
        return;
    case OPY_SEAMS:
        osdtex_seams_destroy(handle);
        return;
    default:
        return;
    }
}

static PyObject *
make(PyObject *type)
{
    allocfunc alloc =
        (allocfunc)PyType_GetSlot((PyTypeObject *)type, Py_tp_alloc);

    return alloc((PyTypeObject *)type, 0);
}

PyObject *
opy_handle_new(opy_context *c, opy_type type, void *handle, const void *info)
{
    opy_handle *h = (opy_handle *)make(c->state->types[type]);

    if (!h)
    {
        destroy(type, handle);
        return NULL;
    }
    Py_INCREF((PyObject *)c);
    h->context = c;
    h->type = type;
    h->handle = handle;
    h->info = info;
    return (PyObject *)h;
}

opy_handle *
opy_handle_of(opy_state *state, PyObject *object, opy_type type)
{
    static const char *const names[] = {"a Context", "a Cage",   "an Exemplar",
                                        "a Mapping", "Textures", "Seams",
                                        ""};

    if (PyObject_TypeCheck(object, (PyTypeObject *)state->types[type]))
        return (opy_handle *)object;
    PyErr_Format(PyExc_TypeError, "%s is needed, not %R", names[type], object);
    return NULL;
}

void
opy_handle_dealloc(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    freefunc release_object = (freefunc)PyType_GetSlot(type, Py_tp_free);
    opy_handle *h = (opy_handle *)self;

    PyObject_GC_UnTrack(self);
    destroy(h->type, h->handle);
    Py_XDECREF((PyObject *)h->context);
    release_object(self);
    Py_DECREF(type);
}

int
opy_handle_traverse(PyObject *self, visitproc visit, void *arg)
{
    Py_VISIT(Py_TYPE(self));
    Py_VISIT((PyObject *)((opy_handle *)self)->context);
    return 0;
}

PyObject *
opy_text(const char *text)
{
    if (!text)
        Py_RETURN_NONE;
    return PyUnicode_DecodeUTF8(
        text, (Py_ssize_t)strlen(text), "surrogateescape");
}

/* The field at an offset of what the handle's describe function lends. */
static const void *
field_at(PyObject *self, void *offset)
{
    return (const char *)((opy_handle *)self)->info + (size_t)offset;
}

PyObject *
opy_get_text(PyObject *self, void *offset)
{
    return opy_text(*(const char *const *)field_at(self, offset));
}

PyObject *
opy_get_int(PyObject *self, void *offset)
{
    return PyLong_FromLong(*(const int32_t *)field_at(self, offset));
}

PyObject *
opy_get_flag(PyObject *self, void *offset)
{
    return PyBool_FromLong(*(const int32_t *)field_at(self, offset));
}

PyObject *
opy_get_real(PyObject *self, void *offset)
{
    return PyFloat_FromDouble(*(const double *)field_at(self, offset));
}

PyObject *
opy_get_reals3(PyObject *self, void *offset)
{
    const double *v = field_at(self, offset);

    return Py_BuildValue("(ddd)", v[0], v[1], v[2]);
}

PyObject *
opy_array_lend(
    opy_handle *owner, const void *data, const char *format, Py_ssize_t rows,
    Py_ssize_t columns)
{
    opy_state *state = owner->context->state;
    lent *l = (lent *)make(state->types[OPY_LENT]);
    PyObject *array;

    if (!l)
        return NULL;
    Py_INCREF((PyObject *)owner);
    l->owner = (PyObject *)owner;
    l->data = data ? data : "";
    l->format[0] = format[0];
    l->item = format[0] == 'B' ? 1 : 4;
    l->dimensions = columns > 0 ? 2 : 1;
    l->shape[0] = data ? rows : 0;
    l->shape[1] = columns;
    l->strides[0] = l->item * (columns > 0 ? columns : 1);
    l->strides[1] = l->item;
    array = PyObject_CallFunctionObjArgs(state->asarray, (PyObject *)l, NULL);
    Py_DECREF(l);
    return array;
}

static int
lent_get(PyObject *self, Py_buffer *view, int flags)
{
    lent *l = (lent *)self;

    view->obj = NULL;
    if (flags & PyBUF_WRITABLE)
    {
        PyErr_SetString(PyExc_BufferError, "what a handle lends is read-only");
        return -1;
    }
    Py_INCREF(self);
    view->obj = self;
    view->buf = (void *)(uintptr_t)l->data;
    view->itemsize = l->item;
    view->len = l->shape[0] * l->strides[0];
    view->readonly = 1;
    view->ndim = l->dimensions;
    view->format = flags & PyBUF_FORMAT ? l->format : NULL;
    view->shape = flags & PyBUF_ND ? l->shape : NULL;
    view->strides =
        (flags & PyBUF_STRIDES) == PyBUF_STRIDES ? l->strides : NULL;
    view->suboffsets = NULL;
    view->internal = NULL;
    return 0;
}

static void
lent_dealloc(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    freefunc release_object = (freefunc)PyType_GetSlot(type, Py_tp_free);

    Py_CLEAR(((lent *)self)->owner);
    release_object(self);
    Py_DECREF(type);
}

static PyType_Slot LENT_SLOTS[] = {
    {Py_bf_getbuffer, lent_get}, {Py_tp_dealloc, lent_dealloc}, {0, NULL}};

PyType_Spec opy_lent_spec = {
    "osdtex._osdtex.Lent", sizeof(lent), 0,
    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, LENT_SLOTS};

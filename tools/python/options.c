/* options.c -- keyword arguments to structs of options. */
#include "options.h"

#include <string.h>

void *
opy_keep_bytes(PyObject *keep, size_t bytes)
{
    PyObject *memory = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)bytes + 1);
    char *data = NULL;

    if (memory && PyList_Append(keep, memory) == 0)
    {
        data = PyBytes_AsString(memory);
        memset(data, 0, bytes + 1);
    }
    Py_XDECREF(memory);
    return data;
}

const char *
opy_path_of(PyObject *path, PyObject *keep)
{
    PyObject *bytes = NULL;
    const char *text = NULL;

    if (!PyUnicode_FSConverter(path, &bytes))
        return NULL;
    if (PyList_Append(keep, bytes) == 0)
        text = PyBytes_AsString(bytes);
    Py_DECREF(bytes);
    return text;
}

static const char *
text_of(PyObject *value, const char *name)
{
    if (!PyUnicode_Check(value))
    {
        PyErr_Format(PyExc_TypeError, "%s is a text", name);
        return NULL;
    }
    return PyUnicode_AsUTF8AndSize(value, NULL);
}

/* The place of a word among others; -1 and ValueError with all of them. */
static int
choice_of(const opy_option *o, PyObject *value)
{
    const char *text = text_of(value, o->name);
    PyObject *words;
    int count = 0;

    for (; text && o->choices[count]; ++count)
        if (strcmp(text, o->choices[count]) == 0)
            return count;
    words = text ? PyUnicode_FromString(o->choices[0]) : NULL;
    for (int i = 1; words && i < count; ++i)
    {
        PyObject *longer = PyUnicode_FromFormat("%U, %s", words, o->choices[i]);

        Py_DECREF(words);
        words = longer;
    }
    if (words)
        PyErr_Format(
            PyExc_ValueError, "%s is one of %U, not '%s'", o->name, words,
            text);
    Py_XDECREF(words);
    return -1;
}

static bool
reals_of(const opy_option *o, PyObject *value, Py_ssize_t count, double *out)
{
    if (PySequence_Size(value) != count)
    {
        if (!PyErr_Occurred())
            PyErr_Format(
                PyExc_ValueError, "%s has %zd numbers", o->name, count);
        return false;
    }
    for (Py_ssize_t i = 0; i < count; ++i)
    {
        PyObject *item = PySequence_GetItem(value, i);

        out[i] = item ? PyFloat_AsDouble(item) : 0.0;
        Py_XDECREF(item);
    }
    return !PyErr_Occurred();
}

static bool
int_of(const opy_option *o, PyObject *value, int32_t *out)
{
    const long long number = PyLong_AsLongLong(value);

    if (number == -1 && PyErr_Occurred())
        return false;
    *out = (int32_t)number;
    if (number == *out)
        return true;
    PyErr_Format(PyExc_ValueError, "%s is too large", o->name);
    return false;
}

static bool
bits_of(const opy_option *o, PyObject *value, uint32_t *out)
{
    const Py_ssize_t count =
        PyUnicode_Check(value) ? -1 : PySequence_Size(value);

    if (count < 0 && !PyErr_Occurred())
        PyErr_Format(PyExc_TypeError, "%s is a list of names", o->name);
    for (Py_ssize_t i = 0; i < count; ++i)
    {
        PyObject *item = PySequence_GetItem(value, i);
        const int bit = item ? choice_of(o, item) : -1;

        Py_XDECREF(item);
        if (bit < 0)
            return false;
        *out |= 1u << bit;
    }
    return count >= 0;
}

/* {"mode": "paper"}: keys and, as texts, values, in their order. */
static bool
settings_of(PyObject *value, char *out, PyObject *keep)
{
    const Py_ssize_t count = PyDict_Check(value) ? PyDict_Size(value) : -1;
    osdtex_setting *list;
    PyObject *key, *item;
    Py_ssize_t at = 0;

    if (count < 0)
    {
        PyErr_SetString(PyExc_TypeError, "settings are a dictionary");
        return false;
    }
    list = opy_keep_bytes(keep, (size_t)count * sizeof *list);
    for (Py_ssize_t i = 0; list && PyDict_Next(value, &at, &key, &item); ++i)
    {
        PyObject *text = item == Py_True    ? PyUnicode_FromString("on")
                         : item == Py_False ? PyUnicode_FromString("off")
                                            : PyObject_Str(item);

        if (!text || PyList_Append(keep, text) < 0)
            list = NULL;
        else
        {
            list[i].key = text_of(key, "the name of a setting");
            list[i].value = PyUnicode_AsUTF8AndSize(text, NULL);
        }
        Py_XDECREF(text);
    }
    if (!list || PyErr_Occurred())
        return false;
    memcpy(out, &list, sizeof list);
    memcpy(out + sizeof list, &(int32_t){(int32_t)count}, sizeof(int32_t));
    return true;
}

/* {"normal": path}: maps of a material by their kind. */
static bool
maps_of(const opy_option *o, PyObject *value, char *out, PyObject *keep)
{
    const Py_ssize_t count = PyDict_Check(value) ? PyDict_Size(value) : -1;
    osdtex_companion *list;
    PyObject *key, *item;
    Py_ssize_t at = 0;

    if (count < 0)
    {
        PyErr_SetString(PyExc_TypeError, "maps are a dictionary of paths");
        return false;
    }
    list = opy_keep_bytes(keep, (size_t)count * sizeof *list);
    for (Py_ssize_t i = 0; list && PyDict_Next(value, &at, &key, &item); ++i)
    {
        list[i].kind = choice_of(o, key);
        list[i].path = list[i].kind < 0 ? NULL : opy_path_of(item, keep);
        if (!list[i].path)
            return false;
    }
    if (!list)
        return false;
    memcpy(out, &list, sizeof list);
    memcpy(out + sizeof list, &(int32_t){(int32_t)count}, sizeof(int32_t));
    return true;
}

static bool
is_auto(PyObject *value)
{
    return PyUnicode_Check(value) &&
           PyUnicode_CompareWithASCIIString(value, "auto") == 0;
}

static bool
read_text(const opy_option *o, PyObject *value, char *at, PyObject *keep)
{
    const char *text = o->kind == OPY_PATH ? opy_path_of(value, keep)
                                           : text_of(value, o->name);

    memcpy(at, &text, sizeof text);
    return text != NULL;
}

static bool
read_real(const opy_option *o, PyObject *value, char *at)
{
    const double real = o->kind == OPY_HEAL && is_auto(value)
                            ? OSDTEX_HEAL_AUTO
                            : PyFloat_AsDouble(value);

    memcpy(at, &real, sizeof real);
    return !PyErr_Occurred();
}

static bool
read_int(const opy_option *o, PyObject *value, char *at)
{
    int32_t number = OSDTEX_LEVEL_AUTO;

    if (o->kind == OPY_CHOICE)
        number = choice_of(o, value);
    else if (o->kind == OPY_SWITCH)
        number = PyObject_IsTrue(value);
    else if (
        !(o->kind == OPY_LEVEL && is_auto(value)) && !int_of(o, value, &number))
        return false;
    memcpy(at, &number, sizeof number);
    return !PyErr_Occurred();
}

static bool
read_seed(PyObject *value, char *at)
{
    const uint64_t seed = PyLong_AsUnsignedLongLong(value);

    memcpy(at, &seed, sizeof seed);
    return !PyErr_Occurred();
}

static bool
read_one(const opy_option *o, PyObject *value, char *at, PyObject *keep)
{
    switch (o->kind)
    {
    case OPY_TEXT:
    case OPY_PATH:
        return read_text(o, value, at, keep);
    case OPY_REAL:
    case OPY_HEAL:
        return read_real(o, value, at);
    case OPY_REALS:
        return reals_of(o, value, 4, (double *)(void *)at);
    case OPY_REALS3:
        return reals_of(o, value, 3, (double *)(void *)at);
    case OPY_SEED:
        return read_seed(value, at);
    case OPY_BITS:
        return bits_of(o, value, (uint32_t *)(void *)at);
    case OPY_SETTINGS:
        return settings_of(value, at, keep);
    case OPY_MAPS:
        return maps_of(o, value, at, keep);
    default:
        return read_int(o, value, at);
    }
}

/* TypeError with the names that there are. */
static void
refuse(const opy_option *table, PyObject *key)
{
    PyObject *names = PyUnicode_FromString(table->name);

    for (const opy_option *o = table + 1; names && o->name; ++o)
    {
        PyObject *longer = PyUnicode_FromFormat("%U, %s", names, o->name);

        Py_DECREF(names);
        names = longer;
    }
    if (names)
        PyErr_Format(
            PyExc_TypeError, "no option %R; there are: %U", key, names);
    Py_XDECREF(names);
}

bool
opy_options_read(
    const opy_option *table, PyObject *kwargs, void *out, PyObject *keep)
{
    PyObject *key, *value;
    Py_ssize_t at = 0;

    while (kwargs && PyDict_Next(kwargs, &at, &key, &value))
    {
        const opy_option *o = table;

        while (o->name && PyUnicode_CompareWithASCIIString(key, o->name) != 0)
            ++o;
        if (!o->name)
        {
            refuse(table, key);
            return false;
        }
        if (value != Py_None &&
            !read_one(o, value, (char *)out + o->offset, keep))
            return false;
    }
    return true;
}

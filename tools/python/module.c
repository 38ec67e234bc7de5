/* module.c -- osdtex._osdtex, what the package osdtex is made of. */
#include "binding.h"

static PyObject *
get_version(PyObject *module, PyObject *nothing)
{
    (void)module, (void)nothing;
    return PyUnicode_FromString(osdtex_version());
}

static PyObject *
get_build(PyObject *module, PyObject *nothing)
{
    (void)module, (void)nothing;
    return PyUnicode_FromString(osdtex_build());
}

/* The settings of a method, {name: (help, default)}. */
static PyObject *
settings_of(int32_t method, int32_t count)
{
    PyObject *settings = PyDict_New();
    osdtex_option_info option;

    for (int32_t i = 0; settings && i < count; ++i)
    {
        PyObject *row;

        if (osdtex_option_get(method, i, &option) != OSDTEX_OK)
            continue;
        row = Py_BuildValue("(ss)", option.help, option.fallback);
        if (!row || PyDict_SetItemString(settings, option.name, row) < 0)
            Py_CLEAR(settings);
        Py_XDECREF(row);
    }
    return settings;
}

static PyObject *
get_methods(PyObject *module, PyObject *nothing)
{
    PyObject *methods = PyDict_New();
    osdtex_method_info info;

    (void)module, (void)nothing;
    for (int32_t i = 0; methods && i < osdtex_method_count(); ++i)
    {
        PyObject *row;

        if (osdtex_method_get(i, &info) != OSDTEX_OK)
            continue;
        row = Py_BuildValue(
            "{sssssN}", "summary", info.summary, "source", info.source,
            "settings", settings_of(i, info.option_count));
        if (!row || PyDict_SetItemString(methods, info.name, row) < 0)
            Py_CLEAR(methods);
        Py_XDECREF(row);
    }
    return methods;
}

static PyObject *
take(const char *module, const char *name)
{
    PyObject *imported = PyImport_ImportModule(module);
    PyObject *found = imported ? PyObject_GetAttrString(imported, name) : NULL;

    Py_XDECREF(imported);
    return found;
}

opy_state *
opy_state_of(PyObject *module)
{
    return PyModule_GetState(module);
}

static bool
add_types(PyObject *module, opy_state *state)
{
    static PyType_Spec *const specs[OPY_TYPES] = {
        &opy_context_spec, &opy_cage_spec,     &opy_exemplar_spec,
        &opy_mapping_spec, &opy_textures_spec, &opy_seams_spec,
        &opy_lent_spec};

    for (int i = 0; i < OPY_TYPES; ++i)
    {
        state->types[i] = PyType_FromModuleAndSpec(module, specs[i], NULL);
        if (!state->types[i] ||
            PyModule_AddType(module, (PyTypeObject *)state->types[i]) < 0)
            return false;
    }
    return true;
}

static int
fill(PyObject *module)
{
    opy_state *state = opy_state_of(module);

    state->failed = take("osdtex.errors", "failed");
    state->finding = take("osdtex.errors", "Finding");
    state->loads = take("json", "loads");
    state->asarray = take("numpy", "asarray");
    state->contiguous = take("numpy", "ascontiguousarray");
    return state->failed && state->finding && state->loads && state->asarray &&
                   state->contiguous && add_types(module, state)
               ? 0
               : -1;
}

static int
traverse(PyObject *module, visitproc visit, void *arg)
{
    opy_state *state = opy_state_of(module);

    for (int i = 0; i < OPY_TYPES; ++i)
        Py_VISIT(state->types[i]);
    Py_VISIT(state->failed);
    Py_VISIT(state->finding);
    Py_VISIT(state->loads);
    Py_VISIT(state->asarray);
    Py_VISIT(state->contiguous);
    return 0;
}

static int
clear(PyObject *module)
{
    opy_state *state = opy_state_of(module);

    for (int i = 0; i < OPY_TYPES; ++i)
        Py_CLEAR(state->types[i]);
    Py_CLEAR(state->failed);
    Py_CLEAR(state->finding);
    Py_CLEAR(state->loads);
    Py_CLEAR(state->asarray);
    Py_CLEAR(state->contiguous);
    return 0;
}

static PyMethodDef METHODS[] = {
    {"version", get_version, METH_NOARGS, "Of the library that is running."},
    {"build", get_build, METH_NOARGS, "Which build of it that is."},
    {"methods", get_methods, METH_NOARGS, "Ways to texture, by their names."},
    {NULL, NULL, 0, NULL}};

static PyModuleDef_Slot SLOTS[] = {{Py_mod_exec, fill}, {0, NULL}};

static struct PyModuleDef DEFINITION = {
    PyModuleDef_HEAD_INIT,
    .m_name = "osdtex._osdtex",
    .m_doc = "The library behind the package osdtex.",
    .m_size = sizeof(opy_state),
    .m_methods = METHODS,
    .m_slots = SLOTS,
    .m_traverse = traverse,
    .m_clear = clear,
};

PyMODINIT_FUNC PyInit__osdtex(void);

PyMODINIT_FUNC
PyInit__osdtex(void)
{
    return PyModuleDef_Init(&DEFINITION);
}

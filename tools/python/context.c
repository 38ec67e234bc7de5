/* context.c -- a context: the calls that are made with it, what they find, and
 * who may stop them. */
#include "binding.h"
#include "options.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const opy_option OPTIONS[] = {
    {"threads", OPY_INT, offsetof(osdtex_context_options, threads), NULL},
    {"colorconfig", OPY_PATH, offsetof(osdtex_context_options, colorconfig),
     NULL},
    {NULL, 0, 0, NULL}};

static void *
allocate(void *user, size_t bytes)
{
    opy_context *c = user;
    void *block = malloc(bytes);

    if (block)
        atomic_fetch_add(&c->held, (long long)bytes);
    return block;
}

static void
release(void *user, void *block, size_t bytes)
{
    opy_context *c = user;

    if (block)
        atomic_fetch_sub(&c->held, (long long)bytes);
    free(block);
}

/* What a callback raised is raised again when the call has returned. */
static void
keep_raised(opy_context *c)
{
    if (!c->raised[0])
        PyErr_Fetch(&c->raised[0], &c->raised[1], &c->raised[2]);
    else
        PyErr_Clear();
}

/* Whether the call goes on. Ctrl-C ends it too. */
static bool
ask(opy_context *c, const char *stage, double fraction)
{
    PyObject *answer;
    bool goes_on = true;

    if (PyErr_CheckSignals() < 0)
        keep_raised(c);
    if (c->raised[0])
        return false;
    if (!c->progress)
        return true;
    answer = PyObject_CallFunction(c->progress, "sd", stage, fraction);
    if (!answer)
        keep_raised(c);
    goes_on = answer && answer != Py_False;
    Py_XDECREF(answer);
    return goes_on;
}

static bool
show_progress(void *user, const char *stage, double fraction)
{
    opy_context *c = user;
    bool goes_on;

    if (atomic_load(&c->is_cancelled))
        return false;
    PyEval_RestoreThread(c->thread);
    goes_on = ask(c, stage, fraction);
    c->thread = PyEval_SaveThread();
    return goes_on;
}

/* A finding as osdtex.errors.Finding. */
static PyObject *
finding_of(const opy_context *c, const osdtex_diagnostic *d)
{
    static const char *const severities[] = {"info", "warning", "error"};

    return PyObject_CallFunction(
        c->state->finding, "ssNNLiiLN", severities[d->severity],
        osdtex_status_name(d->status), opy_text(d->stage), opy_text(d->file),
        (long long)d->line, (int)d->face, (int)d->vertex, (long long)d->count,
        opy_text(d->message));
}

static void
tell(void *user, const osdtex_diagnostic *d)
{
    opy_context *c = user;
    PyObject *finding, *answer = NULL;

    PyEval_RestoreThread(c->thread);
    finding = c->log ? finding_of(c, d) : NULL;
    if (finding)
        answer = PyObject_CallFunctionObjArgs(c->log, finding, NULL);
    if (PyErr_Occurred())
        keep_raised(c);
    Py_XDECREF(answer);
    Py_XDECREF(finding);
    c->thread = PyEval_SaveThread();
}

/* The findings from `first` on. */
static PyObject *
findings_from(const opy_context *c, int32_t first)
{
    PyObject *list = PyList_New(0);
    osdtex_diagnostic d;

    for (int32_t i = first; list && i < osdtex_diagnostic_count(c->handle); ++i)
    {
        PyObject *one = osdtex_diagnostic_get(c->handle, i, &d) == OSDTEX_OK
                            ? finding_of(c, &d)
                            : NULL;

        if (!one || PyList_Append(list, one) < 0)
            Py_CLEAR(list);
        Py_XDECREF(one);
    }
    return list;
}

static void
raise_failure(opy_context *c, osdtex_status status)
{
    PyObject *finding = finding_of(c, osdtex_context_error(c->handle));
    PyObject *findings = finding ? findings_from(c, c->found) : NULL;
    PyObject *error = findings
                          ? PyObject_CallFunction(
                                c->state->failed, "sOO",
                                osdtex_status_name(status), finding, findings)
                          : NULL;

    if (error)
        PyErr_SetObject((PyObject *)Py_TYPE(error), error);
    Py_XDECREF(error);
    Py_XDECREF(findings);
    Py_XDECREF(finding);
}

bool
opy_enter(opy_context *c)
{
    if (!c->handle)
    {
        PyErr_SetString(PyExc_ValueError, "the context is closed");
        return false;
    }
    if (c->is_busy)
    {
        PyErr_SetString(
            PyExc_RuntimeError,
            "the context is at work: each thread takes a Context of its own, "
            "and callbacks may not use theirs");
        return false;
    }
    c->is_busy = true;
    c->found = osdtex_diagnostic_count(c->handle);
    c->thread = PyEval_SaveThread();
    return true;
}

bool
opy_leave(opy_context *c, osdtex_status status)
{
    PyEval_RestoreThread(c->thread);
    c->is_busy = false;
    atomic_store(&c->is_cancelled, false);
    if (c->raised[0])
    {
        PyErr_Restore(c->raised[0], c->raised[1], c->raised[2]);
        memset(c->raised, 0, sizeof c->raised);
        return false;
    }
    if (status == OSDTEX_OK)
        return true;
    raise_failure(c, status);
    return false;
}

/* A callable of the keyword arguments, taken out of them. */
static bool
take_callable(PyObject *kwargs, const char *name, PyObject **out)
{
    PyObject *value = kwargs ? PyDict_GetItemString(kwargs, name) : NULL;

    if (!value)
        return true;
    if (value != Py_None && !PyCallable_Check(value))
    {
        PyErr_Format(
            PyExc_TypeError, "%s is called, so must be callable", name);
        return false;
    }
    if (value != Py_None)
    {
        Py_INCREF(value);
        *out = value;
    }
    return PyDict_DelItemString(kwargs, name) == 0;
}

/* As the program: three quarters of the machine's memory. 0 is no limit. */
static bool
take_limit(PyObject *kwargs, size_t *out)
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGE_SIZE);
    PyObject *value =
        kwargs ? PyDict_GetItemString(kwargs, "memory_limit") : NULL;

    if (pages > 0 && page > 0)
        *out = (size_t)pages / 4 * 3 * (size_t)page;
    if (!value)
        return true;
    if (value != Py_None)
        *out = PyLong_AsSize_t(value);
    return !PyErr_Occurred() &&
           PyDict_DelItemString(kwargs, "memory_limit") == 0;
}

/* Options to a context; false and an exception. */
static bool
open_context(opy_context *c, PyObject *kwargs, PyObject *keep)
{
    osdtex_context_options options = osdtex_context_options_default();
    osdtex_status status;

    options.alloc = allocate;
    options.release = release;
    options.progress = show_progress;
    options.alloc_user = options.progress_user = options.log_user = c;
    if (!take_callable(kwargs, "progress", &c->progress) ||
        !take_callable(kwargs, "log", &c->log) ||
        !take_limit(kwargs, &options.memory_limit) ||
        !opy_options_read(OPTIONS, kwargs, &options, keep))
        return false;
    options.log = c->log ? tell : NULL;
    status = osdtex_context_create(&options, &c->handle);
    if (status == OSDTEX_ERROR_ARGUMENT)
        PyErr_SetString(PyExc_ValueError, "threads are 0 (all cores) to 256");
    else if (status != OSDTEX_OK)
        PyErr_NoMemory();
    return status == OSDTEX_OK;
}

static PyObject *
context_new(PyTypeObject *type, PyObject *args, PyObject *kwargs)
{
    allocfunc make = (allocfunc)PyType_GetSlot(type, Py_tp_alloc);
    opy_context *c = (opy_context *)make(type, 0);
    PyObject *keep = PyList_New(0);
    PyObject *words = kwargs ? PyDict_Copy(kwargs) : NULL;
    bool is_open = false;

    if (c && keep && PyTuple_Size(args) > 0)
        PyErr_SetString(PyExc_TypeError, "a context takes keywords only");
    else if (c && keep && (words || !kwargs))
    {
        /* A class in Python may be derived from ours: ask for our module. */
        PyObject *module = PyImport_ImportModule("osdtex._osdtex");

        c->state = module ? opy_state_of(module) : NULL;
        Py_XDECREF(module);
        is_open = c->state && open_context(c, words, keep);
    }
    Py_XDECREF(words);
    Py_XDECREF(keep);
    if (!is_open)
        Py_CLEAR(c);
    return (PyObject *)c;
}

static int
context_init(PyObject *self, PyObject *args, PyObject *kwargs)
{
    (void)self, (void)args, (void)kwargs;
    return 0;
}

static int
context_traverse(PyObject *self, visitproc visit, void *arg)
{
    opy_context *c = (opy_context *)self;

    Py_VISIT(Py_TYPE(self));
    Py_VISIT(c->progress);
    Py_VISIT(c->log);
    return 0;
}

static int
context_clear(PyObject *self)
{
    opy_context *c = (opy_context *)self;

    Py_CLEAR(c->progress);
    Py_CLEAR(c->log);
    return 0;
}

static void
context_dealloc(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    freefunc release_object = (freefunc)PyType_GetSlot(type, Py_tp_free);

    PyObject_GC_UnTrack(self);
    osdtex_context_destroy(((opy_context *)self)->handle);
    context_clear(self);
    release_object(self);
    Py_DECREF(type);
}

static PyObject *
context_close(PyObject *self, PyObject *nothing)
{
    opy_context *c = (opy_context *)self;

    (void)nothing;
    if (c->is_busy)
    {
        PyErr_SetString(PyExc_RuntimeError, "the context is at work");
        return NULL;
    }
    osdtex_context_destroy(c->handle);
    c->handle = NULL;
    Py_RETURN_NONE;
}

static PyObject *
context_enter(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    Py_INCREF(self);
    return self;
}

static PyObject *
context_exit(PyObject *self, PyObject *args)
{
    (void)args;
    return context_close(self, NULL);
}

static PyObject *
context_cancel(PyObject *self, PyObject *nothing)
{
    opy_context *c = (opy_context *)self;

    (void)nothing;
    if (c->is_busy)
        atomic_store(&c->is_cancelled, true);
    Py_RETURN_NONE;
}

static PyObject *
context_forget(PyObject *self, PyObject *nothing)
{
    opy_context *c = (opy_context *)self;
    osdtex_status status;

    (void)nothing;
    if (!opy_enter(c))
        return NULL;
    status = osdtex_diagnostic_clear(c->handle);
    c->found = 0;
    if (!opy_leave(c, status))
        return NULL;
    Py_RETURN_NONE;
}

/* A set of files begins, is marked, and ends; osdtex.Context.outputs() is made
 * of these. */
static PyObject *
context_begin(PyObject *self, PyObject *args)
{
    opy_context *c = (opy_context *)self;
    const char *job, *source;
    osdtex_status status;

    if (!PyArg_ParseTuple(args, "zz", &job, &source) || !opy_enter(c))
        return NULL;
    status = osdtex_outputs_begin(c->handle);
    if (status == OSDTEX_OK && (job || source))
        status = osdtex_outputs_mark(c->handle, job, source);
    if (!opy_leave(c, status))
        return NULL;
    Py_RETURN_NONE;
}

static PyObject *
context_commit(PyObject *self, PyObject *nothing)
{
    opy_context *c = (opy_context *)self;
    osdtex_status status;

    (void)nothing;
    if (!opy_enter(c))
        return NULL;
    status = osdtex_outputs_commit(c->handle);
    if (!opy_leave(c, status))
        return NULL;
    Py_RETURN_NONE;
}

static PyObject *
context_drop(PyObject *self, PyObject *nothing)
{
    opy_context *c = (opy_context *)self;

    (void)nothing;
    if (!opy_enter(c))
        return NULL;
    osdtex_outputs_drop(c->handle);
    if (!opy_leave(c, OSDTEX_OK))
        return NULL;
    Py_RETURN_NONE;
}

static PyObject *
get_findings(PyObject *self, void *unused)
{
    opy_context *c = (opy_context *)self;

    (void)unused;
    if (c->handle && !c->is_busy)
        return findings_from(c, 0);
    PyErr_SetString(
        PyExc_ValueError,
        "the context is closed, or at work in another thread");
    return NULL;
}

static PyObject *
get_held(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromLongLong(atomic_load(&((opy_context *)self)->held));
}

static PyMethodDef METHODS[] = {
    {"read_cage", (PyCFunction)(void (*)(void))opy_read_cage,
     METH_VARARGS | METH_KEYWORDS, "Reads a cage, an OBJ."},
    {"_make_cage", (PyCFunction)(void (*)(void))opy_make_cage,
     METH_VARARGS | METH_KEYWORDS, "A cage of flat arrays."},
    {"read_exemplar", (PyCFunction)(void (*)(void))opy_read_exemplar,
     METH_VARARGS | METH_KEYWORDS, "Reads a picture: EXR, PNG, TIFF, JPEG."},
    {"exemplar", (PyCFunction)(void (*)(void))opy_make_exemplar,
     METH_VARARGS | METH_KEYWORDS, "An exemplar of pixels, bottom row first."},
    {"map", (PyCFunction)(void (*)(void))opy_map, METH_VARARGS | METH_KEYWORDS,
     "Covers a cage with an exemplar."},
    {"read_mapping", (PyCFunction)(void (*)(void))opy_read_mapping,
     METH_VARARGS | METH_KEYWORDS, "Reads a saved mapping."},
    {"cancel", context_cancel, METH_NOARGS,
     "Stops the call at work, from another thread."},
    {"clear", context_forget, METH_NOARGS, "Forgets all findings."},
    {"close", context_close, METH_NOARGS, "Ends the context's threads."},
    {"_begin", context_begin, METH_VARARGS, "Begins a set of files."},
    {"_commit", context_commit, METH_NOARGS, "Gives a set its names."},
    {"_drop", context_drop, METH_NOARGS, "Ends a set without its files."},
    {"__enter__", context_enter, METH_NOARGS, NULL},
    {"__exit__", context_exit, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL}};

static PyGetSetDef FIELDS[] = {
    {"findings", get_findings, NULL, "All findings so far.", NULL},
    {"held_bytes", get_held, NULL,
     "Memory of the context and of what was made with it.", NULL},
    {NULL, NULL, NULL, NULL, NULL}};

static PyType_Slot SLOTS[] = {
    {Py_tp_doc, "Memory, threads, colour, and where findings go."},
    {Py_tp_new, context_new},
    {Py_tp_init, context_init},
    {Py_tp_dealloc, context_dealloc},
    {Py_tp_traverse, context_traverse},
    {Py_tp_clear, context_clear},
    {Py_tp_methods, METHODS},
    {Py_tp_getset, FIELDS},
    {0, NULL}};

PyType_Spec opy_context_spec = {
    "osdtex._osdtex.Context", sizeof(opy_context), 0,
    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_BASETYPE, SLOTS};

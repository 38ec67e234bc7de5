/* binding.h -- what the parts of the Python module share.
 *
 * The module is made of the public headers alone, and of the part of Python
 * that stays the same from 3.11 on (the limited API): one build serves all
 * later versions. Objects hold what they were made with, so that whatever order
 * Python frees them in, a handle goes before the context that counts its bytes.
 *
 *     if (!opy_enter(c))                       // the GIL is released
 *         return NULL;
 *     status = osdtex_cage_read(c->handle, path, &options, &cage);
 *     if (!opy_leave(c, status))               // held again; the exception set
 *         return NULL;
 */
#ifndef OPY_BINDING_H
#define OPY_BINDING_H

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030b0000
#include <Python.h>

#include <osdtex/osdtex.h>

#include <stdatomic.h>

typedef enum opy_type
{
    OPY_CONTEXT,
    OPY_CAGE,
    OPY_EXEMPLAR,
    OPY_MAPPING,
    OPY_TEXTURES,
    OPY_SEAMS,
    OPY_LENT,
    OPY_TYPES
} opy_type;

/* What belongs to the module, instead of globals. */
typedef struct opy_state
{
    PyObject *types[OPY_TYPES];
    PyObject *failed;     /* osdtex.errors.failed(status, finding, findings) */
    PyObject *finding;    /* osdtex.errors.Finding */
    PyObject *asarray;    /* numpy.asarray */
    PyObject *contiguous; /* numpy.ascontiguousarray */
    PyObject *loads;      /* json.loads */
} opy_state;

typedef struct opy_context
{
    PyObject_HEAD opy_state *state; /* lives as long as the type does */
    osdtex_context *handle;         /* NULL once closed */
    PyObject *progress, *log;       /* NULL none */
    PyThreadState *thread;          /* of the call at work */
    PyObject *raised[3]; /* what a callback raised: type, value, traceback */
    bool is_busy;
    int32_t found; /* findings before the call */
    atomic_bool is_cancelled;
    atomic_llong held; /* bytes of all handles that were made with it */
} opy_context;

/* Any other object: a handle of the library's, or memory that one lends. */
typedef struct opy_handle
{
    PyObject_HEAD opy_context *context;
    opy_type type;
    void *handle;     /* destroyed by its type */
    const void *info; /* what `describe` lends */
} opy_handle;

/* The state of the module that an object of ours is of. */
opy_state *opy_state_of(PyObject *module);

/* Begins a call of the library: false and an exception where the context is
 * closed or at work. The GIL is released until opy_leave(). */
bool opy_enter(opy_context *c);
/* Ends it. False and an exception where it failed, or a callback raised. */
bool opy_leave(opy_context *c, osdtex_status status);

/* Wraps a handle, which is the object's from here on, also on failure.
 *
 *   info  what its describe function lends; NULL none */
PyObject *
opy_handle_new(opy_context *c, opy_type type, void *handle, const void *info);

/* `object` as one of a type, borrowed; NULL and TypeError for others. */
opy_handle *opy_handle_of(opy_state *state, PyObject *object, opy_type type);

/* Text of the library's, which may hold bytes of a file: None for NULL. */
PyObject *opy_text(const char *text);

/* Getters of rows {"name", opy_get_text, NULL, "what", OPY_AT(struct, field)}:
 * a field of what `describe` lends. */
#define OPY_AT(info, field) ((void *)offsetof(info, field))
PyObject *opy_get_text(PyObject *self, void *offset);
PyObject *opy_get_int(PyObject *self, void *offset);
PyObject *opy_get_flag(PyObject *self, void *offset);
PyObject *opy_get_real(PyObject *self, void *offset);
PyObject *opy_get_reals3(PyObject *self, void *offset);

/* A read-only NumPy array over memory that `owner` keeps.
 *
 *   format   of an element, as the struct module names it: "f", "i", "B"
 *   rows     of the array
 *   columns  0: it has one dimension */
PyObject *opy_array_lend(
    opy_handle *owner, const void *data, const char *format, Py_ssize_t rows,
    Py_ssize_t columns);

/* The types. */
extern PyType_Spec opy_context_spec;
extern PyType_Spec opy_cage_spec;
extern PyType_Spec opy_exemplar_spec;
extern PyType_Spec opy_mapping_spec;
extern PyType_Spec opy_textures_spec;
extern PyType_Spec opy_seams_spec;
extern PyType_Spec opy_lent_spec;

/* Methods of the context that make handles. */
PyObject *opy_read_cage(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_make_cage(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_read_exemplar(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_make_exemplar(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_map(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_read_mapping(PyObject *self, PyObject *args, PyObject *kwargs);
/* The comment that the program writes into its files, kept in a list. */
const char *opy_comment(PyObject *keep);

/* Of a mapping. */
PyObject *opy_textures(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_bake(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_render(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_edit(PyObject *self, PyObject *args, PyObject *kwargs);
PyObject *opy_seams(PyObject *self, PyObject *args, PyObject *kwargs);

/* For handles. */
void opy_handle_dealloc(PyObject *self);
int opy_handle_traverse(PyObject *self, visitproc visit, void *arg);

#endif

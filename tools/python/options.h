/* options.h -- keyword arguments to structs of options, by tables.
 *
 *     static const opy_option OPTIONS[] = {
 *         {"scheme", OPY_CHOICE, offsetof(osdtex_cage_options, scheme),
 * SCHEMES},
 *         {"weld", OPY_REAL, offsetof(osdtex_cage_options, weld), NULL},
 *         {NULL, 0, 0, NULL}};
 *
 * None leaves the default. What texts and arrays need lives in a list, which
 * the caller drops when the call has been made. */
#ifndef OPY_OPTIONS_H
#define OPY_OPTIONS_H

#include "binding.h"

typedef enum opy_kind
{
    OPY_TEXT,     /* const char * */
    OPY_PATH,     /* const char *, of a str, bytes or os.PathLike */
    OPY_REAL,     /* double */
    OPY_REALS,    /* double[4] */
    OPY_REALS3,   /* double[3] */
    OPY_INT,      /* int32_t */
    OPY_SEED,     /* uint64_t */
    OPY_SWITCH,   /* int32_t, of a bool */
    OPY_CHOICE,   /* int32_t: the place of a word among the choices */
    OPY_BITS,     /* uint32_t: a list of them */
    OPY_LEVEL,    /* int32_t, of a number or "auto" */
    OPY_HEAL,     /* double, of a number or "auto" */
    OPY_SETTINGS, /* osdtex_setting * and, behind it, an int32_t of how many */
    OPY_MAPS      /* osdtex_companion * and such a count */
} opy_kind;

typedef struct opy_option
{
    const char *name; /* NULL ends the table */
    opy_kind kind;
    size_t offset;              /* into the struct */
    const char *const *choices; /* NULL-terminated */
} opy_option;

/* Reads keyword arguments into a struct.
 *
 *   kwargs  a dictionary, or NULL
 *   keep    a list, which gets what the struct points to
 *
 * False and TypeError (no such option, with all there are) or ValueError. */
bool opy_options_read(
    const opy_option *table, PyObject *kwargs, void *out, PyObject *keep);

/* The option `constraints` where it is a list of dictionaries, taken out of the
 * keywords; a path stays. What they point to lives in the list. False and
 * TypeError or ValueError. */
bool opy_take_constraints(
    PyObject *words, PyObject *keep, const osdtex_constraint **items,
    int32_t *count);

/* The bytes of a path in the file system's encoding, kept in a list. */
const char *opy_path_of(PyObject *path, PyObject *keep);

/* Memory of zeros that lives as long as the list. */
void *opy_keep_bytes(PyObject *keep, size_t bytes);

#endif

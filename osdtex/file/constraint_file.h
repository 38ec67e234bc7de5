/* constraint_file.h -- constraints on fields, as JSON or CSV.
 *
 * The formats are described in docs/formats-constraints.md. What is read is
 * well-formed and finite; whether faces are there is for those who know the
 * cage. */
#ifndef OTX_FILE_CONSTRAINT_FILE_H
#define OTX_FILE_CONSTRAINT_FILE_H

#include "base/run.h"

typedef struct otx_constraint_line
{
    int32_t face; /* 0-based, -1: at the point */
    double point[3];
    double radius;
    bool has_direction;
    double direction[3];
    double scale; /* 0 says nothing */
    bool has_material;
    double material;
    int32_t exemplar;          /* from 1; 0 says nothing */
    const char *exemplar_name; /* NULL none; at most one of the two */
    double reach;              /* 0 says nothing, as the two below */
    int32_t edit, redo;
} otx_constraint_line;

typedef struct otx_constraint_file
{
    const char *path;
    int32_t symmetry;     /* 0 none said */
    const char *follow;   /* "axis", "up", "edges" or "curvature"; NULL none */
    double axis[3];       /* of "axis" */
    double follow_length; /* 0 none said */
    bool is_table;        /* a CSV: a line a face */
    int32_t count;
    otx_constraint_line *lines;
} otx_constraint_file;

/* Reads `path`, CSV where its name ends so, else JSON. In run->arena. FORMAT,
 * naming line or constraint; LIMIT past 64 MiB, IO, MEMORY. */
otx_status otx_constraint_file_read(
    otx_run *run, const char *path, otx_constraint_file *out);

/* The same of JSON text that `path` holds somewhere. */
otx_status otx_constraint_file_parse(
    otx_run *run, const char *path, const char *json, otx_constraint_file *out);

#endif

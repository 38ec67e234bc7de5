/* place_file.h -- pictures that are to be placed, as JSON or CSV.
 *
 * The formats are described in docs/formats-place.md. What is read is
 * well-formed and finite; whether faces and pictures are there is for those who
 * know them. */
#ifndef OTX_FILE_PLACE_FILE_H
#define OTX_FILE_PLACE_FILE_H

#include "base/run.h"

enum
{
    OTX_PLACE_SCATTER_MAX = 10000
};

/* One picture at one place: a list of places is as many of them. */
typedef struct otx_place_line
{
    const char *picture; /* as it is found from where the program runs */
    const char *from;    /* colour space; NULL: by the stated rules */
    int32_t number;      /* of the file's items, from 1 */
    int32_t face; /* of the cage, from 0; -1: at the point, or anywhere */
    double point[3];
    int32_t scatter; /* how many, anywhere; 0: at the face or the point */
    double width;    /* scene units */
    double height;   /* scene units; 0: as the picture's sides ask for */
    bool has_up;
    double up[3];
    double turn; /* degrees */
    bool mirror;
    double opacity;
    double anchor[2];
} otx_place_line;

typedef struct otx_place_file
{
    const char *path;
    int32_t count;
    otx_place_line *lines;
} otx_place_file;

/* Reads `path`, CSV where its name ends so, else JSON. In run->arena. FORMAT,
 * naming line or item; LIMIT past 64 MiB, IO, MEMORY. */
otx_status
otx_place_file_read(otx_run *run, const char *path, otx_place_file *out);

#endif

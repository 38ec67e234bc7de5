/* reference.h -- what the cases of a suite are held against.
 *
 *     DIR/reference/exact.json    hashes, with the class of machine
 *     DIR/reference/results.csv   case,metric,value
 *     DIR/reference/CASE.png      the picture
 *
 * Texts in a fixed order, so that a commit shows what changed. */
#ifndef OTX_REGRESS_REFERENCE_H
#define OTX_REGRESS_REFERENCE_H

#include "regress/suite.h"

enum
{
    OTX_REFERENCE_MACHINE_BYTES = 80
};

typedef struct otx_reference
{
    char folder[OTX_SUITE_PATH_BYTES];
    json_t *exact;   /* case -> {machine, files: {name: hash}} */
    json_t *metrics; /* case -> {name: value} */
} otx_reference;

/* A file that is not there has no references in it. */
bool otx_reference_read(
    const char *suite_folder, otx_reference *out,
    char error[OTX_SUITE_ERROR_BYTES]);
/* Both texts; the folder is made where there is none. */
bool otx_reference_write(
    const otx_reference *reference, char error[OTX_SUITE_ERROR_BYTES]);
void otx_reference_free(otx_reference *reference);

/* Where the picture of a case is. */
void otx_reference_picture(
    const otx_reference *reference, const char *name,
    char path[OTX_SUITE_PATH_BYTES]);

/* Case -> {name: value} as the lines of a CSV, cases and names in order. */
bool otx_reference_put_csv(const json_t *metrics, const char *path);

/* Copies a file; what was at `to` is replaced in one step. */
bool otx_reference_copy(const char *from, const char *to);

/* What exact results may depend on besides the program: the instruction set
 * that libraries choose by, and the C library with its elementary functions.
 */
void otx_reference_machine(char text[OTX_REFERENCE_MACHINE_BYTES]);

#endif

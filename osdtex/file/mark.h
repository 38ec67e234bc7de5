/* mark.h -- by which job a file was written, and whether it is whole.
 *
 * A mark is one line of printable ASCII that every format can hold, in a
 * comment or an attribute near the beginning of the file:
 *
 *     osdtex job 0123456789abcdef0123456789abcdef of shirt.obj seal 89ab...
 *
 * The job is a hash of all that the content depends on, `of` the name of what
 * it was made from. The seal is the hash of the whole file with zeros in the
 * seal's place: it is set when the file is finished, and tells a file that was
 * cut short, damaged or edited from one that is as it was written. */
#ifndef OTX_FILE_MARK_H
#define OTX_FILE_MARK_H

#include "base/hash.h"
#include "base/status.h"

enum
{
    OTX_MARK_SOURCE_BYTES = 81,
    OTX_MARK_BYTES = 256
};

typedef struct otx_mark
{
    char job[OTX_HASH_TEXT_BYTES];      /* "" none */
    char source[OTX_MARK_SOURCE_BYTES]; /* "" not known */
} otx_mark;

/* Sets the source to a name that fits into a mark: that of a file without its
 * folder, with `_` for what is not a letter, digit, '.', '_' or a single '-'.
 * A name that had to be changed gets a hash at its end. */
void otx_mark_set_source(otx_mark *mark, const char *path);

/* The line, with zeros for the seal; "" for NULL, which stands for no mark. */
void otx_mark_print(const otx_mark *mark, char text[OTX_MARK_BYTES]);

/* Sets the seal of a finished file; nothing where the file has none. Returns 0
 * or an error number. */
int otx_mark_seal(const char *path);

/* What a file says of itself. */
typedef struct otx_mark_found
{
    otx_mark mark;
    bool has_seal;
    bool is_whole; /* the seal is right; only where it was asked for */
} otx_mark_found;

/* Looks for the mark of a file. False when there is none.
 *
 *   check_seal  reads the whole file */
bool otx_mark_read(const char *path, bool check_seal, otx_mark_found *out);

#endif

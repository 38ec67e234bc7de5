/* text_out.h -- buffered text output with locale-free numbers.
 *
 * The first failing write is remembered and the rest is swallowed, so a writer
 * checks once, when it closes. */
#ifndef OTX_FILE_TEXT_OUT_H
#define OTX_FILE_TEXT_OUT_H

#include "base/run.h"
#include "file/mark.h"

typedef struct otx_text_out otx_text_out;

/* Opens `path` for writing; it is truncated. The stream lives in run->scratch,
 * whose release closes it when `otx_text_out_close` was not reached.
 *
 *   stage  for messages
 *   name   the file as the user knows it, NULL for `path` */
otx_status otx_text_out_open(
    otx_run *run, const char *stage, const char *path, const char *name,
    otx_text_out **out);

void otx_text_out_bytes(otx_text_out *out, const char *bytes, size_t count);
void otx_text_out_string(otx_text_out *out, const char *text);
void otx_text_out_char(otx_text_out *out, char c);
void otx_text_out_int(otx_text_out *out, int64_t value);
/* The shortest decimal that reads back as the same float. */
void otx_text_out_float(otx_text_out *out, float value);
void otx_text_out_double(otx_text_out *out, double value);
/* The decimal with the fewest places that, less `origin`, is `value`: a number
 * that is kept relative to an origin, put back. With an origin of zero the
 * shortest of the float. */
void otx_text_out_placed(otx_text_out *out, float value, double origin);
/* A name as it can stand in a line: control characters become `_`, and so do
 * blanks unless they may stay. */
void otx_text_out_name(otx_text_out *out, const char *name, bool blanks);

/* A line for the mark, between what makes it a comment; nothing for NULL. */
void otx_text_out_mark(
    otx_text_out *out, const otx_mark *mark, const char *before,
    const char *after);

/* Flushes and closes. IO for the first write that failed, in words for a full
 * disk. */
otx_status otx_text_out_close(otx_run *run, otx_text_out *out);

#endif

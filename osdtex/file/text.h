/* text.h -- a text file as lines and tokens.
 *
 * The whole file is in memory. Lines end with LF, CRLF or a lone CR; the last
 * needs no end; there is no limit to their length. A line that ends with a
 * backslash goes on in the next one, unless it is a comment. Tokens are
 * separated by blanks and point into the file: nothing is copied. */
#ifndef OTX_FILE_TEXT_H
#define OTX_FILE_TEXT_H

#include "base/run.h"

typedef struct otx_token
{
    const char *begin, *end;
} otx_token;

typedef struct otx_text
{
    otx_run *run;
    const char *stage; /* for messages */
    const char *name;
    char *bytes, *end; /* the file, without a byte-order mark */

    int64_t line;   /* of `rest`: 1-based, where a joined line begins */
    otx_token rest; /* what has not been taken of the current line */
    char *next;     /* first byte of the next line */
    int64_t next_line;
} otx_text;

enum
{
    OTX_TEXT_QUOTE_BYTES = 48
};

/* A token made fit to print: shortened, and without control characters. */
typedef struct otx_text_quote
{
    char text[OTX_TEXT_QUOTE_BYTES];
} otx_text_quote;

/* Reads `path` into run->scratch and stands before its first line.
 *
 *   stage        for messages
 *   limit_bytes  LIMIT when the file is larger
 *
 * IO when it is missing, a folder or not readable; FORMAT when it is empty or
 * no text in UTF-8 (or ASCII, or another superset of it). */
otx_status otx_text_read(
    otx_run *run, const char *stage, const char *path, size_t limit_bytes,
    otx_text *out);

/* The same from memory, which is copied into run->scratch. */
otx_status otx_text_open(
    otx_run *run, const char *stage, const char *name, const char *bytes,
    size_t size, otx_text *out);

/* Back to before the first line. */
void otx_text_rewind(otx_text *text);

/* Moves to the next line; false behind the last. */
bool otx_text_next(otx_text *text);

/* Takes the next token of the line; false at its end or at a `#`. */
bool otx_text_token(otx_text *text, otx_token *out);

/* How many tokens are left in the line. */
int64_t otx_text_count(const otx_text *text);

/* Takes the rest of the line without the blanks around it. */
otx_token otx_text_remainder(otx_text *text);

/* Takes the next token as a number. FORMAT with the line when there is none,
 * or it is no finite number, or out of range; `what` names it in the message
 * ("x coordinate"). */
otx_status otx_text_float(otx_text *text, const char *what, float *value);
otx_status otx_text_parse_float(
    const otx_text *text, otx_token token, const char *what, float *value);
/* Of those that a float can have, but with a double's digits. */
otx_status otx_text_parse_double(
    const otx_text *text, otx_token token, const char *what, double *value);
otx_status otx_text_parse_int(
    const otx_text *text, otx_token token, const char *what, int64_t *value);

/* Whether the token reads `word`, and a hash that agrees with it. */
bool otx_token_is(otx_token token, const char *word);
uint32_t otx_token_hash(otx_token token);
otx_text_quote otx_token_quote(otx_token token);

/* Copies a token and ends it with a NUL; NULL when memory is out. */
char *otx_token_copy(otx_arena *arena, otx_token token);

/* The current line, for messages. */
otx_where otx_text_where(const otx_text *text);

#endif

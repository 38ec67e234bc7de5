/* value.h -- the values of flags from text. All return false without a word
 * when the text does not fit; the program never calls setlocale, so numbers
 * have a decimal point. */
#ifndef OTX_CLI_VALUE_H
#define OTX_CLI_VALUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A finite number. */
bool otx_value_real(const char *text, double *out);
bool otx_value_int(const char *text, int64_t low, int64_t high, int64_t *out);
/* `count` numbers with commas between. */
bool otx_value_reals(const char *text, int count, double *out);
/* Bytes, with K, M, G or T for powers of 1024. */
bool otx_value_bytes(const char *text, size_t *out);
/* Index of one of `count` words. */
bool
otx_value_word(const char *text, const char *const *words, int count, int *out);
/* Whether `path` ends in `extension`, in upper or lower case. */
bool otx_value_has_extension(const char *path, const char *extension);

/* FILE of the text "map:FILE" or "-map:FILE"; NULL where it is none. */
const char *otx_value_map_of(const char *text);

#endif

/* charconv.h -- numbers from and to text, whatever the locale is.
 *
 * The library is loaded into programs that call setlocale, where strtod and
 * printf read and write a decimal comma. C has no function that does not look
 * at the locale; C++17's <charconv> has, is exact, and prints the shortest
 * text that reads back as the same number. */
#ifndef OTX_BRIDGE_CHARCONV_H
#define OTX_BRIDGE_CHARCONV_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

    enum
    {
        OTX_CHARCONV_BYTES = 32 /* enough for any number that is printed here */
    };

    typedef enum otx_charconv_result
    {
        OTX_CHARCONV_OK,
        OTX_CHARCONV_MALFORMED, /* no number starts here */
        OTX_CHARCONV_OVERFLOW   /* a number, too large for the type */
    } otx_charconv_result;

    /* Reads the longest number that starts at `begin` and ends by `end`, and
     * sets *rest behind it. A leading '+', ".5", "5.", "1e5", "inf" and "nan"
     * are numbers; blanks are not skipped. What is too small becomes zero of
     * its sign. *value and *rest are untouched when it is malformed, *value on
     * overflow. */
    otx_charconv_result otx_charconv_read_float(
        const char *begin, const char *end, float *value, const char **rest);
    otx_charconv_result otx_charconv_read_double(
        const char *begin, const char *end, double *value, const char **rest);
    otx_charconv_result otx_charconv_read_int(
        const char *begin, const char *end, int64_t *value, const char **rest);

    /* Writes `value` without a final NUL and returns how many bytes that took.
     */
    size_t otx_charconv_print_float(char text[OTX_CHARCONV_BYTES], float value);
    size_t
    otx_charconv_print_double(char text[OTX_CHARCONV_BYTES], double value);
    /* With exactly that many decimals; the shortest where they do not fit. */
    size_t otx_charconv_print_fixed(
        char text[OTX_CHARCONV_BYTES], double value, int decimals);
    size_t otx_charconv_print_int(char text[OTX_CHARCONV_BYTES], int64_t value);

#ifdef __cplusplus
}
#endif
#endif

/* charconv.cpp -- std::from_chars and std::to_chars behind a C face.
 *
 * They allocate and throw nothing for these types; `noexcept` on the two
 * templates below holds them to it. */
#include "bridge/charconv.h"

#include <charconv>
#include <type_traits>

namespace
{

/* Whether the decimal number [at, end), known to be out of range, is so
 * because it is too small: from_chars does not tell. The number is
 * 0.d… * 10^(magnitude + exponent) with d its first digit that is not zero,
 * and the ranges of float and double end far from a power of 0. */
bool
is_tiny(const char *at, const char *end)
{
    bool significant = false, fraction = false;
    long long magnitude = 0, exponent = 0;

    for (; at != end && *at != 'e' && *at != 'E'; ++at)
    {
        significant |= *at >= '1' && *at <= '9';
        if (*at == '.')
            fraction = true;
        else if (significant && !fraction)
            ++magnitude;
        else if (!significant && fraction)
            --magnitude;
    }
    if (at == end)
        return magnitude < 0;
    ++at;
    at += at != end && *at == '+';
    /* An exponent that no integer holds outweighs any number of digits. */
    if (std::from_chars(at, end, exponent).ec != std::errc())
        return *at == '-';
    return exponent < -magnitude;
}

template <class Number>
otx_charconv_result
read(
    const char *begin, const char *end, Number *value,
    const char **rest) noexcept
{
    const bool plus = begin != end && *begin == '+';
    const char *start = begin + plus;

    if (plus && start != end && *start == '-')
        return OTX_CHARCONV_MALFORMED;

    const std::from_chars_result r = std::from_chars(start, end, *value);

    if (r.ec == std::errc::invalid_argument)
        return OTX_CHARCONV_MALFORMED;
    *rest = r.ptr;
    if (r.ec == std::errc())
        return OTX_CHARCONV_OK;
    if constexpr (std::is_floating_point_v<Number>)
    {
        if (is_tiny(start, r.ptr))
        {
            *value = *start == '-' ? Number(-0.0) : Number(0);
            return OTX_CHARCONV_OK;
        }
    }
    return OTX_CHARCONV_OVERFLOW;
}

template <class Number>
size_t
print(char *text, Number value) noexcept
{
    return size_t(
        std::to_chars(text, text + OTX_CHARCONV_BYTES, value).ptr - text);
}

} // namespace

otx_charconv_result
otx_charconv_read_float(
    const char *begin, const char *end, float *value, const char **rest)
{
    return read(begin, end, value, rest);
}

otx_charconv_result
otx_charconv_read_double(
    const char *begin, const char *end, double *value, const char **rest)
{
    return read(begin, end, value, rest);
}

otx_charconv_result
otx_charconv_read_int(
    const char *begin, const char *end, int64_t *value, const char **rest)
{
    return read(begin, end, value, rest);
}

size_t
otx_charconv_print_float(char text[OTX_CHARCONV_BYTES], float value)
{
    return print(text, value);
}

size_t
otx_charconv_print_double(char text[OTX_CHARCONV_BYTES], double value)
{
    return print(text, value);
}

size_t
otx_charconv_print_fixed(
    char text[OTX_CHARCONV_BYTES], double value, int decimals)
{
    const auto r = std::to_chars(
        text, text + OTX_CHARCONV_BYTES, value, std::chars_format::fixed,
        decimals);

    return r.ec == std::errc() ? size_t(r.ptr - text) : print(text, value);
}

size_t
otx_charconv_print_int(char text[OTX_CHARCONV_BYTES], int64_t value)
{
    return print(text, value);
}

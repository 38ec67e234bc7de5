/* lettering.c -- an alphabet of 3 x 5 squares. */
#include "image/lettering.h"

#include <string.h>

enum
{
    WIDE = 3,
    HIGH = 5
};

/* Rows from the top, each a digit whose bits are its squares. */
static const char LETTERS[26][HIGH + 1] = {
    "25755", "65656", "34443", "65556", "74647", "74644", "34553",
    "55755", "72227", "11152", "55655", "44447", "57755", "65555",
    "25552", "65644", "25563", "65655", "34216", "72222", "55557",
    "55552", "55775", "55255", "55222", "71247"};
static const char DIGITS[10][HIGH + 1] = {"25552", "26227", "61247", "61216",
                                          "55711", "74617", "34757", "71222",
                                          "75757", "75716"};

static const char *
rows_of(char c)
{
    if (c >= 'a' && c <= 'z')
        return LETTERS[c - 'a'];
    if (c >= 'A' && c <= 'Z')
        return LETTERS[c - 'A'];
    return c >= '0' && c <= '9' ? DIGITS[c - '0'] : "00000";
}

static void
set_pixel(otx_image *image, int32_t x, int32_t y, float value)
{
    if (x < 0 || y < 0 || x >= image->width || y >= image->height)
        return;
    for (int32_t k = 0; k < image->channels; ++k)
        otx_image_at(image, x, y)[k] = k == 3 ? 1.0f : value;
}

/* The square (i, j) of a text, j downwards; -1 and HIGH are ground. */
static bool
is_ink(const char *text, int32_t length, int32_t i, int32_t j)
{
    const int32_t number = i / (WIDE + 1);

    if (i < 0 || j < 0 || j >= HIGH || number >= length ||
        i % (WIDE + 1) == WIDE)
        return false;
    return (rows_of(text[number])[j] - '0') >> (WIDE - 1 - i % (WIDE + 1)) & 1;
}

void
otx_lettering_write(
    otx_image *image, int32_t x, int32_t y, int32_t scale, const char *text)
{
    const int32_t length = (int32_t)strlen(text);
    const int32_t squares = length * (WIDE + 1);

    for (int32_t row = -scale; row < (HIGH + 1) * scale; ++row)
        for (int32_t column = -scale; column < squares * scale; ++column)
        {
            const int32_t i = column < 0 ? -1 : column / scale;
            const int32_t j = row < 0 ? -1 : row / scale;

            set_pixel(
                image, x + column, y - 1 - row,
                is_ink(text, length, i, j) ? 0.8f : 0.02f);
        }
}

/* exif.c -- a few tags of the directories of a TIFF structure.
 *
 * A whole library for two numbers would be much; anything that is not as
 * expected counts as nothing said. */
#include "file/exif.h"

enum
{
    HEADER_BYTES = 8,
    ENTRY_BYTES = 12,
    TAG_ORIENTATION = 0x0112,
    TAG_EXIF = 0x8769,
    TAG_COLOR_SPACE = 0xA001,
    TAG_INTEROP = 0xA005,
    TAG_INTEROP_INDEX = 1,
    TYPE_ASCII = 2,
    TYPE_SHORT = 3,
    TYPE_LONG = 4,
    COLOR_SPACE_SRGB = 1,
    COLOR_SPACE_ADOBE = 2
};

typedef struct view
{
    const uint8_t *bytes;
    size_t count;
    bool big; /* the first byte of a number weighs most */
} view;

/* A number of `size` bytes; 0 beyond the end. */
static uint32_t
number_at(const view *v, size_t at, size_t size)
{
    uint32_t value = 0;

    if (at > v->count || v->count - at < size)
        return 0;
    for (size_t i = 0; i < size; ++i)
        value = value << 8 | v->bytes[at + (v->big ? i : size - 1 - i)];
    return value;
}

/* The header; false where this is no TIFF structure. */
static bool
view_open(const uint8_t *bytes, size_t count, view *v)
{
    *v = (view){bytes, count, false};
    if (count < HEADER_BYTES || bytes[0] != bytes[1] ||
        (bytes[0] != 'I' && bytes[0] != 'M'))
        return false;
    v->big = bytes[0] == 'M';
    return number_at(v, 2, 2) == 42;
}

/* Where the entry of `tag` and `type` in the directory at `directory` has its
 * value; 0 where there is none. */
static size_t
find_value(const view *v, size_t directory, uint32_t tag, uint32_t type)
{
    const uint32_t entries = number_at(v, directory, 2);
    size_t entry = directory + 2;

    for (uint32_t i = 0; i < entries && entry < v->count;
         ++i, entry += ENTRY_BYTES)
        if (number_at(v, entry, 2) == tag && number_at(v, entry + 2, 2) == type)
            return entry + 8;
    return 0;
}

int32_t
otx_exif_orientation(const uint8_t *bytes, size_t count)
{
    view v;
    size_t at;
    uint32_t value;

    if (!view_open(bytes, count, &v))
        return 1;
    at = find_value(&v, number_at(&v, 4, 4), TAG_ORIENTATION, TYPE_SHORT);
    value = at ? number_at(&v, at, 2) : 1;
    return value >= 1 && value <= 8 ? (int32_t)value : 1;
}

/* Cameras say "uncalibrated", and in a directory of its own that the file
 * follows option R03 of DCF, which is Adobe RGB; some say 2 instead. */
bool
otx_exif_says_adobe_rgb(const uint8_t *bytes, size_t count)
{
    view v;
    size_t at, directory;

    if (!view_open(bytes, count, &v))
        return false;
    at = find_value(&v, number_at(&v, 4, 4), TAG_EXIF, TYPE_LONG);
    if (!at)
        return false;
    directory = number_at(&v, at, 4);
    at = find_value(&v, directory, TAG_COLOR_SPACE, TYPE_SHORT);
    if (!at || number_at(&v, at, 2) == COLOR_SPACE_SRGB)
        return false;
    if (number_at(&v, at, 2) == COLOR_SPACE_ADOBE)
        return true;
    at = find_value(&v, directory, TAG_INTEROP, TYPE_LONG);
    if (!at)
        return false;
    at = find_value(&v, number_at(&v, at, 4), TAG_INTEROP_INDEX, TYPE_ASCII);
    return at && number_at(&v, at, 1) == 'R' &&
           number_at(&v, at + 1, 1) == '0' && number_at(&v, at + 2, 1) == '3';
}

void
otx_exif_note_orientation(
    otx_run *run, const char *path, const char *what, int32_t orientation)
{
    if (orientation != 1)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, "picture", otx_where_file(path),
            "the %s asks viewers to turn or mirror it (orientation %d); the "
            "pixels are taken as stored",
            what, (int)orientation);
}

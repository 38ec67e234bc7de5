/* exif.c -- one tag of the first directory of a TIFF structure.
 *
 * A whole library for one number would be much; anything that is not as
 * expected counts as nothing said. */
#include "file/exif.h"

enum
{
    HEADER_BYTES = 8,
    ENTRY_BYTES = 12,
    TAG_ORIENTATION = 0x0112,
    TYPE_SHORT = 3
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

int32_t
otx_exif_orientation(const uint8_t *bytes, size_t count)
{
    view v = {bytes, count, false};
    size_t entry;
    uint32_t entries;

    if (count < HEADER_BYTES || bytes[0] != bytes[1] ||
        (bytes[0] != 'I' && bytes[0] != 'M'))
        return 1;
    v.big = bytes[0] == 'M';
    if (number_at(&v, 2, 2) != 42)
        return 1;
    entry = number_at(&v, 4, 4);
    entries = number_at(&v, entry, 2);
    entry += 2;
    for (uint32_t i = 0; i < entries; ++i, entry += ENTRY_BYTES)
    {
        const uint32_t value = number_at(&v, entry + 8, 2);

        if (number_at(&v, entry, 2) == TAG_ORIENTATION &&
            number_at(&v, entry + 2, 2) == TYPE_SHORT)
            return value >= 1 && value <= 8 ? (int32_t)value : 1;
    }
    return 1;
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

/* foreign.c -- files of other programs that are taken for an OBJ. */
#include "file/foreign.h"

#include <string.h>

const char *
otx_foreign_kind(const char *bytes, size_t size)
{
    static const struct
    {
        const char *begin;
        const char *kind;
    } kinds[] = {
        {"#usda ", "a USD file"},
        {"PXR-USDC", "a USD file"},
        {"ply\n", "a PLY file"},
        {"ply\r", "a PLY file"},
        {"solid ", "an STL file"},
        {"Kaydara FBX", "an FBX file"},
        {"; FBX ", "an FBX file"},
        {"Ogawa", "an Alembic file"},
        {"glTF", "a glTF file"},
        {"BLENDER", "a Blender file"},
        {"//Maya ASCII", "a Maya scene"},
        {"PK\x03\x04", "a packed file (USDZ or ZIP)"},
        {"OFF\n", "an OFF file"},
    };

    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
    {
        const size_t length = strlen(kinds[i].begin);

        if (size >= length && memcmp(bytes, kinds[i].begin, length) == 0)
            return kinds[i].kind;
    }
    return NULL;
}

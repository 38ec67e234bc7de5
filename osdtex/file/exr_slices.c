/* exr_slices.c -- parts by their names. */
#include "file/exr_slices.h"

#include "file/exr_core.h"

#include <stdio.h>
#include <string.h>

void
otx_exr_slice_name(int32_t index, char name[static OTX_EXR_SLICE_NAME_BYTES])
{
    snprintf(name, OTX_EXR_SLICE_NAME_BYTES, "m%03d", index);
}

int32_t
otx_exr_slice_count(const char *path)
{
    exr_context_initializer_t setup = otx_exr_core_reading();
    char wanted[OTX_EXR_SLICE_NAME_BYTES];
    exr_context_t file = NULL;
    int32_t count = 0, parts = 0;

    if (exr_start_read(&file, path, &setup) != EXR_ERR_SUCCESS)
        return 0;
    exr_get_count(file, &parts);
    while (count < parts && count < OTX_EXR_SLICES_MAX)
    {
        const char *name = NULL;

        otx_exr_slice_name(count, wanted);
        if (exr_get_name(file, count, &name) != EXR_ERR_SUCCESS || !name ||
            strcmp(name, wanted) != 0)
            break;
        ++count;
    }
    exr_finish(&file);
    return count > 1 ? count : 0;
}

void
otx_exr_slice_map_name(
    const char *map, int32_t index, char name[static OTX_EXR_SLICE_NAME_BYTES])
{
    snprintf(
        name, OTX_EXR_SLICE_NAME_BYTES, "%.12s%03u", map,
        (unsigned)index % 1000u);
}

bool
otx_exr_part_is_there(const char *path, const char *name)
{
    exr_context_initializer_t setup = otx_exr_core_reading();
    exr_context_t file = NULL;
    int32_t parts = 0;
    bool found = false;

    if (exr_start_read(&file, path, &setup) != EXR_ERR_SUCCESS)
        return false;
    exr_get_count(file, &parts);
    for (int32_t i = 0; i < parts && !found; ++i)
    {
        const char *has = NULL;

        found = exr_get_name(file, i, &has) == EXR_ERR_SUCCESS && has &&
                strcmp(has, name) == 0;
    }
    exr_finish(&file);
    return found;
}

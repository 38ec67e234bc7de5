/* fuzz_mtl.c -- material libraries, read and asked for each of their names. */
#include "fuzz.h"

#include "file/mtl.h"
#include "support.h"

#include <math.h>
#include <string.h>

static void
check_library(const otx_mtl *mtl)
{
    for (int32_t i = 0; i < mtl->count; ++i)
    {
        const otx_mtl_material *m = &mtl->materials[i];
        const int32_t found = otx_mtl_find(mtl, m->name);

        /* Of several of one name the last. */
        fuzz_check(found >= i && found < mtl->count);
        for (int c = 0; c < 3; ++c)
            fuzz_check(isfinite(m->diffuse[c]));
        fuzz_check(!m->map_kd || *m->map_kd);
    }
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    otx_run *run = test_run_create_with(NULL, 1);
    otx_mtl mtl;

    if (otx_mtl_parse(run, "fuzz.mtl", (const char *)data, size, &mtl) ==
        OSDTEX_OK)
        check_library(&mtl);
    test_run_destroy(run);
    return 0;
}

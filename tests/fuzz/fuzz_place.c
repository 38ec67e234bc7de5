/* fuzz_place.c -- pictures that are to be placed, as JSON or CSV: refused with
 * a sentence, or lines that have what is needed.
 *
 * A file that begins with a bracket is JSON. */
#include "fuzz.h"

#include "file/place_file.h"
#include "support.h"

#include <math.h>
#include <string.h>

static void
check_line(const otx_place_line *line)
{
    fuzz_check(line->picture && *line->picture);
    fuzz_check(!line->from || *line->from);
    fuzz_check(line->number > 0 && line->face >= -1);
    fuzz_check(line->scatter >= 0 && line->scatter <= OTX_PLACE_SCATTER_MAX);
    fuzz_check(line->width > 0.0 && isfinite(line->width));
    fuzz_check(line->height >= 0.0 && isfinite(line->height));
    fuzz_check(isfinite(line->turn));
    fuzz_check(line->opacity >= 0.0 && line->opacity <= 1.0);
    for (int k = 0; k < 3; ++k)
        fuzz_check(isfinite(line->point[k]) && isfinite(line->up[k]));
    for (int k = 0; k < 2; ++k)
        fuzz_check(line->anchor[k] >= 0.0 && line->anchor[k] <= 1.0);
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const int is_json = size > 0 && (data[0] == '{' || data[0] == '[');
    const char *path = fuzz_file(is_json ? "p.json" : "p.csv", data, size);
    otx_run *run = test_run_create_with(NULL, 1);
    otx_place_file file;
    const otx_status status = otx_place_file_read(run, path, &file);

    if (status == OSDTEX_OK)
        for (int32_t i = 0; i < file.count; ++i)
            check_line(&file.lines[i]);
    else
        fuzz_check(strlen(test_last_message(run)) > 3);
    test_run_destroy(run);
    return 0;
}

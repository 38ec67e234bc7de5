/* fuzz_table.c -- the table of a nightly suite: refused with a sentence, or
 * cases that have what a case needs. */
#include "fuzz.h"

#include "regress/suite.h"

#include <string.h>

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[OTX_SUITE_ERROR_BYTES] = "";
    otx_suite suite = {0};
    const char *name;
    json_t *item;

    fuzz_file("table.json", data, size);
    if (!otx_suite_read(fuzz_folder(), &suite, error))
    {
        fuzz_check(strlen(error) > 3 && strlen(error) < sizeof error);
        return 0;
    }
    fuzz_check(
        json_is_object(suite.cases) && json_object_size(suite.cases) > 0);
    json_object_foreach(suite.cases, name, item)
    {
        fuzz_check(*name && !strchr(name, '/'));
        fuzz_check(otx_suite_text(item, "cage"));
        fuzz_check(otx_suite_text(item, "method"));
    }
    otx_suite_free(&suite);
    return 0;
}

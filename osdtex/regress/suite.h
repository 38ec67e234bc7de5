/* suite.h -- the table of a regression suite: DIR/table.json.
 *
 *     {
 *       "render": "--size 192x192 --samples 3",
 *       "threads": 1,
 *       "timeout": 600,
 *       "tolerances": {"time.cpu": 0.5},
 *       "rows": [
 *         {"cages": ["cages/a.obj"], "exemplars": ["moss.png", "bark.exr"],
 *          "methods": ["hierarchical"],
 *          "options": {"": "--level 2", "seed7": "--level 2 --seed 7"}}
 *       ]
 *     }
 *
 * A row stands for the product of its lists; paths are relative to DIR. A case
 * is called CAGE.EXEMPLAR.METHOD, and .OPTION where its options have a name.
 * "tiles": "..." in a row makes tiles of the exemplar first, with these
 * options. An exemplar that is a folder is a material. "again": "..." bakes
 * once more, with these options, from the mapping as it was saved; "swap":
 * another picture in the place of the exemplar then. "stack": "..." makes a
 * stack of the exemplar first, with these options, and with the picture that
 * "to" names. */
#ifndef OTX_REGRESS_SUITE_H
#define OTX_REGRESS_SUITE_H

#include <jansson.h>
#include <stdbool.h>

enum
{
    OTX_SUITE_ERROR_BYTES = 512,
    OTX_SUITE_PATH_BYTES = 4096
};

typedef struct otx_suite
{
    const char *folder; /* as given */
    json_t *table;      /* as in the file */
    json_t *cases;      /* name -> {cage, exemplar, method, options, tiles?,
                         * also?, mask?, again?, swap?, stack?, to?} */
} otx_suite;

/* False after saying in `error` what is wrong with the table. */
bool otx_suite_read(
    const char *folder, otx_suite *out, char error[OTX_SUITE_ERROR_BYTES]);
void otx_suite_free(otx_suite *suite);

/* A text of a case, NULL where it has none. */
const char *otx_suite_text(const json_t *item, const char *key);
/* A number of the table, `fallback` where it has none. */
double
otx_suite_number(const otx_suite *suite, const char *key, double fallback);

#endif

/* report_page.h -- the results of a run as one HTML file that needs nothing
 * else: pictures are in it, and no script is. */
#ifndef OTX_REGRESS_REPORT_PAGE_H
#define OTX_REGRESS_REPORT_PAGE_H

#include <jansson.h>
#include <stdbool.h>

/*   run      as in results.json
 *   history  of otx_history_read */
bool otx_report_page_write(
    const char *path, const json_t *run, const json_t *history);

#endif

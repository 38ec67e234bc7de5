/* saved_files.h -- the files that --from NAME.osdtex brings with it. */
#ifndef OTX_CLI_SAVED_FILES_H
#define OTX_CLI_SAVED_FILES_H

#include "cli/session.h"

/* Lists the files that saved->path names; nothing without one. What is wrong
 * with it is told by a finding: FORMAT, SUPPORT, IO, MEMORY. */
osdtex_status otx_saved_files_take(otx_session *session, otx_flag_saved *saved);
void otx_saved_files_free(otx_flag_saved *saved);

/* What outputs are made from: the first operand, or the cage that the saved
 * mapping names; NULL none. */
const char *otx_saved_files_source(const otx_flag_values *values);

/* How many exemplars the saved mapping has; 0 without one. */
int otx_saved_files_exemplars(const otx_flag_values *values);

#endif

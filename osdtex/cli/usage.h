/* usage.h -- help, man page and completion, all from the two tables. */
#ifndef OTX_CLI_USAGE_H
#define OTX_CLI_USAGE_H

#include "cli/command.h"

void otx_usage_print(void);
void otx_usage_print_command(const otx_command *command);
void otx_usage_print_man(void);
void otx_usage_print_completion(void);

#endif

/* usage.h -- help and man pages, all from the two tables. */
#ifndef OTX_CLI_USAGE_H
#define OTX_CLI_USAGE_H

#include "cli/command.h"

void otx_usage_print(void);
void otx_usage_print_command(const otx_command *command);
void otx_usage_print_man(void);
/* The page of one command. */
void otx_usage_print_command_man(const otx_command *command);

#endif

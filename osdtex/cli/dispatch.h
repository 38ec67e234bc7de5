/* dispatch.h -- what each sub-command does. */
#ifndef OTX_CLI_DISPATCH_H
#define OTX_CLI_DISPATCH_H

#include "cli/command.h"

/* Does what it is for, and returns the exit code. */
int otx_dispatch(const otx_command *command, const otx_flag_values *values);

int otx_map_command_run(const otx_flag_values *values);
int otx_tiles_command_run(const otx_flag_values *values);
int otx_edit_command_run(const otx_flag_values *values);
int otx_stack_command_run(const otx_flag_values *values);
int otx_bake_command_run(const otx_flag_values *values);
int otx_field_command_run(const otx_flag_values *values);
int otx_studio_command_run(const otx_flag_values *values);
int otx_render_command_run(const otx_flag_values *values);
int otx_regress_command_run(const otx_flag_values *values);
int otx_plan_command_run(const otx_flag_values *values);
int otx_run_command_run(const otx_flag_values *values);
int otx_info_command_run(const otx_flag_values *values);
int otx_methods_command_run(const otx_flag_values *values);
int otx_help_command_run(const otx_flag_values *values);

#endif

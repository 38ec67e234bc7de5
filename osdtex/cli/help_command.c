/* help_command.c -- osdtex help. */
#include "cli/completion.h"
#include "cli/dispatch.h"
#include "cli/session.h"
#include "cli/usage.h"

int
otx_help_command_run(const otx_flag_values *values)
{
    const char *name = values->operands[0];
    const bool completes = values->text[OTX_FLAG_COMPLETION] != NULL;
    const otx_command *command =
        name && !completes ? otx_command_find(name) : NULL;

    if (completes)
        return otx_completion_print(name)
                   ? OTX_EXIT_OK
                   : otx_session_refuse(
                         "--completion knows bash, zsh and fish, not '%s'",
                         name);
    if (name && !command)
        return otx_command_refuse(name);
    if (values->text[OTX_FLAG_MAN])
        command ? otx_usage_print_command_man(command) : otx_usage_print_man();
    else
        command ? otx_usage_print_command(command) : otx_usage_print();
    return OTX_EXIT_OK;
}

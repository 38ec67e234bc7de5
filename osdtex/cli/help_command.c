/* help_command.c -- osdtex help. */
#include "cli/session.h"
#include "cli/usage.h"

int
otx_help_command_run(const otx_flag_values *values)
{
    const otx_command *command;

    if (values->text[OTX_FLAG_MAN])
        otx_usage_print_man();
    else if (values->text[OTX_FLAG_COMPLETION])
        otx_usage_print_completion();
    else if (values->operand_count == 0)
        otx_usage_print();
    else
    {
        command = otx_command_find(values->operands[0]);
        if (!command)
            return otx_command_refuse(values->operands[0]);
        otx_usage_print_command(command);
    }
    return OTX_EXIT_OK;
}

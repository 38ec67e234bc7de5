/* main.c -- finds the sub-command and runs it. */
#include "cli/dispatch.h"
#include "cli/session.h"
#include "cli/spool.h"
#include "cli/usage.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void
print_version(void)
{
    printf("osdtex %s (build %s)\n", osdtex_version(), osdtex_build());
}

static int
run(const otx_command *command, int argc, char **argv)
{
    otx_flag_values values;

    if (!otx_flag_parse(argc, argv, command->flags, &values))
        return OTX_EXIT_USAGE;
    if (values.text[OTX_FLAG_HELP])
    {
        otx_usage_print_command(command);
        return OTX_EXIT_OK;
    }
    if (values.text[OTX_FLAG_VERSION])
    {
        print_version();
        return OTX_EXIT_OK;
    }
    if (!otx_command_takes(command, &values))
        return otx_session_refuse(
            "osdtex %s takes %s; see osdtex %s --help", command->name,
            command->operands, command->name);
    if (command->reads_pipes && !otx_spool_inputs(&values))
        return OTX_EXIT_IO;
    return otx_dispatch(command, &values);
}

/* A full disk or a closed pipe behind stdout is an error like any other. */
static int
flush(int exit_code)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return exit_code;
    fputs("osdtex: error: standard output cannot be written\n", stderr);
    return exit_code != OTX_EXIT_OK ? exit_code : OTX_EXIT_IO;
}

int
main(int argc, char **argv)
{
    const otx_command *command;
    int code;

    if (argc < 2)
    {
        otx_usage_print();
        flush(OTX_EXIT_USAGE);
        return OTX_EXIT_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
    {
        otx_usage_print();
        return flush(OTX_EXIT_OK);
    }
    if (strcmp(argv[1], "--version") == 0)
    {
        print_version();
        return flush(OTX_EXIT_OK);
    }
    command = otx_command_find(argv[1]);
    if (!command)
        return otx_command_refuse(argv[1]);
    code = flush(run(command, argc - 1, argv + 1));
    /* Where memory is out, libraries that wait for their threads at exit may
     * wait for ever. */
    if (code == OTX_EXIT_LIMIT)
        _exit(code);
    return code;
}

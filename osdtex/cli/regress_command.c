/* regress_command.c -- osdtex regress: has anything changed? */
#include "cli/dispatch.h"
#include "cli/session.h"
#include "regress/regress.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void
say(void *user, const char *line)
{
    otx_session_say(user, "%s", line);
}

/* The file that is running, for children. */
static bool
own_path(char path[OTX_SUITE_PATH_BYTES])
{
    const ssize_t length =
        readlink("/proc/self/exe", path, OTX_SUITE_PATH_BYTES - 1);

    if (length > 0)
        path[length] = '\0';
    return length > 0;
}

static int
exit_code_of(otx_regress_end end, const char *error)
{
    static const int codes[] = {
        [OTX_REGRESS_PASSED] = OTX_EXIT_OK,
        [OTX_REGRESS_DIFFERS] = OTX_EXIT_DIFFERS,
        [OTX_REGRESS_REFUSED] = OTX_EXIT_DATA,
        [OTX_REGRESS_UNWRITTEN] = OTX_EXIT_IO,
        [OTX_REGRESS_STOPPED] = OTX_EXIT_LIMIT};

    if (end > OTX_REGRESS_DIFFERS && end != OTX_REGRESS_STOPPED)
        otx_session_refuse("%s", error);
    return codes[end];
}

static int
run(otx_session *session, const otx_flag_values *values, const char *program)
{
    const char *output = values->text[OTX_FLAG_OUTPUT];
    const char *history = values->text[OTX_FLAG_HISTORY];
    char beside[OTX_SUITE_PATH_BYTES], error[OTX_SUITE_ERROR_BYTES];
    const otx_regress_options options = {
        .context = session->context,
        .folder = values->operands[0],
        .output = output,
        .history = history ? history : beside,
        .program = program,
        .update = values->text[OTX_FLAG_UPDATE_CASE],
        .names = values->operands + 1,
        .name_count = values->operand_count - 1,
        .stop = otx_session_is_stopped,
        .say = say,
        .user = session,
    };

    snprintf(beside, sizeof beside, "%.4000s/history.jsonl", output);
    return exit_code_of(otx_regress_run(&options, error), error);
}

int
otx_regress_command_run(const otx_flag_values *values)
{
    const char *program = values->text[OTX_FLAG_PROGRAM];
    const char *output = values->text[OTX_FLAG_OUTPUT];
    char own[OTX_SUITE_PATH_BYTES];
    struct stat status;
    otx_session session;
    int code, stopped;
    bool is_new;

    if (!output)
        return otx_session_refuse(
            "results go to a folder: osdtex regress %s -o FOLDER",
            values->operands[0]);
    if (access(values->operands[0], R_OK) != 0)
    {
        otx_session_refuse(
            "%s: the folder cannot be read: %s", values->operands[0],
            strerror(errno));
        return OTX_EXIT_IO;
    }
    is_new = mkdir(output, 0777) == 0;
    if (stat(output, &status) != 0 || !S_ISDIR(status.st_mode))
    {
        otx_session_refuse("the folder '%s' cannot be made", output);
        return OTX_EXIT_IO;
    }
    if (!program && !own_path(own))
        return otx_session_refuse(
            "where this program is cannot be found out; name it: --program");
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    session.remains = "no report was written; the cases' folders remain";
    code = run(&session, values, program ? program : own);
    /* Nothing is in it when the suite was refused. */
    if (is_new && code == OTX_EXIT_DATA)
        rmdir(output);
    stopped = otx_session_end(
        &session,
        otx_session_is_stopped() ? OSDTEX_ERROR_CANCELLED : OSDTEX_OK);
    return stopped != OTX_EXIT_OK ? stopped : code;
}

/* guard.h -- what is read must not be written, nor anything be written twice.
 *
 * One place knows what the inputs of a command are: its operands and the files
 * of its flags, what these name (material libraries and their maps, tiles of
 * masks), the colour configuration with its look-up tables, and the job that a
 * command line stands in. */
#ifndef OTX_CLI_GUARD_H
#define OTX_CLI_GUARD_H

#include "cli/path_list.h"
#include "cli/session.h"

/* Adds the files that a command line names; `deep`: and those that they name.
 */
osdtex_status otx_guard_named(
    osdtex_context *context, const otx_flag_values *values, bool deep,
    otx_path_list *out);

/* Adds all inputs of a command line. A fault in the colour configuration is
 * the only way to fail, of commands that convert colours. */
osdtex_status otx_guard_inputs(
    osdtex_context *context, const otx_flag_values *values, otx_path_list *out);

/* Whether the outputs may be written: none is an input or the same file as
 * another one, each can be made where it is to be (its folder is there, and it
 * replaces neither a link nor a file that is protected), and what they replace
 * was made by osdtex from a file called as the first operand is (unless
 * --replace is given). Says in one sentence what is wrong: ARGUMENT, IO;
 * COLOUR. */
osdtex_status otx_guard_check(
    otx_session *session, const otx_flag_values *values,
    const otx_path_list *outputs);

/* The same for the flags that name one file each: --output, --preview,
 * --json-report. Marks what will be written. */
osdtex_status
otx_guard_check_flags(otx_session *session, const otx_flag_values *values);

#endif

/* completion.h -- what shells complete, from the tables of commands and flags.
 */
#ifndef OTX_CLI_COMPLETION_H
#define OTX_CLI_COMPLETION_H

#include <stdbool.h>

/* Prints the script of a shell: bash (NULL), zsh or fish; false for others. */
bool otx_completion_print(const char *shell);

#endif

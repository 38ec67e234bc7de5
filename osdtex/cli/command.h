/* command.h -- the sub-commands, in one table.
 *
 * A sub-command is one row: what it is called, what it takes, two examples.
 * Everything that is printed about it comes from the row; dispatch.h does what
 * it is for. */
#ifndef OTX_CLI_COMMAND_H
#define OTX_CLI_COMMAND_H

#include "cli/flag.h"

/* Exit codes. */
enum
{
    OTX_EXIT_OK = 0,
    OTX_EXIT_USAGE = 1,
    OTX_EXIT_DATA = 2,
    OTX_EXIT_IO = 3,
    OTX_EXIT_COLOUR = 4,
    OTX_EXIT_LIMIT = 5,  /* or internal */
    OTX_EXIT_DIFFERS = 6 /* a case of a regression suite */
};

typedef struct otx_command
{
    const char *name;
    const char *operands; /* "CAGE.obj EXEMPLAR" */
    int operands_min, operands_max;
    const char *summary;      /* one line */
    const char *description;  /* paragraphs, wrapped at 78 columns */
    const char *examples;     /* lines */
    const char *output;       /* help on --output; NULL where there is none */
    const otx_flag_id *flags; /* ends with OTX_FLAG_COUNT */
    bool reads_pipes;         /* inputs that are pipes are read beforehand */
} otx_command;

/* NULL behind the end. */
const otx_command *otx_command_at(int index);
const otx_command *otx_command_find(const char *name);

/* Says that there is none of this name; OTX_EXIT_USAGE. */
int otx_command_refuse(const char *name);

/* Whether it can do with so many operands: a saved mapping names them, a
 * material its colour. */
bool
otx_command_takes(const otx_command *command, const otx_flag_values *values);

/* Help on one of its flags. */
const char *otx_command_flag_help(const otx_command *command, otx_flag_id flag);

#endif

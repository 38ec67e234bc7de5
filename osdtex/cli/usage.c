/* usage.c -- help for people at a terminal. */
#include "cli/usage.h"

#include <stdio.h>
#include <string.h>

enum
{
    HELP_COLUMN = 26,
    LAST_COLUMN = 78
};

/* Prints words from `column` on, indented and broken at LAST_COLUMN. */
static void
print_wrapped(const char *text, int column)
{
    while (*text)
    {
        const int word = (int)strcspn(text, " ");

        if (column > HELP_COLUMN && column + 1 + word > LAST_COLUMN)
        {
            printf("\n%*s", HELP_COLUMN, "");
            column = HELP_COLUMN;
        }
        else if (column > HELP_COLUMN)
        {
            putchar(' ');
            ++column;
        }
        printf("%.*s", word, text);
        column += word;
        text += word;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void
print_flag(const otx_command *command, otx_flag_id id)
{
    const otx_flag *flag = otx_flag_at(id);
    int column = flag->letter
                     ? printf("    -%c, --%s", flag->letter, flag->name)
                     : printf("    --%s", flag->name);

    if (flag->argument)
        column += printf(" %s", flag->argument);
    if (column < HELP_COLUMN - 1)
        printf("%*s", HELP_COLUMN - column, "");
    else
        printf("\n%*s", HELP_COLUMN, "");
    print_wrapped(otx_command_flag_help(command, id), HELP_COLUMN);
}

static void
print_group(const otx_command *command, otx_flag_group group)
{
    bool begun = false;

    for (const otx_flag_id *id = command->flags; *id != OTX_FLAG_COUNT; ++id)
    {
        if (otx_flag_at(*id)->group != group)
            continue;
        if (!begun)
            printf("\n%s:\n", otx_flag_group_title(group));
        begun = true;
        print_flag(command, *id);
    }
}

/* Every line of `text`, indented. */
static void
print_examples(const char *text)
{
    while (*text)
    {
        const int line = (int)strcspn(text, "\n");

        printf("    %.*s\n", line, text);
        text += line;
        text += *text == '\n';
    }
}

void
otx_usage_print_command(const otx_command *command)
{
    printf("osdtex %s -- %s\n\n", command->name, command->summary);
    print_examples(command->examples);
    printf(
        "\nUsage: osdtex %s %s%s\n", command->name, command->operands,
        command->flags[0] == OTX_FLAG_OUTPUT ? " -o FILE [options]"
                                             : " [options]");
    if (*command->description)
        printf("\n%s\n", command->description);
    for (int g = 0; g < OTX_FLAG_GROUP_HIDDEN; ++g)
        print_group(command, (otx_flag_group)g);
}

void
otx_usage_print(void)
{
    printf(
        "osdtex -- texture subdivision surfaces from a picture of a material\n"
        "version %s\n\n",
        osdtex_version());
    print_examples(otx_command_at(0)->examples);
    printf("\nUsage: osdtex COMMAND ...\n\nCommands:\n");
    for (int i = 0; otx_command_at(i); ++i)
        printf(
            "    %-10s%s\n", otx_command_at(i)->name,
            otx_command_at(i)->summary);
    printf("\n`osdtex COMMAND --help` says what a command takes.\n\n"
           "Exit codes: 0 done, 1 usage, 2 bad input data, 3 input or output\n"
           "failed, 4 colour configuration, 5 a limit or an internal error,\n"
           "6 a case of `osdtex regress` differs; 130 and 143 when stopped by "
           "a\nsignal.\n");
}

/* completion.c -- what shells complete, from the tables of commands and flags.
 */
#include "cli/completion.h"
#include "cli/usage.h"

#include <stdio.h>
#include <string.h>

/* Flags that are shown, in turn. */
static const otx_flag *
next_flag(const otx_command *command, int *at)
{
    while (command->flags[*at] != OTX_FLAG_COUNT)
    {
        const otx_flag *flag = otx_flag_at(command->flags[(*at)++]);

        if (flag->group != OTX_FLAG_GROUP_HIDDEN)
            return flag;
    }
    return NULL;
}

static const char *
help_of(const otx_command *command, int at)
{
    return otx_command_flag_help(command, command->flags[at - 1]);
}

/* Text within single quotes, up to its first line's end: `marks` get a
 * backslash, and a quote is closed, written and opened again. */
static void
put_quoted(const char *text, const char *marks)
{
    for (; *text && *text != '\n'; ++text)
    {
        if (*text == '\'')
            fputs("'\\'", stdout);
        else if (strchr(marks, *text))
            putchar('\\');
        putchar(*text);
    }
}

/* ------------------------------- bash ---------------------------------- */

static void
put_bash(void)
{
    printf("# Completion of osdtex for bash; printed by "
           "`osdtex help --completion`.\n_osdtex()\n{\n"
           "    local words\n    case ${COMP_WORDS[1]} in\n");
    for (int i = 0; otx_command_at(i); ++i)
    {
        const otx_command *command = otx_command_at(i);
        const otx_flag *flag;
        int at = 0;

        printf("    %s) words=\"", command->name);
        while ((flag = next_flag(command, &at)))
            printf(" --%s", flag->name);
        printf("\" ;;\n");
    }
    printf("    esac\n    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "        words=\"");
    for (int i = 0; otx_command_at(i); ++i)
        printf("%s ", otx_command_at(i)->name);
    printf("--help --version\"\n    fi\n"
           "    COMPREPLY=($(compgen -W \"$words\" -- "
           "\"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
           "complete -o default -F _osdtex osdtex\n");
}

/* ------------------------------- zsh ----------------------------------- */

/* '(-o --output)'{-o,--output}'[help]:FILE:_files', one line. */
static void
put_zsh_flag(const otx_flag *flag, const char *help)
{
    printf("        ");
    if (flag->letter)
        printf("{-%c,--%s}", flag->letter, flag->name);
    else
        printf("--%s", flag->name);
    printf("'[");
    put_quoted(help, "[]\\");
    putchar(']');
    if (flag->argument)
    {
        putchar(':');
        put_quoted(flag->argument, ":\\");
        printf(":_files");
    }
    printf("' \\\n");
}

static void
put_zsh(void)
{
    printf("#compdef osdtex\n# Completion of osdtex for zsh; printed by "
           "`osdtex help --completion zsh`.\n_osdtex()\n{\n"
           "    local -a commands\n    commands=(\n");
    for (int i = 0; otx_command_at(i); ++i)
    {
        printf("        '%s:", otx_command_at(i)->name);
        put_quoted(otx_command_at(i)->summary, ":\\");
        printf("'\n");
    }
    printf("    )\n    if (( CURRENT == 2 )); then\n"
           "        _describe command commands\n        return\n    fi\n"
           "    local command=$words[2]\n"
           "    shift words\n    (( CURRENT-- ))\n    case $command in\n");
    for (int i = 0; otx_command_at(i); ++i)
    {
        const otx_command *command = otx_command_at(i);
        const otx_flag *flag;
        int at = 0;

        printf("    %s)\n        _arguments -s \\\n", command->name);
        while ((flag = next_flag(command, &at)))
            put_zsh_flag(flag, help_of(command, at));
        printf("        '*:file:_files' ;;\n");
    }
    printf("    esac\n}\n_osdtex \"$@\"\n");
}

/* ------------------------------- fish ---------------------------------- */

static void
put_fish_flag(const char *command, const otx_flag *flag, const char *help)
{
    printf(
        "complete -c osdtex -n '__fish_seen_subcommand_from %s' -l %s", command,
        flag->name);
    if (flag->letter)
        printf(" -s %c", flag->letter);
    if (flag->argument)
        printf(" -r");
    printf(" -d '");
    put_quoted(help, "\\");
    printf("'\n");
}

static void
put_fish(void)
{
    printf("# Completion of osdtex for fish; printed by "
           "`osdtex help --completion fish`.\n");
    for (int i = 0; otx_command_at(i); ++i)
    {
        const otx_command *command = otx_command_at(i);
        const otx_flag *flag;
        int at = 0;

        printf(
            "complete -c osdtex -n __fish_use_subcommand -f -a %s -d '",
            command->name);
        put_quoted(command->summary, "\\");
        printf("'\n");
        while ((flag = next_flag(command, &at)))
            put_fish_flag(command->name, flag, help_of(command, at));
    }
}

bool
otx_completion_print(const char *shell)
{
    if (!shell || strcmp(shell, "bash") == 0)
        put_bash();
    else if (strcmp(shell, "zsh") == 0)
        put_zsh();
    else if (strcmp(shell, "fish") == 0)
        put_fish();
    else
        return false;
    return true;
}

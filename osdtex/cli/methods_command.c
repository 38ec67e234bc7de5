/* methods_command.c -- osdtex methods. */
#include "cli/dispatch.h"
#include "cli/session.h"

#include "word/near.h"

#include <stdio.h>
#include <string.h>

static const char *
method_name(const void *list, int index)
{
    osdtex_method_info info;

    (void)list;
    return osdtex_method_get(index, &info) == OSDTEX_OK ? info.name : NULL;
}

static void
print_range(const osdtex_option_info *option)
{
    if (option->kind == OSDTEX_OPTION_REAL ||
        option->kind == OSDTEX_OPTION_INTEGER)
        printf("%g .. %g", option->minimum, option->maximum);
    else if (option->kind == OSDTEX_OPTION_SWITCH)
        printf("on | off");
    for (int c = 0; option->choices && option->choices[c]; ++c)
        printf("%s%s", c > 0 ? " | " : "", option->choices[c]);
}

static void
print_method(int method, const osdtex_method_info *info)
{
    osdtex_option_info option;

    printf(
        "%s -- %s\nsource: %s\n\nSettings (--set KEY=VALUE):\n", info->name,
        info->summary, info->source);
    for (int i = 0; i < info->option_count; ++i)
    {
        if (osdtex_option_get(method, i, &option) != OSDTEX_OK)
            continue;
        printf("    %s=%s  (", option.name, option.fallback);
        print_range(&option);
        printf(")\n        %s\n", option.help);
    }
}

int
otx_methods_command_run(const otx_flag_values *values)
{
    const char *wanted = values->operand_count > 0 ? values->operands[0] : NULL;
    const char *near_name;
    osdtex_method_info info;

    for (int i = 0; osdtex_method_get(i, &info) == OSDTEX_OK; ++i)
    {
        if (!wanted)
            printf("%-14s%s\n", info.name, info.summary);
        else if (strcmp(info.name, wanted) == 0)
        {
            print_method(i, &info);
            return OTX_EXIT_OK;
        }
    }
    if (!wanted)
        return OTX_EXIT_OK;
    near_name = otx_near_best(wanted, method_name, NULL);
    if (near_name)
        return otx_session_refuse(
            "there is no method '%s'; did you mean '%s'?", wanted, near_name);
    return otx_session_refuse(
        "there is no method '%s'; see osdtex methods", wanted);
}

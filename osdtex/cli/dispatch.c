/* dispatch.c -- the functions of the sub-commands. */
#include "cli/dispatch.h"

#include <stdio.h>
#include <string.h>

typedef struct deed
{
    const char *name; /* the command's */
    int (*run)(const otx_flag_values *values);
} deed;

static const deed deeds[] = {
    {"map", otx_map_command_run},         {"tiles", otx_tiles_command_run},
    {"stack", otx_stack_command_run},     {"bake", otx_bake_command_run},
    {"edit", otx_edit_command_run},       {"render", otx_render_command_run},
    {"field", otx_field_command_run},     {"studio", otx_studio_command_run},
    {"regress", otx_regress_command_run}, {"plan", otx_plan_command_run},
    {"run", otx_run_command_run},         {"info", otx_info_command_run},
    {"methods", otx_methods_command_run}, {"help", otx_help_command_run},
};

int
otx_dispatch(const otx_command *command, const otx_flag_values *values)
{
    for (size_t i = 0; i < sizeof deeds / sizeof *deeds; ++i)
        if (strcmp(deeds[i].name, command->name) == 0)
            return deeds[i].run(values);
    fprintf(stderr, "osdtex: error: %s is not built in\n", command->name);
    return OTX_EXIT_LIMIT;
}

/* manual.c -- the man pages in roff. */
#include "cli/usage.h"

#include <stdio.h>
#include <string.h>

/* Text with what roff would take for markup made plain. */
static void
put_roff(const char *text)
{
    bool line_start = true;

    for (; *text; ++text)
    {
        if (line_start && (*text == '.' || *text == '\''))
            fputs("\\&", stdout);
        if (*text == '-')
            fputs("\\-", stdout);
        else if (*text == '\\')
            fputs("\\e", stdout);
        else
            putchar(*text);
        line_start = *text == '\n';
    }
}

static void
put_flag(const otx_flag *flag, const char *help)
{
    printf(".TP\n");
    if (flag->letter)
        printf("\\fB\\-%c\\fR, ", flag->letter);
    printf("\\fB\\-\\-");
    put_roff(flag->name);
    printf("\\fR");
    if (flag->argument)
    {
        printf(" \\fI");
        put_roff(flag->argument);
        printf("\\fR");
    }
    putchar('\n');
    put_roff(help);
    putchar('\n');
}

static void
put_settings(int method, const osdtex_method_info *info)
{
    osdtex_option_info option;

    printf(".SS ");
    put_roff(info->name);
    putchar('\n');
    put_roff(info->summary);
    printf("\n(");
    put_roff(info->source);
    printf(")\n");
    for (int i = 0; i < info->option_count; ++i)
    {
        if (osdtex_option_get(method, i, &option) != OSDTEX_OK)
            continue;
        printf(".TP\n\\fB");
        put_roff(option.name);
        printf("\\fR (default ");
        put_roff(option.fallback);
        printf(")\n");
        put_roff(option.help);
        for (int c = 0; option.choices && option.choices[c]; ++c)
        {
            fputs(c == 0 ? ". One of " : ", ", stdout);
            put_roff(option.choices[c]);
        }
        if (option.kind == OSDTEX_OPTION_REAL ||
            option.kind == OSDTEX_OPTION_INTEGER)
            printf(". From %g to %g", option.minimum, option.maximum);
        printf(".\n");
    }
}

/* Flags of a command that are of a group of their own, or the common ones. */
static void
put_flags(const otx_command *command, bool common)
{
    for (const otx_flag_id *id = command->flags; *id != OTX_FLAG_COUNT; ++id)
    {
        const otx_flag_group group = otx_flag_at(*id)->group;

        if (group != OTX_FLAG_GROUP_HIDDEN &&
            (group == OTX_FLAG_GROUP_COMMON) == common)
            put_flag(otx_flag_at(*id), otx_command_flag_help(command, *id));
    }
}

static void
put_examples(const otx_command *command)
{
    printf(".nf\n");
    put_roff(command->examples);
    printf(".fi\n");
}

static void
put_command(const otx_command *command)
{
    printf(".SS osdtex %s \\fI", command->name);
    put_roff(command->operands);
    printf("\\fR\n");
    put_roff(command->description);
    printf("\n.PP\n");
    put_examples(command);
    put_flags(command, false);
}

/* ------------------------- a page for each command --------------------- */

typedef struct file_row
{
    const char *command;
    const char *name;
    const char *what;
} file_row;

/* What commands read and write. */
static const file_row FILES[] = {
    {"map", "CAGE.obj",
     "the cage, with tags for creases, corners and holes; its MTL names "
     "materials for \\-\\-also"},
    {"map", "NAME.obj, NAME.mtl, NAME.exr",
     "the refined mesh with UVs, its material, the exemplar as a texture; "
     "NAME_1.exr and on of several"},
    {"map", "NAME.osdtex", "of \\-\\-save: the mapping, for bake \\-\\-from"},
    {"map", "FILE.json",
     "of \\-\\-json\\-report: docs/report.md says what is in it"},
    {"bake", "CAGE.obj", "the cage; its own UVs are used where they can be"},
    {"bake", "NAME_cage.obj, NAME_cage.mtl",
     "the cage with the UVs of the bake, and its material"},
    {"bake", "NAME.1001.exr",
     "the texture, a file for each UDIM tile; NAME_normal.1001.exr and so on "
     "of a material, NAME_uv.1001.exr and so on of \\-\\-extra"},
    {"bake", "NAME.usda, NAME.mtlx",
     "the cage as USD, with scheme, creases and UV rule; its look"},
    {"tiles", "FILE.exr", "the tiled texture; its header holds the layout"},
    {"stack", "FILE.exr",
     "the slices, one below the other; FILE_mask1.png and on beside it"},
    {"render", "MODEL.obj", "with the MTL and the textures that it names"},
    {"field", "FILE.csv",
     "directions, a line for each face: docs/formats\\-constraints.md"},
    {"regress", "DIR/table.json, DIR/reference",
     "the cases, and what they are to give"},
    {"regress", "report.html, results.json, results.csv",
     "what came of it, in the output folder"},
    {"plan", "JOB.json", "the tasks: docs/farm.md"},
    {"plan", "Makefile, job.sbatch, job.xml, job_info.job",
     "what the engine takes, in the output folder"},
    {"studio", "NAME_constraints.json, NAME_state.json",
     "what gestures ask for, and where the page goes on from"},
    {"edit", "NAME.osdtex", "the mapping to be edited, and the edited one"},
    {"run", "JOB.json", "the tasks: docs/farm.md"},
    {"info", "FILE",
     "an OBJ, a picture, a NAME.osdtex or an OpenColorIO configuration"}};

static void
put_files(const otx_command *command)
{
    bool any = false;

    for (size_t i = 0; i < sizeof FILES / sizeof *FILES; ++i)
    {
        if (strcmp(FILES[i].command, command->name) != 0)
            continue;
        printf(
            "%s.TP\n.I \"%s\"\n%s\n", any ? "" : ".SH FILES\n", FILES[i].name,
            FILES[i].what);
        any = true;
    }
}

/* The summary in one word and with capitals, as headers have it. */
static void
put_title(const otx_command *command)
{
    printf(".\\\" Generated by tools/make-man from the tables of the program.\n"
           ".TH OSDTEX-");
    for (const char *c = command->name; *c; ++c)
        putchar(*c - 'a' + 'A');
    printf(
        " 1 \"\" \"osdtex %s\" \"User Commands\"\n.SH NAME\nosdtex\\-%s \\- ",
        osdtex_version(), command->name);
    put_roff(command->summary);
    printf("\n.SH SYNOPSIS\n.B osdtex %s\n.I ", command->name);
    put_roff(command->operands);
    printf(
        "\n%s.RI [ options ]\n", command->output ? ".BI \\-o \" FILE\"\n" : "");
}

void
otx_usage_print_command_man(const otx_command *command)
{
    put_title(command);
    printf(".SH DESCRIPTION\n");
    put_roff(command->description[0] ? command->description : command->summary);
    printf("\n.SH OPTIONS\n");
    put_flags(command, false);
    put_flags(command, true);
    printf(".SH EXAMPLES\n");
    put_examples(command);
    put_files(command);
    printf(".SH EXIT STATUS\nThat of\n.BR osdtex (1).\n"
           ".SH SEE ALSO\n.BR osdtex (1)\n");
}

static void
put_tail(void)
{
    static const char *const codes[] = {
        "done",
        "the command line is wrong",
        "an input file is damaged, not supported, or no surface",
        "a file cannot be read or written",
        "the colour configuration is wrong, or has no such space",
        "a limit would be exceeded, memory is out, or an internal error",
        "a case of a regression suite differs, crashed or has no reference"};

    printf(".SH EXIT STATUS\n");
    for (int i = 0; i < 7; ++i)
        printf(".TP\n%d\n%s\n", i, codes[i]);
    printf(
        ".TP\n130, 143\nstopped by SIGINT or SIGTERM; nothing half\\-written "
        "is left\n");
    printf(
        ".SH ENVIRONMENT\n.TP\nOCIO\nOpenColorIO configuration, unless "
        "\\-\\-colorconfig is given\n.TP\nOSDTEX_THREADS, CUE_THREADS, "
        "SLURM_CPUS_PER_TASK\nnumber of threads, the first that is set, unless "
        "\\-\\-threads is given\n");
    printf(".SH SEE ALSO\n.BR maketx (1),\n.BR oiiotool (1),\n.BR exrheader "
           "(1)\n");
}

void
otx_usage_print_man(void)
{
    osdtex_method_info method;

    printf(
        ".\\\" Generated by tools/make-man from the tables of the program.\n"
        ".TH OSDTEX 1 \"\" \"osdtex %s\" \"User Commands\"\n"
        ".SH NAME\nosdtex \\- texture subdivision surfaces from a picture of a "
        "material\n.SH SYNOPSIS\n",
        osdtex_version());
    for (int i = 0; otx_command_at(i); ++i)
    {
        printf(".B osdtex %s\n.I ", otx_command_at(i)->name);
        put_roff(otx_command_at(i)->operands);
        printf(
            "\n%s.RI [ options ]\n.br\n",
            otx_command_at(i)->output ? ".BI \\-o \" FILE\"\n" : "");
    }
    printf(".SH COMMANDS\n");
    for (int i = 0; otx_command_at(i); ++i)
        put_command(otx_command_at(i));
    printf(".SH COMMON OPTIONS\n");
    for (int id = 0; id < OTX_FLAG_COUNT; ++id)
    {
        const otx_flag *flag = otx_flag_at((otx_flag_id)id);

        if (flag->group == OTX_FLAG_GROUP_COMMON)
            put_flag(flag, flag->help);
    }
    printf(".SH METHODS\n");
    for (int m = 0; osdtex_method_get(m, &method) == OSDTEX_OK; ++m)
        put_settings(m, &method);
    put_tail();
}

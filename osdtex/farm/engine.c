/* engine.c -- make, Slurm, OpenCue, Deadline.
 *
 * All are told the same: task K is `osdtex run JOB.json --task K`, from 0, none
 * needs another, and each may be tried again. Nothing else of a job is theirs
 * to know. */
#include "farm/engine.h"

#include <stdio.h>
#include <string.h>

enum
{
    HEAD_BYTES = 2048 /* of a file, where its sign is */
};

/* In single quotes for a shell. `dollar` is how the language around it writes
 * one: make wants two. */
static void
put_quoted(FILE *out, const char *text, const char *dollar)
{
    fputc('\'', out);
    for (; *text; ++text)
    {
        if (*text == '\'')
            fputs("'\\''", out);
        else if (*text == '$')
            fputs(dollar, out);
        else
            fputc(*text, out);
    }
    fputc('\'', out);
}

/* In single quotes for a shell, within XML. */
static void
put_quoted_xml(FILE *out, const char *text)
{
    fputc('\'', out);
    for (; *text; ++text)
    {
        if (*text == '\'')
            fputs("'\\''", out);
        else if (*text == '<')
            fputs("&lt;", out);
        else if (*text == '&')
            fputs("&amp;", out);
        else if (*text == '>')
            fputs("&gt;", out);
        else
            fputc(*text, out);
    }
    fputc('\'', out);
}

static void
put_make(FILE *out, const otx_farm_job *job, const char *program)
{
    fprintf(out, "# %s: make -k -j N -f Makefile\nTASKS :=", job->name);
    for (int i = 0; i < job->task_count; ++i)
        fprintf(out, " task-%d", i);
    fprintf(out, "\n\n.PHONY: all $(TASKS)\nall: $(TASKS)\n");
    for (int i = 0; i < job->task_count; ++i)
    {
        fprintf(out, "\n# %s\ntask-%d:\n\t", otx_farm_job_task_name(job, i), i);
        put_quoted(out, program, "$$");
        fputs(" run ", out);
        put_quoted(out, job->path, "$$");
        fprintf(out, " --task %d\n", i);
    }
}

/* Slurm says through the environment how many threads a task may have. */
static void
put_slurm(FILE *out, const otx_farm_job *job, const char *program)
{
    fprintf(
        out,
        "#!/bin/sh\n# osdtex plan\n#SBATCH --job-name=%s\n#SBATCH "
        "--array=0-%d\n"
        "#SBATCH --cpus-per-task=%d\n#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n#SBATCH --output=%s-%%a.log\nexec ",
        job->name, job->task_count - 1, job->threads > 0 ? job->threads : 1,
        job->name);
    put_quoted(out, program, "$");
    fputs(" run ", out);
    put_quoted(out, job->path, "$");
    fputs(" --task \"$SLURM_ARRAY_TASK_ID\"\n", out);
}

/* A job specification as cjsl-1.15.dtd has it. Commands go through a shell;
 * names have three characters at least; one retry is all that Cuebot grants. */
static void
put_opencue(FILE *out, const otx_farm_job *job, const char *program)
{
    fprintf(
        out,
        "<?xml version=\"1.0\"?>\n"
        "<!DOCTYPE spec PUBLIC \"SPI Cue Specification Language\" "
        "\"http://localhost:8080/spcue/dtd/cjsl-1.15.dtd\">\n"
        "<spec>\n  <facility>local</facility>\n  <show>osdtex</show>\n"
        "  <shot>textures</shot>\n  <user>render</user>\n"
        "  <job name=\"%s%s\">\n    <paused>False</paused>\n"
        "    <maxretries>1</maxretries>\n    <layers>\n"
        "      <layer name=\"tasks\" type=\"Render\">\n        <cmd>",
        strlen(job->name) < 3 ? "job_" : "", job->name);
    put_quoted_xml(out, program);
    fputs(" run ", out);
    put_quoted_xml(out, job->path);
    fprintf(
        out,
        " --task #IFRAME#</cmd>\n        <range>0-%d</range>\n"
        "        <chunk>1</chunk>\n        <cores>%d.0</cores>\n"
        "        <threadable>True</threadable>\n      </layer>\n"
        "    </layers>\n  </job>\n</spec>\n",
        job->task_count - 1, job->threads > 0 ? job->threads : 1);
}

static void
put_deadline_job(FILE *out, const otx_farm_job *job, const char *program)
{
    (void)program;
    fprintf(
        out,
        "Plugin=CommandLine\nComment=osdtex "
        "plan\nName=%s\nFrames=0-%d\nChunkSize=1\n"
        "OverrideTaskFailureDetection=true\nFailureDetectionTaskErrors=3\n",
        job->name, job->task_count - 1);
}

static void
put_deadline_plugin(FILE *out, const otx_farm_job *job, const char *program)
{
    fprintf(
        out,
        "Executable=%s\nArguments=run <QUOTE>%s<QUOTE> --task <STARTFRAME>\n"
        "ShellExecute=False\n",
        program, job->path);
}

/* ---- names that cannot be told ---------------------------------------------
 */

/* Control characters end lines, and with them commands. */
static const char *
refuse_control(const char *name)
{
    for (; *name; ++name)
        if ((unsigned char)*name < ' ' || *name == 127)
            return "it holds a control character";
    return NULL;
}

/* XML is UTF-8, and Cue replaces what stands between two #. */
static const char *
refuse_cue(const char *name)
{
    const char *hash = strchr(name, '#');
    json_t *text = json_string(name);
    const bool is_utf8 = text != NULL;

    json_decref(text);
    if (!is_utf8)
        return "it is not UTF-8, as XML is";
    return hash && strchr(hash + 1, '#') ? "OpenCue takes what stands between "
                                           "two # for a word of its own"
                                         : refuse_control(name);
}

/* Deadline knows no escapes; <...> are words of its own. */
static const char *
refuse_deadline(const char *name)
{
    return strpbrk(name, "\"<>")
               ? "in Deadline's files \", < and > cannot be written as they are"
               : refuse_control(name);
}

static const otx_engine engines[] = {
    {"make",
     "make -k -j 4 -f %s/Makefile",
     1,
     {{"Makefile", "make -k -j N -f Makefile\n", put_make}},
     refuse_control},
    {"slurm",
     "sbatch %s/job.sbatch",
     1,
     {{"job.sbatch", "# osdtex plan\n", put_slurm}},
     refuse_control},
    {"opencue",
     "launch %s/job.xml, with opencue.api.launchSpecAndWait",
     1,
     {{"job.xml", "<show>osdtex</show>", put_opencue}},
     refuse_cue},
    {"deadline",
     "deadlinecommand %s/job_info.job %s/plugin_info.job",
     2,
     {{"job_info.job", "Comment=osdtex plan\n", put_deadline_job},
      {"plugin_info.job", "Arguments=run <QUOTE>", put_deadline_plugin}},
     refuse_deadline},
};

const otx_engine *
otx_engine_at(int index)
{
    return index < (int)(sizeof engines / sizeof engines[0]) ? &engines[index]
                                                             : NULL;
}

const otx_engine *
otx_engine_find(const char *name)
{
    for (int i = 0; otx_engine_at(i); ++i)
        if (strcmp(otx_engine_at(i)->name, name) == 0)
            return otx_engine_at(i);
    return NULL;
}

bool
otx_engine_check(
    const otx_engine *engine, const otx_farm_job *job, const char *program,
    char error[OTX_FARM_JOB_ERROR_BYTES])
{
    const char *const names[] = {job->path, program};

    for (int i = 0; i < 2; ++i)
    {
        const char *why = engine->refuse(names[i]);

        if (!why)
            continue;
        snprintf(
            error, OTX_FARM_JOB_ERROR_BYTES,
            "%s cannot be told of '%.300s', the %s: %s; give it another name",
            engine->name, names[i], i == 0 ? "job" : "program", why);
        return false;
    }
    return true;
}

void
otx_engine_path(
    const otx_engine *engine, int index, const char *folder,
    char path[OTX_FARM_JOB_PATH_BYTES])
{
    snprintf(
        path, OTX_FARM_JOB_PATH_BYTES, "%.3900s/%s", folder,
        engine->files[index].name);
}

bool
otx_engine_may_replace(const otx_engine *engine, int index, const char *path)
{
    char head[HEAD_BYTES + 1];
    FILE *file = fopen(path, "rb");
    size_t size;

    if (!file)
        return true;
    size = fread(head, 1, HEAD_BYTES, file);
    fclose(file);
    head[size] = '\0';
    return size == 0 || strstr(head, engine->files[index].sign) != NULL;
}

bool
otx_engine_write(
    const otx_engine *engine, int index, const otx_farm_job *job,
    const char *program, const char *path)
{
    FILE *out = fopen(path, "w");
    bool whole = out != NULL;

    if (!out)
        return false;
    engine->files[index].put(out, job, program);
    whole = !ferror(out);
    return fclose(out) == 0 && whole;
}

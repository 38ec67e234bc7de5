/* engine.c -- make, Slurm, OpenCue, Deadline.
 *
 * All are told the same: task K is `osdtex run JOB.json --task K`, from 0, none
 * needs another, and each may be tried again. Nothing else of a job is theirs
 * to know. */
#include "farm/engine.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

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
        else
            fputc(*text, out);
    }
    fputc('\'', out);
}

static void
put_make(FILE *out, const otx_job *job, const char *program)
{
    fprintf(out, "# %s: make -k -j N -f Makefile\nTASKS :=", job->name);
    for (int i = 0; i < job->task_count; ++i)
        fprintf(out, " task-%d", i);
    fprintf(out, "\n\n.PHONY: all $(TASKS)\nall: $(TASKS)\n");
    for (int i = 0; i < job->task_count; ++i)
    {
        fprintf(out, "\n# %s\ntask-%d:\n\t", otx_job_task_name(job, i), i);
        put_quoted(out, program, "$$");
        fputs(" run ", out);
        put_quoted(out, job->path, "$$");
        fprintf(out, " --task %d\n", i);
    }
}

/* Slurm says through the environment how many threads a task may have. */
static void
put_slurm(FILE *out, const otx_job *job, const char *program)
{
    fprintf(
        out,
        "#!/bin/sh\n#SBATCH --job-name=%s\n#SBATCH --array=0-%d\n"
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
put_opencue(FILE *out, const otx_job *job, const char *program)
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
put_deadline_job(FILE *out, const otx_job *job, const char *program)
{
    (void)program;
    fprintf(
        out,
        "Plugin=CommandLine\nName=%s\nFrames=0-%d\nChunkSize=1\n"
        "OverrideTaskFailureDetection=true\nFailureDetectionTaskErrors=3\n",
        job->name, job->task_count - 1);
}

static void
put_deadline_plugin(FILE *out, const otx_job *job, const char *program)
{
    fprintf(
        out,
        "Executable=%s\nArguments=run <QUOTE>%s<QUOTE> --task <STARTFRAME>\n"
        "ShellExecute=False\n",
        program, job->path);
}

static const otx_engine engines[] = {
    {"make", "make -k -j 4 -f %s/Makefile", 1, {{"Makefile", put_make}}},
    {"slurm", "sbatch %s/job.sbatch", 1, {{"job.sbatch", put_slurm}}},
    {"opencue",
     "launch %s/job.xml, with opencue.api.launchSpecAndWait",
     1,
     {{"job.xml", put_opencue}}},
    {"deadline",
     "deadlinecommand %s/job_info.job %s/plugin_info.job",
     2,
     {{"job_info.job", put_deadline_job},
      {"plugin_info.job", put_deadline_plugin}}},
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
otx_engine_write(
    const otx_engine *engine, const otx_job *job, const char *program,
    const char *folder, char error[OTX_JOB_ERROR_BYTES])
{
    char path[OTX_JOB_PATH_BYTES];

    for (int i = 0; i < engine->file_count; ++i)
    {
        FILE *out;
        bool whole;

        snprintf(
            path, sizeof path, "%.3900s/%s", folder, engine->files[i].name);
        out = fopen(path, "w");
        whole = out != NULL;
        if (out)
        {
            engine->files[i].put(out, job, program);
            whole = !ferror(out);
            whole = fclose(out) == 0 && whole;
        }
        if (whole)
            continue;
        snprintf(
            error, OTX_JOB_ERROR_BYTES, "%.400s: %.80s", path, strerror(errno));
        return false;
    }
    return true;
}

/* test_engine.c -- names that mean something to shells come out as they are. */
#include "support.h"

#include "farm/engine.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What the file of an engine holds for a job at a path; to be freed. */
static char *
told(const char *engine, const char *path, int tasks, const char *name)
{
    const otx_engine *found = otx_engine_find(engine);
    otx_farm_job job = {
        .name = name, .task_count = tasks, .root = json_object()};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);

    assert_non_null(found);
    assert_non_null(out);
    snprintf(job.path, sizeof job.path, "%s", path);
    found->files[found->file_count - 1].put(out, &job, "printf");
    assert_int_equal(fclose(out), 0);
    otx_farm_job_free(&job);
    return text;
}

/* What `sh` makes of a command, with "%s %s\n" printed of its first words. */
static void
run_shell(const char *script, char *said, size_t bytes)
{
    char path[] = "/tmp/osdtex-test-engine-XXXXXX", command[128];
    const int file = mkstemp(path);
    FILE *pipe;
    size_t length;

    assert_true(file >= 0);
    assert_int_equal(
        write(file, script, strlen(script)), (ssize_t)strlen(script));
    close(file);
    snprintf(command, sizeof command, "SLURM_ARRAY_TASK_ID=7 sh %s", path);
    pipe = popen(command, "r");
    assert_non_null(pipe);
    length = fread(said, 1, bytes - 1, pipe);
    said[length] = '\0';
    pclose(pipe);
    unlink(path);
}

static const char *const hostile[] = {"/a b/j.json",        "/a'b/j.json",
                                      "/$HOME/`id`/j.json", "/a\"b\\c/j.json",
                                      "/a&b<c>/j;j.json",   "/*/?/j.json"};

/* printf 'run' is all that the program says here; the path must be one word:
 * the script, told to list its words, gives it back. */
static void
slurm_gets_one_word(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof hostile / sizeof hostile[0]; ++i)
    {
        char *script = told("slurm", hostile[i], 8, "job"), said[512];
        char *exec = strstr(script, "exec 'printf' run ");
        char changed[2048];

        assert_non_null(exec);
        snprintf(
            changed, sizeof changed, "printf '%%s|' %s",
            exec + strlen("exec 'printf' run "));
        run_shell(changed, said, sizeof said);
        assert_true(strncmp(said, hostile[i], strlen(hostile[i])) == 0);
        assert_string_equal(said + strlen(hostile[i]), "|--task|7|");
        free(script);
    }
}

/* &lt;, &gt; and &amp; are the only entities that are written. */
static void
unescape(char *text)
{
    char *to = text;

    for (; *text; ++to)
    {
        const bool less = strncmp(text, "&lt;", 4) == 0;
        const bool more = strncmp(text, "&gt;", 4) == 0;
        const bool and = strncmp(text, "&amp;", 5) == 0;

        *to = less ? '<' : more ? '>' : *text;
        text += less || more ? 4 : and? 5 : 1;
    }
    *to = '\0';
}

static void
opencue_gets_one_word(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof hostile / sizeof hostile[0]; ++i)
    {
        char *script = told("opencue", hostile[i], 8, "ab"), said[512];
        char *command = strstr(script, "<cmd>"), changed[2048];

        assert_non_null(strstr(script, "<job name=\"job_ab\">"));
        assert_non_null(command);
        *strstr(command, "</cmd>") = '\0';
        unescape(command);
        snprintf(
            changed, sizeof changed, "printf '%%s|' %s",
            command + strlen("<cmd>'printf' run "));
        /* #IFRAME# becomes a number: to a shell it begins no comment there. */
        run_shell(changed, said, sizeof said);
        assert_true(strncmp(said, hostile[i], strlen(hostile[i])) == 0);
        free(script);
    }
}

/* Tasks count from 0 in all of them, and the last one is there. */
static void
every_engine_is_told_of_every_task(void **state)
{
    static const struct
    {
        const char *engine, *words;
    } rows[] = {
        {"make", "--task 41\n"},
        {"slurm", "--array=0-41\n"},
        {"opencue", "<range>0-41</range>"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
    {
        char *script = told(rows[i].engine, "/j.json", 42, "job");

        assert_non_null(strstr(script, rows[i].words));
        free(script);
    }
    assert_null(otx_engine_find("tractor"));
    assert_null(otx_engine_find(""));
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slurm_gets_one_word),
        cmocka_unit_test(opencue_gets_one_word),
        cmocka_unit_test(every_engine_is_told_of_every_task),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* trial.c -- tiles or a stack, map, render; then the files are looked at. */
#include "regress/trial.h"
#include "regress/compare.h"
#include "regress/metric.h"
#include "regress/process.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    LOG_BYTES = 2000 /* of what a crashed case printed last */
};

typedef struct trial
{
    const otx_suite *suite;
    const json_t *item;
    const otx_trial_options *options;
    char folder[OTX_SUITE_PATH_BYTES];
    json_t *result;
    double wall, cpu; /* seconds; cpu of `map` alone */
} trial;

static void
path_in(const trial *t, const char *name, char out[OTX_SUITE_PATH_BYTES])
{
    snprintf(out, OTX_SUITE_PATH_BYTES, "%.3800s/%.250s", t->folder, name);
}

/* Says that a folder is a case's, to be emptied by the next run. */
static const char MARKER[] = ".osdtex-case";

/* Names of what a case makes: nothing else is removed. */
static bool
is_made_here(const char *name)
{
    static const char *const names[] = {
        "tiles.exr", "stack.exr",   "stack_mask1.png", "stack_mask2.png",
        "log.txt",   "report.json", "picture.png"};
    static const size_t stem = sizeof "model" - 1;

    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (strcmp(name, names[i]) == 0)
            return true;
    return strncmp(name, "model", stem) == 0 &&
           (name[stem] == '.' || name[stem] == '_');
}

/* Removes what the last run left in the folder; false when the folder is
 * somebody else's. */
static bool
empty_folder(int fd)
{
    const bool is_ours = faccessat(fd, MARKER, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
    DIR *folder = fdopendir(dup(fd));
    const struct dirent *entry;
    bool fine = folder != NULL;

    while (fine && (entry = readdir(folder)) != NULL)
    {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        fine = is_ours;
        if (is_ours && is_made_here(entry->d_name))
            unlinkat(fd, entry->d_name, 0);
    }
    if (folder)
        closedir(folder);
    return fine;
}

/* A folder of its own, not through a link, without the files of the last run.
 */
static bool
make_folder(trial *t, const char *name)
{
    int fd, marker = -1;

    snprintf(
        t->folder, sizeof t->folder, "%.3500s/%.250s", t->options->output,
        name);
    mkdir(t->folder, 0777);
    fd = open(t->folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0)
        return false;
    if (empty_folder(fd))
        marker = openat(
            fd, MARKER, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (marker >= 0)
        close(marker);
    close(fd);
    return marker >= 0;
}

/* The last lines of the log, for the report. */
static void
take_log(trial *t)
{
    char path[OTX_SUITE_PATH_BYTES], text[LOG_BYTES + 1];
    json_t *log;
    size_t bytes;
    FILE *in;

    path_in(t, "log.txt", path);
    in = fopen(path, "rb");
    if (!in)
        return;
    if (fseek(in, -LOG_BYTES, SEEK_END) != 0)
        rewind(in);
    bytes = fread(text, 1, LOG_BYTES, in);
    fclose(in);
    text[bytes] = '\0';
    log = json_string(text); /* NULL unless it is UTF-8 */
    json_object_set_new(
        t->result, "log", log ? log : json_string("(not UTF-8)"));
}

static void
crash(trial *t, json_t *why)
{
    json_object_set_new(t->result, "crash", why);
    take_log(t);
}

/* Runs a command to its end. */
static bool
run(trial *t, const otx_process_words *words, double *cpu)
{
    char log[OTX_SUITE_PATH_BYTES];
    const otx_process_options options = {
        .log = log,
        .timeout = otx_suite_number(t->suite, "timeout", 3600.0),
        .stop = t->options->stop,
    };
    otx_process_end end;

    path_in(t, "log.txt", log);
    if (!otx_process_run(words, &options, &end))
    {
        crash(t, json_string("the program could not be started"));
        return false;
    }
    t->wall += end.wall;
    *cpu = end.cpu;
    if (end.exit_code == 0)
        return true;
    if (end.stopped)
        json_object_set_new(t->result, "stopped", json_true());
    else if (end.timed_out)
        crash(t, json_sprintf("not done after %g s", options.timeout));
    else if (end.signal)
        crash(
            t,
            json_sprintf(
                "killed by signal %d (%s)", end.signal, strsignal(end.signal)));
    else
        crash(t, json_sprintf("exit code %d", end.exit_code));
    return false;
}

/* "osdtex map … && osdtex render …" grows by a command. */
static void
say_command(trial *t, const otx_process_words *words)
{
    char *line = otx_process_line(words);
    const char *before = otx_suite_text(t->result, "command");

    if (line)
        json_object_set_new(
            t->result, "command",
            before ? json_sprintf("%s &&\n%s", before, line)
                   : json_string(line));
    free(line);
}

static bool
run_words(trial *t, otx_process_words *words, double *cpu)
{
    bool good;

    say_command(t, words);
    good = run(t, words, cpu);
    otx_process_free(words);
    return good;
}

/* PROGRAM COMMAND FILE; PROGRAM may be words, such as "taskset 1 osdtex". */
static otx_process_words
begin(const trial *t, const char *command, const char *file)
{
    otx_process_words words = {0};

    otx_process_add_text(&words, t->options->program);
    otx_process_add(&words, command);
    otx_process_add(&words, file);
    return words;
}

static void
add_output(const trial *t, otx_process_words *words, const char *name)
{
    char path[OTX_SUITE_PATH_BYTES];

    path_in(t, name, path);
    otx_process_add(words, "-o");
    otx_process_add(words, path);
}

static bool
make_tiles(trial *t, char path[OTX_SUITE_PATH_BYTES])
{
    otx_process_words words;
    double cpu;

    path_in(t, "tiles.exr", path);
    words = begin(t, "tiles", otx_suite_text(t->item, "exemplar"));
    add_output(t, &words, "tiles.exr");
    otx_process_add_text(&words, otx_suite_text(t->item, "tiles"));
    return run_words(t, &words, &cpu);
}

static bool
make_stack(trial *t, char path[OTX_SUITE_PATH_BYTES])
{
    const char *to = otx_suite_text(t->item, "to");
    otx_process_words words;
    double cpu;

    path_in(t, "stack.exr", path);
    words = begin(t, "stack", otx_suite_text(t->item, "exemplar"));
    if (to)
        otx_process_add(&words, to);
    add_output(t, &words, "stack.exr");
    otx_process_add_text(&words, otx_suite_text(t->item, "stack"));
    return run_words(t, &words, &cpu);
}

/* The exemplars beside the first, and where they go. */
static void
add_several(const trial *t, otx_process_words *words)
{
    const char *mask = otx_suite_text(t->item, "mask");
    json_t *text;
    size_t i;

    json_array_foreach(json_object_get(t->item, "also"), i, text)
    {
        otx_process_add(words, "--also");
        otx_process_add(words, json_string_value(text));
    }
    if (mask)
    {
        otx_process_add(words, "--mask");
        otx_process_add(words, mask);
    }
}

/* A set of maps. */
static bool
is_folder(const char *path)
{
    struct stat info;

    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static void
add_save(const trial *t, otx_process_words *words)
{
    char path[OTX_SUITE_PATH_BYTES];

    if (!otx_suite_text(t->item, "again"))
        return;
    path_in(t, "model.osdtex", path);
    otx_process_add(words, "--save");
    otx_process_add(words, path);
}

/* Bakes from the saved mapping, where that is asked for. */
static bool
bake_again(trial *t)
{
    const char *how = otx_suite_text(t->item, "again");
    const char *swap = otx_suite_text(t->item, "swap");
    char path[OTX_SUITE_PATH_BYTES];
    otx_process_words words;
    double cpu;

    if (!how)
        return true;
    words = begin(t, "bake", otx_suite_text(t->item, "cage"));
    if (swap)
        otx_process_add(&words, swap);
    path_in(t, "model.osdtex", path);
    otx_process_add(&words, "--from");
    otx_process_add(&words, path);
    add_output(t, &words, "model_again.obj");
    otx_process_add_text(&words, how);
    return run_words(t, &words, &cpu);
}

static bool
map(trial *t)
{
    const int threads = (int)otx_suite_number(t->suite, "threads", 1.0);
    const char *exemplar = otx_suite_text(t->item, "exemplar");
    char made[OTX_SUITE_PATH_BYTES], path[OTX_SUITE_PATH_BYTES], text[16];
    otx_process_words words;

    if (otx_suite_text(t->item, "tiles"))
    {
        if (!make_tiles(t, made))
            return false;
        exemplar = made;
    }
    if (otx_suite_text(t->item, "stack"))
    {
        if (!make_stack(t, made))
            return false;
        exemplar = made;
    }
    words = begin(t, "map", otx_suite_text(t->item, "cage"));
    if (is_folder(exemplar))
        otx_process_add(&words, "--material");
    otx_process_add(&words, exemplar);
    add_save(t, &words);
    add_output(t, &words, "model.obj");
    otx_process_add(&words, "--method");
    otx_process_add(&words, otx_suite_text(t->item, "method"));
    add_several(t, &words);
    otx_process_add_text(&words, otx_suite_text(t->item, "options"));
    snprintf(text, sizeof text, "%d", threads);
    otx_process_add(&words, "--threads");
    otx_process_add(&words, text);
    path_in(t, "report.json", path);
    otx_process_add(&words, "--json-report");
    otx_process_add(&words, path);
    return run_words(t, &words, &t->cpu);
}

static bool
render(trial *t)
{
    const char *how = otx_suite_text(t->suite->table, "render");
    char path[OTX_SUITE_PATH_BYTES];
    otx_process_words words;
    double cpu;

    path_in(t, "model.obj", path);
    words = begin(t, "render", path);
    add_output(t, &words, "picture.png");
    otx_process_add_text(&words, how ? how : "--size 192x192");
    if (!run_words(t, &words, &cpu))
        return false;
    path_in(t, "picture.png", path);
    json_object_set_new(t->result, "picture", json_string(path));
    return true;
}

static bool
ends_in(const char *name, const char *end)
{
    const size_t length = strlen(name), tail = strlen(end);

    return length > tail && strcmp(name + length - tail, end) == 0;
}

/* What is compared by content: pixels or text; other files are not. */
static bool
hash_file(trial *t, const char *name, char hash[OSDTEX_HASH_BYTES])
{
    static const char *const texts[] = {".obj", ".mtl", ".usda", ".mtlx"};
    char path[OTX_SUITE_PATH_BYTES];
    bool is_text = false, good;

    for (int i = 0; i < 4; ++i)
        is_text = is_text || ends_in(name, texts[i]);
    if (!is_made_here(name) || strcmp(name, "stack.exr") == 0 ||
        (!is_text && !ends_in(name, ".exr")))
        return false;
    path_in(t, name, path);
    good = is_text ? otx_compare_hash_text(path, hash)
                   : otx_compare_hash_pixels(t->options->context, path, hash);
    if (!good)
        snprintf(hash, OSDTEX_HASH_BYTES, "cannot be read");
    return true;
}

static void
hash_files(trial *t)
{
    char hash[OSDTEX_HASH_BYTES];
    json_t *files = json_object();
    const struct dirent *entry;
    DIR *folder = opendir(t->folder);

    while (folder && (entry = readdir(folder)) != NULL)
        if (hash_file(t, entry->d_name, hash))
            json_object_set_new(files, entry->d_name, json_string(hash));
    if (folder)
        closedir(folder);
    json_object_set_new(t->result, "files", files);
}

static void
take_metrics(trial *t, double calibration)
{
    char path[OTX_SUITE_PATH_BYTES];
    json_t *report;

    path_in(t, "report.json", path);
    report = json_load_file(path, 0, NULL);
    json_object_set_new(
        t->result, "metrics", otx_metric_take(report, t->cpu, calibration));
    json_decref(report);
}

json_t *
otx_trial_run(
    const otx_suite *suite, const char *name, const json_t *item,
    const otx_trial_options *options)
{
    trial t = {
        .suite = suite,
        .item = item,
        .options = options,
        .result = json_object(),
    };
    const double calibration = otx_metric_calibrate();

    if (!make_folder(&t, name))
        crash(
            &t, json_sprintf(
                    "%s cannot be made, is a link, or holds files that osdtex "
                    "regress did not put there",
                    t.folder));
    else if (map(&t) && bake_again(&t) && render(&t))
    {
        hash_files(&t);
        take_metrics(&t, calibration);
    }
    json_object_set_new(t.result, "seconds", json_real(t.wall));
    return t.result;
}

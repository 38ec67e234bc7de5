/* report_handover.c -- what those who take over want to know. */
#include "api/report_handover.h"

#include "api/handle.h"
#include "base/clock.h"
#include "base/hash.h"
#include "colour/receiver.h"
#include "file/atomic_file.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

/* ------------------------------- process ------------------------------- */

static json_t *
text_of(const char *text)
{
    json_t *result = json_string(text);

    /* The bytes of a name need not be UTF-8. */
    return result ? result : json_string("?");
}

static double
seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static void
put_process(json_t *root, const osdtex_context *context)
{
    const osdtex_context_options *options = &context->options;
    json_t *process = json_object(), *words = json_array();
    struct rusage usage;

    json_object_set_new(root, "process", process);
    json_object_set_new(process, "arguments", words);
    for (int32_t i = 0; i < options->argument_count; ++i)
        json_array_append_new(words, text_of(options->arguments[i]));
    json_object_set_new(
        process, "wall_seconds", json_real(otx_clock_now() - context->begun));
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        json_object_set_new(
            process, "cpu_seconds",
            json_real(seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)));
}

/* ------------------------------- outputs ------------------------------- */

typedef struct ending
{
    const char *text;
    const char *role;
} ending;

/* What files are by their names; the first that fits. */
static const ending ENDINGS[] = {
    {"_cage.obj", "cage"},
    {".obj", "model"},
    {"_preview.mtl", "materials for previews"},
    {".mtl", "materials"},
    {".usda", "usd"},
    {".mtlx", "materialx"},
    {".osdtex", "mapping"},
    {".exr", "texture"},
    {".png", "texture"},
    {".json", "report"}};

static bool
ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), tail = strlen(end);

    return length >= tail && strcmp(text + length - tail, end) == 0;
}

static const char *
role_of(const otx_atomic_file_entry *file)
{
    for (size_t i = 0; !file->role && i < sizeof ENDINGS / sizeof *ENDINGS; ++i)
        if (ends_with(file->path, ENDINGS[i].text))
            return ENDINGS[i].role;
    return file->role ? file->role : "other";
}

/* Which map a texture NAME_normal.1001.exr is; NULL for what is no texture. */
static const char *
map_of(const char *path, const char *role)
{
    static const char *const maps[] = {
        "normal", "roughness", "height",  "metalness", "occlusion",
        "patch",  "uv",        "stretch", "seam",      "source"};
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const size_t length = strcspn(name, ".");

    if (strcmp(role, "texture") != 0)
        return NULL;
    for (size_t i = 0; i < sizeof maps / sizeof *maps; ++i)
    {
        const size_t tail = strlen(maps[i]);

        if (length > tail + 1 && name[length - tail - 1] == '_' &&
            strncmp(name + length - tail, maps[i], tail) == 0)
            return maps[i];
    }
    return "color";
}

static otx_status
put_output(otx_run *run, json_t *list, const otx_atomic_file_entry *file)
{
    const char *role = role_of(file), *map = map_of(file->path, role);
    json_t *one = json_object();
    char hash[OTX_HASH_TEXT_BYTES];
    struct stat info;

    json_array_append_new(list, one);
    if (!otx_hash_file(file->temporary, hash) ||
        stat(file->temporary, &info) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_IO, "report", otx_where_file(file->path),
            "the file that was just written cannot be read again");
    json_object_set_new(one, "path", text_of(file->path));
    json_object_set_new(one, "role", json_string(role));
    if (map)
        json_object_set_new(one, "map", json_string(map));
    json_object_set_new(one, "hash", json_string(hash));
    json_object_set_new(one, "bytes", json_integer((json_int_t)info.st_size));
    return OSDTEX_OK;
}

/* Of a set of files all that are finished, as they will be. */
static otx_status
put_outputs(otx_run *run, json_t *root)
{
    json_t *list = json_array();
    otx_atomic_file_entry file;

    json_object_set_new(root, "outputs", list);
    if (!run->outputs)
        return OSDTEX_OK;
    OTX_TRY(otx_atomic_file_seal(run, run->outputs));
    for (int32_t i = 0; otx_atomic_file_at(run->outputs, i, &file); ++i)
    {
        OTX_TRY(otx_pulse(run));
        OTX_TRY(put_output(run, list, &file));
    }
    return OSDTEX_OK;
}

/* ------------------------------- verdicts ------------------------------ */

typedef enum verdict
{
    GOOD,
    FAIR,
    POOR
} verdict;

/* By two limits of a figure that is better when it is less. */
static verdict
judge(double value, double good, double fair)
{
    return value <= good ? GOOD : value <= fair ? FAIR : POOR;
}

__attribute__((format(printf, 4, 5))) static void
put_verdict(json_t *list, const char *what, verdict v, const char *format, ...)
{
    static const char *const words[] = {"good", "fair", "poor"};
    json_t *one = json_object();
    char sentence[256];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    json_object_set_new(one, "what", json_string(what));
    json_object_set_new(one, "verdict", json_string(words[v]));
    json_object_set_new(one, "sentence", json_string(sentence));
    json_array_append_new(list, one);
}

/* On a straight walk, every so many texels a seam that shows. */
static void
judge_seams(json_t *list, const otx_measure *m)
{
    const double per_100 = m->seams_per_100 * m->seam_visible_share;
    const verdict v = judge(per_100, 100.0 / 300.0, 1.0);

    if (!isfinite(per_100))
        return;
    if (per_100 <= 0.0)
        put_verdict(list, "seams", GOOD, "no seam shows");
    else
        put_verdict(
            list, "seams", v,
            "a straight walk meets a seam that shows every %.0f texels "
            "(good: 300 or more, fair: 100 or more)",
            100.0 / per_100);
}

static void
judge_faces(json_t *list, const otx_measure *m)
{
    const int64_t bad =
        (int64_t)m->flips + m->folds + m->uncovered + m->outside;

    if (bad == 0)
        put_verdict(
            list, "faces", GOOD,
            "every face is covered, and none is turned over or folded");
    else
        put_verdict(
            list, "faces", POOR,
            "%lld faces are bare, turned over, folded or outside the picture: "
            "see distortion",
            (long long)bad);
}

static void
judge_stretch(json_t *list, const otx_measure *m)
{
    const double ratio = m->stretch_ratio_p95;

    if (isfinite(ratio))
        put_verdict(
            list, "stretch", judge(ratio, 1.25, 2.0),
            "19 of 20 texels are at most %.2f times as long as wide (good: "
            "1.25, fair: 2)",
            ratio);
}

static void
judge_variety(json_t *list, const otx_measure *m)
{
    const double missing = 1.0 - m->coverage;

    if (isfinite(missing))
        put_verdict(
            list, "variety", judge(missing, 0.5, 0.8),
            "%.0f %% of the picture is in use (good: 50 or more, fair: 20 or "
            "more); where it is less, pieces recur",
            100.0 * m->coverage);
}

/* ------------------------------- receiver ------------------------------ */

/* What is left to be told to the program that reads it, if anything. */
static const char *const HINTS[OTX_RECEIVER_COUNT][3] = {
    [OTX_RECEIVER_BLENDER] =
        {"maps other than the colour are Non-Color; the colour's space is that "
         "named here",
         "several UDIM tiles are one image of source Tiled",
         "the cage: Subdivision Surface with Use Limit Surface, or import it "
         "by osdtex_import.py, which sets creases and the UV rule"},
    [OTX_RECEIVER_MAYA] =
        {"file nodes: colour Raw where the rendering space is ACEScg, all "
         "other maps Raw",
         "UV Tiling Mode is UDIM (Mari) where there are several tiles",
         "the cage: smooth mesh preview by OpenSubdiv, Catmull-Clark, with the "
         "UV rule that its first comment states"},
    [OTX_RECEIVER_HOUDINI] =
        {"file names take <UDIM>; maps other than the colour are read raw",
         "the cage: Subdivide by OpenSubdiv, or render it as a subdivision "
         "surface",
         "crease weights are those of the file's tags"},
    [OTX_RECEIVER_USD] =
        {"NAME.usda has the look, scheme, creases and the UV rule",
         "sourceColorSpace is raw for all textures", NULL},
    [OTX_RECEIVER_WEB] = {
        "the colour is 8-bit sRGB, all other maps are linear data",
        "show NAME.obj: the browser does not subdivide", NULL}};

static void
put_receiver(json_t *root, const osdtex_mapping *mapping)
{
    const otx_receiver receiver = mapping->exemplar->exemplar.receiver;
    const char *name = otx_receiver_name(receiver);
    json_t *one = json_object(), *hints = json_array();

    json_object_set_new(root, "receiver", one);
    json_object_set_new(one, "for", name ? json_string(name) : json_null());
    json_object_set_new(
        one, "color_space", text_of(mapping->exemplar->info.linear_space));
    json_object_set_new(one, "uv_origin", json_string("lower left"));
    json_object_set_new(one, "hints", hints);
    for (int i = 0; name && i < 3 && HINTS[receiver][i]; ++i)
        json_array_append_new(hints, json_string(HINTS[receiver][i]));
}

otx_status
otx_report_handover(
    otx_call *call, const osdtex_mapping *mapping, const otx_measure *measure,
    json_t *root)
{
    json_t *verdicts = json_array();

    put_process(root, call->context);
    OTX_TRY(put_outputs(&call->run, root));
    json_object_set_new(root, "verdicts", verdicts);
    judge_faces(verdicts, measure);
    judge_seams(verdicts, measure);
    judge_stretch(verdicts, measure);
    judge_variety(verdicts, measure);
    put_receiver(root, mapping);
    return OSDTEX_OK;
}

/* history.c -- appending a line, reading the last ones. */
#include "regress/history.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static json_t *
line_of(const json_t *run)
{
    json_t *line = json_object(), *cases = json_object(), *result;
    static const char *const kept[] = {"time", "version", "build", "machine"};
    const char *name;

    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; ++i)
        json_object_set(line, kept[i], json_object_get(run, kept[i]));
    json_object_foreach(json_object_get(run, "cases"), name, result)
    {
        json_object_set_new(
            cases, name,
            json_pack(
                "{s:O,s:O?}", "status", json_object_get(result, "status"),
                "metrics", json_object_get(result, "metrics")));
    }
    json_object_set_new(line, "cases", cases);
    return line;
}

bool
otx_history_append(const char *path, const json_t *run)
{
    json_t *line = line_of(run);
    char *text = json_dumps(line, JSON_COMPACT | JSON_REAL_PRECISION(9));
    FILE *out = text ? fopen(path, "a") : NULL;
    bool whole = out != NULL;

    if (out)
    {
        whole = fprintf(out, "%s\n", text) > 0;
        whole = fclose(out) == 0 && whole;
    }
    free(text);
    json_decref(line);
    return whole;
}

json_t *
otx_history_read(const char *path)
{
    json_t *history = json_array(), *line;
    FILE *in = fopen(path, "r");
    char *text = NULL;
    size_t room = 0;

    while (in && getline(&text, &room, in) > 0)
    {
        line = json_loads(text, 0, NULL);
        if (line)
            json_array_append_new(history, line);
        if (json_array_size(history) > OTX_HISTORY_SHOWN)
            json_array_remove(history, 0);
    }
    if (in)
        fclose(in);
    free(text);
    return history;
}

json_t *
otx_history_trend(const json_t *history, const char *name, const char *metric)
{
    json_t *trend = json_array(), *line;
    size_t i;

    json_array_foreach(history, i, line)
    {
        json_t *value = json_object_get(
            json_object_get(
                json_object_get(json_object_get(line, "cases"), name),
                "metrics"),
            metric);

        if (json_is_number(value))
            json_array_append(trend, value);
    }
    return trend;
}

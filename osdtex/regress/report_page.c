/* report_page.c -- the page: failed first, what to look at beside what to do.
 *
 * The difference is not a third picture: the browser takes it, from the two
 * that are there, and multiplies it. Each picture is in the file once, as a
 * property that all places share. */
#include "regress/report_page.h"
#include "regress/compare.h"
#include "regress/history.h"
#include "regress/html.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const char style[] =
    ":root{color-scheme:light dark;--line:#8884;--bad:#c62828;--odd:#b26a00;"
    "--good:#2e7d32}\n"
    "*{box-sizing:border-box}\n"
    "body{font:15px/1.45 system-ui,sans-serif;margin:0 auto;padding:1rem;"
    "max-width:76rem}\n"
    "h1{font-size:1.35rem;margin:.2rem 0}\n"
    "h2{font-size:1.05rem;margin:0;overflow-wrap:anywhere}\n"
    "p{margin:.4rem 0}\n"
    ".about{opacity:.75}\n"
    "article{border:1px solid var(--line);border-left:.4rem solid "
    "var(--good);border-radius:.4rem;padding:.8rem;margin:1rem 0}\n"
    "article.fail,article.crashed{border-left-color:var(--bad)}\n"
    "article.missing{border-left-color:var(--odd)}\n"
    "b.fail,b.crashed{color:var(--bad)}b.missing,b.skipped{color:var(--odd)}"
    "b.pass{color:var(--good)}\n"
    ".pictures{display:grid;gap:.6rem;margin:.6rem 0;"
    "grid-template-columns:repeat(auto-fill,minmax(min(15rem,100%),1fr))}\n"
    "figure{margin:0}figcaption{font-size:.85rem;opacity:.75}\n"
    ".shot{position:relative;background:#000 center/100% 100% no-repeat;"
    "image-rendering:pixelated;border-radius:.2rem;outline-offset:2px}\n"
    ".now{background-image:var(--now)}.was{background-image:var(--was)}\n"
    ".swap:hover,.swap:focus,.swap:active{background-image:var(--was)}\n"
    ".shot i{position:absolute;width:1.4rem;height:1.4rem;"
    "margin:-.7rem;border:2px solid #fd0;border-radius:50%}\n"
    ".difference{background-image:var(--now),var(--was);"
    "background-blend-mode:difference,normal;filter:brightness(16)}\n"
    ".scroll{overflow-x:auto}\n"
    "table{border-collapse:collapse;font-size:.88rem;"
    "font-variant-numeric:tabular-nums}\n"
    "td,th{text-align:right;padding:.1rem .7rem .1rem 0;white-space:nowrap}"
    "td:first-child,th:first-child{text-align:left}\n"
    "pre{background:#8882;padding:.5rem;border-radius:.3rem;margin:.3rem 0;"
    "white-space:pre-wrap;overflow-wrap:anywhere;font-size:.85rem}\n"
    "summary{cursor:pointer}\n"
    "nav a{margin-right:.8rem;overflow-wrap:anywhere}\n"
    ".trend{width:7.5rem;height:1.5rem;vertical-align:middle;fill:none;"
    "stroke:currentColor;stroke-width:1.2}.trend circle{fill:currentColor}"
    ".trend line.was{stroke-dasharray:3 3;opacity:.5}\n"
    "@media(max-width:40rem){body{padding:.5rem}.optional{display:none}}\n";

/* The order in which cases are shown. */
static const char *const statuses[] = {"crashed", "fail", "missing", "pass"};

enum
{
    STATUS_COUNT = sizeof statuses / sizeof statuses[0]
};

static const char *
text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));

    return text ? text : "";
}

static bool
has_status(const json_t *result, const char *status)
{
    return strcmp(text_of(result, "status"), status) == 0;
}

static void
put_status(FILE *out, const char *status)
{
    fprintf(out, "<b class=\"%s\">%s</b>", status, status);
}

/* ---------------------------------------------------------------------- */

/* The middle of a pixel over the side. */
static double
percent_of(const json_t *pixel, int side)
{
    return 100.0 * ((double)json_integer_value(pixel) + 0.5) / side;
}

/*   mark  x and y of a pixel to point at, NULL none */
static void
put_shot(
    FILE *out, const char *kind, const char *caption, const int size[2],
    const json_t *mark)
{
    fprintf(
        out,
        "<figure><div class=\"shot %s\" role=\"img\" tabindex=\"0\" "
        "aria-label=\"%s\" style=\"aspect-ratio:%d/%d\">",
        kind, caption, size[0], size[1]);
    if (mark)
        fprintf(
            out, "<i style=\"left:%.2f%%;top:%.2f%%\"></i>",
            percent_of(json_array_get(mark, 0), size[0]),
            percent_of(json_array_get(mark, 1), size[1]));
    fprintf(out, "</div><figcaption>%s</figcaption></figure>\n", caption);
}

static void
put_pictures(FILE *out, const json_t *result)
{
    const json_t *tier = json_object_get(result, "tolerance");
    const char *now = text_of(result, "picture");
    const char *was = text_of(tier, "reference");
    int size[2];

    if (!otx_html_png_size(now, size) || size[0] < 1 || size[1] < 1)
        return;
    fputs("<div class=\"pictures\" style=\"--now:", out);
    otx_html_put_png(out, now);
    if (*was)
    {
        fputs(";--was:", out);
        otx_html_put_png(out, was);
    }
    fputs("\">\n", out);
    put_shot(
        out, *was ? "now swap" : "now",
        *was ? "new (hover or tap: reference)" : "new; there is no reference",
        size, NULL);
    if (*was)
    {
        put_shot(out, "was", "reference", size, NULL);
        put_shot(
            out, "difference", "difference &times; 16", size,
            has_status(tier, "pass") ? NULL : json_object_get(tier, "at"));
    }
    fputs("</div>\n", out);
}

static void
put_tolerance(FILE *out, const json_t *tier)
{
    const json_t *at = json_object_get(tier, "at");
    const double pixels = json_number_value(json_object_get(tier, "pixels"));

    if (!at)
    {
        fputs("<p>", out);
        otx_html_put_text(out, text_of(tier, "text"));
        fputs("</p>\n", out);
        return;
    }
    fprintf(
        out,
        "<p>Picture: worst difference %.4f at %d,%d (allowed %g); %lld of "
        "%.0f pixels over %g (allowed %.0f); %lld differ at all.</p>\n",
        json_number_value(json_object_get(tier, "worst")),
        (int)json_integer_value(json_array_get(at, 0)),
        (int)json_integer_value(json_array_get(at, 1)), OTX_COMPARE_HARD,
        (long long)json_integer_value(json_object_get(tier, "over")), pixels,
        OTX_COMPARE_FAIL, floor(OTX_COMPARE_SHARE * pixels),
        (long long)json_integer_value(json_object_get(tier, "differing")));
}

/* Only the files that are not as they were, or that all are. */
static void
put_exact(FILE *out, const json_t *tier)
{
    const json_t *files = json_object_get(tier, "files");
    bool any = false;
    json_t *row;
    size_t i;

    fputs("<p>Files: ", out);
    if (has_status(tier, "skipped"))
    {
        fputs("not compared, as the reference is from another machine (", out);
        otx_html_put_text(out, text_of(tier, "reference_machine"));
        fputs(")</p>\n", out);
        return;
    }
    json_array_foreach(files, i, row)
    {
        if (has_status(row, "pass"))
            continue;
        fputs(any ? ", " : "", out);
        otx_html_put_text(out, text_of(row, "name"));
        fputs(
            has_status(row, "missing") ? " has no reference" : " differs", out);
        any = true;
    }
    if (!any)
        fprintf(out, "all %zu as they were", json_array_size(files));
    fputs(".</p>\n", out);
}

/* ---------------------------------------------------------------------- */

static void
put_number(FILE *out, const json_t *number)
{
    if (json_is_number(number))
        fprintf(out, "<td>%.5g</td>", json_number_value(number));
    else
        fputs("<td>&ndash;</td>", out);
}

static void
put_change(FILE *out, const json_t *value, const json_t *reference)
{
    const double now = json_number_value(value);
    const double was = json_number_value(reference);

    if (json_is_number(value) && json_is_number(reference) && was != 0.0)
        fprintf(out, "<td>%+.2f %%</td>", 100.0 * (now - was) / fabs(was));
    else
        fputs("<td></td>", out);
}

static void
put_metric(
    FILE *out, const char *name, const json_t *row, const json_t *history)
{
    const json_t *value = json_object_get(row, "value");
    const json_t *reference = json_object_get(row, "reference");
    json_t *trend = otx_history_trend(history, name, text_of(row, "name"));

    fputs("<tr><td>", out);
    otx_html_put_text(out, text_of(row, "name"));
    fputs("</td>", out);
    put_number(out, value);
    put_number(out, reference);
    put_change(out, value, reference);
    fputs("<td class=\"optional\">", out);
    otx_html_put_text(out, text_of(row, "allowed"));
    fputs("</td><td>", out);
    put_status(out, text_of(row, "status"));
    fputs("</td><td>", out);
    otx_html_put_sparkline(out, trend, reference);
    fputs("</td></tr>\n", out);
    json_decref(trend);
}

static void
put_metrics(
    FILE *out, const char *name, const json_t *tier, const json_t *history)
{
    json_t *row;
    size_t i;

    fprintf(
        out,
        "<details%s><summary>Figures</summary><div class=\"scroll\"><table>"
        "<tr><th>figure</th><th>new</th><th>reference</th><th>change</th>"
        "<th class=\"optional\">allowed</th><th></th><th>trend</th></tr>\n",
        has_status(tier, "pass") ? "" : " open");
    json_array_foreach(json_object_get(tier, "rows"), i, row)
    {
        put_metric(out, name, row, history);
    }
    fputs("</table></div></details>\n", out);
}

static void
put_crash(FILE *out, const json_t *result)
{
    fputs("<p>", out);
    otx_html_put_text(out, text_of(result, "crash"));
    fputs("</p>\n", out);
    if (!*text_of(result, "log"))
        return;
    fputs("<pre class=\"log\">", out);
    otx_html_put_text(out, text_of(result, "log"));
    fputs("</pre>\n", out);
}

static void
put_tiers(FILE *out, const json_t *result)
{
    static const char *const names[] = {"exact", "tolerance", "metric"};

    fputs("<p>", out);
    for (int i = 0; i < 3; ++i)
    {
        fprintf(out, "%s%s: ", i > 0 ? " &middot; " : "", names[i]);
        put_status(out, text_of(json_object_get(result, names[i]), "status"));
    }
    fputs("</p>\n", out);
}

static void
put_commands(FILE *out, const json_t *result)
{
    fprintf(
        out,
        "<details%s><summary>To make this the reference</summary>"
        "<pre class=\"update\">",
        has_status(result, "pass") ? "" : " open");
    otx_html_put_text(out, text_of(result, "update"));
    fprintf(
        out,
        "</pre></details>\n<details><summary>How it was made, %.1f s"
        "</summary><pre>",
        json_number_value(json_object_get(result, "seconds")));
    otx_html_put_text(out, text_of(result, "command"));
    fputs("</pre></details>\n", out);
}

static void
put_case(
    FILE *out, const char *name, const json_t *result, const json_t *history)
{
    const char *status = text_of(result, "status");

    fprintf(out, "<article class=\"%s\" id=\"%s\">\n<h2>", status, name);
    put_status(out, status);
    fprintf(out, " %s</h2>\n", name);
    if (has_status(result, "crashed"))
        put_crash(out, result);
    else
    {
        put_tiers(out, result);
        put_pictures(out, result);
        put_tolerance(out, json_object_get(result, "tolerance"));
        put_exact(out, json_object_get(result, "exact"));
        put_metrics(out, name, json_object_get(result, "metric"), history);
    }
    put_commands(out, result);
    fputs("</article>\n", out);
}

/* ---------------------------------------------------------------------- */

static size_t
count_of(const json_t *cases, const char *status)
{
    size_t count = 0;
    const char *name;
    json_t *result;

    json_object_foreach((json_t *)(uintptr_t)cases, name, result)
    {
        count += has_status(result, status);
    }
    return count;
}

static void
put_head(FILE *out, const json_t *run)
{
    const json_t *cases = json_object_get(run, "cases");
    const char *name;
    json_t *result;

    fputs(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
        "charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width,initial-scale=1\">\n<title>osdtex: ",
        out);
    for (int i = 0; i < STATUS_COUNT; ++i)
        fprintf(
            out, "%s%zu %s", i > 0 ? ", " : "", count_of(cases, statuses[i]),
            statuses[i]);
    fprintf(out, "</title>\n<style>\n%s</style>\n</head>\n<body>\n<h1>", style);
    for (int i = 0; i < STATUS_COUNT; ++i)
        fprintf(
            out, "%s%zu <b class=\"%s\">%s</b>", i > 0 ? ", " : "",
            count_of(cases, statuses[i]), statuses[i], statuses[i]);
    fputs("</h1>\n<p class=\"about\">", out);
    otx_html_put_text(out, text_of(run, "suite"));
    fprintf(out, " &middot; osdtex %s &middot; ", text_of(run, "build"));
    otx_html_put_text(out, text_of(run, "machine"));
    fprintf(out, " &middot; %s</p>\n<nav>", text_of(run, "time"));
    for (int i = 0; i < STATUS_COUNT - 1; ++i)
    {
        json_object_foreach((json_t *)(uintptr_t)cases, name, result)
        {
            if (has_status(result, statuses[i]))
                fprintf(out, "<a href=\"#%s\">%s</a> ", name, name);
        }
    }
    fputs("</nav>\n", out);
}

bool
otx_report_page_write(
    const char *path, const json_t *run, const json_t *history)
{
    FILE *out = fopen(path, "w");
    const char *name;
    json_t *result;
    bool whole;

    if (!out)
        return false;
    put_head(out, run);
    for (int i = 0; i < STATUS_COUNT; ++i)
    {
        json_object_foreach(json_object_get(run, "cases"), name, result)
        {
            if (has_status(result, statuses[i]))
                put_case(out, name, result, history);
        }
    }
    fputs("</body>\n</html>\n", out);
    whole = !ferror(out);
    return fclose(out) == 0 && whole;
}

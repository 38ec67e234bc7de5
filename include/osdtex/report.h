/* report.h -- what was done and how good it is, in figures and as JSON.
 *
 *     osdtex_report *report;
 *
 *     osdtex_report_create(context, mapping, NULL, &report);
 *     const osdtex_report_info *info = osdtex_report_describe(report);
 *
 *     for (int32_t i = 0; i < info->figure_count; ++i)
 *         printf("%s  %g %s\n", info->figures[i].key, info->figures[i].value,
 *                info->figures[i].unit);
 *     osdtex_report_destroy(report);
 *
 * The text is the whole report as docs/report.md describes it: inputs with
 * hashes, options and colour decisions as resolved, patches, seams, distortion,
 * times since the context was created, findings. The figures are its numbers,
 * for hosts that read no JSON; which of them matter, and what each is blind to,
 * is said in docs/notes/measure.md. */
#ifndef OSDTEX_REPORT_H
#define OSDTEX_REPORT_H

#include <osdtex/mapping.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_report osdtex_report;

typedef int32_t osdtex_figure_kind;
enum
{
    OSDTEX_FIGURE_COUNT = 0, /* a whole number */
    OSDTEX_FIGURE_REAL = 1
};

/* A number of the report. Rows of the same key, one after the other, are a
 * list: the patches of each level, or the share of each exemplar. */
typedef struct osdtex_figure
{
    const char *key;      /* "seams.visible_share": its place in the JSON */
    const char *unit;     /* "texels", "Delta E"; "" of a plain number */
    const char *sentence; /* what it says */
    double value;         /* NAN where it could not be measured */
    osdtex_figure_kind kind;
    int32_t reserved;
} osdtex_figure;

typedef struct osdtex_report_info
{
    const char *json;             /* UTF-8, keys sorted, NUL at its end */
    size_t json_bytes;            /* without the NUL */
    const osdtex_figure *figures; /* [figure_count] */
    int32_t figure_count;
    int32_t reserved;
} osdtex_report_info;

typedef struct osdtex_report_options
{
    size_t size;
    /* Windows at seams, and as many inside patches, that are looked up in the
     * exemplar for the figures seams.windows, which is slow: 60 of each
     * took 3.7 seconds of processor time in 512 x 512 texels. 64 tell medians
     * apart; 0: none, and those figures are 0. */
    int32_t windows;
    int32_t reserved;
} osdtex_report_options;

static inline osdtex_report_options
osdtex_report_options_default(void)
{
    osdtex_report_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.windows = 64;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_report_options_init(osdtex_report_options *out, size_t bytes);

/* Measures a mapping; most of the time goes into windows. Figures of the
 * mapping are the same for any number of threads; seconds and bytes are not.
 * The mapping may be destroyed before the report. ARGUMENT, MEMORY, CANCELLED.
 */
OSDTEX_API osdtex_status osdtex_report_create(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_report_options *options, osdtex_report **out);
OSDTEX_API const osdtex_report_info *
osdtex_report_describe(const osdtex_report *report);
OSDTEX_API void osdtex_report_destroy(osdtex_report *report);

/* Writes the text into a file. As osdtex_report_create, and IO. */
OSDTEX_API osdtex_status osdtex_report_write(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path);

OSDTEX_END_DECLS

#endif

/* html.h -- text, pictures and curves as they stand in a page. */
#ifndef OTX_REGRESS_HTML_H
#define OTX_REGRESS_HTML_H

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/* With what markup would take for its own made plain. NULL is nothing. */
void otx_html_put_text(FILE *out, const char *text);

/* A PNG file as url(data:…). False when it cannot be read: nothing is put. */
bool otx_html_put_png(FILE *out, const char *path);

/* Width and height of a PNG file; false when it is none. */
bool otx_html_png_size(const char *path, int size[2]);

/* Numbers as a curve, the newest at the right with a dot, `reference` as a
 * dashed line. JSON null: no reference. */
void otx_html_put_sparkline(
    FILE *out, const json_t *numbers, const json_t *reference);

#endif

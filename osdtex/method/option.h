/* option.h -- the settings of a method as one table.
 *
 * The table is the only place where a setting's name, kind, range, default and
 * sentence of help are written down: validation, `--set KEY=VALUE`, `--help`,
 * the man page and the docs all read it. Values live in a struct of doubles
 * and int32s at the offsets that the table gives. */
#ifndef OTX_METHOD_OPTION_H
#define OTX_METHOD_OPTION_H

#include "base/run.h"

typedef enum otx_option_kind
{
    OTX_OPTION_REAL,    /* double */
    OTX_OPTION_INTEGER, /* int32_t */
    OTX_OPTION_CHOICE,  /* int32_t, index into choices */
    OTX_OPTION_SWITCH   /* int32_t, 0 or 1; written on|off */
} otx_option_kind;

typedef struct otx_option
{
    const char *name;
    otx_option_kind kind;
    size_t offset;              /* into the settings struct */
    double minimum, maximum;    /* REAL and INTEGER; inclusive */
    double fallback;            /* the default; index for CHOICE */
    const char *const *choices; /* NULL-terminated; CHOICE only */
    const char *help;           /* one sentence, with the unit */
} otx_option;

/* Fills `settings` with the defaults of the table. */
void
otx_option_defaults(const otx_option *options, int32_t count, void *settings);

/* Sets one value from text. ARGUMENT, with near names or the range in the
 * sentence, when the key is unknown or the value does not fit. */
otx_status otx_option_set(
    otx_run *run, const otx_option *options, int32_t count, void *settings,
    const char *key, const char *value);

/* Writes the value as `otx_option_set` reads it, into text[64]. */
void
otx_option_text(const otx_option *option, const void *settings, char text[64]);

#endif

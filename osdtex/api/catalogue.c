/* catalogue.c -- the table of methods and their settings, for anyone. */
#include "method/method.h"

#include <osdtex/osdtex.h>

_Static_assert(
    (int)OSDTEX_OPTION_REAL == (int)OTX_OPTION_REAL &&
        (int)OSDTEX_OPTION_INTEGER == (int)OTX_OPTION_INTEGER &&
        (int)OSDTEX_OPTION_CHOICE == (int)OTX_OPTION_CHOICE &&
        (int)OSDTEX_OPTION_SWITCH == (int)OTX_OPTION_SWITCH,
    "public and internal kinds of settings are the same numbers");

int32_t
osdtex_method_count(void)
{
    return otx_method_count();
}

static const otx_method *
method_at(int32_t index)
{
    return index >= 0 && index < otx_method_count() ? otx_method_at(index)
                                                    : NULL;
}

osdtex_status
osdtex_method_get(int32_t index, osdtex_method_info *out)
{
    const otx_method *method = method_at(index);

    if (!method || !out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = (osdtex_method_info){
        method->name, method->summary, method->source, method->option_count, 0};
    return OSDTEX_OK;
}

/* The default as text. A setting is written where its table says, so one that
 * stands at offset 0 of a small buffer is enough to print it. */
static void
fallback_text(const otx_option *option, char text[64])
{
    otx_option alone = *option;
    double buffer = 0.0;

    alone.offset = 0;
    otx_option_defaults(&alone, 1, &buffer);
    otx_option_text(&alone, &buffer, text);
}

osdtex_status
osdtex_option_get(int32_t index, int32_t option, osdtex_option_info *out)
{
    const otx_method *method = method_at(index);
    const otx_option *o;

    if (!method || !out || option < 0 || option >= method->option_count)
        return OSDTEX_ERROR_ARGUMENT;
    o = &method->options[option];
    *out = (osdtex_option_info){
        .name = o->name,
        .help = o->help,
        .choices = o->choices,
        .minimum = o->minimum,
        .maximum = o->maximum,
        .kind = (osdtex_option_kind)o->kind,
    };
    fallback_text(o, out->fallback);
    return OSDTEX_OK;
}

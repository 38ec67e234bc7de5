/* option.c -- settings from text, settings to text, through their table.
 *
 * Numbers are read and written by charconv, so that a host that has called
 * setlocale changes nothing. */
#include "method/option.h"
#include "bridge/charconv.h"
#include "word/near.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void
store(const otx_option *option, void *settings, double value)
{
    char *at = (char *)settings + option->offset;
    const int32_t whole = (int32_t)value;

    if (option->kind == OTX_OPTION_REAL)
        memcpy(at, &value, sizeof value);
    else
        memcpy(at, &whole, sizeof whole);
}

static double
load(const otx_option *option, const void *settings)
{
    const char *at = (const char *)settings + option->offset;
    double value;
    int32_t whole;

    if (option->kind == OTX_OPTION_REAL)
    {
        memcpy(&value, at, sizeof value);
        return value;
    }
    memcpy(&whole, at, sizeof whole);
    return whole;
}

void
otx_option_defaults(const otx_option *options, int32_t count, void *settings)
{
    for (int32_t i = 0; i < count; ++i)
        store(&options[i], settings, options[i].fallback);
}

static void
number_text(double value, char text[OTX_CHARCONV_BYTES + 1])
{
    text[otx_charconv_print_double(text, value)] = '\0';
}

static const char *
choice_name(const void *choices, int32_t index)
{
    return ((const char *const *)choices)[index];
}

static otx_status
set_choice(
    otx_run *run, const otx_option *option, const char *const *choices,
    void *settings, const char *value)
{
    char all[256] = "";
    size_t length = 0;

    for (int32_t i = 0; choices[i]; ++i)
    {
        if (strcmp(choices[i], value) == 0)
        {
            store(option, settings, i);
            return OSDTEX_OK;
        }
        if (length < sizeof all)
            length += (size_t)snprintf(
                all + length, sizeof all - length, "%s%s", i > 0 ? ", " : "",
                choices[i]);
    }
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "options", OTX_NOWHERE,
        "setting '%s' is one of %s, not '%.60s'", option->name, all, value);
}

static otx_status
set_number(
    otx_run *run, const otx_option *option, void *settings, const char *value)
{
    const bool whole = option->kind == OTX_OPTION_INTEGER;
    const char *const end = value + strlen(value);
    const char *rest = value;
    char least[OTX_CHARCONV_BYTES + 1], most[OTX_CHARCONV_BYTES + 1];
    double number = 0.0;
    const bool is_number = otx_charconv_read_double(
                               value, end, &number, &rest) == OTX_CHARCONV_OK &&
                           rest == end && value != end &&
                           (!whole || number == floor(number));

    /* Written so that NaN is refused too. */
    if (is_number && number >= option->minimum && number <= option->maximum)
    {
        store(option, settings, number);
        return OSDTEX_OK;
    }
    number_text(option->minimum, least);
    number_text(option->maximum, most);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "options", OTX_NOWHERE,
        "setting '%s' is a%s number from %s to %s, not '%.60s'", option->name,
        whole ? " whole" : "", least, most, value);
}

typedef struct option_list
{
    const otx_option *options;
    int32_t count;
} option_list;

static const char *
option_name(const void *list, int32_t index)
{
    const option_list *l = list;

    return index < l->count ? l->options[index].name : NULL;
}

otx_status
otx_option_set(
    otx_run *run, const otx_option *options, int32_t count, void *settings,
    const char *key, const char *value)
{
    static const char *const switches[] = {"off", "on", NULL};
    const option_list list = {options, count};
    char near_names[256];

    for (int32_t i = 0; i < count; ++i)
    {
        const otx_option *option = &options[i];

        if (strcmp(option->name, key) != 0)
            continue;
        if (option->kind == OTX_OPTION_CHOICE)
            return set_choice(run, option, option->choices, settings, value);
        if (option->kind == OTX_OPTION_SWITCH)
            return set_choice(run, option, switches, settings, value);
        return set_number(run, option, settings, value);
    }
    otx_near_text(key, option_name, &list, near_names);
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, "options", OTX_NOWHERE,
        "the method has no setting '%.60s'%s", key, near_names);
}

void
otx_option_text(const otx_option *option, const void *settings, char text[64])
{
    const double value = load(option, settings);

    if (option->kind == OTX_OPTION_CHOICE)
        snprintf(text, 64, "%s", choice_name(option->choices, (int32_t)value));
    else if (option->kind == OTX_OPTION_SWITCH)
        snprintf(text, 64, "%s", value != 0.0 ? "on" : "off");
    else
        number_text(value, text);
}

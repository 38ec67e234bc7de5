/* method.h -- how to texture, and the settings of each method.
 *
 * For menus and checks before a job. All that can be set is in these tables,
 * which are those of the program's --set and its manual:
 *
 *     for (int32_t m = 0; m < osdtex_method_count(); ++m)
 *     {
 *         osdtex_method_info method;
 *         osdtex_option_info option;
 *
 *         osdtex_method_get(m, &method);
 *         for (int32_t o = 0; o < method.option_count; ++o)
 *             if (osdtex_option_get(m, o, &option) == OSDTEX_OK)
 *                 menu_add(menu, method.name, option.name, option.fallback);
 *     }
 *
 * Tables are static: what they lend lives for ever, and any thread may ask. */
#ifndef OSDTEX_METHOD_H
#define OSDTEX_METHOD_H

#include <osdtex/common.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_method_info
{
    const char *name;
    const char *summary; /* one sentence */
    const char *source;  /* the paper */
    int32_t option_count;
    int32_t reserved;
} osdtex_method_info;

typedef int32_t osdtex_option_kind;
enum
{
    OSDTEX_OPTION_REAL = 0,
    OSDTEX_OPTION_INTEGER = 1,
    OSDTEX_OPTION_CHOICE = 2,
    OSDTEX_OPTION_SWITCH = 3 /* on | off */
};

typedef struct osdtex_option_info
{
    const char *name;
    const char *help;           /* one sentence, with the unit */
    const char *const *choices; /* NULL-terminated; CHOICE only */
    double minimum;             /* REAL and INTEGER; inclusive */
    double maximum;
    char fallback[64]; /* the default, as osdtex_setting takes it */
    osdtex_option_kind kind;
    int32_t reserved;
} osdtex_option_info;

OSDTEX_API int32_t osdtex_method_count(void);
/* Number `method` of the table, from 0; the first is the default. ARGUMENT when
 * there is no such method, or it has no such option. */
OSDTEX_API osdtex_status
osdtex_method_get(int32_t method, osdtex_method_info *out);
OSDTEX_API osdtex_status
osdtex_option_get(int32_t method, int32_t option, osdtex_option_info *out);

/* A setting as text, as osdtex_map_options takes them: "mode", "paper". */
typedef struct osdtex_setting
{
    const char *key;
    const char *value;
} osdtex_setting;

OSDTEX_END_DECLS

#endif

/* colour.h -- what the colour configuration of a context offers.
 *
 * For menus of colour spaces, as osdtex_exemplar_options.from takes them:
 *
 *     static void
 *     add_space(void *menu, osdtex_colour_kind kind, const char *name,
 *               const char *value)
 *     {
 *         if (kind == OSDTEX_COLOUR_SPACE)
 *             menu_add(menu, name);
 *     }
 *
 *     osdtex_colour_list(context, add_space, menu);
 *
 * The configuration is that of the context's options, else of $OCIO, else the
 * one built in. It is opened at the first call that needs it, and stays open.
 */
#ifndef OSDTEX_COLOUR_H
#define OSDTEX_COLOUR_H

#include <osdtex/context.h>

OSDTEX_BEGIN_DECLS

typedef int32_t osdtex_colour_kind;
enum
{
    OSDTEX_COLOUR_ROLE = 0,   /* `name` and the space that has it */
    OSDTEX_COLOUR_SPACE = 1,  /* `name` and its encoding, "" not stated */
    OSDTEX_COLOUR_ALIAS = 2,  /* another name, and the space's own */
    OSDTEX_COLOUR_DISPLAY = 3 /* `name` and a view of it */
};

/* Called with strings that live until the function returns. */
typedef void (*osdtex_colour_visitor)(
    void *user, osdtex_colour_kind kind, const char *name, const char *value);

/* Visits the roles of the configuration, each of its spaces with its aliases
 * behind it, and each view of its displays. COLOUR, ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status osdtex_colour_list(
    osdtex_context *context, osdtex_colour_visitor visit, void *user);

OSDTEX_END_DECLS

#endif

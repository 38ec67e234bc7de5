/* colour_call.c -- a configuration, item by item. */
#include "api/call.h"

#include <osdtex/osdtex.h>

static void
list_roles(const otx_ocio *config, osdtex_colour_visitor visit, void *user)
{
    const char *role;

    for (int32_t i = 0; (role = otx_ocio_role_name(config, i)) != NULL; ++i)
    {
        const char *space = otx_ocio_role(config, role);

        visit(user, OSDTEX_COLOUR_ROLE, role, space ? space : "");
    }
}

static void
list_spaces(const otx_ocio *config, osdtex_colour_visitor visit, void *user)
{
    for (int32_t i = 0; i < otx_ocio_space_count(config); ++i)
    {
        const char *space = otx_ocio_space_name(config, i);
        const char *alias;

        visit(
            user, OSDTEX_COLOUR_SPACE, space, otx_ocio_encoding(config, space));
        for (int32_t k = 0; (alias = otx_ocio_alias(config, space, k)) != NULL;
             ++k)
            visit(user, OSDTEX_COLOUR_ALIAS, alias, space);
    }
}

static void
list_displays(const otx_ocio *config, osdtex_colour_visitor visit, void *user)
{
    const char *display, *view;

    for (int32_t i = 0; (display = otx_ocio_display(config, i)) != NULL; ++i)
        for (int32_t k = 0; (view = otx_ocio_view(config, display, k)) != NULL;
             ++k)
            visit(user, OSDTEX_COLOUR_DISPLAY, display, view);
}

osdtex_status
osdtex_colour_list(
    osdtex_context *context, osdtex_colour_visitor visit, void *user)
{
    const otx_colour *colour;
    otx_call call;
    otx_status status;

    if (!visit)
        return OSDTEX_ERROR_ARGUMENT;
    OTX_TRY(otx_call_begin(context, "colour", &call));
    status = otx_call_colour(&call, &colour);
    if (status == OSDTEX_OK)
    {
        list_roles(colour->config, visit, user);
        list_spaces(colour->config, visit, user);
        list_displays(colour->config, visit, user);
    }
    return otx_call_drop(&call, status);
}

/* mtlx.c -- one document, with the names put in. */
#include "file/mtlx.h"

#include "file/text_out.h"
#include "file/usda.h"

#include <string.h>

static const char STAGE[] = "mtlx";

/* MaterialX's name for a colour space of a colorInteropID, NULL for those it
 * does not define. */
static const char *
color_space(const char *interop_id)
{
    static const char *const names[][2] = {
        {"lin_ap1_scene", "acescg"},
        {"lin_rec709_scene", "lin_rec709"},
        {"lin_adobergb_scene", "lin_adobergb"},
        {"srgb_rec709_scene", "srgb_texture"}};

    for (size_t i = 0; interop_id && i < sizeof names / sizeof *names; ++i)
        if (strcmp(names[i][0], interop_id) == 0)
            return names[i][1];
    return NULL;
}

static void
write_escaped(otx_text_out *out, const char *text)
{
    for (const char *c = text; *c; ++c)
        switch (*c)
        {
        case '<':
            otx_text_out_string(out, "&lt;");
            break;
        case '>':
            otx_text_out_string(out, "&gt;");
            break;
        case '&':
            otx_text_out_string(out, "&amp;");
            break;
        case '"':
            otx_text_out_string(out, "&quot;");
            break;
        default:
            otx_text_out_char(out, *c);
        }
}

static void
write_image(otx_text_out *out, const otx_mtlx *mtlx, const char *name)
{
    const char *space = color_space(mtlx->interop_id);

    otx_text_out_string(out, "  <image name=\"");
    otx_text_out_string(out, name);
    otx_text_out_string(
        out, "_image\" type=\"color3\">\n    <input name=\"file\" "
             "type=\"filename\" value=\"");
    write_escaped(out, mtlx->texture);
    otx_text_out_char(out, '"');
    if (space)
    {
        otx_text_out_string(out, " colorspace=\"");
        otx_text_out_string(out, space);
        otx_text_out_char(out, '"');
    }
    otx_text_out_string(
        out, " />\n"
             "    <input name=\"uaddressmode\" type=\"string\" "
             "value=\"clamp\" />\n"
             "    <input name=\"vaddressmode\" type=\"string\" "
             "value=\"clamp\" />\n"
             "  </image>\n");
}

static void
write_material(otx_text_out *out, const char *name)
{
    static const char text[] =
        "  <standard_surface name=\"$_surface\" type=\"surfaceshader\">\n"
        "    <input name=\"base\" type=\"float\" value=\"1\" />\n"
        "    <input name=\"base_color\" type=\"color3\" "
        "nodename=\"$_image\" />\n"
        "    <input name=\"specular_roughness\" type=\"float\" value=\"0.5\" "
        "/>\n"
        "  </standard_surface>\n"
        "  <surfacematerial name=\"$\" type=\"material\">\n"
        "    <input name=\"surfaceshader\" type=\"surfaceshader\" "
        "nodename=\"$_surface\" />\n"
        "  </surfacematerial>\n";

    for (const char *c = text; *c; ++c)
        if (*c == '$')
            otx_text_out_string(out, name);
        else
            otx_text_out_char(out, *c);
}

otx_status
otx_mtlx_write(
    otx_run *run, const otx_mtlx *mtlx, const char *path, const char *title)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const char *name = otx_usda_identifier(run->scratch, mtlx->name);
    otx_text_out *out;
    otx_status status;

    OTX_TRY(otx_run_ok(run));
    status = otx_text_out_open(run, STAGE, path, title, &out);
    if (status == OSDTEX_OK)
    {
        otx_text_out_string(
            out, "<?xml version=\"1.0\"?>\n<materialx version=\"1.38\">\n");
        otx_text_out_mark(out, run->mark, "<!-- ", " -->\n");
        write_image(out, mtlx, name);
        write_material(out, name);
        otx_text_out_string(out, "</materialx>\n");
        status = otx_text_out_close(run, out);
    }
    otx_arena_release(run->scratch, mark);
    return status;
}

/* mtlx.c -- one document, with the names put in. */
#include "file/mtlx.h"

#include "file/text_out.h"
#include "file/usda_name.h"

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

/* One image, called NAME_key.
 *
 *   type   of its values: "color3", "vector3", "float"
 *   space  that they are in; NULL: none is stated, and data have none */
static void
write_image(
    otx_text_out *out, const char *name, const char *key, const char *type,
    const char *file, const char *space)
{
    if (!file)
        return;
    otx_text_out_string(out, "  <image name=\"");
    otx_text_out_string(out, name);
    otx_text_out_string(out, key);
    otx_text_out_string(out, "\" type=\"");
    otx_text_out_string(out, type);
    otx_text_out_string(
        out, "\">\n    <input name=\"file\" type=\"filename\" value=\"");
    write_escaped(out, file);
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

/* `$` stands for the material's name. */
static void
write_text(otx_text_out *out, const char *text, const char *name)
{
    for (const char *c = text; *c; ++c)
        if (*c == '$')
            otx_text_out_string(out, name);
        else
            otx_text_out_char(out, *c);
}

static void
write_images(otx_text_out *out, const otx_mtlx *m, const char *name)
{
    write_image(
        out, name, "_image", "color3", m->texture, color_space(m->interop_id));
    write_image(out, name, "_normal", "vector3", m->maps.normal, NULL);
    write_image(out, name, "_roughness", "float", m->maps.roughness, NULL);
    write_image(out, name, "_metalness", "float", m->maps.metalness, NULL);
    write_image(out, name, "_height", "float", m->maps.height, NULL);
}

/* Of maps with y down, green is 1 less what they say. */
static void
write_normal(otx_text_out *out, const otx_mtlx *m, const char *name)
{
    if (m->maps.normal_y_down)
        write_text(
            out,
            "  <multiply name=\"$_flipped\" type=\"vector3\">\n"
            "    <input name=\"in1\" type=\"vector3\" "
            "nodename=\"$_normal\" />\n"
            "    <input name=\"in2\" type=\"vector3\" value=\"1, -1, 1\" />\n"
            "  </multiply>\n"
            "  <add name=\"$_up\" type=\"vector3\">\n"
            "    <input name=\"in1\" type=\"vector3\" "
            "nodename=\"$_flipped\" />\n"
            "    <input name=\"in2\" type=\"vector3\" value=\"0, 1, 0\" />\n"
            "  </add>\n",
            name);
    write_text(
        out,
        m->maps.normal_y_down
            ? "  <normalmap name=\"$_bent\" type=\"vector3\">\n"
              "    <input name=\"in\" type=\"vector3\" nodename=\"$_up\" />\n"
              "  </normalmap>\n"
            : "  <normalmap name=\"$_bent\" type=\"vector3\">\n"
              "    <input name=\"in\" type=\"vector3\" "
              "nodename=\"$_normal\" />\n"
              "  </normalmap>\n",
        name);
}

static void
write_surface(otx_text_out *out, const otx_mtlx *m, const char *name)
{
    if (m->maps.normal)
        write_normal(out, m, name);
    write_text(
        out,
        "  <standard_surface name=\"$_surface\" type=\"surfaceshader\">\n"
        "    <input name=\"base\" type=\"float\" value=\"1\" />\n"
        "    <input name=\"base_color\" type=\"color3\" "
        "nodename=\"$_image\" />\n",
        name);
    write_text(
        out,
        m->maps.roughness
            ? "    <input name=\"specular_roughness\" type=\"float\" "
              "nodename=\"$_roughness\" />\n"
            : "    <input name=\"specular_roughness\" type=\"float\" "
              "value=\"0.5\" />\n",
        name);
    if (m->maps.metalness)
        write_text(
            out,
            "    <input name=\"metalness\" type=\"float\" "
            "nodename=\"$_metalness\" />\n",
            name);
    if (m->maps.normal)
        write_text(
            out,
            "    <input name=\"normal\" type=\"vector3\" "
            "nodename=\"$_bent\" />\n",
            name);
    otx_text_out_string(out, "  </standard_surface>\n");
}

static void
write_material(otx_text_out *out, const otx_mtlx *m, const char *name)
{
    if (m->maps.height)
        write_text(
            out,
            "  <displacement name=\"$_displacement\" "
            "type=\"displacementshader\">\n"
            "    <input name=\"displacement\" type=\"float\" "
            "nodename=\"$_height\" />\n"
            "    <input name=\"scale\" type=\"float\" value=\"1\" />\n"
            "  </displacement>\n",
            name);
    write_text(
        out,
        "  <surfacematerial name=\"$\" type=\"material\">\n"
        "    <input name=\"surfaceshader\" type=\"surfaceshader\" "
        "nodename=\"$_surface\" />\n",
        name);
    if (m->maps.height)
        write_text(
            out,
            "    <input name=\"displacementshader\" "
            "type=\"displacementshader\" nodename=\"$_displacement\" />\n",
            name);
    otx_text_out_string(out, "  </surfacematerial>\n");
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
        write_images(out, mtlx, name);
        write_surface(out, mtlx, name);
        write_material(out, mtlx, name);
        otx_text_out_string(out, "</materialx>\n");
        status = otx_text_out_close(run, out);
    }
    otx_arena_release(run->scratch, mark);
    return status;
}

/* usda_look.c -- shaders and what connects them.
 *
 * Numbers of normals are from 0 to 1 in the file, whatever type they have
 * there, and scale and bias of the texture make vectors of them. */
#include "file/usda_look.h"

#include "file/usda_name.h"

#include <stdio.h>
#include <string.h>

enum
{
    NAME_BYTES = 256
};

/* A texture of the look, and what it goes into. */
typedef struct texture
{
    const char *prim;
    const char *file; /* NULL: there is none */
    const char *space;
    const char *id;     /* colorInteropID; NULL unknown */
    const char *output; /* "rgb" or "r" */
    const char *input;  /* of the surface, with its type */
    bool is_normal, is_y_down;
} texture;

/* UsdUVTexture knows two encodings: sRGB, and numbers that are taken as they
 * are, by which an EXR is linear Rec.709 unless its attribute says otherwise.
 */
static const char *
source_color_space(const char *id)
{
    return id && strcmp(id, "srgb_rec709_scene") == 0 ? "sRGB" : "raw";
}

enum
{
    TEXTURE_COUNT = 6
};

/* One of the two looks: that of all faces, or of what lies over them. */
typedef struct look
{
    const char *path; /* "MODEL/Look" */
    const char *color;
    const otx_data_maps *maps;
    bool is_cut_out; /* by the alpha of its colour */
} look;

static void
list_textures(const otx_usda *u, const look *l, texture list[TEXTURE_COUNT])
{
    const otx_data_maps *m = l->maps;
    const texture all[TEXTURE_COUNT] = {
        {"Texture", l->color, source_color_space(u->interop_id), u->interop_id,
         "rgb", "color3f inputs:diffuseColor", false, false},
        {"Normal", m->normal, "raw", NULL, "rgb", "normal3f inputs:normal",
         true, m->normal_y_down},
        {"Roughness", m->roughness, "raw", NULL, "r", "float inputs:roughness",
         false, false},
        {"Metalness", m->metalness, "raw", NULL, "r", "float inputs:metallic",
         false, false},
        {"Occlusion", m->occlusion, "raw", NULL, "r", "float inputs:occlusion",
         false, false},
        {"Height", m->height, "raw", NULL, "r", "float inputs:displacement",
         false, false}};

    memcpy(list, all, sizeof all);
}

/* ---- pieces ---------------------------------------------------------------
 */

/* Between single `@` or, where there is one in the name, between three: there
 * only a run of three needs a backslash. */
static void
write_asset(otx_text_out *out, const char *path)
{
    const char *delimiter = strchr(path, '@') ? "@@@" : "@";

    otx_text_out_string(out, delimiter);
    for (; *path; ++path)
    {
        if (strncmp(path, "@@@", 3) == 0)
        {
            otx_text_out_string(out, "\\@@@");
            path += 2;
            continue;
        }
        otx_text_out_char(out, *path);
    }
    otx_text_out_string(out, delimiter);
}

/* `$` stands for the model's name, `%` for `word`. */
static void
write_text(
    otx_text_out *out, const char *text, const char *name, const char *word)
{
    for (const char *c = text; *c; ++c)
        if (*c == '$')
            otx_text_out_string(out, name);
        else if (*c == '%')
            otx_text_out_string(out, word);
        else
            otx_text_out_char(out, *c);
}

/* The asset and, as metadata of the attribute, the space of its colours, which
 * UsdShade defines for what is colour managed. */
static void
write_file(otx_text_out *out, const texture *t)
{
    otx_text_out_string(out, "            asset inputs:file = ");
    write_asset(out, t->file);
    if (t->id)
        write_text(
            out, " (\n                colorSpace = \"%\"\n            )", "",
            t->id);
    otx_text_out_char(out, '\n');
}

static void
write_texture(otx_text_out *out, const texture *t, const look *l)
{
    write_text(
        out,
        "\n        def Shader \"%\"\n"
        "        {\n"
        "            uniform token info:id = \"UsdUVTexture\"\n",
        "", t->prim);
    write_file(out, t);
    write_text(
        out, "            token inputs:sourceColorSpace = \"%\"\n", "",
        t->space);
    if (t->is_normal)
        otx_text_out_string(
            out, t->is_y_down
                     ? "            float4 inputs:scale = (2, -2, 2, 1)\n"
                       "            float4 inputs:bias = (-1, 1, -1, 0)\n"
                     : "            float4 inputs:scale = (2, 2, 2, 1)\n"
                       "            float4 inputs:bias = (-1, -1, -1, 0)\n");
    write_text(
        out,
        "            token inputs:wrapS = \"clamp\"\n"
        "            token inputs:wrapT = \"clamp\"\n"
        "            float2 inputs:st.connect = "
        "</$/Reader.outputs:result>\n",
        l->path, NULL);
    write_text(
        out,
        strcmp(t->output, "r") == 0 ? "            float outputs:%\n"
                                    : "            float3 outputs:%\n",
        "", t->output);
    otx_text_out_string(out, "        }\n");
}

/* What the textures go into; roughness has a value where there is no map. */
static void
write_surface(otx_text_out *out, const look *l, const texture *list)
{
    otx_text_out_string(
        out, "        def Shader \"Surface\"\n"
             "        {\n"
             "            uniform token info:id = \"UsdPreviewSurface\"\n");
    for (int i = 0; i < TEXTURE_COUNT; ++i)
    {
        if (!list[i].file)
            continue;
        write_text(out, "            %.connect = </$/", l->path, list[i].input);
        write_text(out, "%.outputs:", l->path, list[i].prim);
        write_text(out, "%>\n", l->path, list[i].output);
    }
    if (l->is_cut_out)
        write_text(
            out,
            "            float inputs:opacity.connect = "
            "</$/Texture.outputs:a>\n",
            l->path, NULL);
    if (!l->maps->roughness)
        otx_text_out_string(out, "            float inputs:roughness = 0.5\n");
    if (l->maps->height)
        otx_text_out_string(out, "            token outputs:displacement\n");
    otx_text_out_string(
        out, "            token outputs:surface\n"
             "        }\n");
}

/* ---- the look -------------------------------------------------------------
 */

static void
write_outputs(otx_text_out *out, const look *l)
{
    if (l->maps->height)
        write_text(
            out,
            "        token outputs:displacement.connect = "
            "</$/Surface.outputs:displacement>\n",
            l->path, NULL);
    write_text(
        out,
        "        token outputs:surface.connect = "
        "</$/Surface.outputs:surface>\n"
        "\n",
        l->path, NULL);
}

const char *
otx_usda_look_material(
    otx_arena *arena, const otx_usda_subsets *materials, int32_t index)
{
    const char *name = otx_usda_identifier(arena, materials->names[index]);
    char *prim = OTX_NEW(arena, char, NAME_BYTES);

    if (!name || !prim)
        return NULL;
    snprintf(prim, NAME_BYTES, "material_%d_%.200s", (int)index, name);
    return prim;
}

/* The same look as MaterialX, behind a choice: readers that have no MaterialX
 * would fail on a reference, and do not look into what is not chosen. */
static void
write_variants(otx_text_out *out, const otx_usda *u, const char *name)
{
    if (!u->materialx)
    {
        otx_text_out_string(out, "\n    {\n");
        return;
    }
    otx_text_out_string(
        out, " (\n"
             "        variants = {\n"
             "            string shading = \"preview\"\n"
             "        }\n"
             "        prepend variantSets = \"shading\"\n"
             "    )\n    {\n"
             "        variantSet \"shading\" = {\n"
             "            \"materialx\" (\n"
             "                prepend references = ");
    write_asset(out, u->materialx);
    write_text(
        out,
        "</MaterialX/Materials/$>\n"
        "            ) {\n            }\n"
        "            \"preview\" {\n            }\n"
        "        }\n\n",
        name, NULL);
}

/* A material of the cage is the look under a name of its own; what lies over
 * the first is the other look. */
static bool
write_materials(
    otx_run *run, otx_text_out *out, const otx_usda *u, const char *name)
{
    for (int32_t i = 0; u->materials.face_names && i < u->materials.count; ++i)
    {
        const char *prim =
            otx_usda_look_material(run->scratch, &u->materials, i);

        if (!prim)
            return false;
        write_text(
            out,
            u->overlay && i > 0 ? "\n    def Material \"%\" (\n"
                                  "        prepend inherits = </$/Overlay>\n"
                                : "\n    def Material \"%\" (\n"
                                  "        prepend inherits = </$/Look>\n",
            name, prim);
        otx_text_out_string(out, "    )\n    {\n    }\n");
    }
    return true;
}

/* What is in the prim of a look, and its end. */
static void
write_look(otx_text_out *out, const otx_usda *u, const look *l)
{
    texture list[TEXTURE_COUNT];

    list_textures(u, l, list);
    write_outputs(out, l);
    write_surface(out, l, list);
    for (int i = 0; i < TEXTURE_COUNT; ++i)
        if (list[i].file)
            write_texture(out, &list[i], l);
    otx_text_out_string(
        out, "\n        def Shader \"Reader\"\n"
             "        {\n"
             "            uniform token info:id = "
             "\"UsdPrimvarReader_float2\"\n"
             "            string inputs:varname = \"st\"\n"
             "            float2 outputs:result\n"
             "        }\n"
             "    }\n");
}

/* "MODEL/Look"; NULL when memory is out. */
static const char *
path_of(otx_run *run, const char *name, const char *prim)
{
    const size_t bytes = strlen(name) + strlen(prim) + 2;
    char *path = OTX_NEW(run->scratch, char, bytes);

    if (path)
        snprintf(path, bytes, "%s/%s", name, prim);
    return path;
}

bool
otx_usda_look_write(
    otx_run *run, otx_text_out *out, const otx_usda *u, const char *name)
{
    const look below = {
        path_of(run, name, "Look"), u->texture, &u->maps, false};
    const look over = {
        path_of(run, name, "Overlay"), u->overlay, &u->overlay_maps, true};

    if (!below.path || !over.path)
        return false;
    otx_text_out_string(out, "    def Material \"Look\"");
    write_variants(out, u, name);
    write_look(out, u, &below);
    if (u->overlay)
    {
        otx_text_out_string(out, "\n    def Material \"Overlay\"\n    {\n");
        write_look(out, u, &over);
    }
    return write_materials(run, out, u, name);
}

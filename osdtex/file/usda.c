/* usda.c -- USD's text format, line by line. */
#include "file/usda.h"

#include "file/text_out.h"
#include "file/usda_look.h"
#include "file/usda_name.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "usda";

enum
{
    VALUES_A_LINE = 16 /* so that lines stay short enough for any editor */
};

/* ---- arrays ---------------------------------------------------------------
 */

/* Opens line `i` of an array, or goes on in it. */
static void
separate(otx_text_out *out, int64_t i)
{
    if (i > 0)
        otx_text_out_string(out, ", ");
    if (i % VALUES_A_LINE == 0 && i > 0)
        otx_text_out_string(out, "\n            ");
}

static void
write_ints(
    otx_text_out *out, const char *name, const int32_t *values, int64_t count)
{
    otx_text_out_string(out, "        int[] ");
    otx_text_out_string(out, name);
    otx_text_out_string(out, " = [");
    for (int64_t i = 0; i < count; ++i)
    {
        separate(out, i);
        otx_text_out_int(out, values[i]);
    }
    otx_text_out_char(out, ']');
}

static void
write_floats(
    otx_text_out *out, const char *name, const float *values, int64_t count)
{
    otx_text_out_string(out, "        float[] ");
    otx_text_out_string(out, name);
    otx_text_out_string(out, " = [");
    for (int64_t i = 0; i < count; ++i)
    {
        separate(out, i);
        otx_text_out_float(out, values[i]);
    }
    otx_text_out_string(out, "]\n");
}

/* `width` floats to a tuple. */
static void
write_tuples(
    otx_text_out *out, const char *declaration, const float *values,
    int64_t count, int32_t width)
{
    otx_text_out_string(out, "        ");
    otx_text_out_string(out, declaration);
    otx_text_out_string(out, " = [");
    for (int64_t i = 0; i < count; ++i)
    {
        separate(out, i);
        for (int32_t k = 0; k < width; ++k)
        {
            otx_text_out_string(out, k == 0 ? "(" : ", ");
            otx_text_out_float(out, values[i * width + k]);
        }
        otx_text_out_char(out, ')');
    }
    otx_text_out_char(out, ']');
}

/*   type  "uniform token" or "token", as the schema declares it */
static void
write_token(
    otx_text_out *out, const char *type, const char *name, const char *value)
{
    otx_text_out_string(out, "        ");
    otx_text_out_string(out, type);
    otx_text_out_char(out, ' ');
    otx_text_out_string(out, name);
    otx_text_out_string(out, " = \"");
    otx_text_out_string(out, value);
    otx_text_out_string(out, "\"\n");
}

/* ---- mesh -----------------------------------------------------------------
 */

static bool
write_faces(otx_run *run, otx_text_out *out, const otx_usda *u)
{
    int32_t *sizes = OTX_NEW(run->scratch, int32_t, u->face_count);

    if (!sizes)
        return false;
    for (int32_t f = 0; f < u->face_count; ++f)
        sizes[f] = u->face_first[f + 1] - u->face_first[f];
    write_ints(out, "faceVertexCounts", sizes, u->face_count);
    otx_text_out_char(out, '\n');
    write_ints(out, "faceVertexIndices", u->face_verts, u->corner_count);
    otx_text_out_char(out, '\n');
    return true;
}

static void
write_extent(otx_text_out *out, const otx_usda *u)
{
    float box[6] = {
        INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};

    for (int64_t i = 0; i < 3 * (int64_t)u->vert_count; ++i)
    {
        box[i % 3] = fminf(box[i % 3], u->points[i]);
        box[3 + i % 3] = fmaxf(box[3 + i % 3], u->points[i]);
    }
    write_tuples(out, "float3[] extent", box, u->vert_count > 0 ? 2 : 0, 3);
    otx_text_out_char(out, '\n');
}

/* Where points are at rest, by the name that renderers look for. */
static void
write_rest(otx_text_out *out, const otx_usda *u)
{
    if (!u->rest)
        return;
    write_tuples(out, "point3f[] primvars:Pref", u->rest, u->vert_count, 3);
    otx_text_out_string(
        out, " (\n            interpolation = \"vertex\"\n        )\n");
}

/* Points are floats in USD, a translation may be double. */
static void
write_origin(otx_text_out *out, const otx_usda *u)
{
    if (u->origin[0] == 0.0 && u->origin[1] == 0.0 && u->origin[2] == 0.0)
        return;
    otx_text_out_string(out, "        double3 xformOp:translate = (");
    for (int k = 0; k < 3; ++k)
    {
        otx_text_out_string(out, k == 0 ? "" : ", ");
        otx_text_out_double(out, u->origin[k]);
    }
    otx_text_out_string(
        out, ")\n        uniform token[] xformOpOrder = "
             "[\"xformOp:translate\"]\n");
}

/* One crease of two vertices for each edge: chains would have to share a
 * sharpness. */
static bool
write_sharp(otx_run *run, otx_text_out *out, const otx_usda *u)
{
    int32_t *lengths = OTX_NEW(run->scratch, int32_t, u->crease_count);

    if (!lengths)
        return false;
    for (int32_t i = 0; i < u->crease_count; ++i)
        lengths[i] = 2;
    if (u->crease_count > 0)
    {
        write_ints(
            out, "creaseIndices", u->crease_verts,
            2 * (int64_t)u->crease_count);
        otx_text_out_char(out, '\n');
        write_ints(out, "creaseLengths", lengths, u->crease_count);
        otx_text_out_char(out, '\n');
        write_floats(
            out, "creaseSharpnesses", u->crease_sharpness, u->crease_count);
    }
    if (u->corner_tag_count > 0)
    {
        write_ints(
            out, "cornerIndices", u->corner_tag_verts, u->corner_tag_count);
        otx_text_out_char(out, '\n');
        write_floats(
            out, "cornerSharpnesses", u->corner_tag_sharpness,
            u->corner_tag_count);
    }
    return true;
}

static bool
write_holes(otx_run *run, otx_text_out *out, const otx_usda *u)
{
    int32_t *holes = OTX_NEW(run->scratch, int32_t, u->face_count);
    int32_t count = 0;

    if (!holes)
        return false;
    for (int32_t f = 0; u->face_hole && f < u->face_count; ++f)
        if (u->face_hole[f])
            holes[count++] = f;
    if (count > 0)
    {
        write_ints(out, "holeIndices", holes, count);
        otx_text_out_char(out, '\n');
    }
    return true;
}

static void
write_uvs(otx_text_out *out, const otx_usda *u)
{
    write_tuples(out, "texCoord2f[] primvars:st", u->uvs, u->uv_count, 2);
    otx_text_out_string(
        out, " (\n            interpolation = \"faceVarying\"\n        )\n");
    write_ints(out, "primvars:st:indices", u->face_uvs, u->corner_count);
    otx_text_out_char(out, '\n');
    if (!u->slices)
        return;
    otx_text_out_string(out, "        float[] primvars:slice = [");
    for (int32_t c = 0; c < u->corner_count; ++c)
    {
        separate(out, c);
        otx_text_out_float(out, u->slices[c]);
    }
    otx_text_out_string(
        out, "] (\n            interpolation = \"faceVarying\"\n        )\n");
}

/* Corner by corner: the attribute has no indices. */
static bool
write_normals(otx_run *run, otx_text_out *out, const otx_usda *u)
{
    float *spread = OTX_NEW(run->scratch, float, 3 * (size_t)u->corner_count);

    if (!u->normals)
        return true;
    for (int32_t c = 0; spread && c < u->corner_count; ++c)
        memcpy(
            spread + 3 * (size_t)c, u->normals + 3 * (size_t)u->face_normals[c],
            3 * sizeof *spread);
    if (!spread)
        return false;
    write_tuples(out, "normal3f[] normals", spread, u->corner_count, 3);
    otx_text_out_string(
        out, " (\n            interpolation = \"faceVarying\"\n        )\n");
    return true;
}

/* The faces of one name, of one family. Names that become one identifier would
 * be one prim: the index tells them apart. */
static bool
begin_subset(
    otx_run *run, otx_text_out *out, const otx_usda *u,
    const otx_usda_subsets *family, int32_t index, const char *kind)
{
    const char *name = otx_usda_identifier(run->scratch, family->names[index]);
    const bool binds = family == &u->materials;
    int32_t *faces = OTX_NEW(run->scratch, int32_t, u->face_count);
    int32_t count = 0;

    if (!name || !faces)
        return false;
    for (int32_t f = 0; f < u->face_count; ++f)
        if (family->face_names[f] == index)
            faces[count++] = f;
    otx_text_out_string(out, "\n        def GeomSubset \"");
    otx_text_out_string(out, kind);
    otx_text_out_char(out, '_');
    otx_text_out_int(out, index);
    otx_text_out_char(out, '_');
    otx_text_out_string(out, name);
    otx_text_out_string(
        out, binds ? "\" (\n            prepend apiSchemas = "
                     "[\"MaterialBindingAPI\"]\n        )\n        {\n    "
                   : "\"\n        {\n    ");
    write_token(out, "uniform token", "elementType", "face");
    otx_text_out_string(out, "    ");
    write_token(
        out, "uniform token", "familyName", binds ? "materialBind" : "group");
    otx_text_out_string(out, "    ");
    write_ints(out, "indices", faces, count);
    otx_text_out_char(out, '\n');
    return true;
}

static bool
write_binding(
    otx_run *run, otx_text_out *out, const otx_usda *u, const char *model,
    int32_t index)
{
    const char *prim =
        otx_usda_look_material(run->scratch, &u->materials, index);

    if (!prim)
        return false;
    otx_text_out_string(out, "            rel material:binding = </");
    otx_text_out_string(out, model);
    otx_text_out_char(out, '/');
    otx_text_out_string(out, prim);
    otx_text_out_string(out, ">\n");
    return true;
}

/* Families of subsets: materials are bound to theirs. */
static bool
write_subsets(
    otx_run *run, otx_text_out *out, const otx_usda *u,
    const otx_usda_subsets *family, const char *model)
{
    const bool binds = family == &u->materials;

    for (int32_t i = 0; family->face_names && i < family->count; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(run->scratch);
        const bool ok =
            begin_subset(
                run, out, u, family, i, binds ? "material" : "group") &&
            (!binds || write_binding(run, out, u, model, i));

        otx_arena_release(run->scratch, mark);
        if (!ok)
            return false;
        otx_text_out_string(out, "        }\n");
    }
    return true;
}

static bool
write_mesh(otx_run *run, otx_text_out *out, const otx_usda *u, const char *name)
{
    otx_text_out_string(
        out, "    def Mesh \"Cage\" (\n"
             "        prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
             "    )\n    {\n");
    write_token(out, "uniform token", "subdivisionScheme", u->scheme);
    write_token(out, "token", "interpolateBoundary", u->boundary);
    write_token(out, "token", "faceVaryingLinearInterpolation", u->fvar);
    write_token(out, "token", "triangleSubdivisionRule", u->triangles);
    write_token(out, "uniform token", "orientation", "rightHanded");
    if (!write_faces(run, out, u))
        return false;
    write_tuples(out, "point3f[] points", u->points, u->vert_count, 3);
    otx_text_out_char(out, '\n');
    write_rest(out, u);
    write_extent(out, u);
    write_origin(out, u);
    if (!write_sharp(run, out, u) || !write_holes(run, out, u) ||
        !write_normals(run, out, u))
        return false;
    write_uvs(out, u);
    otx_text_out_string(out, "        rel material:binding = </");
    otx_text_out_string(out, name);
    otx_text_out_string(out, "/Look>\n");
    if (u->materials.face_names)
        otx_text_out_string(
            out, "        uniform token subsetFamily:materialBind:familyType = "
                 "\"partition\"\n");
    if (!write_subsets(run, out, u, &u->materials, name) ||
        !write_subsets(run, out, u, &u->groups, name))
        return false;
    otx_text_out_string(out, "    }\n\n");
    return true;
}

static otx_status
write_all(otx_run *run, otx_text_out *out, const otx_usda *u)
{
    const char *name = otx_usda_identifier(run->scratch, u->name);

    OTX_TRY(otx_run_ok(run));
    otx_text_out_string(out, "#usda 1.0\n");
    for (int32_t i = 0; i < u->comment_count; ++i)
    {
        otx_text_out_string(out, "# ");
        otx_text_out_name(out, u->comments[i], true);
        otx_text_out_char(out, '\n');
    }
    otx_text_out_mark(out, run->mark, "# ", "\n");
    otx_text_out_string(out, "(\n    defaultPrim = \"");
    otx_text_out_string(out, name);
    otx_text_out_string(out, "\"\n");
    otx_text_out_string(out, "    metersPerUnit = ");
    otx_text_out_double(out, u->meters_per_unit);
    otx_text_out_string(
        out, u->z_up ? "\n    upAxis = \"Z\"\n" : "\n    upAxis = \"Y\"\n");
    otx_text_out_string(out, ")\n\ndef Xform \"");
    otx_text_out_string(out, name);
    otx_text_out_string(out, "\" (\n    kind = \"component\"\n)\n{\n");
    if (!write_mesh(run, out, u, name))
        return otx_fail_memory(run, STAGE);
    if (!otx_usda_look_write(run, out, u, name))
        return otx_fail_memory(run, STAGE);
    otx_text_out_string(out, "}\n");
    return otx_text_out_close(run, out);
}

/* ---- file -----------------------------------------------------------------
 */

static bool
is_finite(const float *values, int64_t count)
{
    for (int64_t i = 0; i < count; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

otx_status
otx_usda_write(
    otx_run *run, const otx_usda *usda, const char *path, const char *title)
{
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    otx_where where = OTX_NOWHERE;
    otx_text_out *out;
    otx_status status;

    where.file = title ? title : path;
    if (!is_finite(usda->points, 3 * (int64_t)usda->vert_count) ||
        (usda->rest && !is_finite(usda->rest, 3 * (int64_t)usda->vert_count)) ||
        !is_finite(usda->uvs, 2 * (int64_t)usda->uv_count) ||
        !is_finite(usda->crease_sharpness, usda->crease_count) ||
        !is_finite(usda->corner_tag_sharpness, usda->corner_tag_count))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "a position, UV or sharpness is not finite, so the cage is not "
            "written");
    status = otx_text_out_open(run, STAGE, path, title, &out);
    if (status == OSDTEX_OK)
        status = write_all(run, out, usda);
    otx_arena_release(run->scratch, mark);
    return status;
}

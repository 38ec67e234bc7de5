/* obj_write.c -- a mesh to an OBJ file. */
#include "file/obj_write.h"

#include "file/text_out.h"

#include <inttypes.h>
#include <math.h>

#define STAGE "obj"

enum
{
    FACES_PER_PROGRESS = 1 << 16
};

/* A name that stands for the faces behind it. */
typedef struct attribute
{
    const char *keyword;
    const char *none; /* line for faces that have none behind some that do */
    const int32_t *face_name;
    const otx_obj_names *names;
    bool blanks; /* may stay in the name */
    int32_t current;
} attribute;

static otx_status
check_finite(
    otx_run *run, const char *name, const char *what, const float *values,
    int64_t count, int32_t width)
{
    for (int64_t i = 0; i < count * width; ++i)
    {
        otx_where where = OTX_NOWHERE;

        if (isfinite(values[i]))
            continue;
        where.file = name;
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "%s %" PRId64 " is not finite, so the mesh is not written", what,
            i / width);
    }
    return OSDTEX_OK;
}

static void
write_comments(otx_text_out *out, const otx_obj_write_options *options)
{
    for (int32_t i = 0; i < options->comment_count; ++i)
    {
        otx_text_out_string(out, "# ");
        otx_text_out_name(out, options->comments[i], true);
        otx_text_out_char(out, '\n');
    }
}

static void
write_floats(otx_text_out *out, const float *values, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
    {
        otx_text_out_char(out, ' ');
        otx_text_out_float(out, values[i]);
    }
}

static void
write_vertices(otx_text_out *out, const otx_obj *obj)
{
    if (obj->point_lines)
        otx_text_out_bytes(out, obj->point_lines, obj->point_line_bytes);
    for (size_t i = 0; !obj->point_lines && i < (size_t)obj->vert_count; ++i)
    {
        otx_text_out_char(out, 'v');
        for (size_t k = 0; k < 3; ++k)
        {
            otx_text_out_char(out, ' ');
            otx_text_out_placed(out, obj->points[3 * i + k], obj->origin[k]);
        }
        if (obj->colors)
            write_floats(out, obj->colors + 3 * i, 3);
        otx_text_out_char(out, '\n');
    }
    for (size_t i = 0; i < (size_t)obj->uv_count; ++i)
    {
        otx_text_out_bytes(out, "vt", 2);
        write_floats(out, obj->uvs + 2 * i, 2);
        if (obj->uv_depths)
            write_floats(out, obj->uv_depths + i, 1);
        otx_text_out_char(out, '\n');
    }
    for (size_t i = 0; i < (size_t)obj->normal_count; ++i)
    {
        otx_text_out_bytes(out, "vn", 2);
        write_floats(out, obj->normals + 3 * i, 3);
        otx_text_out_char(out, '\n');
    }
}

static void
write_change(otx_text_out *out, attribute *a, int32_t face)
{
    const int32_t index = a->face_name ? a->face_name[face] : -1;

    if (index == a->current)
        return;
    a->current = index;
    if (index < 0)
    {
        otx_text_out_string(out, a->none);
        return;
    }
    otx_text_out_string(out, a->keyword);
    otx_text_out_name(out, a->names->text[index], a->blanks);
    otx_text_out_char(out, '\n');
}

static void
write_face(otx_text_out *out, const otx_obj *obj, int32_t face)
{
    otx_text_out_char(out, 'f');
    for (int32_t c = obj->face_first[face]; c < obj->face_first[face + 1]; ++c)
    {
        otx_text_out_char(out, ' ');
        otx_text_out_int(out, (int64_t)obj->face_verts[c] + 1);
        if (obj->face_uvs && obj->face_uvs[c] >= 0)
        {
            otx_text_out_char(out, '/');
            otx_text_out_int(out, (int64_t)obj->face_uvs[c] + 1);
        }
        else if (obj->face_normals)
            otx_text_out_char(out, '/');
        if (!obj->face_normals)
            continue;
        otx_text_out_char(out, '/');
        otx_text_out_int(out, (int64_t)obj->face_normals[c] + 1);
    }
    otx_text_out_char(out, '\n');
}

static otx_status
write_faces(otx_run *run, otx_text_out *out, const otx_obj *obj)
{
    attribute attributes[] = {
        {"o ", "o\n", obj->face_object, &obj->objects, true, -1},
        {"g ", "g\n", obj->face_group, &obj->groups, true, -1},
        {"usemtl ", "usemtl\n", obj->face_material, &obj->materials, false, -1},
        {"s ", "s off\n", obj->face_smooth, &obj->smooths, true, -1}};

    for (int32_t face = 0; face < obj->face_count; ++face)
    {
        for (size_t i = 0; i < sizeof attributes / sizeof *attributes; ++i)
            write_change(out, &attributes[i], face);
        write_face(out, obj, face);
        if ((face + 1) % FACES_PER_PROGRESS == 0)
            OTX_TRY(otx_progress(
                run, "write", (double)(face + 1) / obj->face_count));
    }
    return OSDTEX_OK;
}

static void
write_sharp(
    otx_text_out *out, const char *start, int32_t width,
    const otx_obj_creases *list)
{
    for (size_t i = 0; i < (size_t)list->count; ++i)
    {
        otx_text_out_string(out, start);
        for (size_t k = 0; k < (size_t)width; ++k)
        {
            otx_text_out_char(out, ' ');
            otx_text_out_int(out, list->verts[i * (size_t)width + k]);
        }
        write_floats(out, list->sharpness + i, 1);
        otx_text_out_char(out, '\n');
    }
}

static void
write_number_rule(otx_text_out *out, const char *start, otx_obj_rule rule)
{
    if (rule.value < 0)
        return;
    otx_text_out_string(out, start);
    otx_text_out_int(out, rule.value);
    otx_text_out_char(out, '\n');
}

static void
write_word_rule(
    otx_text_out *out, otx_obj_rule rule, const char *first, const char *second)
{
    if (rule.value >= 0)
        otx_text_out_string(out, rule.value == 0 ? first : second);
}

static void
write_tags(otx_text_out *out, const otx_obj *obj)
{
    write_sharp(out, "t crease 2/1/0", 2, &obj->creases);
    write_sharp(out, "t corner 1/1/0", 1, &obj->corners);
    for (int32_t i = 0; i < obj->hole_count; ++i)
        write_number_rule(
            out, "t hole 1/0/0 ", (otx_obj_rule){obj->hole_faces[i], 0});
    write_number_rule(out, "t interpolateboundary 1/0/0 ", obj->boundary);
    write_number_rule(
        out, "t facevaryinginterpolateboundary 1/0/0 ", obj->fvar);
    write_word_rule(
        out, obj->crease_method, "t creasemethod 0/0/1 normal\n",
        "t creasemethod 0/0/1 chaikin\n");
    write_word_rule(
        out, obj->triangles, "t smoothtriangles 0/0/1 catmark\n",
        "t smoothtriangles 0/0/1 smooth\n");
}

static otx_status
write_obj(
    otx_run *run, const otx_obj *obj, const otx_obj_write_options *options,
    otx_text_out *out)
{
    write_comments(out, options);
    otx_text_out_mark(out, run->mark, "# ", "\n");
    for (int32_t i = 0; i < obj->libraries.count; ++i)
    {
        otx_text_out_string(out, "mtllib ");
        otx_text_out_name(out, obj->libraries.text[i], true);
        otx_text_out_char(out, '\n');
    }
    write_vertices(out, obj);
    OTX_TRY(write_faces(run, out, obj));
    if (options->tags)
        write_tags(out, obj);
    return otx_text_out_close(run, out);
}

otx_status
otx_obj_write(
    otx_run *run, const otx_obj *obj, const char *path,
    const otx_obj_write_options *options)
{
    static const otx_obj_write_options defaults = {0};
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    const otx_obj_write_options *o = options ? options : &defaults;
    const char *name = o->name ? o->name : path;
    otx_text_out *out;
    otx_status status;

    OTX_TRY(check_finite(run, name, "vertex", obj->points, obj->vert_count, 3));
    OTX_TRY(
        check_finite(run, name, "texture vertex", obj->uvs, obj->uv_count, 2));
    OTX_TRY(
        check_finite(run, name, "normal", obj->normals, obj->normal_count, 3));
    status = otx_text_out_open(run, STAGE, path, name, &out);
    if (status == OSDTEX_OK)
        status = write_obj(run, obj, o, out);
    otx_arena_release(run->scratch, mark);
    return status;
}

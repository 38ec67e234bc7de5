/* field_write.c -- a field as lines of a CSV. */
#include "api/call.h"
#include "api/handle.h"
#include "file/atomic_file.h"
#include "file/text_out.h"

/* A field on the faces of one level. */
typedef struct sheet
{
    const osdtex_field *field;
    otx_connection connection;
    otx_direction direction;
    bool has_scale, has_material;
} sheet;

static otx_status
gather(otx_run *run, const osdtex_field *field, int32_t level, sheet *out)
{
    const osdtex_field_info *info = &field->info;

    *out = (sheet){.field = field};
    OTX_TRY(otx_connection_build(
        run, &field->surface->surface, level, &out->connection));
    OTX_TRY(otx_direction_coarsen(
        run, &field->direction, &out->connection, &out->direction));
    for (int32_t v = 0; v < info->vert_count; ++v)
    {
        out->has_scale |= info->scales[v] != 1.0f;
        out->has_material |= info->materials[v] != 0.0f;
    }
    return OSDTEX_OK;
}

/* Mean at the corners of a face: vertices keep their numbers at all levels. */
static float
face_mean(const sheet *s, const float *values, int32_t face)
{
    const otx_level *level = s->connection.level;
    double sum = 0.0;

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
        sum += values[level->face_verts[i]];
    return (float)(sum / otx_level_face_size(level, face));
}

static void
print_value(otx_text_out *out, float value)
{
    otx_text_out_char(out, ',');
    otx_text_out_float(out, value);
}

static void
print_face(otx_text_out *out, const sheet *s, int32_t face)
{
    const osdtex_field_info *info = &s->field->info;
    const otx_vec3 d = otx_direction_vector(&s->direction, face);

    otx_text_out_int(out, face);
    print_value(out, (float)d.x);
    print_value(out, (float)d.y);
    print_value(out, (float)d.z);
    if (s->has_scale || s->has_material)
        print_value(out, face_mean(s, info->scales, face));
    if (s->has_material)
        print_value(out, face_mean(s, info->materials, face));
    otx_text_out_char(out, '\n');
}

/* Holes keep their line, so that lines are faces: their direction is 0. */
static void
print_hole(otx_text_out *out, const sheet *s, int32_t face)
{
    otx_text_out_int(out, face);
    otx_text_out_string(out, ",0,0,0");
    if (s->has_scale || s->has_material)
        otx_text_out_string(out, ",1");
    if (s->has_material)
        otx_text_out_string(out, ",0");
    otx_text_out_char(out, '\n');
}

static void
print_sheet(otx_text_out *out, const sheet *s)
{
    const otx_level *level = s->connection.level;

    otx_text_out_string(out, "face,x,y,z");
    if (s->has_scale || s->has_material)
        otx_text_out_string(out, ",scale");
    if (s->has_material)
        otx_text_out_string(out, ",material");
    otx_text_out_char(out, '\n');
    for (int32_t f = 0; f < level->face_count; ++f)
        if (level->face_hole[f])
            print_hole(out, s, f);
        else
            print_face(out, s, f);
}

static otx_status
write_field(
    otx_run *run, const osdtex_field *field, int32_t level, const char *path)
{
    otx_atomic_file_set *set;
    const char *temporary;
    otx_text_out *out;
    sheet s;

    if (!field || !path || level < 0 ||
        level >= field->surface->surface.level_count)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "field", OTX_NOWHERE,
            "no field or no path is given, or the surface has no such level");
    OTX_TRY(gather(run, field, level, &s));
    OTX_TRY(otx_atomic_file_begin(run, run->arena, &set));
    OTX_TRY(otx_atomic_file_add(run, set, path, &temporary));
    OTX_TRY(otx_text_out_open(run, "field", temporary, path, &out));
    print_sheet(out, &s);
    OTX_TRY(otx_text_out_close(run, out));
    return otx_atomic_file_commit(run, set, false);
}

osdtex_status
osdtex_field_write(
    osdtex_context *context, const osdtex_field *field, int32_t level,
    const char *path)
{
    otx_call call;

    OTX_TRY(otx_call_begin(context, "field", &call));
    return otx_call_drop(&call, write_field(&call.run, field, level, path));
}

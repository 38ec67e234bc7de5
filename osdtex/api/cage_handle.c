/* cage_handle.c -- cages from files and from arrays. */
#include "api/call.h"
#include "api/handle.h"
#include "base/hash.h"
#include "base/union_find.h"
#include "file/obj.h"

#include <math.h>
#include <string.h>

/* A default scale is a fifth of the bounding box's diagonal: five pictures
 * across the model. */
#define DEFAULT_SCALE 0.2

/* `t interpolateboundary` counts otherwise than the rule's enum. */
static int32_t
boundary_of(otx_obj_rule rule)
{
    static const int32_t boundaries[] = {
        OTX_BOUNDARY_NONE, OTX_BOUNDARY_EDGE_AND_CORNER,
        OTX_BOUNDARY_EDGE_ONLY};

    return rule.value < 0 ? OTX_CAGE_UNSET : boundaries[rule.value];
}

static otx_cage_input
input_from_obj(const otx_obj *obj)
{
    otx_cage_input input = otx_cage_input_none();

    input.path = obj->path;
    input.vert_count = obj->vert_count;
    input.face_count = obj->face_count;
    input.uv_count = obj->uv_count;
    input.points = obj->points;
    memcpy(input.origin, obj->origin, sizeof input.origin);
    input.colors = obj->colors;
    input.point_lines = obj->point_lines;
    input.point_line_bytes = obj->point_line_bytes;
    input.face_first = obj->face_first;
    input.face_verts = obj->face_verts;
    input.uvs = obj->uvs;
    input.face_uvs = obj->uv_count > 0 ? obj->face_uvs : NULL;
    input.face_line = obj->face_line;
    input.crease_count = obj->creases.count;
    input.crease_verts = obj->creases.verts;
    input.crease_sharpness = obj->creases.sharpness;
    input.crease_line = obj->creases.line;
    input.corner_tag_count = obj->corners.count;
    input.corner_tag_verts = obj->corners.verts;
    input.corner_tag_sharpness = obj->corners.sharpness;
    input.corner_tag_line = obj->corners.line;
    input.hole_count = obj->hole_count;
    input.hole_faces = obj->hole_faces;
    input.hole_line = obj->hole_line;
    input.boundary = boundary_of(obj->boundary);
    input.fvar = obj->fvar.value;
    input.crease_chaikin = obj->crease_method.value;
    input.triangles_smooth = obj->triangles.value;
    input.group_count = obj->groups.count;
    input.group_names = obj->groups.text;
    input.face_group = obj->face_group;
    input.object_count = obj->objects.count;
    input.object_names = obj->objects.text;
    input.face_object = obj->face_object;
    input.material_count = obj->materials.count;
    input.material_names = obj->materials.text;
    input.face_material = obj->face_material;
    input.smooth_count = obj->smooths.count;
    input.smooth_names = obj->smooths.text;
    input.face_smooth = obj->face_smooth;
    input.library_count = obj->libraries.count;
    input.library_names = obj->libraries.text;
    return input;
}

/* Components of the faces, by union-find over their vertices. */
static otx_status
count_components(otx_run *run, const otx_cage *cage, int32_t *out)
{
    int32_t *parent = OTX_NEW(run->scratch, int32_t, cage->vert_count);
    uint8_t *used = OTX_ZNEW(run->scratch, uint8_t, cage->vert_count);
    int32_t count = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < cage->vert_count; ++v)
        parent[v] = v;
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        const int32_t first = cage->face_first[f];

        for (int32_t c = first; c < cage->face_first[f + 1]; ++c)
        {
            used[cage->face_verts[c]] = 1;
            otx_union_find_join(
                parent, cage->face_verts[first], cage->face_verts[c]);
        }
    }
    for (int32_t v = 0; v < cage->vert_count; ++v)
        count += used[v] && parent[v] == v;
    *out = count;
    return OSDTEX_OK;
}

static void
measure_faces(const otx_cage *cage, osdtex_cage_info *info)
{
    for (int32_t f = 0; f < cage->face_count; ++f)
    {
        const int32_t size = cage->face_first[f + 1] - cage->face_first[f];

        info->triangle_count += size == 3;
        info->quad_count += size == 4;
        info->hole_count += cage->face_hole && cage->face_hole[f];
    }
    for (int32_t k = 0; k < 3; ++k)
    {
        info->lower[k] = INFINITY;
        info->upper[k] = -INFINITY;
    }
    for (int32_t c = 0; c < cage->corner_count; ++c)
    {
        const float *p = cage->points + 3 * (size_t)cage->face_verts[c];

        for (int32_t k = 0; k < 3; ++k)
        {
            info->lower[k] =
                fmin(info->lower[k], cage->origin[k] + (double)p[k]);
            info->upper[k] =
                fmax(info->upper[k], cage->origin[k] + (double)p[k]);
        }
    }
}

static osdtex_cage_info
info_of(const otx_cage *cage)
{
    osdtex_cage_info info = {
        .path = cage->path,
        .scheme = (osdtex_scheme)cage->scheme,
        .boundary = (osdtex_boundary)cage->boundary,
        .fvar = (osdtex_fvar)cage->fvar,
        .vert_count = cage->vert_count,
        .face_count = cage->face_count,
        .edge_count = cage->edge_count,
        .uv_count = cage->uv_count,
        .crease_count = cage->crease_count,
        .corner_count = cage->corner_tag_count,
        /* An edge has one face or two, so corners count the inner ones twice.
         */
        .boundary_edge_count = 2 * cage->edge_count - cage->corner_count,
        .material_count = cage->material_count,
        .group_count = cage->group_count,
        .diagonal = cage->diagonal,
        .mean_edge_length = cage->mean_edge_length,
        .default_scale = DEFAULT_SCALE * cage->diagonal,
    };

    measure_faces(cage, &info);
    return info;
}

/* Builds the handle; `path` of a file to hash, or NULL. */
static otx_status
build(
    otx_run *run, const otx_cage_input *input,
    const osdtex_cage_options *options, const char *path, osdtex_cage **out)
{
    otx_cage_options how = otx_cage_options_default();
    osdtex_cage *handle = OTX_ZNEW(run->arena, osdtex_cage, 1);
    char hash[OTX_HASH_TEXT_BYTES];

    OTX_TRY(otx_run_ok(run));
    how.scheme = (otx_scheme)options->scheme;
    how.boundary = options->boundary;
    how.fvar = options->fvar;
    /* Zero says nothing here, and the usual distance there. */
    handle->weld = options->weld;
    how.weld = options->weld > 0.0   ? options->weld
               : options->weld < 0.0 ? 0.0
                                     : -1.0;
    handle->arena = run->arena;
    OTX_TRY(otx_cage_build(run, input, &how, &handle->cage));
    handle->info = info_of(&handle->cage);
    OTX_TRY(
        count_components(run, &handle->cage, &handle->info.component_count));
    if (path && otx_hash_file(path, hash))
    {
        handle->info.hash = otx_arena_strdup(run->arena, hash);
        OTX_TRY(otx_run_ok(run));
    }
    *out = handle;
    return OSDTEX_OK;
}

static otx_status
check_options(
    otx_run *run, const osdtex_cage_options *theirs, osdtex_cage_options *ours)
{
    *ours = osdtex_cage_options_default();
    OTX_TRY(otx_call_options(run, ours, sizeof *ours, theirs));
    if (ours->scheme < OSDTEX_SCHEME_CATMARK ||
        ours->scheme > OSDTEX_SCHEME_NONE || ours->boundary < OSDTEX_UNSET ||
        ours->boundary > OSDTEX_BOUNDARY_EDGE_AND_CORNER ||
        ours->fvar < OSDTEX_UNSET || ours->fvar > OSDTEX_FVAR_ALL)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "cage", OTX_NOWHERE,
            "scheme, boundary or fvar is none of the values of osdtex.h");
    if (!isfinite(ours->weld))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "cage", OTX_NOWHERE,
            "the distance of vertices to weld is not a finite number");
    return OSDTEX_OK;
}

static otx_status
read_cage(
    otx_call *call, const char *path, const osdtex_cage_options *options,
    osdtex_cage **out)
{
    osdtex_cage_options ours;
    otx_cage_input input;
    otx_run aside;
    otx_obj obj;

    if (!path)
        return otx_fail(
            &call->run, OSDTEX_ERROR_ARGUMENT, "cage", OTX_NOWHERE,
            "no path of a cage is given");
    OTX_TRY(check_options(&call->run, options, &ours));
    OTX_TRY(otx_call_aside(call, &aside));
    OTX_TRY(otx_obj_read(&aside, path, &obj));
    input = input_from_obj(&obj);
    return build(&call->run, &input, &ours, path, out);
}

osdtex_status
osdtex_cage_read(
    osdtex_context *context, const char *path,
    const osdtex_cage_options *options, osdtex_cage **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "cage", &call));
    return otx_call_end(&call, read_cage(&call, path, options, out), out);
}

/* Offsets of the corners from the sizes of the faces. */
static otx_status
offsets_of(
    otx_run *run, const osdtex_index *sizes, osdtex_index count,
    const int32_t **out)
{
    int32_t *first = OTX_NEW(run->scratch, int32_t, (size_t)count + 1);
    int64_t total = 0;

    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < count; ++f)
    {
        first[f] = (int32_t)total;
        total += sizes[f] > 0 ? sizes[f] : 0;
        if (total > INT32_MAX)
            return otx_fail(
                run, OSDTEX_ERROR_LIMIT, "cage", OTX_NOWHERE,
                "the faces have more than %d corners together", INT32_MAX);
    }
    first[count] = (int32_t)total;
    *out = first;
    return OSDTEX_OK;
}

static bool
arrays_are_there(const osdtex_cage_arrays *a)
{
    return a->vert_count >= 0 && a->face_count >= 0 && a->uv_count >= 0 &&
           a->crease_count >= 0 && a->corner_count >= 0 && a->hole_count >= 0 &&
           (a->vert_count == 0 || a->points) &&
           (a->face_count == 0 || (a->face_sizes && a->face_verts)) &&
           (a->uv_count == 0 || (a->uvs && a->face_uvs)) &&
           (a->crease_count == 0 || (a->crease_verts && a->crease_sharpness)) &&
           (a->corner_count == 0 || (a->corner_verts && a->corner_sharpness)) &&
           (a->hole_count == 0 || a->hole_faces);
}

static otx_status
create_cage(
    otx_run *run, const osdtex_cage_arrays *theirs,
    const osdtex_cage_options *options, osdtex_cage **out)
{
    osdtex_cage_arrays arrays = osdtex_cage_arrays_none();
    otx_cage_input input = otx_cage_input_none();
    osdtex_cage_options ours;

    OTX_TRY(check_options(run, options, &ours));
    OTX_TRY(otx_call_options(run, &arrays, sizeof arrays, theirs));
    if (!theirs || !arrays_are_there(&arrays))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "cage", OTX_NOWHERE,
            "an array is NULL whose count is not 0, or a count is negative");
    OTX_TRY(offsets_of(
        run, arrays.face_sizes, arrays.face_count, &input.face_first));
    input.vert_count = arrays.vert_count;
    input.face_count = arrays.face_count;
    input.points = arrays.points;
    input.face_verts = arrays.face_verts;
    input.uv_count = arrays.uv_count;
    input.uvs = arrays.uvs;
    input.face_uvs = arrays.face_uvs;
    input.crease_count = arrays.crease_count;
    input.crease_verts = arrays.crease_verts;
    input.crease_sharpness = arrays.crease_sharpness;
    input.corner_tag_count = arrays.corner_count;
    input.corner_tag_verts = arrays.corner_verts;
    input.corner_tag_sharpness = arrays.corner_sharpness;
    input.hole_count = arrays.hole_count;
    input.hole_faces = arrays.hole_faces;
    return build(run, &input, &ours, NULL, out);
}

osdtex_status
osdtex_cage_create(
    osdtex_context *context, const osdtex_cage_arrays *arrays,
    const osdtex_cage_options *options, osdtex_cage **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, "cage", &call));
    return otx_call_end(
        &call, create_cage(&call.run, arrays, options, out), out);
}

const osdtex_cage_info *
osdtex_cage_describe(const osdtex_cage *cage)
{
    return cage ? &cage->info : NULL;
}

void
osdtex_cage_destroy(osdtex_cage *cage)
{
    if (cage)
        otx_arena_destroy(cage->arena);
}

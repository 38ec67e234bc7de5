/* opensubdiv.cpp -- uniform refinement by OpenSubdiv's Far, for C. */
#include "bridge/opensubdiv.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <memory>
#include <new>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

struct otx_osd
{
    std::unique_ptr<Far::TopologyRefiner> refiner;
    bool has_uvs;
};

namespace
{

/* Runs `body` so that nothing is thrown through the C interface. */
template <class Body>
otx_status
guard(Body body) noexcept
{
    try
    {
        return body();
    }
    catch (const std::bad_alloc &)
    {
        return OSDTEX_ERROR_MEMORY;
    }
    catch (...)
    {
        return OSDTEX_ERROR_NUMERIC;
    }
}

void
destroy(void *object)
{
    delete static_cast<otx_osd *>(object);
}

/* What Far's templates interpolate: N floats. */
template <int N> struct Value
{
    float x[N];

    void Clear()
    {
        for (int i = 0; i < N; ++i)
            x[i] = 0.0f;
    }

    void AddWithWeight(const Value &other, float weight)
    {
        for (int i = 0; i < N; ++i)
            x[i] += weight * other.x[i];
    }
};

/* Values at a stride of floats, so that tan1 and tan2 of a vertex lie side by
 * side without a copy. */
template <int N> class Strided
{
  public:
    Strided(float *base, size_t stride) : base_(base), stride_(stride)
    {
    }

    Value<N> &operator[](int index)
    {
        return *reinterpret_cast<Value<N> *>(
            base_ + stride_ * static_cast<size_t>(index));
    }

  private:
    float *base_;
    size_t stride_;
};

template <int N>
const Value<N> *
values(const float *floats)
{
    return reinterpret_cast<const Value<N> *>(floats);
}

template <int N>
Value<N> *
values(float *floats)
{
    return reinterpret_cast<Value<N> *>(floats);
}

Sdc::SchemeType
scheme_type(otx_osd_scheme scheme)
{
    switch (scheme)
    {
    case OTX_OSD_LOOP:
        return Sdc::SCHEME_LOOP;
    case OTX_OSD_BILINEAR:
        return Sdc::SCHEME_BILINEAR;
    default:
        return Sdc::SCHEME_CATMARK;
    }
}

Sdc::Options
scheme_options(const otx_osd_mesh *mesh)
{
    Sdc::Options options;

    options.SetVtxBoundaryInterpolation(
        static_cast<Sdc::Options::VtxBoundaryInterpolation>(mesh->boundary));
    options.SetFVarLinearInterpolation(
        static_cast<Sdc::Options::FVarLinearInterpolation>(mesh->fvar));
    options.SetCreasingMethod(
        mesh->crease_chaikin ? Sdc::Options::CREASE_CHAIKIN
                             : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(
        mesh->triangles_smooth ? Sdc::Options::TRI_SUB_SMOOTH
                               : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

void
describe(
    const otx_osd_mesh *mesh, Far::TopologyDescriptor *descriptor,
    Far::TopologyDescriptor::FVarChannel *channel)
{
    descriptor->numVertices = mesh->vert_count;
    descriptor->numFaces = mesh->face_count;
    descriptor->numVertsPerFace = mesh->face_sizes;
    descriptor->vertIndicesPerFace = mesh->face_verts;
    descriptor->numCreases = mesh->crease_count;
    descriptor->creaseVertexIndexPairs = mesh->crease_verts;
    descriptor->creaseWeights = mesh->crease_sharpness;
    descriptor->numCorners = mesh->corner_tag_count;
    descriptor->cornerVertexIndices = mesh->corner_tag_verts;
    descriptor->cornerWeights = mesh->corner_tag_sharpness;
    descriptor->numHoles = mesh->hole_count;
    descriptor->holeIndices = mesh->holes;
    if (mesh->uv_count > 0)
    {
        channel->numValues = mesh->uv_count;
        channel->valueIndices = mesh->face_uvs;
        descriptor->numFVarChannels = 1;
        descriptor->fvarChannels = channel;
    }
}

/* Corners of one face: false when there are not as many as expected. */
bool
copy_indices(const Far::ConstIndexArray &from, int32_t count, int32_t *to)
{
    if (from.size() != count)
        return false;
    for (int32_t i = 0; i < count; ++i)
        to[i] = from[i];
    return true;
}

/* Children of one face: contiguous, and the next face's start after them. */
bool
copy_children(
    const Far::TopologyLevel &level, int32_t face, int32_t child_count,
    int32_t *face_child_first)
{
    const Far::ConstIndexArray children = level.GetFaceChildFaces(face);
    const bool last = face + 1 == level.GetNumFaces();

    for (int32_t i = 1; i < children.size(); ++i)
    {
        if (children[i] != children[0] + i)
            return false;
    }
    face_child_first[face] = children[0];
    if (face == 0 && children[0] != 0)
        return false;
    if (last)
        face_child_first[face + 1] = child_count;
    return children[0] + children.size() ==
           (last ? child_count : level.GetFaceChildFaces(face + 1)[0]);
}

} // namespace

otx_status
otx_osd_create(otx_arena *arena, const otx_osd_mesh *mesh, otx_osd **out)
{
    *out = nullptr;
    return guard(
        [&]() -> otx_status
        {
            using Factory =
                Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
            Far::TopologyDescriptor descriptor;
            Far::TopologyDescriptor::FVarChannel channel;
            std::unique_ptr<otx_osd> osd(new otx_osd());

            describe(mesh, &descriptor, &channel);
            osd->has_uvs = mesh->uv_count > 0;
            osd->refiner.reset(Factory::Create(
                descriptor,
                Factory::Options(
                    scheme_type(mesh->scheme), scheme_options(mesh))));
            if (!osd->refiner)
                return OSDTEX_ERROR_TOPOLOGY;
            if (!otx_arena_defer(arena, destroy, osd.get()))
                return OSDTEX_ERROR_MEMORY;
            *out = osd.release();
            return OSDTEX_OK;
        });
}

otx_status
otx_osd_refine(otx_osd *osd, int32_t level)
{
    return guard(
        [&]() -> otx_status
        {
            Far::TopologyRefiner::UniformOptions options(level);

            options.fullTopologyInLastLevel = true;
            osd->refiner->RefineUniform(options);
            return osd->refiner->GetMaxLevel() == level ? OSDTEX_OK
                                                        : OSDTEX_ERROR_NUMERIC;
        });
}

otx_osd_counts
otx_osd_counts_at(const otx_osd *osd, int32_t level)
{
    const Far::TopologyLevel &l = osd->refiner->GetLevel(level);

    return {
        l.GetNumFaces(), l.GetNumVertices(), l.GetNumEdges(),
        l.GetNumFaceVertices(), osd->has_uvs ? l.GetNumFVarValues(0) : 0};
}

otx_status
otx_osd_export_faces(
    const otx_osd *osd, int32_t level, otx_osd_range faces,
    const otx_osd_relations *out)
{
    const Far::TopologyRefiner &refiner = *osd->refiner;
    const Far::TopologyLevel &l = refiner.GetLevel(level);
    const bool has_children = out->face_child_first != nullptr;
    const bool has_face_verts =
        has_children && refiner.GetSchemeType() != Sdc::SCHEME_LOOP;
    const int32_t child_count =
        has_children ? refiner.GetLevel(level + 1).GetNumFaces() : 0;

    for (int32_t f = faces.first; f < faces.end; ++f)
    {
        const int32_t first = out->face_first[f];
        const int32_t size = out->face_first[f + 1] - first;

        if (!copy_indices(l.GetFaceVertices(f), size, out->face_verts + first))
            return OSDTEX_ERROR_NUMERIC;
        if (!copy_indices(l.GetFaceEdges(f), size, out->face_edges + first))
            return OSDTEX_ERROR_NUMERIC;
        if (out->face_uvs &&
            !copy_indices(
                l.GetFaceFVarValues(f, 0), size, out->face_uvs + first))
            return OSDTEX_ERROR_NUMERIC;
        out->face_hole[f] = l.IsFaceHole(f);
        if (out->face_parent)
            out->face_parent[f] = l.GetFaceParentFace(f);
        if (!has_children)
            continue;
        if (!copy_children(l, f, child_count, out->face_child_first))
            return OSDTEX_ERROR_NUMERIC;
        /* Loop has no such vertex, and asking for it crashes. */
        out->face_child_vert[f] = has_face_verts ? l.GetFaceChildVertex(f) : -1;
    }
    return OSDTEX_OK;
}

otx_status
otx_osd_export_edges(
    const otx_osd *osd, int32_t level, otx_osd_range edges,
    const otx_osd_relations *out)
{
    const Far::TopologyLevel &l = osd->refiner->GetLevel(level);

    for (int32_t e = edges.first; e < edges.end; ++e)
    {
        const Far::ConstIndexArray verts = l.GetEdgeVertices(e);
        const Far::ConstIndexArray faces = l.GetEdgeFaces(e);

        if (faces.size() < 1 || faces.size() > 2)
            return OSDTEX_ERROR_NUMERIC;
        out->edge_verts[2 * (size_t)e] = verts[0];
        out->edge_verts[2 * (size_t)e + 1] = verts[1];
        out->edge_faces[2 * (size_t)e] = faces[0];
        out->edge_faces[2 * (size_t)e + 1] = faces.size() == 2 ? faces[1] : -1;
        if (out->edge_child_vert)
            out->edge_child_vert[e] = l.GetEdgeChildVertex(e);
    }
    return OSDTEX_OK;
}

otx_status
otx_osd_check_prefix(const otx_osd *osd, int32_t level)
{
    const Far::TopologyLevel &l = osd->refiner->GetLevel(level);

    for (int32_t v = 0; v < l.GetNumVertices(); ++v)
    {
        if (l.GetVertexChildVertex(v) != v)
            return OSDTEX_ERROR_NUMERIC;
    }
    return OSDTEX_OK;
}

otx_status
otx_osd_refine_points(
    const otx_osd *osd, int32_t level, const float *from, float *to)
{
    return guard(
        [&]() -> otx_status
        {
            const Value<3> *source = values<3>(from);
            Value<3> *result = values<3>(to);

            Far::PrimvarRefiner(*osd->refiner)
                .Interpolate(level, source, result);
            return OSDTEX_OK;
        });
}

otx_status
otx_osd_refine_uvs(
    const otx_osd *osd, int32_t level, const float *from, float *to)
{
    return guard(
        [&]() -> otx_status
        {
            const Value<2> *source = values<2>(from);
            Value<2> *result = values<2>(to);

            Far::PrimvarRefiner(*osd->refiner)
                .InterpolateFaceVarying(level, source, result, 0);
            return OSDTEX_OK;
        });
}

otx_status
otx_osd_limit_points(
    const otx_osd *osd, const float *from, float *points, float *tangents)
{
    return guard(
        [&]() -> otx_status
        {
            const Value<3> *source = values<3>(from);
            Value<3> *result = values<3>(points);
            Strided<3> tan1(tangents, 6);
            Strided<3> tan2(tangents + 3, 6);

            Far::PrimvarRefiner(*osd->refiner)
                .Limit(source, result, tan1, tan2);
            return OSDTEX_OK;
        });
}

otx_status
otx_osd_limit_uvs(const otx_osd *osd, const float *from, float *uvs)
{
    return guard(
        [&]() -> otx_status
        {
            const Value<2> *source = values<2>(from);
            Value<2> *result = values<2>(uvs);

            Far::PrimvarRefiner(*osd->refiner).LimitFaceVarying(source, result);
            return OSDTEX_OK;
        });
}

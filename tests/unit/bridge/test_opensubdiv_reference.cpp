/* test_opensubdiv_reference.cpp -- Far called as its tutorials do. */
#include "test_opensubdiv_reference.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <memory>
#include <vector>

using namespace OpenSubdiv;

namespace
{

template <int N> struct Primvar
{
    float x[N];

    void Clear()
    {
        for (float &v : x)
            v = 0.0f;
    }

    void AddWithWeight(const Primvar &other, float weight)
    {
        for (int i = 0; i < N; ++i)
            x[i] += weight * other.x[i];
    }
};

template <int N>
std::vector<Primvar<N>>
load(const float *from, int count)
{
    std::vector<Primvar<N>> to(static_cast<size_t>(count));

    for (int i = 0; i < N * count; ++i)
        to[static_cast<size_t>(i / N)].x[i % N] = from[i];
    return to;
}

} // namespace

struct reference_osd
{
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::vector<Primvar<3>> refined, limit, tan1, tan2;
    std::vector<Primvar<2>> uvs;
};

/* All levels of points and of face-varying values, each from the one before. */
static void
reference_osd_interpolate(
    reference_osd *r, const Far::PrimvarRefiner &primvars, int level,
    std::vector<Primvar<3>> &points, std::vector<Primvar<2>> &uvs)
{
    for (int l = 1; l <= level; ++l)
    {
        const Far::TopologyLevel &at = r->refiner->GetLevel(l);
        std::vector<Primvar<3>> to(static_cast<size_t>(at.GetNumVertices()));

        primvars.Interpolate(l, points, to);
        points.swap(to);
        if (uvs.empty())
            continue;

        std::vector<Primvar<2>> uv_to(
            static_cast<size_t>(at.GetNumFVarValues(0)));

        primvars.InterpolateFaceVarying(l, uvs, uv_to, 0);
        uvs.swap(uv_to);
    }
}

reference_osd *
reference_osd_create(
    const otx_osd_mesh *mesh, const float *points, const float *uvs, int level)
{
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    static const Sdc::SchemeType types[] = {
        Sdc::SCHEME_CATMARK, Sdc::SCHEME_LOOP, Sdc::SCHEME_BILINEAR};
    reference_osd *r = new reference_osd();
    Far::TopologyDescriptor d;
    Far::TopologyDescriptor::FVarChannel channel;
    Sdc::Options options;

    d.numVertices = mesh->vert_count;
    d.numFaces = mesh->face_count;
    d.numVertsPerFace = mesh->face_sizes;
    d.vertIndicesPerFace = mesh->face_verts;
    d.numCreases = mesh->crease_count;
    d.creaseVertexIndexPairs = mesh->crease_verts;
    d.creaseWeights = mesh->crease_sharpness;
    d.numCorners = mesh->corner_tag_count;
    d.cornerVertexIndices = mesh->corner_tag_verts;
    d.cornerWeights = mesh->corner_tag_sharpness;
    d.numHoles = mesh->hole_count;
    d.holeIndices = mesh->holes;
    channel.numValues = mesh->uv_count;
    channel.valueIndices = mesh->face_uvs;
    d.numFVarChannels = mesh->uv_count > 0;
    d.fvarChannels = &channel;
    options.SetVtxBoundaryInterpolation(
        static_cast<Sdc::Options::VtxBoundaryInterpolation>(mesh->boundary));
    options.SetFVarLinearInterpolation(
        static_cast<Sdc::Options::FVarLinearInterpolation>(mesh->fvar));
    if (mesh->crease_chaikin)
        options.SetCreasingMethod(Sdc::Options::CREASE_CHAIKIN);
    if (mesh->triangles_smooth)
        options.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
    r->refiner.reset(
        Factory::Create(d, Factory::Options(types[mesh->scheme], options)));

    Far::TopologyRefiner::UniformOptions uniform(level);
    uniform.fullTopologyInLastLevel = true;
    r->refiner->RefineUniform(uniform);

    Far::PrimvarRefiner primvars(*r->refiner);
    std::vector<Primvar<3>> from = load<3>(points, mesh->vert_count);
    std::vector<Primvar<2>> uv_from = load<2>(uvs, mesh->uv_count);
    reference_osd_interpolate(r, primvars, level, from, uv_from);
    r->refined = from;
    r->limit.resize(from.size());
    r->tan1.resize(from.size());
    r->tan2.resize(from.size());
    primvars.Limit(from, r->limit, r->tan1, r->tan2);
    r->uvs.resize(uv_from.size());
    if (mesh->uv_count > 0)
        primvars.LimitFaceVarying(uv_from, r->uvs);
    return r;
}

void
reference_osd_destroy(reference_osd *r)
{
    delete r;
}

int
reference_osd_vert_count(const reference_osd *r)
{
    return static_cast<int>(r->limit.size());
}

const float *
reference_osd_refined(const reference_osd *r)
{
    return r->refined.data()->x;
}

const float *
reference_osd_limit(const reference_osd *r)
{
    return r->limit.data()->x;
}

const float *
reference_osd_tan1(const reference_osd *r)
{
    return r->tan1.data()->x;
}

int
reference_osd_uv_count(const reference_osd *r)
{
    return static_cast<int>(r->uvs.size());
}

const float *
reference_osd_uvs(const reference_osd *r)
{
    return r->uvs.data()->x;
}

int
reference_osd_face_vert(const reference_osd *r, int level, int face, int corner)
{
    return r->refiner->GetLevel(level).GetFaceVertices(face)[corner];
}

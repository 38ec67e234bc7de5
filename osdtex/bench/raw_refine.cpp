/* raw_refine.cpp -- the refinement of a cage by bare OpenSubdiv calls. */
#include "bench/raw_refine.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <cstring>
#include <memory>
#include <vector>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace
{

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

template <int N>
std::vector<Value<N>>
copied(const float *values, int32_t count)
{
    std::vector<Value<N>> out(static_cast<size_t>(count));

    std::memcpy(out.data(), values, out.size() * sizeof(Value<N>));
    return out;
}

std::unique_ptr<Far::TopologyRefiner>
make_refiner(const bench_raw_cage *cage)
{
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const std::vector<int> sizes(static_cast<size_t>(cage->face_count), 4);
    Far::TopologyDescriptor descriptor;
    Far::TopologyDescriptor::FVarChannel channel;
    Sdc::Options options;

    options.SetVtxBoundaryInterpolation(
        Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1);
    descriptor.numVertices = cage->vert_count;
    descriptor.numFaces = cage->face_count;
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = cage->face_verts;
    if (cage->uv_count > 0)
    {
        channel.numValues = cage->uv_count;
        channel.valueIndices = cage->face_uvs;
        descriptor.numFVarChannels = 1;
        descriptor.fvarChannels = &channel;
    }
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(
        descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
}

void
refine_points(
    const Far::TopologyRefiner &refiner, const bench_raw_cage *cage,
    int32_t level, float *points)
{
    const Far::PrimvarRefiner primvars(refiner);
    const size_t count = refiner.GetLevel(level).GetNumVertices();
    auto values = copied<3>(cage->points, cage->vert_count);
    std::vector<Value<3>> limit(count), tan1(count), tan2(count);

    for (int32_t l = 1; l <= level; ++l)
    {
        std::vector<Value<3>> next(refiner.GetLevel(l).GetNumVertices());

        primvars.Interpolate(l, values, next);
        values.swap(next);
    }
    primvars.Limit(values, limit, tan1, tan2);
    if (points)
        std::memcpy(points, limit.data(), count * sizeof(Value<3>));
}

void
refine_uvs(
    const Far::TopologyRefiner &refiner, const bench_raw_cage *cage,
    int32_t level)
{
    const Far::PrimvarRefiner primvars(refiner);
    auto values = copied<2>(cage->uvs, cage->uv_count);

    for (int32_t l = 1; l <= level; ++l)
    {
        std::vector<Value<2>> next(refiner.GetLevel(l).GetNumFVarValues(0));

        primvars.InterpolateFaceVarying(l, values, next, 0);
        values.swap(next);
    }
    std::vector<Value<2>> limit(values.size());

    primvars.LimitFaceVarying(values, limit, 0);
}

} // namespace

bool
bench_raw_refine_run(const bench_raw_cage *cage, int32_t level, float *points)
{
    try
    {
        const auto refiner = make_refiner(cage);
        Far::TopologyRefiner::UniformOptions options(level);

        options.fullTopologyInLastLevel = true;
        refiner->RefineUniform(options);
        refine_points(*refiner, cage, level, points);
        if (cage->uv_count > 0)
            refine_uvs(*refiner, cage, level);
        return true;
    }
    catch (...)
    {
        return false;
    }
}

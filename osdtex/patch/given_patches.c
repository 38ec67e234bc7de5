/* given_patches.c -- surfaces that are textured in part already.
 *
 * Another method has laid its texture where it can; the rest is covered by
 * patches that continue it. What is given takes part in the cut and in the
 * relaxation like any patch, but offers nothing beyond its own faces. */
#include "patch/given_patches.h"

#include <string.h>

void
otx_given_take(const otx_mosaic_job *job, otx_cover *cover)
{
    const otx_level *leaf = job->leaves.level;
    const otx_patch_given *given = job->given;

    cover->patch_count = given->patch_count;
    if (given->patch_exemplar && cover->patch_exemplar)
        memcpy(
            cover->patch_exemplar, given->patch_exemplar,
            (size_t)given->patch_count);
    memcpy(
        cover->uvs, given->uvs,
        (size_t)leaf->corner_count * sizeof *cover->uvs);
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        cover->face_patch[f] = leaf->face_hole[f] ? -1 : given->face_patch[f];
        if (cover->face_patch[f] >= 0)
            cover->done_area += job->leaves.areas[f];
    }
}

bool
otx_given_holds(const otx_mosaic_job *job, int32_t face)
{
    return job->given && job->given->state &&
           job->given->face_patch[face] >= 0 &&
           job->given->state[face] == OTX_GIVEN_HELD;
}

otx_status
otx_given_region(
    const otx_mosaic_job *job, const otx_cover *cover, int32_t exemplar,
    otx_cluster *out)
{
    const otx_level *leaf = job->leaves.level;
    int32_t *faces = OTX_NEW(job->run->arena, int32_t, leaf->face_count);

    OTX_TRY(otx_run_ok(job->run));
    *out = (otx_cluster){job->leaves.level_index, 0, faces, 0.0, -1};
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (cover->face_patch[f] < 0 && !leaf->face_hole[f] &&
            otx_supply_wanted(job, f) == exemplar)
        {
            faces[out->face_count++] = f;
            out->area += job->leaves.areas[f];
        }
    return OSDTEX_OK;
}

/* The given patch that offers a face, -1 none. */
static int32_t
patch_of(const otx_mosaic *m, int32_t face)
{
    const otx_patch_given *given = m->job.given;

    if (m->job.leaves.level->face_hole[face])
        return -1;
    if (given->face_patch[face] < 0 && given->before)
        return given->before[face];
    return given->face_patch[face];
}

/* The faces of one given patch, at their UVs. */
static otx_status
offer_patch(const otx_mosaic *m, int32_t patch, int32_t count, otx_offer *out)
{
    const otx_level *leaf = m->job.leaves.level;
    int32_t *faces = OTX_NEW(m->job.run->arena, int32_t, count);
    int32_t *first = OTX_NEW(m->job.run->arena, int32_t, count + 1);
    int32_t corners = 0, n = 0;
    otx_vec2 *uvs;

    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (patch_of(m, f) == patch)
        {
            faces[n] = f;
            first[n++] = corners;
            corners += otx_level_face_size(leaf, f);
        }
    first[n] = corners;
    uvs = OTX_NEW(m->job.run->arena, otx_vec2, corners);
    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t i = 0; i < n; ++i)
        memcpy(
            uvs + first[i], m->job.given->uvs + leaf->face_first[faces[i]],
            (size_t)(first[i + 1] - first[i]) * sizeof *uvs);
    *out = (otx_offer){
        n, faces, uvs, first, NULL, otx_cover_exemplar(&m->cover, patch)};
    return OSDTEX_OK;
}

otx_status
otx_given_offers(const otx_mosaic *m, otx_offer *offers)
{
    const otx_level *leaf = m->job.leaves.level;
    int32_t *counts =
        OTX_ZNEW(m->job.run->scratch, int32_t, m->job.given->patch_count + 1);

    OTX_TRY(otx_run_ok(m->job.run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (patch_of(m, f) >= 0)
            ++counts[patch_of(m, f)];
    for (int32_t p = 0; p < m->job.given->patch_count; ++p)
        OTX_TRY(offer_patch(m, p, counts[p], &offers[p]));
    return OSDTEX_OK;
}

/* cover.c -- which patch each face shows, and at which UVs. */
#include "patch/cover.h"

otx_status
otx_cover_create(const otx_mosaic_job *job, otx_cover *out)
{
    const otx_level *leaf = job->leaves.level;
    otx_arena *arena = job->run->arena;

    *out = (otx_cover){
        .face_patch = OTX_NEW(arena, int32_t, leaf->face_count),
        .uvs = OTX_ZNEW(arena, otx_vec2, leaf->corner_count),
    };
    if (job->demand)
        out->patch_exemplar =
            OTX_ZNEW(arena, uint8_t, 2 * (int64_t)leaf->face_count);
    OTX_TRY(otx_run_ok(job->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        out->face_patch[f] = -1;
        out->total_area += job->leaves.areas[f];
    }
    return OSDTEX_OK;
}

int32_t
otx_cover_exemplar(const otx_cover *cover, int32_t patch)
{
    return cover->patch_exemplar ? cover->patch_exemplar[patch] : 0;
}

/* Whether a patch was there before an edit, and is left where it lies. */
static bool
stays(const otx_mosaic_job *job, int32_t patch)
{
    return job->given && job->given->state && patch < job->given->patch_count;
}

/* Whole pictures by which each patch is moved so that its first corner lies in
 * [0, 1): floats are finest there. */
static otx_status
write_uvs(const otx_mosaic_job *job, const otx_cover *cover, otx_mapping *out)
{
    const otx_level *leaf = job->leaves.level;
    otx_vec2 *shift =
        OTX_ZNEW(job->run->scratch, otx_vec2, cover->patch_count + 1);
    uint8_t *known =
        OTX_ZNEW(job->run->scratch, uint8_t, cover->patch_count + 1);

    OTX_TRY(otx_run_ok(job->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t p = cover->face_patch[f];
        const otx_exemplar *e =
            &job->exemplars[p < 0 ? 0 : otx_cover_exemplar(cover, p)];

        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            otx_vec2 uv = {
                cover->uvs[c].x / e->match.width,
                cover->uvs[c].y / e->match.height};

            if (p < 0)
                uv = (otx_vec2){0, 0};
            else if (!known[p] && !stays(job, p))
            {
                shift[p].x = e->wrap_x ? floor(uv.x) : 0.0;
                shift[p].y = e->wrap_y ? floor(uv.y) : 0.0;
                known[p] = 1;
            }
            if (p >= 0)
                uv = otx_vec2_sub(uv, shift[p]);
            out->uvs[2 * (size_t)c] = (float)uv.x;
            out->uvs[2 * (size_t)c + 1] = (float)uv.y;
        }
    }
    return OSDTEX_OK;
}

/* Patches keep their order; those that the cut emptied lose their number, but
 * for those that were there before an edit. */
static otx_status
number_patches(
    const otx_mosaic_job *job, const otx_cover *cover, otx_mapping *out)
{
    const int32_t faces = job->leaves.level->face_count;
    int32_t *number =
        OTX_ZNEW(job->run->scratch, int32_t, cover->patch_count + 1);

    OTX_TRY(otx_run_ok(job->run));
    for (int32_t f = 0; f < faces; ++f)
        if (cover->face_patch[f] >= 0)
            number[cover->face_patch[f]] = 1;
    for (int32_t p = 0; p < cover->patch_count; ++p)
    {
        if (stays(job, p))
            number[p] = 1;
        /* Patches come before their numbers: none is overwritten unread. */
        if (number[p] && cover->patch_exemplar)
            cover->patch_exemplar[out->patch_count] = cover->patch_exemplar[p];
        number[p] = number[p] ? out->patch_count++ : -1;
    }
    out->patch_exemplar = cover->patch_exemplar;
    out->exemplar_count = job->exemplar_count;
    for (int32_t f = 0; f < faces; ++f)
        out->face_patch[f] =
            cover->face_patch[f] < 0 ? -1 : number[cover->face_patch[f]];
    return OSDTEX_OK;
}

otx_status
otx_cover_write(
    const otx_mosaic_job *job, const otx_cover *cover, otx_mapping *out)
{
    const otx_level *leaf = job->leaves.level;

    *out = (otx_mapping){.surface = job->surface, .scale = job->scale};
    out->uvs = OTX_NEW(job->run->arena, float, 2 * (int64_t)leaf->corner_count);
    out->face_patch = OTX_NEW(job->run->arena, int32_t, leaf->face_count);
    OTX_TRY(otx_run_ok(job->run));
    OTX_TRY(write_uvs(job, cover, out));
    return number_patches(job, cover, out);
}

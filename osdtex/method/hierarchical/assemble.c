/* assemble.c -- from fitted patches to a mapping.
 *
 * Every patch offers its whole chart, collar included; the cut chooses, the
 * relaxation closes what is left, and UVs go out in units of the picture. */
#include "method/hierarchical/hierarchical.h"

#include "relax/elastic.h"

static otx_status
cut(otx_mapper *m)
{
    otx_cut_stats stats;

    OTX_TRY(otx_offers_make(m));
    OTX_TRY(otx_offers_cut(m, &stats));
    m->stats->cut_before = stats.energy_before;
    m->stats->cut_after = stats.energy_after;
    return OSDTEX_OK;
}

static otx_status
relax(otx_mapper *m)
{
    const otx_elastic_options options = {
        .texels = m->texels,
        .rounds = m->settings.relax_rounds,
        .levels = 3,
        .stiffness = m->settings.stiffness,
        .stretch = 1.6,
        .reach = m->given ? m->given->reach : 0.0,
        .patch_exemplar = m->patch_exemplar,
        .exemplar_count = m->supply_count,
        .keep_shape = m->given != NULL,
    };
    otx_elastic_stats stats;

    OTX_TRY(otx_elastic_run(
        m->run, m->surface, m->exemplars, &options, m->face_patch, m->uvs,
        &stats));
    m->stats->relax_before = stats.seam_before;
    m->stats->relax_after = stats.seam_after;
    return OSDTEX_OK;
}

/* Whole pictures by which each patch is moved so that its first corner lies in
 * [0, 1): floats are finest there. */
static otx_status
write_uvs(const otx_mapper *m, otx_mapping *out)
{
    const otx_level *leaf = m->leaves.level;
    otx_vec2 *shift = OTX_NEW(m->run->scratch, otx_vec2, m->patch_count + 1);
    uint8_t *known = OTX_ZNEW(m->run->scratch, uint8_t, m->patch_count + 1);

    if (!shift || !known)
        return otx_fail_memory(m->run, "map");
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const int32_t p = m->face_patch[f];
        const otx_exemplar *e =
            &m->exemplars[p < 0 ? 0 : otx_supply_of_patch(m, p)];

        for (int32_t c = leaf->face_first[f]; c < leaf->face_first[f + 1]; ++c)
        {
            otx_vec2 uv = {
                m->uvs[c].x / e->match.width, m->uvs[c].y / e->match.height};

            if (p < 0)
                uv = (otx_vec2){0, 0};
            else if (!known[p])
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

/* Patches keep their order; those that the cut emptied lose their number. */
static otx_status
number_patches(const otx_mapper *m, otx_mapping *out)
{
    const int32_t faces = m->leaves.level->face_count;
    int32_t *number = OTX_ZNEW(m->run->scratch, int32_t, m->patch_count + 1);

    if (!number)
        return otx_fail_memory(m->run, "map");
    for (int32_t f = 0; f < faces; ++f)
        if (m->face_patch[f] >= 0)
            number[m->face_patch[f]] = 1;
    for (int32_t p = 0; p < m->patch_count; ++p)
    {
        /* Patches come before their numbers: none is overwritten unread. */
        if (number[p] && m->patch_exemplar)
            m->patch_exemplar[out->patch_count] = m->patch_exemplar[p];
        number[p] = number[p] ? out->patch_count++ : -1;
    }
    out->patch_exemplar = m->patch_exemplar;
    out->exemplar_count = m->supply_count;
    for (int32_t f = 0; f < faces; ++f)
        out->face_patch[f] =
            m->face_patch[f] < 0 ? -1 : number[m->face_patch[f]];
    return OSDTEX_OK;
}

static otx_status
keep_guide(const otx_mapper *m, otx_mapping *out)
{
    otx_guide *guide = OTX_NEW(m->run->arena, otx_guide, 1);

    if (!guide)
        return otx_fail_memory(m->run, "map");
    if (!m->supplies[0].guide)
        return OSDTEX_OK;
    *guide = *m->supplies[0].guide;
    out->guide = guide;
    return OSDTEX_OK;
}

otx_status
otx_assemble(otx_mapper *m, otx_mapping *out)
{
    const otx_level *leaf = m->leaves.level;

    *out = (otx_mapping){.surface = m->surface, .scale = m->request->scale};
    OTX_TRY(keep_guide(m, out));
    if (m->settings.cut == OTX_HIERARCHICAL_ON && m->patch_count > 1)
    {
        otx_map_stats_stage(m->stats, "cut");
        OTX_TRY(cut(m));
    }
    otx_nodes_free(m);
    if (m->settings.relax == OTX_HIERARCHICAL_RELAX_GLOBAL)
    {
        otx_map_stats_stage(m->stats, "relax");
        OTX_TRY(relax(m));
    }
    out->uvs = OTX_NEW(m->run->arena, float, 2 * (int64_t)leaf->corner_count);
    out->face_patch = OTX_NEW(m->run->arena, int32_t, leaf->face_count);
    if (!out->uvs || !out->face_patch)
        return otx_fail_memory(m->run, "map");
    OTX_TRY(otx_straighten(m));
    otx_unfold(m);
    OTX_TRY(write_uvs(m, out));
    return number_patches(m, out);
}

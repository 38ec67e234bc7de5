/* refit.c -- part of a mapping made anew, all else left as it is to the bit. */
#include "edit/refit.h"

#include "mapping/source.h"
#include "seam/unit.h"
#include "surface/subset.h"

#include <string.h>

static const char STAGE[] = "edit";

/* Texels of held faces around the part: what is looked at to continue them. */
static const double RING = 100.0;

/* The part, and what it is given. */
typedef struct part
{
    const otx_refit *refit;
    otx_run *run;
    otx_subset subset;
    const otx_level *level; /* of the subset */
    int32_t *patches;       /* [given.patch_count] their numbers in `from` */
    uint8_t *state;         /* [face_count] OTX_REFIT_..., of the part */
    otx_patch_given given;
    otx_map_request request;
    otx_guide guide;
    otx_mapping made;
} part;

static double
texels_of(const part *p)
{
    const otx_job *job = p->refit->job;

    return otx_unit_texels(job->exemplars, job->request->scale);
}

static otx_status
take_part(part *p)
{
    const otx_surface *surface = p->refit->job->surface;
    const int32_t faces = otx_surface_leaf(surface)->face_count;
    uint8_t *taken = OTX_NEW(p->run->scratch, uint8_t, faces);

    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < faces; ++f)
        taken[f] = p->refit->state[f] != OTX_REFIT_HELD;
    OTX_TRY(otx_subset_widen(p->run, surface, RING / texels_of(p), 1, taken));
    OTX_TRY(otx_subset_take(p->run, surface, taken, &p->subset));
    p->level = otx_surface_leaf(&p->subset.surface);
    p->state = OTX_NEW(p->run->arena, uint8_t, p->level->face_count);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < p->level->face_count; ++f)
        p->state[f] = p->refit->state[p->subset.faces[f]];
    return OSDTEX_OK;
}

/* Numbers the patches of the part in the order in which faces name them. */
static otx_status
give_patches(part *p)
{
    const otx_mapping *from = p->refit->from;
    const int32_t faces = p->level->face_count;
    int32_t *number = OTX_NEW(p->run->scratch, int32_t, from->patch_count + 1);
    int32_t *patch = OTX_NEW(p->run->arena, int32_t, faces);
    int32_t *before = OTX_NEW(p->run->arena, int32_t, faces);
    uint8_t *exemplar = OTX_NEW(p->run->arena, uint8_t, faces + 1);

    p->patches = OTX_NEW(p->run->arena, int32_t, faces + 1);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t k = 0; k < from->patch_count; ++k)
        number[k] = -1;
    for (int32_t f = 0; f < faces; ++f)
    {
        const int32_t was = from->face_patch[p->subset.faces[f]];

        patch[f] = before[f] = -1;
        if (was < 0 || p->state[f] == OTX_REFIT_OPEN)
            continue;
        if (number[was] < 0)
        {
            number[was] = p->given.patch_count;
            exemplar[p->given.patch_count] =
                (uint8_t)otx_source_of(from, p->subset.faces[f]);
            p->patches[p->given.patch_count++] = was;
        }
        *(p->state[f] == OTX_REFIT_EITHER ? &before[f] : &patch[f]) =
            number[was];
    }
    p->given.face_patch = patch;
    p->given.before = before;
    p->given.patch_exemplar = exemplar;
    return OSDTEX_OK;
}

/* Texels: a product of a float and a size is exact in a double, and so comes
 * back as the same float. */
static otx_status
give_uvs(part *p)
{
    const otx_mapping *from = p->refit->from;
    otx_vec2 *uvs = OTX_NEW(p->run->arena, otx_vec2, p->level->corner_count);

    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < p->level->face_count; ++f)
    {
        const otx_image *match =
            &p->refit->job->exemplars[otx_source_of(from, p->subset.faces[f])]
                 .match;

        for (int32_t c = p->level->face_first[f];
             c < p->level->face_first[f + 1]; ++c)
        {
            const float *uv = from->uvs + 2 * (size_t)p->subset.corners[c];

            uvs[c] = (otx_vec2){
                (double)uv[0] * match->width, (double)uv[1] * match->height};
        }
    }
    p->given.uvs = uvs;
    return OSDTEX_OK;
}

static otx_status
give_states(part *p)
{
    uint8_t *state = OTX_NEW(p->run->arena, uint8_t, p->level->face_count);

    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < p->level->face_count; ++f)
        state[f] =
            p->state[f] == OTX_REFIT_HELD ? OTX_GIVEN_HELD : OTX_GIVEN_FREE;
    p->given.state = state;
    p->given.avoid = p->refit->avoid;
    return OSDTEX_OK;
}

/* What the request says of each face. */
static otx_status
take_request(part *p)
{
    const otx_map_request *whole = p->refit->job->request;
    const int32_t faces = p->level->face_count;
    otx_vec3 *directions = OTX_NEW(p->run->arena, otx_vec3, faces);
    uint8_t *demand = OTX_NEW(p->run->arena, uint8_t, faces);

    OTX_TRY(otx_run_ok(p->run));
    p->request = (otx_map_request){
        .scale = whole->scale, .first_face = -1, .analysis = whole->analysis};
    for (int32_t f = 0; f < faces; ++f)
    {
        if (whole->guide)
            directions[f] = whole->guide->directions[p->subset.faces[f]];
        if (whole->demand)
            demand[f] = whole->demand[p->subset.faces[f]];
    }
    if (whole->guide)
    {
        p->guide = *whole->guide;
        p->guide.directions = directions;
        p->request.guide = &p->guide;
    }
    if (whole->demand)
        p->request.demand = demand;
    return OSDTEX_OK;
}

static otx_status
fill(part *p)
{
    otx_job job = *p->refit->job;

    job.run = p->run;
    job.surface = &p->subset.surface;
    job.request = &p->request;
    job.figures = NULL;
    return p->refit->method ? p->refit->method->fill(&job, &p->given, &p->made)
                            : otx_method_fill(&job, &p->given, &p->made);
}

/* ---- back onto the whole surface ---- */

/* A copy of what there was, with room for the patches that were made. */
static otx_status
copy(const part *p, otx_run *run, otx_mapping *out)
{
    const otx_mapping *from = p->refit->from;
    const otx_level *leaf = otx_surface_leaf(p->refit->job->surface);
    const size_t corners = (size_t)leaf->corner_count;
    const size_t faces = (size_t)leaf->face_count;

    *out = (otx_mapping){
        .surface = p->refit->job->surface,
        .scale = from->scale,
        .uvs = OTX_NEW(run->arena, float, 2 * corners),
        .face_patch = OTX_NEW(run->arena, int32_t, faces),
        .patch_count = from->patch_count,
        .exemplar_count = from->exemplar_count,
        .guide = p->refit->job->request->guide,
        .lattice = from->lattice,
        .along = from->along,
        .decals = from->decals,
    };
    OTX_TRY(otx_run_ok(run));
    memcpy(out->uvs, from->uvs, 2 * corners * sizeof *out->uvs);
    memcpy(out->face_patch, from->face_patch, faces * sizeof *out->face_patch);
    return OSDTEX_OK;
}

/* Numbers in the whole mapping of the patches of the part: those that were
 * there have theirs, new ones take what nobody has any more.
 *
 *   number  [made.patch_count] in run->scratch */
static otx_status
number_patches(const part *p, otx_mapping *out, int32_t **number)
{
    const otx_mapping *from = p->refit->from;
    const otx_level *leaf = otx_surface_leaf(p->refit->job->surface);
    uint8_t *used = OTX_ZNEW(p->run->scratch, uint8_t, from->patch_count + 1);
    int32_t next = 0;

    *number = OTX_NEW(p->run->scratch, int32_t, p->made.patch_count + 1);
    OTX_TRY(otx_run_ok(p->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (p->refit->state[f] == OTX_REFIT_HELD && from->face_patch[f] >= 0)
            used[from->face_patch[f]] = 1;
    for (int32_t f = 0; f < p->level->face_count; ++f)
        if (p->made.face_patch[f] < p->given.patch_count)
            used[p->patches[p->made.face_patch[f]]] = 1;
    for (int32_t k = 0; k < p->given.patch_count; ++k)
        (*number)[k] = p->patches[k];
    for (int32_t k = p->given.patch_count; k < p->made.patch_count; ++k)
    {
        while (next < from->patch_count && used[next])
            ++next;
        (*number)[k] = next++;
    }
    if (next > out->patch_count)
        out->patch_count = next;
    return OSDTEX_OK;
}

/* The exemplars of all patches. */
static otx_status
name_exemplars(
    const part *p, otx_run *run, const int32_t *number, otx_mapping *out)
{
    const otx_mapping *from = p->refit->from;
    uint8_t *exemplar;

    if (!from->patch_exemplar)
        return OSDTEX_OK;
    exemplar = OTX_ZNEW(run->arena, uint8_t, out->patch_count + 1);
    OTX_TRY(otx_run_ok(run));
    memcpy(exemplar, from->patch_exemplar, (size_t)from->patch_count);
    for (int32_t k = p->given.patch_count; k < p->made.patch_count; ++k)
        if (p->made.patch_exemplar)
            exemplar[number[k]] = p->made.patch_exemplar[k];
    out->patch_exemplar = exemplar;
    return OSDTEX_OK;
}

static otx_status
put_back(const part *p, otx_run *run, otx_mapping *out)
{
    int32_t *number;

    OTX_TRY(copy(p, run, out));
    OTX_TRY(number_patches(p, out, &number));
    for (int32_t f = 0; f < p->level->face_count; ++f)
    {
        if (p->state[f] == OTX_REFIT_HELD)
            continue;
        out->face_patch[p->subset.faces[f]] = number[p->made.face_patch[f]];
        for (int32_t c = p->level->face_first[f];
             c < p->level->face_first[f + 1]; ++c)
            memcpy(
                out->uvs + 2 * (size_t)p->subset.corners[c],
                p->made.uvs + 2 * (size_t)c, 2 * sizeof *out->uvs);
    }
    return name_exemplars(p, run, number, out);
}

static bool
changes_anything(const otx_refit *refit)
{
    const int32_t faces = otx_surface_leaf(refit->job->surface)->face_count;

    for (int32_t f = 0; f < faces; ++f)
        if (refit->state[f] != OTX_REFIT_HELD)
            return true;
    return false;
}

static otx_status
refit_part(const otx_refit *refit, otx_run *aside, otx_mapping *out)
{
    part p = {.refit = refit, .run = aside};

    if (!changes_anything(refit))
    {
        OTX_TRY(copy(&p, refit->job->run, out));
        out->patch_exemplar = refit->from->patch_exemplar;
        return OSDTEX_OK;
    }
    OTX_TRY(take_part(&p));
    OTX_TRY(give_patches(&p));
    OTX_TRY(give_uvs(&p));
    OTX_TRY(give_states(&p));
    OTX_TRY(take_request(&p));
    OTX_TRY(fill(&p));
    return put_back(&p, refit->job->run, out);
}

otx_status
otx_refit_run(const otx_refit *refit, otx_mapping *out)
{
    const otx_arena_mark mark = otx_arena_here(refit->job->run->scratch);
    otx_run aside = *refit->job->run;
    otx_status status;

    if (refit->method && !refit->method->fill)
        return otx_fail(
            refit->job->run, OSDTEX_ERROR_SUPPORT, STAGE, OTX_NOWHERE,
            "the method '%s' cannot cover a part of a surface",
            refit->method->name);
    /* What is made on the way is as large as the part, and goes with it. */
    aside.arena = otx_arena_create(aside.allocator);
    if (!aside.arena)
        return otx_fail_memory(refit->job->run, STAGE);
    status = refit_part(refit, &aside, out);
    otx_arena_destroy(aside.arena);
    otx_arena_release(refit->job->run->scratch, mark);
    return status;
}

/* compose.c -- what is seen of the pastes, as lookups of the faces.
 *
 * A paste is kept on a face where it is seen at a sample [Praun00, sec. 4].
 * The lowest one is opaque there: between samples nothing opens. */
#include "method/lapped/lapped.h"

#include "flatten/aligned.h"

#include <string.h>

/* Weights below which nobody sees a paste, and masks by which it counts as
 * laid on a face. */
static const double SEEN = 0.01, TOUCHED = 0.02;

/* A paste on a face. */
typedef struct entry
{
    int32_t paste;
    int32_t piece; /* of the paste */
    int32_t slot;  /* of the face in its chart */
    float seen;    /* its largest weight */
    float share;   /* mean of its weights */
    bool touches;
} entry;

typedef struct composition
{
    const otx_lapped *l;
    int64_t *first;     /* [leaf face_count + 1] */
    entry *entries;     /* of a face, bottom first */
    int32_t *bottom;    /* [leaf face_count] the entry that is opaque there */
    int32_t *top;       /* [leaf face_count] the entry that is seen most */
    int32_t *fragments; /* [paste_count + 1] the first of each paste */
} composition;

/* ---- lists ---- */

/* Whether a piece may reach a face of its paste's chart: some of the circle
 * around it is in the box around the face. */
static bool
meets(
    const otx_lapped_paste *paste, int32_t slot, const otx_lapped_piece *piece)
{
    const otx_lapped_chart *c = &paste->chart;
    const double reach = (double)piece->cut->most;
    otx_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};

    for (int32_t k = c->first[slot]; k < c->first[slot + 1]; ++k)
    {
        const otx_vec2 at = otx_vec2_sub(c->flat[c->corners[k]], piece->middle);

        low = (otx_vec2){fmin(low.x, at.x), fmin(low.y, at.y)};
        high = (otx_vec2){fmax(high.x, at.x), fmax(high.y, at.y)};
    }
    return otx_vec2_length((otx_vec2){
               fmax(fmax(low.x, -high.x), 0.0),
               fmax(fmax(low.y, -high.y), 0.0)}) < reach;
}

/* Calls for every piece on every face, bottom first: counts, or puts. */
static void
visit(composition *c, int64_t *at)
{
    const otx_lapped *l = c->l;

    for (int32_t p = 0; p < l->paste_count; ++p)
        for (int32_t i = 0; i < l->pastes[p].chart.face_count; ++i)
            for (int32_t k = 0; k < l->pastes[p].piece_count; ++k)
            {
                const int32_t face = l->pastes[p].chart.faces[i];

                if (!meets(&l->pastes[p], i, &l->pastes[p].pieces[k]))
                    continue;
                if (at)
                    c->entries[at[face]++] =
                        (entry){.paste = p, .piece = k, .slot = i};
                else
                    ++c->first[face + 1];
            }
}

static const otx_lapped_piece *
piece_of(const otx_lapped *l, const entry *e)
{
    return &l->pastes[e->paste].pieces[e->piece];
}

/* Higher pieces over lower ones; those of one height stay as they are. */
static void
order(const otx_lapped *l, entry *list, int32_t count)
{
    for (int32_t i = 1; i < count; ++i)
    {
        const entry e = list[i];
        const double height = piece_of(l, &e)->height;
        int32_t k = i;

        for (; k > 0 && piece_of(l, &list[k - 1])->height > height; --k)
            list[k] = list[k - 1];
        list[k] = e;
    }
}

static otx_status
list_pastes(composition *c)
{
    const otx_lapped *l = c->l;
    const int32_t n = l->leaf->face_count;
    otx_run *run = l->run;
    int64_t *at = OTX_ZNEW(run->scratch, int64_t, (int64_t)n + 1);

    c->first = OTX_ZNEW(run->scratch, int64_t, (int64_t)n + 1);
    c->bottom = OTX_ZNEW(run->scratch, int32_t, n);
    c->top = OTX_ZNEW(run->scratch, int32_t, n);
    OTX_TRY(otx_run_ok(run));
    visit(c, NULL);
    for (int32_t f = 0; f < n; ++f)
        c->first[f + 1] += c->first[f];
    c->entries = OTX_ZNEW(run->scratch, entry, c->first[n]);
    OTX_TRY(otx_run_ok(run));
    memcpy(at, c->first, ((size_t)n + 1) * sizeof *at);
    visit(c, at);
    for (int32_t f = 0; f < n; ++f)
        order(
            l, c->entries + c->first[f],
            (int32_t)(c->first[f + 1] - c->first[f]));
    return OSDTEX_OK;
}

/* ---- what is seen ---- */

/* A corner of the level as a vertex of the entry's chart. */
static int32_t
vertex_of(const otx_lapped *l, const entry *e, int32_t face, int32_t corner)
{
    const otx_lapped_chart *chart = &l->pastes[e->paste].chart;

    return chart
        ->corners[chart->first[e->slot] + corner - l->leaf->face_first[face]];
}

/* Mask and rim of an entry at a sample. */
static void
weigh(
    const otx_lapped *l, const entry *e, int32_t face,
    const otx_sample_place *sample, double *mask, double *rim)
{
    const otx_lapped_paste *paste = &l->pastes[e->paste];
    otx_vec2 at = {0, 0};

    *rim = 0.0;
    for (int k = 0; k < 3; ++k)
    {
        const int32_t v = vertex_of(l, e, face, sample->corners[k]);

        at = otx_vec2_add(
            at, otx_vec2_scale(sample->at[k], paste->chart.flat[v]));
        *rim += sample->at[k] * (double)paste->chart.rim[v];
    }
    *mask = otx_radial_alpha(
        piece_of(l, e)->cut, otx_vec2_sub(at, piece_of(l, e)->middle), 0.0);
}

/* Light goes down through the pastes; what none has stopped comes from the
 * topmost that has the place, whatever its rim. `rest` counts that. */
static void
look(const composition *c, int32_t face, int32_t index, double *rest)
{
    const otx_lapped *l = c->l;
    const otx_sample_place sample = otx_samples_at(&l->samples, face, index);
    const int32_t count = (int32_t)(c->first[face + 1] - c->first[face]);
    entry *list = c->entries + c->first[face];
    double through = 1.0, best = 0.0;
    int32_t carrier = 0;

    for (int32_t i = count - 1; i >= 0; --i)
    {
        double mask, rim, weight;

        weigh(l, &list[i], face, &sample, &mask, &rim);
        list[i].touches = list[i].touches || mask > TOUCHED;
        weight = through * mask * rim;
        through -= weight;
        list[i].seen = fmaxf(list[i].seen, (float)weight);
        list[i].share += (float)weight;
        if (mask > best + 1e-6)
        {
            best = mask;
            carrier = i;
        }
    }
    rest[carrier] += through;
}

static otx_status
look_at_face(void *context, int64_t index, otx_worker *worker)
{
    composition *c = context;
    const int32_t face = (int32_t)index;
    const int32_t count = (int32_t)(c->first[face + 1] - c->first[face]);
    entry *list = c->entries + c->first[face];
    double *rest = OTX_ZNEW(worker->scratch, double, count + 1);
    const int32_t samples = otx_samples_count(&c->l->samples, face);
    int32_t bottom = 0, top = 0;

    if (!rest)
        return OSDTEX_ERROR_MEMORY;
    if (count == 0) /* a hole */
        return OSDTEX_OK;
    for (int32_t i = 0; i < samples; ++i)
        look(c, face, i, rest);
    /* Opaque is the one that most comes through to, and nothing is below it. */
    while (bottom + 1 < count && !(list[bottom].seen > SEEN))
        ++bottom;
    for (int32_t i = 0; i < count; ++i)
        if (rest[i] > rest[bottom] + 0.5)
            bottom = i;
    list[bottom].seen = 1.0f;
    list[bottom].share += (float)rest[bottom];
    for (int32_t i = 0; i < count; ++i)
        if (list[i].share > list[top].share)
            top = i;
    list[top].seen = 1.0f;
    c->bottom[face] = bottom;
    c->top[face] = top;
    return OSDTEX_OK;
}

/* ---- the mapping ---- */

/* Entries that a face keeps: once more the bottom one, where others are kept
 * below it. */
static int32_t
kept_count(const composition *c, int32_t face)
{
    const entry *list = c->entries + c->first[face];
    const int32_t count = (int32_t)(c->first[face + 1] - c->first[face]);
    int32_t kept = 0, lowest = count;

    for (int32_t i = count - 1; i >= 0; --i)
        if ((double)list[i].seen > SEEN)
        {
            ++kept;
            lowest = i;
        }
    return kept + (count > 0 && lowest < c->bottom[face]);
}

static void
put_uv(
    const otx_lapped *l, const entry *e, int32_t face, int32_t k, float uv[2])
{
    const otx_lapped_paste *paste = &l->pastes[e->paste];
    const otx_vec2 at =
        paste->chart.flat[vertex_of(l, e, face, l->leaf->face_first[face] + k)];

    uv[0] = (float)((paste->centre.x + at.x) / l->exemplar->match.width);
    uv[1] = (float)((paste->centre.y + at.y) / l->exemplar->match.height);
}

/* Whether the paste that shows most leaves the exemplar on a face: where it is
 * the only one, it then has to be a lookup, which may. */
static bool
leaves(const composition *c, int32_t face)
{
    const otx_exemplar *e = c->l->exemplar;
    const entry *top = c->entries + c->first[face] + c->top[face];

    for (int32_t k = 0; k < otx_level_face_size(c->l->leaf, face); ++k)
    {
        float uv[2];

        put_uv(c->l, top, face, k, uv);
        if ((!e->wrap_x && !(uv[0] >= 0.0f && uv[0] <= 1.0f)) ||
            (!e->wrap_y && !(uv[1] >= 0.0f && uv[1] <= 1.0f)))
            return true;
    }
    return false;
}

/* The lookups of a face, bottom first. The fragment of the opaque one is the
 * last of all. */
static void
put_items(const composition *c, int32_t face, otx_lookup *items)
{
    const otx_lapped *l = c->l;
    const int32_t size = otx_level_face_size(l->leaf, face);
    const entry *list = c->entries + c->first[face];
    const int32_t count = (int32_t)(c->first[face + 1] - c->first[face]);
    int32_t lowest = 0;

    while (!((double)list[lowest].seen > SEEN))
        ++lowest;
    for (int32_t step = -1; step < count; ++step)
    {
        const bool opaque = step < 0;
        const int32_t i = opaque ? c->bottom[face] : step;

        if (!opaque && (!((double)list[i].seen > SEEN) ||
                        (i == lowest && lowest == c->bottom[face])))
            continue;
        for (int32_t k = 0; k < size; ++k, ++items)
        {
            const int32_t v =
                vertex_of(l, &list[i], face, l->leaf->face_first[face] + k);

            put_uv(l, &list[i], face, k, items->uv);
            items->weight =
                opaque ? 1.0f : l->pastes[list[i].paste].chart.rim[v];
            items->fragment = opaque
                                  ? c->fragments[l->paste_count]
                                  : c->fragments[list[i].paste] + list[i].piece;
        }
    }
}

static otx_fragment
fragment_of(
    const otx_lapped *l, const otx_lapped_paste *paste,
    const otx_lapped_piece *piece, int32_t patch)
{
    const double w = l->exemplar->match.width;
    const double h = l->exemplar->match.height;
    const otx_vec2 origin = otx_vec2_add(paste->centre, piece->middle);

    return (otx_fragment){
        .patch = patch,
        .outline = piece->cut,
        .frame = {
            (float)(origin.x / w), (float)(origin.y / h), (float)(1.0 / w),
            (float)(1.0 / h)}};
}

/* Outlines of the pieces, and an opaque one behind them. */
static otx_status
put_fragments(const composition *c, const int32_t *number, otx_lookups *lookups)
{
    const otx_lapped *l = c->l;
    const int32_t count = c->fragments[l->paste_count] + 1;
    otx_fragment *list = OTX_ZNEW(l->run->arena, otx_fragment, count);

    if (!list)
        return otx_fail_memory(l->run, "map");
    for (int32_t p = 0; p < l->paste_count; ++p)
        for (int32_t k = 0; k < l->pastes[p].piece_count; ++k)
            list[c->fragments[p] + k] = fragment_of(
                l, &l->pastes[p], &l->pastes[p].pieces[k], number[p]);
    list[count - 1] = (otx_fragment){.patch = -1};
    lookups->fragments = list;
    lookups->fragment_count = count;
    return OSDTEX_OK;
}

/* Pieces before those of each paste. */
static otx_status
count_fragments(composition *c)
{
    const otx_lapped *l = c->l;

    c->fragments = OTX_ZNEW(l->run->scratch, int32_t, l->paste_count + 1);
    if (!c->fragments)
        return otx_fail_memory(l->run, "map");
    for (int32_t p = 0; p < l->paste_count; ++p)
        c->fragments[p + 1] = c->fragments[p] + l->pastes[p].piece_count;
    return OSDTEX_OK;
}

static otx_status
put_lookups(const composition *c, const int32_t *number, otx_mapping *out)
{
    const otx_lapped *l = c->l;
    const int32_t n = l->leaf->face_count;
    otx_arena *arena = l->run->arena;
    otx_lookups *lookups = OTX_ZNEW(arena, otx_lookups, 1);
    int64_t *first = OTX_ZNEW(arena, int64_t, (int64_t)n + 1);
    otx_lookup *items;

    OTX_TRY(otx_run_ok(l->run));
    for (int32_t f = 0; f < n; ++f)
    {
        const int32_t kept = kept_count(c, f);
        const bool plain = kept == 0 || (kept == 1 && !leaves(c, f));

        first[f + 1] =
            first[f] +
            (plain ? 0 : (int64_t)kept * otx_level_face_size(l->leaf, f));
    }
    items = OTX_NEW(arena, otx_lookup, first[n]);
    OTX_TRY(otx_run_ok(l->run));
    for (int32_t f = 0; f < n; ++f)
        if (first[f + 1] > first[f])
            put_items(c, f, items + first[f]);
    lookups->first = first;
    lookups->items = items;
    lookups->layering = OTX_LAYERING_OVER;
    out->lookups = lookups;
    return put_fragments(c, number, lookups);
}

/* Numbers the pastes that are seen most on some face, in their order. */
static void
put_patches(const composition *c, int32_t *number, otx_mapping *out)
{
    const otx_lapped *l = c->l;

    for (int32_t p = 0; p < l->paste_count; ++p)
        number[p] = -1;
    for (int32_t f = 0; f < l->leaf->face_count; ++f)
        if (!l->leaf->face_hole[f])
            number[c->entries[c->first[f] + c->top[f]].paste] = 0;
    for (int32_t p = 0; p < l->paste_count; ++p)
        if (number[p] == 0)
            number[p] = out->patch_count++;
    for (int32_t f = 0; f < l->leaf->face_count; ++f)
    {
        const int32_t first = l->leaf->face_first[f];
        const entry *top = c->entries + c->first[f] + c->top[f];

        out->face_patch[f] = l->leaf->face_hole[f] ? -1 : number[top->paste];
        for (int32_t k = 0; k < otx_level_face_size(l->leaf, f); ++k)
            if (l->leaf->face_hole[f])
                out->uvs[2 * (first + k)] = out->uvs[2 * (first + k) + 1] = 0;
            else
                put_uv(
                    l, top, f, k, out->uvs + 2 * ((size_t)first + (size_t)k));
    }
}

/* ---- figures ---- */

/* Means over the area of what is kept. */
static void
put_figures(const composition *c)
{
    const otx_lapped *l = c->l;
    double area = 0.0, touched = 0.0, visible = 0.0, error[3] = {0.0};

    for (int32_t f = 0; f < l->leaf->face_count; ++f)
    {
        const double a = l->connection.areas[f];

        area += a;
        visible += a * kept_count(c, f);
        for (int64_t i = c->first[f]; i < c->first[f + 1]; ++i)
        {
            const entry *e = &c->entries[i];
            const otx_lapped_paste *paste = &l->pastes[e->paste];
            const otx_lapped_chart *chart = &paste->chart;
            const otx_rigid_mesh mesh = {
                chart->face_count,       chart->vert_count,  chart->first,
                chart->corners,          chart->verts,       l->surface->points,
                l->texels / paste->size, l->surface->density};

            touched += e->touches ? a : 0.0;
            if ((double)e->seen > SEEN)
                otx_aligned_error(
                    &mesh, e->slot, chart->rights[e->slot], chart->flat, error);
        }
    }
    area = fmax(area, 1e-300);
    otx_figures_count(
        l->job->figures, "lapped.pastes", "pastes", l->paste_count);
    otx_figures_real(
        l->job->figures, "lapped.touched", "layers", touched / area);
    otx_figures_real(
        l->job->figures, "lapped.visible", "layers", visible / area);
    error[2] = fmax(error[2], 1e-300);
    otx_figures_real(
        l->job->figures, "lapped.misfit_right", "", sqrt(error[0] / error[2]));
    otx_figures_real(
        l->job->figures, "lapped.misfit_up", "", sqrt(error[1] / error[2]));
}

otx_status
otx_lapped_compose(const otx_lapped *l, otx_mapping *out)
{
    composition c = {.l = l};
    int32_t *number = OTX_NEW(l->run->scratch, int32_t, l->paste_count + 1);

    if (!number)
        return otx_fail_memory(l->run, "map");
    *out = (otx_mapping){
        .surface = l->surface,
        .scale = l->job->request->scale,
        .uvs =
            OTX_NEW(l->run->arena, float, 2 * (int64_t)l->leaf->corner_count),
        .face_patch = OTX_NEW(l->run->arena, int32_t, l->leaf->face_count),
    };
    OTX_TRY(otx_run_ok(l->run));
    OTX_TRY(list_pastes(&c));
    OTX_TRY(count_fragments(&c));
    OTX_TRY(otx_loop_result(
        l->run, "map",
        otx_pool_for(l->run->pool, l->leaf->face_count, look_at_face, &c)));
    put_patches(&c, number, out);
    put_figures(&c);
    return put_lookups(&c, number, out);
}

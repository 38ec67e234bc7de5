/* whole.c -- pastes of whole features. */
#include "method/lapped/whole.h"

#include "base/random.h"

#include <string.h>

enum
{
    STAGE_FEATURE = 0x6c617101, /* of random numbers */
    STAGE_PLACE,
    STAGE_ANGLE
};

enum
{
    TRIES = 40, /* places that are compared, at most */
    TURNS = 12, /* to a full turn, where the exemplar has no direction */
    DRAWS = 16, /* of a feature that is whole */
    MANY = 100  /* features of a picture, which then looks stochastic */
};

static const double TAU = 6.283185307179586;
/* Features whose axes lie as much alike lie in one direction. */
static const double ALIGNED = 0.7;
static const double CELL = 4.0; /* side, texels */
/* Of a feature that is kept, what lies in the chart at the least. */
static const double INSIDE = 0.95;
/* Radii of a clump, in those of a mean feature. */
static const double CLUMP = 2.6;
/* Texels of joint that a feature takes along, at most, and of its feather. */
static const double JOINT = 3.0, FEATHER = 1.5;
/* How much a feature that was used more often than others counts less. */
static const double USED = 0.5;

/* ---- outlines ---- */

/* How far the feature goes in a direction, and half of the joint behind it. */
static double
radius_along(const otx_features *f, int32_t index, otx_vec2 ray)
{
    const otx_feature *feature = &f->list[index];
    double last = 0.0, end;

    for (double r = 0.5; r <= feature->radius + 1.0; r += 0.5)
        if (otx_features_at(
                f, otx_vec2_add(feature->middle, otx_vec2_scale(r, ray))) ==
            index + 1)
            last = r;
    for (end = last; end < last + 2.0 * JOINT; end += 0.5)
        if (otx_features_at(
                f, otx_vec2_add(
                       feature->middle, otx_vec2_scale(end + 0.5, ray))) > 0 &&
            end > last)
            break;
    return f->by_alpha ? last + FEATHER : last + 0.5 * (end - last);
}

static otx_status
make_outlines(otx_lapped *l)
{
    const otx_features *f = &l->features;
    const double scale = (double)l->exemplar->match.width / f->width;
    otx_radial *list = OTX_ZNEW(l->run->arena, otx_radial, f->count);

    if (!list)
        return otx_fail_memory(l->run, "map");
    for (int32_t i = 0; i < f->count; ++i)
    {
        list[i].feather = (float)FEATHER;
        for (int32_t a = 0; a < OTX_RADIAL_ANGLES; ++a)
            list[i].radius[a] = (float)fmax(
                1.0,
                scale * radius_along(
                            f, i, otx_vec2_polar(TAU * a / OTX_RADIAL_ANGLES)));
        otx_radial_bound(&list[i]);
    }
    l->feature_cuts = list;
    return OSDTEX_OK;
}

/* ---- the mode ---- */

static otx_lapped_mode
fitting_mode(const otx_features *f, otx_analysis_class kind, const char **why)
{
    if (!otx_features_are_clear(f))
    {
        *why = "it shows nothing that is parted from its surroundings";
        return OTX_LAPPED_SPLOTCH;
    }
    if (kind == OTX_ANALYSIS_LATTICE && !f->by_alpha)
    {
        *why = "its features lie on a lattice, which other methods keep";
        return OTX_LAPPED_SPLOTCH;
    }
    if (!f->by_alpha && f->count > MANY)
    {
        *why = "its features are so small that nobody misses a part of one";
        return OTX_LAPPED_SPLOTCH;
    }
    if (f->by_alpha && f->aligned < ALIGNED)
    {
        *why = "its alpha cuts out things that lie in all directions";
        return OTX_LAPPED_CLUMPS;
    }
    if (f->by_alpha)
    {
        *why = "its alpha cuts out things that lie in one direction";
        return OTX_LAPPED_ORDERED;
    }
    *why = "joints part what it shows";
    return OTX_LAPPED_PACKING;
}

otx_status
otx_lapped_find_features(otx_lapped *l, otx_analysis_class kind)
{
    static const char *const names[] = {
        "auto", "splotch", "clumps", "packing", "ordered", "paper"};
    otx_lapped_settings *s = &l->settings;
    const char *why = "it was asked for";

    if (s->mode == OTX_LAPPED_SPLOTCH || s->mode == OTX_LAPPED_PAPER)
        return OSDTEX_OK;
    OTX_TRY(otx_features_find(l->run, l->exemplar, &l->features));
    if (s->mode == OTX_LAPPED_AUTO)
        s->mode = fitting_mode(&l->features, kind, &why);
    else if (!otx_features_some_are_whole(&l->features))
    {
        s->mode = OTX_LAPPED_SPLOTCH;
        why = "it shows nothing that is parted from its surroundings";
    }
    otx_note(
        l->run, OSDTEX_SEVERITY_INFO, "map",
        otx_where_file(l->exemplar->source_path),
        "pieces are laid as mode=%s says, since %s (%d features)",
        names[s->mode], why, (int)l->features.count);
    return otx_lapped_is_whole(l) ? make_outlines(l) : OSDTEX_OK;
}

/* ---- the plane ---- */

/* Texels of the labels to one of the exemplar's. */
static double
label_scale(const otx_lapped *l)
{
    return (double)l->features.width / l->exemplar->match.width;
}

static double
mean_radius(const otx_lapped *l)
{
    double area = 0.0, count = 0.0;

    for (int32_t i = 0; i < l->features.count; ++i)
        if (l->features.list[i].whole)
        {
            area += l->features.list[i].area;
            count += 1.0;
        }
    return sqrt(area / (fmax(count, 1.0) * 0.5 * TAU)) / label_scale(l);
}

static double
largest_radius(const otx_lapped *l)
{
    double most = 0.0;

    for (int32_t i = 0; i < l->features.count; ++i)
        if (l->features.list[i].whole)
            most = fmax(most, (double)l->feature_cuts[i].most);
    return most;
}

/* Middles of features lie within this of the seed. */
static double
clump_radius(const otx_lapped *l)
{
    const double mean = mean_radius(l);

    return l->features.by_alpha && l->settings.mode == OTX_LAPPED_CLUMPS
               ? mean
               : CLUMP * mean;
}

double
otx_lapped_whole_spacing(const otx_lapped *l)
{
    return 0.7 * mean_radius(l);
}

double
otx_lapped_whole_reach(const otx_lapped *l)
{
    return clump_radius(l) + largest_radius(l);
}

/* What the samples of a chart say about cells of its plane. */
typedef struct plane
{
    int32_t side;
    float *count; /* samples; 0 beyond the chart */
    float *open;  /* of them that no feature covers */
} plane;

static otx_status
make_plane(
    const otx_lapped *l, otx_arena *arena, const otx_lapped_chart *c,
    double reach, plane *p)
{
    p->side = 2 * ((int32_t)ceil(reach / CELL) + 1);
    p->count = OTX_ZNEW(arena, float, p->side * p->side);
    p->open = OTX_ZNEW(arena, float, p->side * p->side);
    if (!p->count || !p->open)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < c->face_count; ++i)
        for (int32_t t = 0; t < otx_facet_count(l->leaf, c->faces[i]); ++t)
        {
            const otx_lapped_facet facet = otx_lapped_facet_at(l, c, i, t);

            for (int32_t s = 0; s < facet.count; ++s)
            {
                const otx_vec2 at = otx_lapped_place(&facet, s);
                const double x = floor(at.x / CELL) + p->side / 2;
                const double y = floor(at.y / CELL) + p->side / 2;
                int32_t cell;

                if (!(x >= 0 && y >= 0 && x < p->side && y < p->side))
                    continue;
                cell = (int32_t)y * p->side + (int32_t)x;
                p->count[cell] += 1.0f;
                p->open[cell] +=
                    l->samples.covered[facet.first + s] ? 0.0f : 1.0f;
            }
        }
    return OSDTEX_OK;
}

/* ---- a place in the exemplar ---- */

/* What lies under the chart of each feature, cells. */
typedef struct tally
{
    double area, open;
    otx_vec2 sum; /* of places in the plane */
} tally;

typedef struct candidate
{
    otx_vec2 centre; /* texels of the exemplar */
    otx_vec2 turn;   /* from the chart's plane to the exemplar's */
    int32_t seed;    /* the feature under the seed */
    double score;
} candidate;

typedef struct search
{
    const otx_lapped *l;
    const otx_lapped_try *attempt;
    plane plane;
    tally *tallies; /* [features.count] */
    int32_t *found; /* [features.count] those with a tally */
    int32_t found_count;
    double mean_use;
} search;

/* A feature that is whole, rather one that was used little. */
static int32_t
draw_feature(const search *s, uint64_t seed)
{
    const otx_features *f = &s->l->features;
    int32_t best = -1;

    for (uint64_t i = 0; i < DRAWS; ++i)
    {
        const int32_t index =
            (int32_t)(otx_random_unit(seed, STAGE_FEATURE, i) * f->count);

        if (!f->list[index].whole)
            continue;
        if (best < 0 || s->attempt->uses[index] < s->attempt->uses[best])
            best = index;
        if (best >= 0 && i >= 2)
            break;
    }
    return best;
}

/* Some place inside of a feature lies on the seed. */
static bool
draw(const search *s, uint64_t number, candidate *c)
{
    const otx_lapped *l = s->l;
    const uint64_t seed =
        otx_random_bits(l->run->seed ^ s->attempt->number, STAGE_PLACE, number);
    const bool turns = !l->guide.directions;
    const otx_feature *f;

    c->seed = draw_feature(s, seed);
    if (c->seed < 0)
        return false;
    f = &l->features.list[c->seed];
    c->turn = turns ? otx_vec2_polar(
                          TAU / TURNS *
                          floor(otx_random_unit(seed, STAGE_ANGLE, 0) * TURNS))
                    : (otx_vec2){1, 0};
    for (uint64_t i = 0; i < DRAWS; ++i)
    {
        const double r = sqrt(otx_random_unit(seed, STAGE_PLACE, 2 * i));
        const otx_vec2 at = otx_vec2_add(
            f->middle,
            otx_vec2_scale(
                0.8 * f->radius * r,
                otx_vec2_polar(
                    TAU * otx_random_unit(seed, STAGE_PLACE, 2 * i + 1))));

        if (otx_features_at(&l->features, at) != c->seed + 1)
            continue;
        c->centre = otx_vec2_scale(1.0 / label_scale(l), at);
        return true;
    }
    c->centre = otx_vec2_scale(1.0 / label_scale(l), f->middle);
    return true;
}

/* Counts what is in the square of `reach` cells around the seed. */
static void
count_cells(search *s, const candidate *c, int32_t reach)
{
    const otx_lapped *l = s->l;
    const plane *p = &s->plane;
    const double scale = label_scale(l);
    const int32_t middle = p->side / 2;
    const int32_t from = reach < middle ? middle - reach : 0;
    const otx_vec2 step = otx_vec2_scale(scale * CELL, c->turn);

    for (int32_t i = 0; i < s->found_count; ++i)
        s->tallies[s->found[i]] = (tally){0};
    s->found_count = 0;
    for (int32_t y = from; y < p->side - from; ++y)
        for (int32_t x = from; x < p->side - from; ++x)
        {
            const int32_t cell = y * p->side + x;
            const otx_vec2 at = {
                (x - middle + 0.5) * CELL, (y - middle + 0.5) * CELL};
            int32_t label;
            tally *t;

            if (!(p->count[cell] > 0.0f))
                continue;
            label = otx_features_at(
                &l->features,
                otx_vec2_add(
                    otx_vec2_scale(scale, c->centre),
                    otx_vec2_mul(
                        step, (otx_vec2){x - middle + 0.5, y - middle + 0.5})));
            if (label == 0)
                continue;
            t = &s->tallies[label - 1];
            if (t->area == 0.0)
                s->found[s->found_count++] = label - 1;
            t->area += 1.0;
            t->open += (double)(p->open[cell] / p->count[cell]);
            t->sum = otx_vec2_add(t->sum, at);
        }
}

/* How much of a feature may lie on others. Cut-outs have to cover all. */
static double
overlap_most(const otx_lapped *l)
{
    if (l->settings.mode == OTX_LAPPED_PACKING)
        return 0.03;
    return l->settings.mode == OTX_LAPPED_ORDERED && !l->features.by_alpha
               ? 0.6
               : 1.0;
}

static bool
is_kept(const search *s, int32_t index)
{
    const otx_lapped *l = s->l;
    const otx_feature *f = &l->features.list[index];
    const tally *t = &s->tallies[index];
    const double scale = label_scale(l);
    const double cells = f->area / (scale * scale * CELL * CELL);

    return f->whole && t->area >= INSIDE * cells - 2.0 &&
           t->area <= 1.5 * cells + 4.0 &&
           t->area - t->open <= overlap_most(l) * t->area + 0.5 &&
           otx_vec2_length(otx_vec2_scale(1.0 / t->area, t->sum)) <=
               clump_radius(l);
}

/* What is new, of features that were not used more often than others. */
static double
score_of(const search *s)
{
    double sum = 0.0;

    for (int32_t i = 0; i < s->found_count; ++i)
    {
        const int32_t index = s->found[i];
        const tally *t = &s->tallies[index];

        if (is_kept(s, index))
            sum +=
                t->open /
                (1.0 + USED * fmax(0.0, s->attempt->uses[index] - s->mean_use));
    }
    return sum;
}

static bool
find_best(search *s, candidate *best)
{
    const int32_t tries =
        s->l->settings.mode == OTX_LAPPED_PACKING ? TRIES : TRIES / 8;

    best->score = 0.0;
    for (int32_t i = 0; i < tries; ++i)
    {
        candidate c;

        if (!draw(s, (uint64_t)i, &c))
            continue;
        /* The seed's feature first, which decides most. */
        count_cells(
            s, &c,
            (int32_t)(2.0 * s->l->features.list[c.seed].radius / (label_scale(s->l) * CELL)) +
                1);
        if (!is_kept(s, c.seed))
            continue;
        count_cells(s, &c, s->plane.side);
        c.score = score_of(s);
        if (c.score > best->score)
            *best = c;
    }
    return best->score > 0.0;
}

/* ---- what is kept ---- */

/* Where a feature's middle is in the chart, turned already: the image of it
 * nearest to where its cells are. */
static otx_vec2
middle_of(const search *s, const candidate *c, int32_t index)
{
    const otx_lapped *l = s->l;
    const otx_features *f = &l->features;
    const tally *t = &s->tallies[index];
    const otx_vec2 about =
        otx_vec2_mul(c->turn, otx_vec2_scale(1.0 / t->area, t->sum));
    otx_vec2 at = otx_vec2_sub(
        otx_vec2_scale(1.0 / label_scale(l), f->list[index].middle), c->centre);

    if (f->wrap_x)
        at.x += l->exemplar->match.width *
                floor((about.x - at.x) / l->exemplar->match.width + 0.5);
    if (f->wrap_y)
        at.y += l->exemplar->match.height *
                floor((about.y - at.y) / l->exemplar->match.height + 0.5);
    return at;
}

/* What lies along the picture's u turns the other way. */
static void
turn_chart(const otx_lapped *l, otx_vec2 turn, otx_lapped_chart *c)
{
    for (int32_t v = 0; v < c->vert_count; ++v)
        c->flat[v] = otx_vec2_mul(turn, c->flat[v]);
    for (int32_t i = 0; i < c->face_count; ++i)
        c->rights[i] = otx_vec3_mix(
            turn.x, c->rights[i], -turn.y,
            otx_vec3_cross(l->connection.normals[c->faces[i]], c->rights[i]));
}

static otx_status
keep(
    const search *s, const candidate *c, otx_arena *arena,
    otx_lapped_paste *paste)
{
    const otx_lapped *l = s->l;

    paste->centre = c->centre;
    paste->pieces = OTX_NEW(arena, otx_lapped_piece, s->found_count);
    if (!paste->pieces)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t i = 0; i < s->found_count; ++i)
    {
        const int32_t index = s->found[i];
        const otx_vec2 middle = middle_of(s, c, index);

        if (is_kept(s, index))
            paste->pieces[paste->piece_count++] = (otx_lapped_piece){
                middle, &l->feature_cuts[index],
                l->settings.mode == OTX_LAPPED_ORDERED
                    ? s->attempt->height + middle.y / s->attempt->size
                    : 0.0};
    }
    turn_chart(l, c->turn, &paste->chart);
    return OSDTEX_OK;
}

otx_status
otx_lapped_choose_features(
    const otx_lapped *l, otx_arena *arena, const otx_lapped_try *attempt,
    otx_lapped_paste *paste)
{
    search s = {
        .l = l,
        .attempt = attempt,
        .tallies = OTX_ZNEW(arena, tally, l->features.count),
        .found = OTX_NEW(arena, int32_t, l->features.count)};
    candidate best;

    paste->piece_count = 0;
    paste->size = attempt->size;
    if (!s.tallies || !s.found)
        return OSDTEX_ERROR_MEMORY;
    for (int32_t v = 0; v < paste->chart.vert_count; ++v)
        paste->chart.flat[v] =
            otx_vec2_scale(1.0 / attempt->size, paste->chart.flat[v]);
    for (int32_t i = 0; i < l->features.count; ++i)
        s.mean_use += (double)attempt->uses[i] / l->features.count;
    OTX_TRY(make_plane(
        l, arena, &paste->chart, otx_lapped_whole_reach(l), &s.plane));
    if (!find_best(&s, &best))
        return OSDTEX_OK;
    count_cells(&s, &best, s.plane.side);
    return keep(&s, &best, arena, paste);
}

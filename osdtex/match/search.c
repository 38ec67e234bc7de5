/* search.c -- coarse and exhaustive, then fine and few.
 *
 * 1. Every translation of every angle at a coarse level (exhaust.c); the best
 *    local minima are kept.
 * 2. Each goes down to full resolution on a few hundred samples. Most are
 *    hopeless by then.
 * 3. The finalists get all samples, Gauss-Newton if asked, and the exact
 *    score, by which they are sorted.
 *
 * Each step is a loop over independent items, run by the pool or in place. */
#include "match/exhaust.h"
#include "match/polish.h"

#include <stdatomic.h>
#include <string.h>

enum
{
    FEWEST_PIXELS = 64, /* of a mask at the level of the search */
    FEW_SAMPLES = 300,
    FEWEST_FINALISTS = 4,
    SPARE_WINNERS = 1, /* scored besides what was asked for */
    MAX_PERIODS = 4    /* exemplars to the longest diagonal of a mask */
};

typedef struct candidate
{
    otx_match match;         /* error: mean square */
    otx_matcher_range range; /* of shifts at its angle */
    int32_t angle;           /* index */
    double rank;             /* error times usage */
} candidate;

typedef struct search
{
    const otx_matcher *matcher;
    const otx_mask *mask;
    const otx_match_query *query;
    otx_worker *worker; /* of the loop that this is in; NULL: all of `pool` */
    otx_pool *pool;     /* NULL: in this thread */
    otx_arena *scratch;
    int32_t level;

    _Atomic int32_t next_angle;
    otx_peaks *lane_peaks; /* [lanes] */
    otx_polish_picks picks;
    candidate *candidates;
    int32_t candidate_count;
} search;

static otx_status
for_each(search *s, int64_t count, otx_pool_body body)
{
    return s->worker ? otx_pool_share(s->worker, count, body, s)
                     : otx_pool_for(s->pool, count, body, s);
}

/* --------------------------------------------------------------- coarse */

/* One lane of the pool: takes angles until none is left, so that its buffers
 * are made once, and its best so far keep the next angle's list short. Peaks
 * are totally ordered: the best of all lanes do not depend on who had which
 * angle. */
static otx_status
search_lane(void *context, int64_t lane, otx_worker *worker)
{
    search *s = context;
    otx_exhaust_buffers buffers;
    int32_t angle = atomic_fetch_add(&s->next_angle, 1);

    if (angle >= s->query->angle_count)
        return OSDTEX_OK;
    OTX_TRY(otx_exhaust_buffers_create(
        worker->scratch, &s->matcher->planes[s->level], s->query, &buffers));
    for (; angle < s->query->angle_count;
         angle = atomic_fetch_add(&s->next_angle, 1))
        otx_exhaust_angle(
            s->matcher, s->level, s->mask, s->query, angle, &buffers,
            &s->lane_peaks[lane]);
    return OSDTEX_OK;
}

/* The level asked for, or a finer one if the mask would be a few pixels. */
static int32_t
choose_level(const search *s)
{
    const otx_matcher *m = s->matcher;
    const double area = otx_mask_area(s->mask);
    int32_t level = s->query->coarse_levels;

    if (level >= m->level_count)
        level = m->level_count - 1;
    while (level > m->finest_level && area < FEWEST_PIXELS *
                                                 m->planes[level].pixel.x *
                                                 m->planes[level].pixel.y)
        --level;
    return level < m->finest_level ? m->finest_level : level;
}

static otx_status
search_coarsely(search *s)
{
    const int32_t angle_count = s->query->angle_count;
    const int32_t keep = s->query->coarse_keep;
    otx_peaks all = {.capacity = keep};
    int64_t lanes = s->pool ? otx_pool_threads(s->pool) : 1;

    if (lanes > angle_count)
        lanes = angle_count;
    s->lane_peaks = OTX_NEW(s->scratch, otx_peaks, lanes);
    s->candidates = OTX_NEW(s->scratch, candidate, keep);
    if (!s->lane_peaks || !s->candidates)
        return OSDTEX_ERROR_MEMORY;
    for (int64_t l = 0; l < lanes; ++l)
    {
        s->lane_peaks[l].count = 0;
        s->lane_peaks[l].capacity = keep;
    }
    OTX_TRY(for_each(s, lanes, search_lane));
    for (int64_t l = 0; l < lanes; ++l)
        for (int32_t i = 0; i < s->lane_peaks[l].count; ++i)
            otx_peaks_insert(&all, &s->lane_peaks[l].list[i]);
    for (int32_t i = 0; i < all.count; ++i)
    {
        candidate *c = &s->candidates[i];

        c->angle = all.list[i].angle;
        c->range = otx_matcher_shifts(
            s->matcher, s->mask, s->query, s->query->angles[c->angle]);
        c->match = otx_exhaust_placement(
            s->matcher, s->level, s->mask, s->query, &all.list[i], &c->range);
        c->rank = all.list[i].value;
    }
    s->candidate_count = all.count;
    return OSDTEX_OK;
}

/* ----------------------------------------------------------------- fine */

static otx_vec2
landing(const search *s, const otx_match *match)
{
    return otx_vec2_add(
        otx_vec2_mul(otx_vec2_polar(match->angle), s->query->centre),
        match->shift);
}

static void
rank_candidate(const search *s, candidate *c)
{
    c->rank = c->match.error * otx_wear_factor(s->matcher, s->query, &c->match);
}

/* Onto whole texels, where levels of odd sizes do not lead by themselves. */
static void
round_shift(candidate *c)
{
    const otx_vec2 whole = {
        floor(c->match.shift.x + 0.5), floor(c->match.shift.y + 0.5)};

    if (otx_matcher_allows(&c->range, whole))
        c->match.shift = whole;
}

static otx_status
descend(void *context, int64_t index, otx_worker *worker)
{
    search *s = context;
    candidate *c = &s->candidates[index];

    for (int32_t level = s->level - 1; level >= 0; --level)
    {
        if (level == 0)
            round_shift(c);
        OTX_TRY(otx_polish_window(
            worker->scratch, s->matcher, &s->picks, FEW_SAMPLES, &c->range,
            level, 2, &c->match));
    }
    rank_candidate(s, c);
    return OSDTEX_OK;
}

static otx_status
sharpen(search *s, candidate *c, otx_arena *scratch)
{
    otx_match trial = c->match;
    otx_matcher_range range;

    OTX_TRY(otx_polish_gauss_newton(scratch, s->matcher, &s->picks, &trial));
    range = otx_matcher_shifts(s->matcher, s->mask, s->query, trial.angle);
    if (!otx_matcher_allows(&range, trial.shift))
        return OSDTEX_OK;
    trial.error = otx_matcher_square(s->matcher, s->mask, &trial);
    if (trial.error < c->match.error)
        c->match = trial;
    return OSDTEX_OK;
}

/* All samples: which of the finalists are worth an exact score. */
static otx_status
measure(void *context, int64_t index, otx_worker *worker)
{
    search *s = context;
    candidate *c = &s->candidates[index];

    OTX_TRY(otx_polish_window(
        worker->scratch, s->matcher, &s->picks, s->picks.count, &c->range, 0, 1,
        &c->match));
    rank_candidate(s, c);
    return OSDTEX_OK;
}

static otx_status
finish(void *context, int64_t index, otx_worker *worker)
{
    search *s = context;
    candidate *c = &s->candidates[index];

    c->match.error = otx_matcher_square(s->matcher, s->mask, &c->match);
    if (s->query->gauss_newton)
        OTX_TRY(sharpen(s, c, worker->scratch));
    rank_candidate(s, c);
    return OSDTEX_OK;
}

/* Stable: equal ranks stay in the order of angle, row and column. */
static void
sort_candidates(search *s)
{
    for (int32_t i = 1; i < s->candidate_count; ++i)
    {
        const candidate c = s->candidates[i];
        int32_t at = i;

        for (; at > 0 && c.rank < s->candidates[at - 1].rank; --at)
            s->candidates[at] = s->candidates[at - 1];
        s->candidates[at] = c;
    }
}

/* The best `count` and no others. */
static void
keep_best(search *s, int32_t count)
{
    sort_candidates(s);
    if (s->candidate_count > count)
        s->candidate_count = count;
}

static otx_status
refine(search *s, int32_t capacity)
{
    const int32_t spare = capacity + SPARE_WINNERS;
    const int32_t finalists = 2 * capacity;

    if (s->level > 0 || s->query->gauss_newton)
        OTX_TRY(otx_polish_pick_samples(
            s->scratch, s->mask, s->query->sample_limit, &s->picks));
    if (s->level > 0)
    {
        OTX_TRY(for_each(s, s->candidate_count, descend));
        keep_best(
            s, finalists < FEWEST_FINALISTS ? FEWEST_FINALISTS : finalists);
        OTX_TRY(for_each(s, s->candidate_count, measure));
    }
    keep_best(s, spare);
    OTX_TRY(for_each(s, s->candidate_count, finish));
    sort_candidates(s);
    return OSDTEX_OK;
}

/* --------------------------------------------------------------- result */

static bool
is_near(double a, double b, int32_t size, bool wrap)
{
    double d = fabs(a - b);

    if (wrap)
    {
        d = fmod(d, size);
        d = fmin(d, size - d);
    }
    return d < 2.0;
}

/* Two minima of the coarse map may lead to one placement. */
static bool
is_repeat(const search *s, const candidate *kept, const candidate *c)
{
    const otx_matcher *m = s->matcher;

    return kept->angle == c->angle &&
           is_near(
               kept->match.shift.x, c->match.shift.x, m->width, m->wrap_x) &&
           is_near(kept->match.shift.y, c->match.shift.y, m->height, m->wrap_y);
}

/* The match as the caller gets it: RMS over sigma, landing in the exemplar. */
static otx_match
present(const search *s, const otx_match *match)
{
    const otx_matcher *m = s->matcher;
    const otx_vec2 at = landing(s, match);
    otx_match out = *match;

    if (m->wrap_x)
        out.shift.x -= otx_view_period(at.x, m->width);
    if (m->wrap_y)
        out.shift.y -= otx_view_period(at.y, m->height);
    out.error = sqrt(match->error);
    if (m->sigma > 0.0)
        out.error /= m->sigma;
    return out;
}

static void
collect(search *s, otx_match *best, int32_t capacity, int32_t *count)
{
    int32_t kept = 0;

    for (int32_t i = 0; i < s->candidate_count && kept < capacity; ++i)
    {
        bool repeat = !isfinite(s->candidates[i].rank);

        for (int32_t k = 0; k < kept && !repeat; ++k)
            repeat = is_repeat(s, &s->candidates[k], &s->candidates[i]);
        if (repeat)
            continue;
        best[kept] = present(s, &s->candidates[i].match);
        s->candidates[kept++] = s->candidates[i];
    }
    *count = kept;
}

/* ---------------------------------------------------------------- entry */

double
otx_matcher_reach(const otx_matcher *matcher)
{
    return MAX_PERIODS * hypot(matcher->width, matcher->height);
}

static const char *
query_complaint(const otx_match_query *query)
{
    if (query->angle_count < 1)
        return "A search needs at least one angle.";
    for (int32_t a = 0; a < query->angle_count; ++a)
        if (!isfinite(query->angles[a]))
            return "The angles of a search must be finite numbers.";
    if (query->coarse_levels < 0 || query->coarse_keep < 1 ||
        query->coarse_keep > OTX_MATCH_MAX_KEEP || query->sample_limit < 1)
        return "A search keeps 1 to 64 candidates and refines them on at "
               "least one sample.";
    for (int32_t i = 0; i < query->cover_count; ++i)
        if (!isfinite(query->cover[i].x) || !isfinite(query->cover[i].y))
            return "The points to cover must be finite numbers.";
    if (!isfinite(query->centre.x) || !isfinite(query->centre.y))
        return "The centre of a search must be finite numbers.";
    if (query->usage && (query->usage_width < 1 || query->usage_height < 1 ||
                         !(query->usage_weight >= 0.0)))
        return "The usage grid needs cells and a weight of 0 or more.";
    return NULL;
}

/* What is wrong with the arguments, or NULL. */
static const char *
find_complaint(
    const otx_matcher *m, const otx_mask *mask, const otx_match_query *query,
    int32_t capacity)
{
    const otx_mask_frame frame = {.rotation = {1.0, 0.0}, .pixel = {1.0, 1.0}};
    otx_mask_box box;

    if (mask->triangle_count < 1)
        return "The mask is empty: a patch without textured neighbours is "
               "placed, not searched for.";
    if (!otx_mask_is_valid(mask))
        return "The mask holds a coordinate or a weight that is not a finite, "
               "sane number.";
    if (capacity < 1)
        return "A search needs room for one match.";
    box = otx_mask_bounds(mask, &frame);
    if (hypot(box.high.x - box.low.x, box.high.y - box.low.y) >
        otx_matcher_reach(m))
        return "The mask is more than four times as large as the exemplar; "
               "use a smaller patch or a larger exemplar.";
    return query_complaint(query);
}

static otx_status
search_all(search *s, otx_match *best, int32_t capacity, int32_t *count)
{
    const otx_arena_mark mark = otx_arena_here(s->scratch);
    otx_status status;

    s->level = choose_level(s);
    status = search_coarsely(s);
    if (status == OSDTEX_OK)
        status = refine(s, capacity);
    if (status == OSDTEX_OK)
        collect(s, best, capacity, count);
    otx_arena_release(s->scratch, mark);
    return status;
}

otx_status
otx_matcher_search_within(
    otx_worker *worker, const otx_matcher *matcher, const otx_mask *mask,
    const otx_match_query *query, otx_match *best, int32_t capacity,
    int32_t *count)
{
    search s = {
        .matcher = matcher,
        .mask = mask,
        .query = query,
        .worker = worker,
        .pool = worker->pool,
        .scratch = worker->scratch};

    *count = 0;
    if (find_complaint(matcher, mask, query, capacity))
        return OSDTEX_ERROR_ARGUMENT;
    return search_all(&s, best, capacity, count);
}

otx_status
otx_matcher_search(
    otx_run *run, const otx_matcher *matcher, const otx_mask *mask,
    const otx_match_query *query, otx_match *best, int32_t capacity,
    int32_t *count)
{
    const char *complaint = find_complaint(matcher, mask, query, capacity);
    search s = {
        .matcher = matcher,
        .mask = mask,
        .query = query,
        .pool = run->pool,
        .scratch = run->scratch};
    otx_status status;

    *count = 0;
    if (complaint)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, "match", OTX_NOWHERE, "%s", complaint);
    status = search_all(&s, best, capacity, count);
    return status == OSDTEX_ERROR_MEMORY ? otx_fail_memory(run, "match")
                                         : status;
}

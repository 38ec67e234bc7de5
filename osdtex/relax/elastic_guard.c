/* elastic_guard.c -- steps that are allowed.
 *
 * A step that would flip a face or stretch it past the limit is taken back
 * there, never merely penalised. */
#include "relax/elastic_state.h"

#include "flatten/stretch.h"

#include <string.h>

enum
{
    TAKE_BACK_ROUNDS = 64
};

/* The larger of stretch and its inverse over the fan of a face; INFINITY when
 * a triangle of it is flipped. */
static double
face_badness(const otx_elastic *e, int32_t face)
{
    const otx_sheet *s = &e->sheet;
    const int32_t first = s->first[face];
    double worst = 1.0;

    for (int32_t c = first + 1; c + 1 < s->first[face + 1]; ++c)
    {
        const int32_t v[3] = {
            s->corners[first], s->corners[c], s->corners[c + 1]};
        const int32_t leaf[3] = {
            s->verts[v[0]], s->verts[v[1]], s->verts[v[2]]};
        const double texels =
            e->options->texels * otx_surface_density(e->surface, leaf, 3);
        otx_vec3 p[3];
        otx_vec2 uv[3];
        double sigma[2];

        for (int i = 0; i < 3; ++i)
        {
            p[i] = otx_vec3_scale(
                texels, otx_vec3_load(e->surface->points, leaf[i]));
            uv[i] = s->at[v[i]];
        }
        otx_stretch_singular(p, uv, sigma);
        worst = sigma[1] > 0.0 ? fmax(worst, fmax(sigma[0], 1.0 / sigma[1]))
                               : INFINITY;
    }
    return worst;
}

/* Whether a variable of the face was taken back in the last round. */
static bool
was_touched(const otx_elastic *e, int32_t face, int32_t round)
{
    const otx_sheet *s = &e->sheet;

    for (int32_t c = s->first[face]; c < s->first[face + 1]; ++c)
        if (e->guard.held[s->corners[c]] == round)
            return true;
    return false;
}

typedef struct judgement
{
    otx_elastic *e;
    int32_t round; /* 0: all faces, else those that the round touched */
    double *out;   /* [face_count] */
} judgement;

static otx_status
judge_faces(void *context, int64_t index, otx_worker *worker)
{
    const judgement *j = context;
    const int64_t first = index * OTX_ELASTIC_FACES;
    const int64_t end = first + OTX_ELASTIC_FACES;

    (void)worker;
    for (int64_t f = first; f < end && f < j->e->sheet.face_count; ++f)
        if (j->round == 0 || was_touched(j->e, (int32_t)f, j->round))
            j->out[f] = face_badness(j->e, (int32_t)f);
    return OSDTEX_OK;
}

static otx_status
judge(otx_elastic *e, int32_t round, double *out)
{
    judgement j = {e, round, out};

    return otx_pool_for(
        e->run->pool,
        (e->sheet.face_count + OTX_ELASTIC_FACES - 1) / OTX_ELASTIC_FACES,
        judge_faces, &j);
}

/* Takes back the variables of the faces that the step made worse than the
 * limit; how many. */
static int64_t
take_back_once(otx_elastic *e, int32_t round)
{
    otx_sheet *s = &e->sheet;
    int64_t refused = 0;

    for (int32_t f = 0; f < s->face_count; ++f)
    {
        if (e->guard.badness[f] <= e->options->stretch ||
            e->guard.badness[f] <= e->guard.before[f])
            continue;
        for (int32_t c = s->first[f]; c < s->first[f + 1]; ++c)
        {
            const int32_t v = s->corners[c];

            if (e->guard.held[v])
                continue;
            e->guard.held[v] = (uint8_t)round;
            s->at[v] = e->guard.from[v];
            ++refused;
        }
    }
    return refused;
}

/* Taking back may spoil a neighbour, so it is repeated; after the last round
 * everything is taken back, and the state is the one before. */
static otx_status
take_back(otx_elastic *e, int64_t *refused)
{
    otx_sheet *s = &e->sheet;

    for (int32_t round = 1; round <= TAKE_BACK_ROUNDS; ++round)
    {
        int64_t now;

        OTX_TRY(judge(e, round - 1, e->guard.badness));
        now = take_back_once(e, round);
        *refused += now;
        if (now == 0)
            return OSDTEX_OK;
    }
    memcpy(s->at, e->guard.from, (size_t)s->count * sizeof *s->at);
    return OSDTEX_OK;
}

otx_status
otx_elastic_judge(otx_elastic *e)
{
    return judge(e, 0, e->guard.badness);
}

static double
inside(double x, bool wrap, double size)
{
    return wrap ? x : fmin(fmax(x, 0.5), size - 0.5);
}

otx_status
otx_elastic_move(otx_elastic *e, double share, double longest, int64_t *refused)
{
    otx_sheet *s = &e->sheet;

    memset(e->guard.held, 0, (size_t)s->count);
    for (int32_t v = 0; v < s->count; ++v)
    {
        const otx_exemplar *from =
            &e->pictures.exemplars[e->pictures.source[v]];
        const double length = otx_vec2_length(e->system.step[v]);
        const double scale =
            length > longest ? share * longest / length : share;
        const otx_vec2 p = otx_vec2_add(
            e->guard.from[v], otx_vec2_scale(scale, e->system.step[v]));

        s->at[v] = e->guard.from[v];
        if (s->fixed[v])
            continue;
        s->at[v].x = inside(p.x, from->wrap_x, from->match.width);
        s->at[v].y = inside(p.y, from->wrap_y, from->match.height);
    }
    return take_back(e, refused);
}

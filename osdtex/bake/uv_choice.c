/* uv_choice.c -- onto which texture coordinates a bake goes, and why. */
#include "bake/uv_choice.h"

#include <stdio.h>

static const char STAGE[] = "bake";

/* Share of the texture that faces may claim together, and share of the faces
 * that may have no area, before UVs count as not made for one texture each.
 * Charts that touch or overlap by a sliver are common: those of the cages that
 * this was set on stay below half of it, and UVs that are shared on purpose
 * come to a half and more. */
static const double SHARE_MAX = 0.02;

/* Share of claimed texels from which a word is said. */
static const double SHARE_TOLD = 0.001;

/* Faces on a texel, in the mean, from which UVs were never laid out apart. Two
 * are halves that mirror each other, four a quarter of an ornament. */
static const double DEPTH_MAX = 4.5;

enum
{
    REASON_BYTES = 256
};

static otx_where
where_is(const otx_cage *cage, int32_t face)
{
    otx_where where = OTX_NOWHERE;

    where.file = cage->path;
    where.face = face;
    where.line = cage->face_line && face >= 0 ? cage->face_line[face] : 0;
    return where;
}

/* The first reason, if any, for which UVs cannot be baked onto at all.
 *
 *   reason  a sentence without its end, out
 *   where   of the face at fault, out */
static bool
is_hopeless(
    const otx_cage *cage, const otx_uv_survey *s, char reason[REASON_BYTES],
    otx_where *where)
{
    if (s->outside > 0)
    {
        *where = where_is(cage, s->outside_face);
        snprintf(
            reason, REASON_BYTES,
            "face %d has UVs near (%g, %g), outside of the UDIM tiles 1001 to "
            "9999, which are at u from 0 to 10 and v from 0",
            s->outside_face, (double)s->outside_uv[0],
            (double)s->outside_uv[1]);
        return true;
    }
    if (s->flat > 0 && s->flat == s->face_count)
    {
        *where = where_is(cage, s->flat_face);
        snprintf(
            reason, REASON_BYTES, "the cage's UVs lie in a point or on a line");
        return true;
    }
    if (s->depth <= DEPTH_MAX)
        return false;
    *where = where_is(cage, s->overlap_face);
    snprintf(
        reason, REASON_BYTES,
        "%.0f or more faces lie on top of each other everywhere in UV, as if "
        "they were never unwrapped (face %d is the first that lies on another)",
        s->depth, s->overlap_face);
    return true;
}

/* The same for reasons that leave a texture, though one that is wrong in
 * places. */
static bool
is_poor(
    const otx_cage *cage, const otx_uv_survey *s, char reason[REASON_BYTES],
    otx_where *where)
{
    if (s->overlap > SHARE_MAX)
    {
        *where = where_is(cage, s->overlap_face);
        snprintf(
            reason, REASON_BYTES,
            "faces lie on top of each other in %.0f %% of what the cage's UVs "
            "cover, and a texel has the colour of one of them (face %d is the "
            "first that lies on another)",
            100.0 * s->overlap, s->overlap_face);
        return true;
    }
    if (s->flat <= SHARE_MAX * s->face_count)
        return false;
    *where = where_is(cage, s->flat_face);
    snprintf(
        reason, REASON_BYTES,
        "face %d has no area in UV, and neither has %.0f %% of the surface's "
        "faces, which texels cannot show",
        s->flat_face, 100.0 * s->flat / s->face_count);
    return true;
}

/* Places after the point of a percentage. */
static int
places(double percent)
{
    return percent < 10.0 ? 2 : 0;
}

/* What is wrong with UVs that are baked onto. */
static void
warn(otx_run *run, const otx_cage *cage, const otx_uv_survey *s)
{
    const double flat = 100.0 * s->flat / s->face_count;
    const double overlap = 100.0 * s->overlap;

    if (s->flat > 0)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where_is(cage, s->flat_face),
            "face %d has no area in UV, and %.*f %% of the surface's faces "
            "have none: texels cannot show them; unwrap them, or bake to an "
            "atlas",
            s->flat_face, places(flat), flat);
    if (s->overlap > SHARE_TOLD)
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE,
            where_is(cage, s->overlap_face),
            "faces lie on top of each other in %.*f %% of what the cage's UVs "
            "cover (face %d is the first), and one of them is baked there; "
            "bake to an atlas if they are to differ",
            places(overlap), overlap, s->overlap_face);
}

/* Own UVs where they are asked for. */
static otx_status
insist(otx_run *run, const otx_cage *cage, const otx_uv_survey *s)
{
    char reason[REASON_BYTES];
    otx_where where;

    if (is_hopeless(cage, s, reason, &where))
        return otx_fail(
            run, OSDTEX_ERROR_TOPOLOGY, STAGE, where,
            "%s; mend the UVs, or bake to an atlas", reason);
    warn(run, cage, s);
    return OSDTEX_OK;
}

static otx_layout_source
choose(otx_run *run, const otx_cage *cage, const otx_uv_survey *s)
{
    char reason[REASON_BYTES];
    otx_where where;

    if (is_hopeless(cage, s, reason, &where) ||
        is_poor(cage, s, reason, &where))
    {
        otx_note(
            run, OSDTEX_SEVERITY_WARNING, STAGE, where,
            "%s; so an atlas is baked, and the cage's own UVs are left alone",
            reason);
        return OTX_LAYOUT_ATLAS;
    }
    warn(run, cage, s);
    return OTX_LAYOUT_OWN;
}

otx_status
otx_uv_choose(
    otx_run *run, const otx_surface *draft, otx_layout_source asked,
    otx_layout_source *out, otx_uv_survey *survey)
{
    const otx_cage *cage = draft->cage;

    *survey = (otx_uv_survey){
        .outside_face = -1, .flat_face = -1, .overlap_face = -1};
    *out = asked;
    if (asked == OTX_LAYOUT_OWN && cage->uv_count == 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the cage has no UVs to bake onto; give it some, or let an atlas "
            "be made");
    if (cage->uv_count == 0 && asked == OTX_LAYOUT_AUTO)
        *out = OTX_LAYOUT_ATLAS;
    if (*out == OTX_LAYOUT_ATLAS || *out == OTX_LAYOUT_CHARTS)
        return OSDTEX_OK;
    OTX_TRY(otx_uv_survey_run(run, draft, survey));
    if (asked == OTX_LAYOUT_OWN)
        return insist(run, cage, survey);
    *out = choose(run, cage, survey);
    return OSDTEX_OK;
}

/* inputs.c -- words of flags to values of the library. */
#include "cli/inputs.h"
#include "cli/session.h"
#include "cli/value.h"

static const char *const schemes[] = {"catmark", "loop", "bilinear", "none"};
static const char *const boundaries[] = {"none", "edgeOnly", "edgeAndCorner"};
static const char *const fvars[] = {
    "none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"};
static const char *const embeddings[] = {"hsv", "hsv-cylinder", "lab", "rgb"};
static const char *const wraps[] = {"auto", "no", "yes"};
static const char *const tileables[] = {"auto", "keep", "make"};

const char *
otx_inputs_scheme_name(osdtex_scheme scheme)
{
    return schemes[scheme];
}

const char *
otx_inputs_boundary_name(osdtex_boundary boundary)
{
    return boundaries[boundary];
}

const char *
otx_inputs_fvar_name(osdtex_fvar fvar)
{
    return fvars[fvar];
}

/* Sets *out from the word of a flag, when it is given. */
static bool
choose(
    const otx_flag_values *values, otx_flag_id id, const char *const *words,
    int count, int32_t *out)
{
    const char *text = values->text[id];
    int index;

    if (!text)
        return true;
    if (otx_value_word(text, words, count, &index))
    {
        *out = index;
        return true;
    }
    otx_session_refuse(
        "--%s takes %s, not '%s'", otx_flag_at(id)->name,
        otx_flag_at(id)->argument, text);
    return false;
}

bool
otx_inputs_cage(const otx_flag_values *values, osdtex_cage_options *out)
{
    *out = osdtex_cage_options_default();
    return choose(values, OTX_FLAG_SCHEME, schemes, 4, &out->scheme) &&
           choose(values, OTX_FLAG_BOUNDARY, boundaries, 3, &out->boundary) &&
           choose(values, OTX_FLAG_FVAR, fvars, 6, &out->fvar);
}

bool
otx_inputs_exemplar(const otx_flag_values *values, osdtex_exemplar_options *out)
{
    *out = osdtex_exemplar_options_default();
    out->from = values->text[OTX_FLAG_FROM];
    out->to = values->text[OTX_FLAG_TO];
    out->match_space = values->text[OTX_FLAG_MATCH_SPACE];
    return choose(values, OTX_FLAG_MATCH_IN, embeddings, 4, &out->embedding) &&
           choose(values, OTX_FLAG_WRAP, wraps, 3, &out->wrap) &&
           choose(values, OTX_FLAG_TILEABLE, tileables, 3, &out->tileable);
}

/* inputs.c -- words of flags to values of the library. */
#include "cli/inputs.h"
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
#include <string.h>

enum
{
    PEEK_BYTES = 512
};

static const char *const schemes[] = {"catmark", "loop", "bilinear", "none"};
static const char *const boundaries[] = {"none", "edgeOnly", "edgeAndCorner"};
static const char *const fvars[] = {
    "none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"};
static const char *const embeddings[] = {"hsv", "hsv-cylinder", "lab", "rgb"};
static const char *const wraps[] = {"auto", "no", "yes"};
/* The first is the default, which has no word. */
static const char *const receivers[] = {
    "", "blender", "maya", "houdini", "usd", "web"};
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
    if (text[0] && otx_value_word(text, words, count, &index))
    {
        *out = index;
        return true;
    }
    otx_session_refuse(
        "--%s takes %s, not '%s'", otx_flag_at(id)->name,
        otx_flag_at(id)->argument, text);
    return false;
}

/* "" is the flag without a number. */
static bool
take_weld(const otx_flag_values *values, double *out)
{
    const char *text = values->text[OTX_FLAG_WELD];

    if (!text)
        return true;
    *out = -1.0;
    if (!*text || (otx_value_real(text, out) && *out > 0.0))
        return true;
    otx_session_refuse(
        "--weld takes a distance above 0 in scene units, not '%s'", text);
    return false;
}

bool
otx_inputs_cage(const otx_flag_values *values, osdtex_cage_options *out)
{
    *out = osdtex_cage_options_default();
    return take_weld(values, &out->weld) &&
           choose(values, OTX_FLAG_SCHEME, schemes, 4, &out->scheme) &&
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
    out->layer = values->text[OTX_FLAG_LAYER];
    return choose(values, OTX_FLAG_MATCH_IN, embeddings, 4, &out->embedding) &&
           choose(values, OTX_FLAG_WRAP, wraps, 3, &out->wrap) &&
           choose(values, OTX_FLAG_TILEABLE, tileables, 3, &out->tileable) &&
           choose(values, OTX_FLAG_RECEIVER, receivers, 6, &out->receiver);
}

static size_t
peek(const char *path, unsigned char bytes[PEEK_BYTES])
{
    FILE *file = fopen(path, "rb");
    size_t count;

    if (!file)
        return 0;
    count = fread(bytes, 1, PEEK_BYTES, file);
    fclose(file);
    return count;
}

bool
otx_inputs_is_picture(const char *path)
{
    static const struct
    {
        const char *bytes;
        size_t count;
    } magics[] = {
        {"\x76\x2f\x31\x01", 4},
        {"\x89PNG", 4},
        {"II*\0", 4},
        {"MM\0*", 4},
        {"II+\0", 4},
        {"MM\0+", 4},
        {"\xff\xd8\xff", 3},
    };
    unsigned char head[PEEK_BYTES];
    const size_t count = peek(path, head);

    for (size_t i = 0; i < sizeof magics / sizeof magics[0]; ++i)
        if (count >= magics[i].count &&
            memcmp(head, magics[i].bytes, magics[i].count) == 0)
            return true;
    return false;
}

bool
otx_inputs_is_binary(const char *path)
{
    unsigned char head[PEEK_BYTES];

    return !otx_value_has_extension(path, ".obj") &&
           memchr(head, 0, peek(path, head)) != NULL;
}

bool
otx_inputs_holds(const char *path, const char *word)
{
    unsigned char head[PEEK_BYTES];
    const size_t count = peek(path, head);

    return memmem(head, count, word, strlen(word)) != NULL;
}

bool
otx_inputs_number(
    const otx_flag_values *values, otx_flag_id id, int64_t low, int64_t high,
    int64_t *out)
{
    const char *text = values->text[id];

    if (!text || otx_value_int(text, low, high, out))
        return true;
    otx_session_refuse(
        "--%s takes a whole number from %lld to %lld, not '%s'",
        otx_flag_at(id)->name, (long long)low, (long long)high, text);
    return false;
}

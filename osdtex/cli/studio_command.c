/* studio_command.c -- osdtex studio: a page on which a texture is directed. */
#include "cli/dispatch.h"
#include "cli/map_flags.h"
#include "cli/session.h"
#include "cli/value.h"
#include "studio/studio.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    WORDS_MOST = 2 * (OTX_FLAG_COUNT + OTX_FLAG_SETTINGS_MAX + OTX_ALSO_MAX)
};

typedef struct job
{
    otx_map_flags request;
    otx_studio_files files;
    const char *words[WORDS_MOST];
    char texts[OTX_FLAG_COUNT + OTX_FLAG_SETTINGS_MAX][512];
    int word_count, text_count;
    osdtex_cage *cage;
    otx_session *session;
} job;

/* -- names ---------------------------------------------------------------- */

/* The files of `stem`. */
static bool
name_files(const char *stem, otx_studio_files *out)
{
    const int most = OTX_STUDIO_PATH_BYTES;

    return snprintf(out->model, (size_t)most, "%s.obj", stem) < most &&
           snprintf(out->saved, (size_t)most, "%s.osdtex", stem) < most &&
           snprintf(out->state, (size_t)most, "%s_state.json", stem) < most &&
           snprintf(
               out->constraints, (size_t)most, "%s_constraints.json", stem) <
               most;
}

/* Makes the folder in which this program keeps what it can keep nowhere else;
 * false where there is none. */
static bool
make_state_folder(char *out, size_t bytes)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    int length;

    if (state && state[0] == '/')
        length = snprintf(out, bytes, "%s/osdtex", state);
    else if (home && home[0] == '/')
        length = snprintf(out, bytes, "%s/.local/state/osdtex", home);
    else
        return false;
    if (length >= (int)bytes)
        return false;
    for (char *c = out + 1; *c; ++c)
        if (*c == '/')
        {
            *c = '\0';
            mkdir(out, 0777);
            *c = '/';
        }
    mkdir(out, 0777);
    return access(out, W_OK) == 0;
}

/* CAGE_studio beside the cage, or in the state folder. */
static bool
name_stem(const char *cage, char stem[OTX_STUDIO_PATH_BYTES])
{
    const char *slash = strrchr(cage, '/');
    const char *name = slash ? slash + 1 : cage;
    const int folder = (int)(name - cage);
    const int length =
        (int)strlen(name) - (otx_value_has_extension(name, ".obj") ? 4 : 0);
    char other[OTX_STUDIO_PATH_BYTES / 2], hash[OSDTEX_HASH_BYTES];

    snprintf(
        stem, OTX_STUDIO_PATH_BYTES, "%.*s", folder > 0 ? folder : 1,
        folder > 0 ? cage : ".");
    if (access(stem, W_OK) == 0)
        return snprintf(
                   stem, OTX_STUDIO_PATH_BYTES, "%.*s%.*s_studio", folder, cage,
                   length, name) < OTX_STUDIO_PATH_BYTES;
    if (!make_state_folder(other, sizeof other))
        return false;
    /* Cages of one name in several folders are several. */
    osdtex_hash(cage, strlen(cage), hash);
    return snprintf(
               stem, OTX_STUDIO_PATH_BYTES, "%s/%.*s_%.8s_studio", other,
               length, name, hash) < OTX_STUDIO_PATH_BYTES;
}

static bool
name_outputs(job *j, const otx_flag_values *values)
{
    const char *output = values->text[OTX_FLAG_OUTPUT];
    char stem[OTX_STUDIO_PATH_BYTES];

    if (output && (!otx_value_has_extension(output, ".obj") ||
                   strlen(output) >= sizeof stem))
    {
        otx_session_refuse("the output is called NAME.obj: -o DIR/NAME.obj");
        return false;
    }
    if (output)
        snprintf(stem, sizeof stem, "%.*s", (int)strlen(output) - 4, output);
    if ((output || name_stem(values->operands[0], stem)) &&
        name_files(stem, &j->files))
        return true;
    otx_session_refuse(
        "the folder of '%s' cannot be written to; say where with -o "
        "DIR/NAME.obj",
        values->operands[0]);
    return false;
}

/* -- the command line that makes the same ---------------------------------- */

static void
add_word(job *j, const char *word)
{
    if (j->word_count < WORDS_MOST)
        j->words[j->word_count++] = word;
}

static void
add_flag(job *j, otx_flag_id id, const char *value)
{
    char *text = j->texts[j->text_count++];

    snprintf(text, sizeof *j->texts, "--%s", otx_flag_at(id)->name);
    add_word(j, text);
    if (value && value[0])
        add_word(j, value);
}

/* Flags that a mapping depends on and that the page has no say in. */
static void
list_words(job *j, const otx_flag_values *values)
{
    static const otx_flag_id fixed[] = {
        OTX_FLAG_METHOD,      OTX_FLAG_LEVEL,     OTX_FLAG_FOLLOW,
        OTX_FLAG_ALONG,       OTX_FLAG_SCHEME,    OTX_FLAG_BOUNDARY,
        OTX_FLAG_FVAR,        OTX_FLAG_WELD,      OTX_FLAG_FROM,
        OTX_FLAG_LAYER,       OTX_FLAG_TO,        OTX_FLAG_MATCH_SPACE,
        OTX_FLAG_MATCH_IN,    OTX_FLAG_WRAP,      OTX_FLAG_TILEABLE,
        OTX_FLAG_COLORCONFIG, OTX_FLAG_GENERATORS};

    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; ++i)
        if (values->text[fixed[i]])
            add_flag(j, fixed[i], values->text[fixed[i]]);
    for (int i = 0; i < values->also_count; ++i)
        add_flag(j, OTX_FLAG_ALSO, values->also[i]);
    for (int i = 0; i < values->setting_count; ++i)
    {
        char *text = j->texts[j->text_count++];

        snprintf(
            text, sizeof *j->texts, "--set=%s=%s", values->settings[i].key,
            values->settings[i].value);
        add_word(j, text);
    }
}

/* -- the studio ----------------------------------------------------------- */

static void
say_address(void *user, const char *address)
{
    job *j = user;

    otx_session_print("%s\n", address);
    fflush(stdout);
    otx_session_say(
        j->session,
        "open the address above in a browser of this machine; what is done "
        "there is saved in %s; Ctrl-C ends it",
        j->files.constraints);
}

/* Reads what is wrong to read before a page is opened for it. */
static osdtex_status
read_inputs(job *j, const otx_flag_values *values)
{
    osdtex_context *context = j->session->context;
    osdtex_exemplar *exemplar;
    osdtex_status status = osdtex_cage_read(
        context, values->operands[0], &j->request.cage_options, &j->cage);

    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(
            context, values->operands[1], &j->request.exemplar_options,
            &exemplar);
    if (status == OSDTEX_OK)
        osdtex_exemplar_destroy(exemplar);
    if (status == OSDTEX_OK)
        status = otx_also_flags_read(
            context, &j->request.exemplar_options, &j->request.also);
    j->request.map_options.also = j->request.also.list;
    j->request.map_options.also_count = j->request.also.count;
    return status;
}

static osdtex_status
serve(job *j, const otx_flag_values *values)
{
    char error[OTX_STUDIO_ERROR_BYTES];
    otx_studio_options options = {
        .context = j->session->options,
        .cage = j->cage,
        .exemplar_count = values->operand_count - 1,
        .exemplar = j->request.exemplar_options,
        .surface = j->request.surface_options,
        .map = j->request.map_options,
        .files = &j->files,
        .words = j->words,
        .word_count = j->word_count,
        .is_stopped = otx_session_is_stopped,
        .say = say_address,
        .say_user = j,
        .opens_browser = !values->text[OTX_FLAG_NO_BROWSER]};
    osdtex_status status;

    for (int i = 0; i < options.exemplar_count; ++i)
        options.exemplars[i] = values->operands[i + 1];
    status = otx_studio_run(&options, error);
    if (status != OSDTEX_OK)
        otx_session_refuse("%s", error);
    else
        otx_session_say(
            j->session, "ended; all that was done is in %s",
            j->files.constraints);
    return status;
}

int
otx_studio_command_run(const otx_flag_values *values)
{
    osdtex_status status;
    otx_session session;
    job *j = calloc(1, sizeof *j);

    if (!j)
        return OTX_EXIT_LIMIT;
    if (!otx_map_flags_parse_mapping(values, &j->request) ||
        !name_outputs(j, values))
    {
        free(j);
        return OTX_EXIT_USAGE;
    }
    if (!otx_session_begin(&session, values))
    {
        free(j);
        return session.exit_code;
    }
    j->session = &session;
    list_words(j, values);
    status = otx_studio_is_built() ? read_inputs(j, values) : OSDTEX_OK;
    if (status == OSDTEX_OK)
        status = serve(j, values);
    otx_also_flags_destroy(&j->request.also);
    osdtex_cage_destroy(j->cage);
    free(j);
    return otx_session_end(&session, status);
}

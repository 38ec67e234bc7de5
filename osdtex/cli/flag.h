/* flag.h -- every flag of every sub-command, in one table.
 *
 * The table is where a flag's name, letter, argument and help are written
 * down: parsing, `--help`, the man page and the shell completion read it. A
 * sub-command only lists which flags it takes. */
#ifndef OTX_CLI_FLAG_H
#define OTX_CLI_FLAG_H

#include <osdtex/osdtex.h>
#include <stdbool.h>
#include <string.h>

typedef enum otx_flag_id
{
    OTX_FLAG_OUTPUT,
    OTX_FLAG_METHOD,
    OTX_FLAG_SCALE,
    OTX_FLAG_LEVEL,
    OTX_FLAG_SEED,
    OTX_FLAG_SET,
    OTX_FLAG_ALSO,
    OTX_FLAG_MATERIAL,
    OTX_FLAG_MAP,
    OTX_FLAG_NORMAL_Y,
    OTX_FLAG_MATCH_MAPS,
    OTX_FLAG_HEIGHT_RANGE,
    OTX_FLAG_HEIGHT_MIDDLE,
    OTX_FLAG_MASK,
    OTX_FLAG_FIRST_PATCH,
    OTX_FLAG_CONSTRAINTS,
    OTX_FLAG_KEEP,
    OTX_FLAG_REST,
    OTX_FLAG_REDO,
    OTX_FLAG_REACH,
    OTX_FLAG_FOLLOW,
    OTX_FLAG_ALONG,
    OTX_FLAG_PLACE,
    OTX_FLAG_SYMMETRY,
    OTX_FLAG_OCTAVES,
    OTX_FLAG_EXEMPLAR_CLASS,
    OTX_FLAG_GENERATORS,
    OTX_FLAG_TILE_LEVEL,
    OTX_FLAG_BOUNDARIES,
    OTX_FLAG_CORNERS,
    OTX_FLAG_TILE_SIZE,
    OTX_FLAG_GUTTER,
    OTX_FLAG_ORIENTED,
    OTX_FLAG_EDGE_TEMPLATE,
    OTX_FLAG_CORNER_TEMPLATE,
    OTX_FLAG_BACKGROUND,
    OTX_FLAG_BLEND,
    OTX_FLAG_SLICES,
    OTX_FLAG_STACK_SIZE,
    OTX_FLAG_MASKS,
    OTX_FLAG_FEATURES,
    OTX_FLAG_MORPH,
    OTX_FLAG_VARY,
    OTX_FLAG_FOR,
    OTX_FLAG_RECEIVER,
    OTX_FLAG_BAKE,
    OTX_FLAG_BAKE_UVS,
    OTX_FLAG_RESOLUTION,
    OTX_FLAG_TEXELS_PER_UNIT,
    OTX_FLAG_MARGIN,
    OTX_FLAG_SEAM_BLEND,
    OTX_FLAG_HEAL,
    OTX_FLAG_EXTRA,
    OTX_FLAG_PREVIEW_PNG,
    OTX_FLAG_UDIM,
    OTX_FLAG_NORMALS,
    OTX_FLAG_PASTES,
    OTX_FLAG_UNITS,
    OTX_FLAG_UP,
    OTX_FLAG_PREVIEW,
    OTX_FLAG_JSON_REPORT,
    OTX_FLAG_SAVE,
    OTX_FLAG_SCHEME,
    OTX_FLAG_BOUNDARY,
    OTX_FLAG_FVAR,
    OTX_FLAG_WELD,
    OTX_FLAG_LAYER,
    OTX_FLAG_FROM,
    OTX_FLAG_TO,
    OTX_FLAG_MATCH_SPACE,
    OTX_FLAG_MATCH_IN,
    OTX_FLAG_WRAP,
    OTX_FLAG_TILEABLE,
    OTX_FLAG_COLORCONFIG,
    OTX_FLAG_CAMERA,
    OTX_FLAG_TURN,
    OTX_FLAG_SIZE,
    OTX_FLAG_SAMPLES,
    OTX_FLAG_SHOW,
    OTX_FLAG_DRAW,
    OTX_FLAG_FRAMES,
    OTX_FLAG_UNLIT,
    OTX_FLAG_PLAIN,
    OTX_FLAG_DISPLACE,
    OTX_FLAG_NO_SHADOWS,
    OTX_FLAG_NO_BROWSER,
    OTX_FLAG_THREADS,
    OTX_FLAG_MEMORY_LIMIT,
    OTX_FLAG_DRY_RUN,
    OTX_FLAG_UPDATE,
    OTX_FLAG_REPLACE,
    OTX_FLAG_UPDATE_CASE,
    OTX_FLAG_PROGRAM,
    OTX_FLAG_HISTORY,
    OTX_FLAG_ENGINE,
    OTX_FLAG_TASK,
    OTX_FLAG_MAN,
    OTX_FLAG_COMPLETION,
    OTX_FLAG_VERBOSE,
    OTX_FLAG_QUIET,
    OTX_FLAG_HELP,
    OTX_FLAG_VERSION,
    OTX_FLAG_COUNT
} otx_flag_id;

/* Where a flag stands in `--help`. */
typedef enum otx_flag_group
{
    OTX_FLAG_GROUP_MAIN,
    OTX_FLAG_GROUP_BAKE,
    OTX_FLAG_GROUP_CAGE,
    OTX_FLAG_GROUP_COLOUR,
    OTX_FLAG_GROUP_PICTURE,
    OTX_FLAG_GROUP_COMMON,
    OTX_FLAG_GROUP_HIDDEN,
    OTX_FLAG_GROUP_COUNT
} otx_flag_group;

typedef struct otx_flag
{
    const char *name; /* without dashes */
    char letter;      /* 0 none */
    otx_flag_group group;
    const char *argument; /* how it is called in the help; NULL: a switch */
    const char *help;
} otx_flag;

enum
{
    OTX_FLAG_SETTINGS_MAX = 64,
    /* Files of --from. */
    OTX_FLAG_SAVED_MAX = 1 + OSDTEX_EXEMPLARS_MAX * (1 + OSDTEX_MAP_KINDS) +
                         OSDTEX_PLACE_PICTURES_MAX,
    OTX_FLAG_SPOOLS_MAX = 8,
    OTX_FLAG_OPERANDS_MAX = 8,
    OTX_FLAG_EDGES_MAX = 8,
    OTX_FLAG_WORDS_MAX = 256,
    OTX_FLAG_ALSO_MAX = 8,
    OTX_FLAG_SET_FILES =
        OSDTEX_MAP_KINDS + 1 /* of a material, its colour too */
};

/* An input that is a pipe: see cli/spool.h. */
typedef struct otx_flag_spool
{
    const char *name; /* as given */
    char text[256];   /* what is given in its place */
    size_t prefix;    /* bytes of both before the file's name */
} otx_flag_spool;

/* The files that a saved mapping names: its cage, then its exemplars and their
 * maps, of which operands stand in the place of the first ones. See
 * saved_files.h. */
typedef struct otx_flag_saved
{
    const char *path; /* NAME.osdtex; NULL none */
    char *files[OTX_FLAG_SAVED_MAX];
    int count;
    int exemplars;
    uint32_t maps[OSDTEX_EXEMPLARS_MAX]; /* bit k: it has a map of kind k */
    bool out_of_memory;
} otx_flag_saved;

/* Files that a command line leads to, beyond those that stand in it; found
 * before anything is read. */
typedef struct otx_flag_inputs
{
    /* Of materials. */
    const char *maps[OSDTEX_MAP_KINDS + OTX_FLAG_ALSO_MAX * OTX_FLAG_SET_FILES];
    int map_count;
    otx_flag_saved saved; /* of --from */
    otx_flag_spool spools[OTX_FLAG_SPOOLS_MAX];
    int spool_count;
} otx_flag_inputs;

/* Adds a file, once. */
static inline void
otx_flag_inputs_add(otx_flag_inputs *inputs, const char *path)
{
    for (int i = 0; i < inputs->map_count; ++i)
        if (strcmp(inputs->maps[i], path) == 0)
            return;
    inputs->maps[inputs->map_count++] = path;
}

/* A command line, taken apart. Strings point into argv. */
typedef struct otx_flag_values
{
    const char *text[OTX_FLAG_COUNT]; /* NULL: not given; "" for switches */
    osdtex_setting settings[OTX_FLAG_SETTINGS_MAX]; /* of --set, in order */
    int setting_count;
    const char *edges[OTX_FLAG_EDGES_MAX]; /* of --edge-template, in order */
    int edge_count;
    const char *also[OTX_FLAG_ALSO_MAX]; /* of --also, in order */
    int also_count;
    const char *operands[OTX_FLAG_OPERANDS_MAX];
    int operand_count;
    const otx_flag_id *ids;                /* the flags of the command */
    const char *words[OTX_FLAG_WORDS_MAX]; /* as they were given */
    int word_count;
    const char *job; /* file of the job that this is a task of; NULL none */
    otx_flag_inputs inputs;
} otx_flag_values;

const otx_flag *otx_flag_at(otx_flag_id id);
const char *otx_flag_group_title(otx_flag_group group);

/* Whether the command takes a flag. */
bool otx_flag_is_taken(const otx_flag_values *values, otx_flag_id id);

/* Takes argv[1..argc) apart. `ids` ends with OTX_FLAG_COUNT. On a mistake it
 * prints one sentence on stderr and returns false. */
bool otx_flag_parse(
    int argc, char **argv, const otx_flag_id *ids, otx_flag_values *out);

#endif

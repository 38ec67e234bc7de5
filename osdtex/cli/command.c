/* command.c -- the table of sub-commands. */
#include "cli/command.h"
#include "cli/session.h"
#include "studio/studio.h"
#include "word/near.h"

#include <string.h>

static const otx_flag_id map_flags[] = {
    OTX_FLAG_OUTPUT,       OTX_FLAG_NORMALS,
    OTX_FLAG_PASTES,       OTX_FLAG_METHOD,
    OTX_FLAG_SCALE,        OTX_FLAG_LEVEL,
    OTX_FLAG_SEED,         OTX_FLAG_SET,
    OTX_FLAG_TILE_LEVEL,   OTX_FLAG_ALSO,
    OTX_FLAG_MATERIAL,     OTX_FLAG_MAP,
    OTX_FLAG_NORMAL_Y,     OTX_FLAG_MATCH_MAPS,
    OTX_FLAG_HEIGHT_RANGE, OTX_FLAG_HEIGHT_MIDDLE,
    OTX_FLAG_MASK,         OTX_FLAG_FIRST_PATCH,
    OTX_FLAG_KEEP,         OTX_FLAG_REST,
    OTX_FLAG_CONSTRAINTS,  OTX_FLAG_ALONG,
    OTX_FLAG_PLACE,        OTX_FLAG_EXEMPLAR_CLASS,
    OTX_FLAG_GENERATORS,   OTX_FLAG_PREVIEW,
    OTX_FLAG_JSON_REPORT,  OTX_FLAG_SCHEME,
    OTX_FLAG_BOUNDARY,     OTX_FLAG_FVAR,
    OTX_FLAG_WELD,         OTX_FLAG_FROM,
    OTX_FLAG_LAYER,        OTX_FLAG_TO,
    OTX_FLAG_RECEIVER,     OTX_FLAG_MATCH_SPACE,
    OTX_FLAG_MATCH_IN,     OTX_FLAG_WRAP,
    OTX_FLAG_TILEABLE,     OTX_FLAG_COLORCONFIG,
    OTX_FLAG_THREADS,      OTX_FLAG_MEMORY_LIMIT,
    OTX_FLAG_REPLACE,      OTX_FLAG_DRY_RUN,
    OTX_FLAG_UPDATE,       OTX_FLAG_VERBOSE,
    OTX_FLAG_QUIET,        OTX_FLAG_HELP,
    OTX_FLAG_VERSION,      OTX_FLAG_BAKE,
    OTX_FLAG_BAKE_UVS,     OTX_FLAG_RESOLUTION,
    OTX_FLAG_MARGIN,       OTX_FLAG_SEAM_BLEND,
    OTX_FLAG_HEAL,         OTX_FLAG_TEXELS_PER_UNIT,
    OTX_FLAG_EXTRA,        OTX_FLAG_PREVIEW_PNG,
    OTX_FLAG_UNITS,        OTX_FLAG_UP,
    OTX_FLAG_SHOW,         OTX_FLAG_PLAIN,
    OTX_FLAG_DISPLACE,     OTX_FLAG_FOLLOW,
    OTX_FLAG_CAMERA,       OTX_FLAG_TURN,
    OTX_FLAG_DRAW,         OTX_FLAG_SIZE,
    OTX_FLAG_SAMPLES,      OTX_FLAG_UNLIT,
    OTX_FLAG_NO_SHADOWS,   OTX_FLAG_SAVE,
    OTX_FLAG_COUNT};

static const otx_flag_id bake_flags[] = {
    OTX_FLAG_OUTPUT,
    OTX_FLAG_NORMALS,
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
    OTX_FLAG_TILE_LEVEL,
    OTX_FLAG_FIRST_PATCH,
    OTX_FLAG_KEEP,
    OTX_FLAG_REST,
    OTX_FLAG_CONSTRAINTS,
    OTX_FLAG_ALONG,
    OTX_FLAG_PLACE,
    OTX_FLAG_EXEMPLAR_CLASS,
    OTX_FLAG_GENERATORS,
    OTX_FLAG_PREVIEW,
    OTX_FLAG_JSON_REPORT,
    OTX_FLAG_BAKE_UVS,
    OTX_FLAG_RESOLUTION,
    OTX_FLAG_MARGIN,
    OTX_FLAG_SEAM_BLEND,
    OTX_FLAG_HEAL,
    OTX_FLAG_TEXELS_PER_UNIT,
    OTX_FLAG_EXTRA,
    OTX_FLAG_PREVIEW_PNG,
    OTX_FLAG_UNITS,
    OTX_FLAG_UP,
    OTX_FLAG_UDIM,
    OTX_FLAG_SCHEME,
    OTX_FLAG_BOUNDARY,
    OTX_FLAG_FVAR,
    OTX_FLAG_WELD,
    OTX_FLAG_FROM,
    OTX_FLAG_LAYER,
    OTX_FLAG_TO,
    OTX_FLAG_RECEIVER,
    OTX_FLAG_MATCH_SPACE,
    OTX_FLAG_MATCH_IN,
    OTX_FLAG_WRAP,
    OTX_FLAG_TILEABLE,
    OTX_FLAG_COLORCONFIG,
    OTX_FLAG_THREADS,
    OTX_FLAG_MEMORY_LIMIT,
    OTX_FLAG_REPLACE,
    OTX_FLAG_DRY_RUN,
    OTX_FLAG_UPDATE,
    OTX_FLAG_VERBOSE,
    OTX_FLAG_QUIET,
    OTX_FLAG_HELP,
    OTX_FLAG_VERSION,
    OTX_FLAG_SHOW,
    OTX_FLAG_PLAIN,
    OTX_FLAG_DISPLACE,
    OTX_FLAG_FOLLOW,
    OTX_FLAG_DRAW,
    OTX_FLAG_CAMERA,
    OTX_FLAG_TURN,
    OTX_FLAG_SIZE,
    OTX_FLAG_SAMPLES,
    OTX_FLAG_UNLIT,
    OTX_FLAG_NO_SHADOWS,
    OTX_FLAG_SAVE,
    OTX_FLAG_COUNT};

static const otx_flag_id stack_flags[] = {
    OTX_FLAG_OUTPUT,      OTX_FLAG_SLICES,   OTX_FLAG_STACK_SIZE,
    OTX_FLAG_MASKS,       OTX_FLAG_FEATURES, OTX_FLAG_MORPH,
    OTX_FLAG_VARY,        OTX_FLAG_SEED,     OTX_FLAG_FROM,
    OTX_FLAG_TO,          OTX_FLAG_WRAP,     OTX_FLAG_TILEABLE,
    OTX_FLAG_COLORCONFIG, OTX_FLAG_THREADS,  OTX_FLAG_MEMORY_LIMIT,
    OTX_FLAG_REPLACE,     OTX_FLAG_DRY_RUN,  OTX_FLAG_VERBOSE,
    OTX_FLAG_QUIET,       OTX_FLAG_HELP,     OTX_FLAG_VERSION,
    OTX_FLAG_COUNT};

static const otx_flag_id edit_flags[] = {
    OTX_FLAG_OUTPUT,       OTX_FLAG_CONSTRAINTS, OTX_FLAG_REDO,
    OTX_FLAG_SEED,         OTX_FLAG_REACH,       OTX_FLAG_PREVIEW,
    OTX_FLAG_SHOW,         OTX_FLAG_COLORCONFIG, OTX_FLAG_THREADS,
    OTX_FLAG_MEMORY_LIMIT, OTX_FLAG_REPLACE,     OTX_FLAG_DRY_RUN,
    OTX_FLAG_VERBOSE,      OTX_FLAG_QUIET,       OTX_FLAG_HELP,
    OTX_FLAG_VERSION,      OTX_FLAG_COUNT};

static const otx_flag_id tiles_flags[] = {
    OTX_FLAG_OUTPUT,
    OTX_FLAG_MATERIAL,
    OTX_FLAG_MAP,
    OTX_FLAG_MATCH_MAPS,
    OTX_FLAG_NORMAL_Y,
    OTX_FLAG_BOUNDARIES,
    OTX_FLAG_CORNERS,
    OTX_FLAG_TILE_SIZE,
    OTX_FLAG_GUTTER,
    OTX_FLAG_ORIENTED,
    OTX_FLAG_SEED,
    OTX_FLAG_EDGE_TEMPLATE,
    OTX_FLAG_CORNER_TEMPLATE,
    OTX_FLAG_BACKGROUND,
    OTX_FLAG_BLEND,
    OTX_FLAG_FOR,
    OTX_FLAG_SCALE,
    OTX_FLAG_LEVEL,
    OTX_FLAG_TILE_LEVEL,
    OTX_FLAG_SET,
    OTX_FLAG_SCHEME,
    OTX_FLAG_BOUNDARY,
    OTX_FLAG_FVAR,
    OTX_FLAG_WELD,
    OTX_FLAG_FROM,
    OTX_FLAG_LAYER,
    OTX_FLAG_TO,
    OTX_FLAG_MATCH_SPACE,
    OTX_FLAG_MATCH_IN,
    OTX_FLAG_WRAP,
    OTX_FLAG_COLORCONFIG,
    OTX_FLAG_THREADS,
    OTX_FLAG_MEMORY_LIMIT,
    OTX_FLAG_REPLACE,
    OTX_FLAG_DRY_RUN,
    OTX_FLAG_VERBOSE,
    OTX_FLAG_QUIET,
    OTX_FLAG_HELP,
    OTX_FLAG_VERSION,
    OTX_FLAG_COUNT};

static const otx_flag_id render_flags[] = {
    OTX_FLAG_FROM,    OTX_FLAG_OUTPUT,       OTX_FLAG_CAMERA,
    OTX_FLAG_TURN,    OTX_FLAG_FRAMES,       OTX_FLAG_SIZE,
    OTX_FLAG_SAMPLES, OTX_FLAG_SHOW,         OTX_FLAG_DRAW,
    OTX_FLAG_PLAIN,   OTX_FLAG_DISPLACE,     OTX_FLAG_NO_SHADOWS,
    OTX_FLAG_UNLIT,   OTX_FLAG_UP,           OTX_FLAG_CONSTRAINTS,
    OTX_FLAG_FOLLOW,  OTX_FLAG_SYMMETRY,     OTX_FLAG_COLORCONFIG,
    OTX_FLAG_THREADS, OTX_FLAG_MEMORY_LIMIT, OTX_FLAG_REPLACE,
    OTX_FLAG_DRY_RUN, OTX_FLAG_VERBOSE,      OTX_FLAG_QUIET,
    OTX_FLAG_HELP,    OTX_FLAG_VERSION,      OTX_FLAG_COUNT};

static const otx_flag_id field_flags[] = {
    OTX_FLAG_OUTPUT,       OTX_FLAG_CONSTRAINTS, OTX_FLAG_FOLLOW,
    OTX_FLAG_SYMMETRY,     OTX_FLAG_OCTAVES,     OTX_FLAG_LEVEL,
    OTX_FLAG_SHOW,         OTX_FLAG_CAMERA,      OTX_FLAG_TURN,
    OTX_FLAG_SIZE,         OTX_FLAG_SAMPLES,     OTX_FLAG_UNLIT,
    OTX_FLAG_UP,           OTX_FLAG_SCHEME,      OTX_FLAG_BOUNDARY,
    OTX_FLAG_FVAR,         OTX_FLAG_WELD,        OTX_FLAG_THREADS,
    OTX_FLAG_MEMORY_LIMIT, OTX_FLAG_REPLACE,     OTX_FLAG_DRY_RUN,
    OTX_FLAG_VERBOSE,      OTX_FLAG_QUIET,       OTX_FLAG_HELP,
    OTX_FLAG_VERSION,      OTX_FLAG_COUNT};

static const otx_flag_id studio_flags[] = {
    OTX_FLAG_METHOD,       OTX_FLAG_OUTPUT,      OTX_FLAG_SCALE,
    OTX_FLAG_LEVEL,        OTX_FLAG_SEED,        OTX_FLAG_SET,
    OTX_FLAG_ALSO,         OTX_FLAG_FIRST_PATCH, OTX_FLAG_CONSTRAINTS,
    OTX_FLAG_FOLLOW,       OTX_FLAG_ALONG,       OTX_FLAG_EXEMPLAR_CLASS,
    OTX_FLAG_GENERATORS,   OTX_FLAG_NO_BROWSER,  OTX_FLAG_SCHEME,
    OTX_FLAG_BOUNDARY,     OTX_FLAG_FVAR,        OTX_FLAG_WELD,
    OTX_FLAG_FROM,         OTX_FLAG_LAYER,       OTX_FLAG_TO,
    OTX_FLAG_MATCH_SPACE,  OTX_FLAG_MATCH_IN,    OTX_FLAG_WRAP,
    OTX_FLAG_TILEABLE,     OTX_FLAG_COLORCONFIG, OTX_FLAG_THREADS,
    OTX_FLAG_MEMORY_LIMIT, OTX_FLAG_QUIET,       OTX_FLAG_HELP,
    OTX_FLAG_VERSION,      OTX_FLAG_COUNT};

static const otx_flag_id regress_flags[] = {
    OTX_FLAG_OUTPUT, OTX_FLAG_UPDATE_CASE, OTX_FLAG_PROGRAM, OTX_FLAG_HISTORY,
    OTX_FLAG_QUIET,  OTX_FLAG_HELP,        OTX_FLAG_VERSION, OTX_FLAG_COUNT};

static const otx_flag_id plan_flags[] = {OTX_FLAG_OUTPUT,  OTX_FLAG_ENGINE,
                                         OTX_FLAG_PROGRAM, OTX_FLAG_HELP,
                                         OTX_FLAG_VERSION, OTX_FLAG_COUNT};

static const otx_flag_id run_flags[] = {
    OTX_FLAG_TASK, OTX_FLAG_HELP, OTX_FLAG_VERSION, OTX_FLAG_COUNT};

static const otx_flag_id info_flags[] = {
    OTX_FLAG_SCHEME,  OTX_FLAG_BOUNDARY,     OTX_FLAG_FVAR,
    OTX_FLAG_WELD,    OTX_FLAG_FROM,         OTX_FLAG_LAYER,
    OTX_FLAG_TO,      OTX_FLAG_MATCH_SPACE,  OTX_FLAG_COLORCONFIG,
    OTX_FLAG_THREADS, OTX_FLAG_MEMORY_LIMIT, OTX_FLAG_VERBOSE,
    OTX_FLAG_QUIET,   OTX_FLAG_HELP,         OTX_FLAG_VERSION,
    OTX_FLAG_COUNT};

static const otx_flag_id methods_flags[] = {
    OTX_FLAG_HELP, OTX_FLAG_VERSION, OTX_FLAG_COUNT};

static const otx_flag_id help_flags[] = {
    OTX_FLAG_MAN, OTX_FLAG_COMPLETION, OTX_FLAG_HELP, OTX_FLAG_VERSION,
    OTX_FLAG_COUNT};

static const otx_command commands[] = {
    {"map", "CAGE.obj EXEMPLAR", 2, 2,
     "texture a subdivision cage from a picture of a material",
     "Subdivides the cage, covers its limit surface with pieces of the "
     "exemplar so\nthat seams do not show, and writes the refined mesh with "
     "UVs "
     "into the exemplar\n(NAME.obj), its material (NAME.mtl) and the exemplar "
     "as a texture (NAME.exr).\nWith --scheme none the mesh stays as it is: "
     "its vertices and faces get UVs.\nThe exemplar is an EXR, PNG, TIFF or "
     "JPEG; it "
     "need not tile.",
     "osdtex map models/cages/creature.obj models/exemplars/pebbles_tile.png "
     "\\\n    -o pebbles.obj --preview pebbles.png\n"
     "osdtex map shirt.obj weave.exr -o out/shirt.obj --scale 12 --level 3 \\\n"
     "    --json-report out/shirt.json\n"
     "osdtex map scan.obj bark.png -o out/scan.obj --scheme none\n",
     "DIR/NAME.obj; NAME.mtl and NAME.exr are written beside it. NAME.png, "
     "NAME.tif or NAME.jpg: the same with such a texture",
     map_flags, true},
    {"tiles", "EXEMPLAR", 1, 1, "make a tiled texture from a picture",
     "Makes square tiles that meet exactly on any quad mesh, at edges, "
     "vertices and\nmip levels: osdtex map CAGE.obj TILES.exr --method tile. "
     "The UVs do not depend\non the picture, so that other tiles of the same "
     "layout fit the same OBJ.",
     "osdtex tiles models/exemplars/gravel_tile.png -o gravel_tiles.exr\n"
     "osdtex tiles wood.exr -o wood_tiles.exr --oriented --for shirt.obj \\\n"
     "    --tile-level 2\n",
     "an .exr", tiles_flags, true},
    {"stack", "EXEMPLAR...", 1, 8, "make the pictures between two that tile",
     "Makes slices in which the spots or joints of one picture become "
     "those of the\nnext: a texture with a third axis. Masks of them are found "
     "and written beside\nthe stack, so that they can be changed and given "
     "instead. An EXEMPLAR may be\nthe folder of a material: its maps go "
     "through, too.",
     "osdtex stack spots.png stripes.png -o fur.exr\n"
     "osdtex stack cobbles.png bricks.png -o wall.exr --features joints \\\n"
     "    --slices 12 --size 512\n"
     "osdtex stack pebbles.png --vary -o pebbles.exr\n",
     "an .exr; NAME_mask1.png, ... are written beside it", stack_flags, true},
    {"bake", "CAGE.obj EXEMPLAR", 2, 2,
     "texture a cage and bake the result onto its UVs",
     "Textures the cage as `osdtex map` does, but keeps it as it is: writes\n"
     "NAME_cage.obj (the cage, on its own UVs or on an atlas), NAME_cage.mtl, "
     "its\ntextures NAME.1001.exr and on (mip-mapped, a UDIM tile each), and "
     "NAME.usda and\nNAME.mtlx for what OBJ and MTL cannot say. Render it "
     "subdivided, with the UV\nrule that NAME_cage.obj states.",
     "osdtex bake models/cages/creature.obj models/exemplars/pebbles_tile.png "
     "\\\n    -o pebbles.obj --resolution 2048 --save pebbles.osdtex\n"
     "osdtex bake --from pebbles.osdtex -o large.obj --resolution 8192\n"
     "osdtex bake shirt.obj weave.exr -o out/shirt.obj --uvs atlas \\\n"
     "    --texels-per-unit 40 --preview-png\n",
     "DIR/NAME.obj: what is written is called after NAME, and beside it. "
     "NAME.png, NAME.tif or NAME.jpg: the same with such textures",
     bake_flags, true},
    {"edit", "MAP.osdtex", 1, 1, "change a saved mapping in a part of it",
     "Covers again what the constraints of a file hold and reach, or the spot "
     "that\n--redo names, so that it continues what is around it; everything "
     "else stays as\nit is to the bit. What was asked for is saved too. "
     "`osdtex "
     "map --from` and\n`osdtex bake --from` make models and textures of it.",
     "osdtex edit pebbles.osdtex --redo 0.2,1.5,0.4,0.1 -o again.osdtex\n"
     "osdtex edit wood.osdtex --constraints comb.json -o combed.osdtex \\\n"
     "    --reach 0.5 --preview combed.png\n",
     "a .osdtex, another one than MAP.osdtex", edit_flags, true},
    {"render", "MODEL.obj", 1, 1, "take a picture of a textured model",
     "Ray-traces an OBJ with the textures that its MTL names. PNG is for the "
     "eye\n(sRGB), EXR is scene-linear. --show field and --show singularities "
     "make a\nfield on the OBJ's own faces: the smoothest, or exactly that of "
     "a "
     "table that\n`osdtex field CAGE.obj --level N -o FILE.csv` wrote for the "
     "level of the OBJ.",
     "osdtex render pebbles.obj -o pebbles.png --camera front --size 800x800\n"
     "osdtex render pebbles.obj -o patches.png --show patches --unlit\n"
     "osdtex render --from pebbles.osdtex -o sheet.png --show sheet\n"
     "osdtex render pebbles.obj -o turn.%04d.png --frames 48\n"
     "osdtex render wood.obj -o field.png --show field --constraints "
     "field.csv\n",
     "a .png or .exr; NAME.%04d.png or .exr for the frames of a turntable",
     render_flags, true},
    {"field", "CAGE.obj", 1, 1, "show or write a direction field on a cage",
     "Solves for the field of directions that textures follow: the smoothest, "
     "or what\nconstraints and --follow ask for. A picture shows its lines, "
     "and "
     "dots where it\nhas no direction; a .csv has a line for each face of the "
     "cage, or of --level N,\nand can be given as --constraints again.",
     "osdtex field models/cages/creature.obj -o field.png --follow up\n"
     "osdtex field shirt.obj -o field.csv --constraints pull.json --symmetry "
     "4\n",
     "a .png or .exr for a picture, a .csv for the directions", field_flags,
     true},
    {"studio", "CAGE.obj EXEMPLAR...", 2, 1 + OTX_STUDIO_EXEMPLARS_MAX,
     "direct a texture by hand, on a page in the browser",
     "Serves a page on which the textured model is turned, looked at and "
     "directed:\ncomb directions, brush sizes, choose the first patch and the "
     "exemplar. Each\ngesture is a constraint in a file that `osdtex map "
     "--constraints` reads, which\nis saved as it changes; the page shows the "
     "command. Only this machine can open\nthe page, by the address that is "
     "printed. Ctrl-C ends it.",
     "osdtex studio models/cages/creature.obj models/exemplars/scales_cut.png\n"
     "osdtex studio shirt.obj weave.exr denim.exr -o out/shirt.obj --scale "
     "12\n",
     "DIR/NAME.obj, for when the page exports; NAME_constraints.json and "
     "NAME_state.json are beside it, and what they hold is gone on from "
     "(default: CAGE_studio.obj beside the cage)",
     studio_flags, false},
    {"regress", "DIR [CASE...]", 1, OTX_FLAG_OPERANDS_MAX,
     "run a table of cases and compare them with their references",
     "Runs the cases of DIR/table.json and holds them against DIR/reference: "
     "files by\ncontent, a rendered picture within 0.004, figures within "
     "stated tolerances.\nWrites report.html, results.json and results.csv "
     "into the output folder. Exit\nstatus 6: a case differs, crashed, or has "
     "no reference.",
     "osdtex regress tests/regress/suite -o /var/tmp/nightly\n"
     "osdtex regress tests/regress/suite -o /var/tmp/nightly --update all\n",
     "a folder, which is made where it is not there", regress_flags, false},
    {"plan", "JOB.json", 1, 1, "write a job for a farm",
     "A job is a list of tasks, each an `osdtex map` or `osdtex bake`. Writes "
     "it as\nmake, Slurm, OpenCue or Deadline take it, and prints how to hand "
     "it over.",
     "osdtex plan shirts.json --engine slurm -o farm/\n"
     "osdtex plan shirts.json -o farm/ && make -k -j 8 -f farm/Makefile\n",
     "a folder, which is made where it is not there", plan_flags, false},
    {"run", "JOB.json", 1, 1, "run a task of a job",
     "Runs one task, unless its outputs were made by this version from the "
     "same\ninputs and options. Paths in the job are relative to its folder.",
     "osdtex run shirts.json --task 3\n", NULL, run_flags, false},
    {"info", "[FILE]", 0, 1,
     "say what a cage, picture, mapping or colour configuration is",
     "Of an OBJ: faces, tags, components, boundary, size. Of a picture: size, "
     "type,\ncolour space as it would be resolved, whether it tiles. Of an "
     "OpenColorIO\nconfiguration, and without FILE of the one in force: its "
     "roles, spaces with all\ntheir names, and displays.",
     "osdtex info models/cages/creature.obj\n"
     "osdtex info models/exemplars/pebbles_tile.png\n"
     "osdtex info studio.ocio\n"
     "osdtex info\n",
     NULL, info_flags, true},
    {"methods", "[NAME]", 0, 1, "list the methods, or the settings of one",
     "Settings are given to `osdtex map` with --set KEY=VALUE.",
     "osdtex methods\n"
     "osdtex methods hierarchical\n",
     NULL, methods_flags, false},
    {"help", "[COMMAND]", 0, 1, "print help on a command", "",
     "osdtex help map\n", NULL, help_flags, false},
};

const otx_command *
otx_command_at(int index)
{
    const int count = (int)(sizeof commands / sizeof commands[0]);

    return index < count ? &commands[index] : NULL;
}

const char *
otx_command_flag_help(const otx_command *command, otx_flag_id flag)
{
    return flag == OTX_FLAG_OUTPUT ? command->output : otx_flag_at(flag)->help;
}

const otx_command *
otx_command_find(const char *name)
{
    for (int i = 0; otx_command_at(i); ++i)
        if (strcmp(otx_command_at(i)->name, name) == 0)
            return otx_command_at(i);
    return NULL;
}

static const char *
name_of(const void *list, int index)
{
    (void)list;
    return otx_command_at(index) ? otx_command_at(index)->name : NULL;
}

bool
otx_command_takes(const otx_command *command, const otx_flag_values *values)
{
    const int least =
        values->inputs.saved.path
            ? 0
            : command->operands_min - (values->text[OTX_FLAG_MATERIAL] ? 1 : 0);

    return values->operand_count >= least &&
           values->operand_count <= command->operands_max;
}

int
otx_command_refuse(const char *name)
{
    const char *near_name = otx_near_best(name, name_of, NULL);

    if (near_name)
        return otx_session_refuse(
            "there is no command '%s'; did you mean '%s'?", name, near_name);
    return otx_session_refuse(
        "there is no command '%s'; see osdtex --help", name);
}

/* flag.c -- the table of flags, and getopt_long over it. */
#include "cli/flag.h"
#include "cli/value.h"
#include "word/near.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

static const otx_flag flags[OTX_FLAG_COUNT] = {
    [OTX_FLAG_OUTPUT] =
        {"output", 'o', OTX_FLAG_GROUP_MAIN, "FILE", "what to write"},
    [OTX_FLAG_METHOD] =
        {"method", 0, OTX_FLAG_GROUP_MAIN, "NAME",
         "how to texture; `osdtex methods` lists them, auto chooses by the "
         "exemplar (default: the first)"},
    [OTX_FLAG_SCALE] =
        {"scale", 0, OTX_FLAG_GROUP_MAIN, "S[,S...]",
         "width of the exemplar on the surface, in scene units (default: a "
         "fifth of the diagonal of the cage's bounding box), and of those of "
         "--also in their order (default: as many texels to a unit as the "
         "first has)"},
    [OTX_FLAG_LEVEL] =
        {"level", 0, OTX_FLAG_GROUP_MAIN, "N|auto",
         "times the cage is subdivided, 0 to 10 (default auto: leaf edges of "
         "about a 48th of the exemplar, or 14 texels where that is less)"},
    [OTX_FLAG_SEED] =
        {"seed", 0, OTX_FLAG_GROUP_MAIN, "N",
         "another number, another result (default 1)"},
    [OTX_FLAG_SET] =
        {"set", 0, OTX_FLAG_GROUP_MAIN, "KEY=VALUE",
         "a setting of the method, as often as needed; `osdtex methods NAME` "
         "lists them"},
    [OTX_FLAG_ALSO] =
        {"also", 0, OTX_FLAG_GROUP_MAIN, "[MATERIAL=]FILE",
         "another exemplar, up to three times: for the faces of the cage that "
         "have this material (usemtl), or for those that --mask or "
         "--constraints say; EXEMPLAR goes everywhere else, and "
         "the seams between them run within --set transition=TEXELS of where "
         "they are asked for. =FILE for a name with a =; a folder is a "
         "material as --material takes it"},
    [OTX_FLAG_MATERIAL] =
        {"material", 0, OTX_FLAG_GROUP_MAIN, "FOLDER|PREFIX",
         "the set of maps in a folder, or of those whose names begin so, or "
         "in the layers of an EXR: "
         "colour, which stands in the place of EXEMPLAR, normal, roughness, "
         "height, metalness and occlusion, found by what their files are "
         "called; all get the same mapping and are written beside the colour"},
    [OTX_FLAG_MAP] =
        {"map", 0, OTX_FLAG_GROUP_MAIN, "KIND=FILE,...",
         "maps by name: normal, normal-dx (y down), roughness, gloss, height, "
         "metalness, occlusion, or arm, which holds occlusion, roughness and "
         "metalness"},
    [OTX_FLAG_NORMAL_Y] =
        {"normal-y", 0, OTX_FLAG_GROUP_MAIN, "up|down",
         "which way green points in the normal maps that are written: up as "
         "OpenGL has it (default), down as DirectX; NAME.usda and NAME.mtlx "
         "say so, NAME.mtl cannot"},
    [OTX_FLAG_MATCH_MAPS] =
        {"match-maps", 0, OTX_FLAG_GROUP_MAIN, "KIND[=WEIGHT],...",
         "what is compared where patches meet: color, and maps of the material "
         "by kind, as 'color,height=.5' (default: color alone)"},
    [OTX_FLAG_HEIGHT_RANGE] =
        {"height-range", 0, OTX_FLAG_GROUP_MAIN, "UNITS",
         "scene units from black to white of the height map (default: a "
         "twentieth of the exemplar's width)"},
    [OTX_FLAG_HEIGHT_MIDDLE] =
        {"height-middle", 0, OTX_FLAG_GROUP_MAIN, "VALUE",
         "what the height map says where the surface stays where it is "
         "(default .5)"},
    [OTX_FLAG_MASK] =
        {"mask", 0, OTX_FLAG_GROUP_MAIN, "FILE",
         "a picture on the cage's own UVs that says where exemplars go: black "
         "for EXEMPLAR; red, green and blue for the first, second and third "
         "--also; what weighs most on a face wins. With <UDIM> or <UVTILE> in "
         "its name, as 'mask.<UDIM>.exr', a picture for each tile"},
    [OTX_FLAG_FIRST_PATCH] =
        {"first-patch", 0, OTX_FLAG_GROUP_MAIN, "FACE,U,V,ANGLE",
         "begin at this face of the cage (0-based): its middle at U,V of the "
         "exemplar, its first edge at ANGLE degrees there; the direction "
         "spreads"},
    [OTX_FLAG_CONSTRAINTS] =
        {"constraints", 0, OTX_FLAG_GROUP_MAIN, "FILE",
         "directions and sizes that the texture is to have at faces of the "
         "cage or at points, and which exemplar: a .json or .csv"},
    [OTX_FLAG_KEEP] =
        {"keep", 0, OTX_FLAG_GROUP_MAIN, "OLD.osdtex",
         "a saved mapping of the cage before it was changed: what lies where "
         "it did shows what it did, what has moved is relaxed, or covered anew "
         "where it would be stretched too far; method, settings, scale "
         "and level are those of OLD"},
    [OTX_FLAG_REST] =
        {"rest", 0, OTX_FLAG_GROUP_MAIN, "REST.obj",
         "the cage at rest: the mapping is made on it, and goes with its faces "
         "to CAGE, a frame of an animation; UVs are the same on every frame"},
    [OTX_FLAG_REDO] =
        {"redo", 0, OTX_FLAG_GROUP_MAIN, "FACE|X,Y,Z,RADIUS",
         "not this texture here: cover a face of the cage (0-based), or what "
         "lies around a point, with another one; --seed N tries others "
         "(default 1)"},
    [OTX_FLAG_REACH] =
        {"reach", 0, OTX_FLAG_GROUP_MAIN, "DIST",
         "scene units along the surface beyond which an edit changes nothing, "
         "where a constraint names no reach of its own (default: half the "
         "exemplar's width)"},
    [OTX_FLAG_FOLLOW] =
        {"follow", 0, OTX_FLAG_GROUP_MAIN, "WHAT",
         "what directions follow where no constraint says otherwise: smooth, "
         "up, edges (the cage's edge loops), curvature (least bending), or an "
         "axis X,Y,Z (default: what the file of constraints says, else "
         "smooth)"},
    [OTX_FLAG_ALONG] =
        {"along", 0, OTX_FLAG_GROUP_MAIN, "AXIS",
         "of a stack (osdtex stack): what its slices follow, unless "
         "constraints name a material: x, y, z, from the lowest to the highest "
         "point (default y); curvature, ridges, hollows; occlusion; "
         "boundary[:LENGTH], creases[:LENGTH], the way from them; red, green, "
         "blue of the vertices' colours; scatter[:LENGTH], another slice by "
         "chance every so far; map:FILE, a picture from black to white on the "
         "cage's own UVs, <UDIM> in its name as of --mask; with a minus, as "
         "-y, the other way"},
    [OTX_FLAG_PLACE] =
        {"place", 0, OTX_FLAG_GROUP_MAIN, "FILE",
         "pictures that lie over the texture where they are put, once or many "
         "times, such as a label, a scar or knots in bark: a .json or .csv "
         "that says which, at what face or point, how large and which way up"},
    [OTX_FLAG_SYMMETRY] =
        {"symmetry", 0, OTX_FLAG_GROUP_MAIN, "1|2|4",
         "a field of arrows, of lines or of crosses (default: what the file "
         "of constraints says, else 2)"},
    [OTX_FLAG_OCTAVES] =
        {"octaves", 0, OTX_FLAG_GROUP_MAIN, "O",
         "how far the texture's size gives way so that rows can follow the "
         "surface's curvature (default 0: not at all)"},
    [OTX_FLAG_EXEMPLAR_CLASS] =
        {"exemplar-class", 0, OTX_FLAG_GROUP_MAIN, "NAME",
         "what the exemplar is: isotropic, directional, weak-lattice or "
         "lattice (default: it is analysed; see `osdtex info`)"},
    [OTX_FLAG_GENERATORS] =
        {"generators", 0, OTX_FLAG_GROUP_MAIN, "X,Y,X,Y",
         "two vectors, in texels, by which the exemplar repeats (default: it "
         "is analysed)"},
    [OTX_FLAG_TILE_LEVEL] =
        {"tile-level", 0, OTX_FLAG_GROUP_MAIN, "N",
         "method tile: subdivision level whose quads get one tile each "
         "(default: by the scale)"},
    [OTX_FLAG_BOUNDARIES] =
        {"boundaries", 0, OTX_FLAG_GROUP_MAIN, "N",
         "kinds of edges, 1 to 3, each with two sides: (2N)^4 tiles (default "
         "1)"},
    [OTX_FLAG_CORNERS] =
        {"corners", 0, OTX_FLAG_GROUP_MAIN, "N",
         "kinds of vertices, 1 to 4: with 2 or more, vertices show the picture "
         "as it is wherever the tiles around them lie alike; N^4 times the "
         "tiles, which --for keeps few (default 1)"},
    [OTX_FLAG_TILE_SIZE] =
        {"tile-size", 0, OTX_FLAG_GROUP_MAIN, "PX",
         "texels of a tile's side with its gutters, a power of two (default "
         "128, less for small pictures)"},
    [OTX_FLAG_GUTTER] =
        {"gutter", 0, OTX_FLAG_GROUP_MAIN, "PX",
         "texels beyond the edge of a tile, a power of two; mip levels show "
         "the picture up to texels of twice that (default 4)"},
    [OTX_FLAG_ORIENTED] =
        {"oriented", 0, OTX_FLAG_GROUP_MAIN, NULL,
         "for pictures with a direction: rows and columns have edges of their "
         "own, and nothing is turned by 90 degrees"},
    [OTX_FLAG_EDGE_TEMPLATE] =
        {"edge-template", 0, OTX_FLAG_GROUP_MAIN, "X,Y,ANGLE[,LENGTH]",
         "what the next boundary shows: a segment of the picture by its middle "
         "in texels from the lower left, angle in degrees and length (default: "
         "chosen by the cuts that come of it)"},
    [OTX_FLAG_CORNER_TEMPLATE] =
        {"corner-template", 0, OTX_FLAG_GROUP_MAIN, "X,Y",
         "what the first kind of vertex shows, in texels from the lower left "
         "(default: chosen likewise)"},
    [OTX_FLAG_BACKGROUND] =
        {"background", 0, OTX_FLAG_GROUP_MAIN, "X0,Y0,X1,Y1",
         "insides of tiles come from these texels only (default: from all)"},
    [OTX_FLAG_BLEND] =
        {"blend", 0, OTX_FLAG_GROUP_MAIN, "cut|ramp",
         "how edges meet insides: cut, or ramp, the cross-fade of the method "
         "as published, for comparison; its tiles jump at vertices (default "
         "cut)"},
    [OTX_FLAG_SLICES] =
        {"slices", 0, OTX_FLAG_GROUP_MAIN, "N",
         "pictures from one to the next, with both, or of --vary, 2 to 64 "
         "(default 8, with --vary 4)"},
    [OTX_FLAG_STACK_SIZE] =
        {"size", 0, OTX_FLAG_GROUP_MAIN, "PX",
         "texels of the slices' width (default: as the first picture has)"},
    [OTX_FLAG_MASKS] =
        {"masks", 0, OTX_FLAG_GROUP_MAIN, "FILE,FILE,...",
         "pictures that are white where each picture's features are; an empty "
         "name: they are found (default: all are; they are written to "
         "NAME_mask1.png, ... to be changed and given here)"},
    [OTX_FLAG_FEATURES] =
        {"features", 0, OTX_FLAG_GROUP_MAIN, "auto|spots|joints",
         "what to look for: spots are darker or lighter than the rest, joints "
         "are narrow besides (default auto: what parts the pictures more "
         "clearly)"},
    [OTX_FLAG_MORPH] =
        {"morph", 0, OTX_FLAG_GROUP_MAIN, "auto|advect|relax|linear",
         "how features go over: advect moves them, for networks such as "
         "joints; linear blends their distances, for spots; relax does both "
         "(default auto: what leaves the fewest crumbs)"},
    [OTX_FLAG_VARY] =
        {"vary", 0, OTX_FLAG_GROUP_MAIN, NULL,
         "of one EXEMPLAR: pictures that share its features and otherwise have "
         "nothing in the same place, so that `osdtex map --along scatter` "
         "hides "
         "the period of a tile"},
    [OTX_FLAG_FOR] =
        {"for", 0, OTX_FLAG_GROUP_MAIN, "CAGE.obj",
         "make only the tiles that `osdtex map CAGE.obj` needs with the same "
         "--level, --tile-level, --scale, --seed and --set"},
    [OTX_FLAG_BAKE] =
        {"bake", 0, OTX_FLAG_GROUP_BAKE, NULL,
         "also write what `osdtex bake` writes"},
    [OTX_FLAG_BAKE_UVS] =
        {"uvs", 0, OTX_FLAG_GROUP_BAKE, "auto|own|atlas|charts",
         "texture coordinates to bake onto: the cage's own, an atlas with a "
         "block for every face, or charts: few islands that lie flat, for "
         "painters (default auto: its own where they can be baked "
         "onto, on UDIM tiles, with area, not on top of each other)"},
    [OTX_FLAG_RESOLUTION] =
        {"resolution", 0, OTX_FLAG_GROUP_BAKE, "PX",
         "texels of a UDIM tile's side (default 4096), and of the texture that "
         "pastes are baked into (default: as fine as the exemplar)"},
    [OTX_FLAG_TEXELS_PER_UNIT] =
        {"texels-per-unit", 0, OTX_FLAG_GROUP_BAKE, "D",
         "density of an atlas, which takes as many UDIM tiles as that needs "
         "(default: what fills one tile)"},
    [OTX_FLAG_MARGIN] =
        {"margin", 0, OTX_FLAG_GROUP_BAKE, "PX",
         "texels beyond the rims of charts that go on as the surface does; of "
         "an atlas 4, 8, 16, 32 or 64 (default: up to 16, as there is room)"},
    [OTX_FLAG_SEAM_BLEND] =
        {"seam-blend", 0, OTX_FLAG_GROUP_BAKE, "PX",
         "texels over which patches are blended where they meet (default 0: "
         "not at all)"},
    [OTX_FLAG_HEAL] =
        {"heal", 0, OTX_FLAG_GROUP_BAKE, "PX|auto",
         "make a band of this many texels of the exemplar across seams anew, "
         "so that its structure goes on through them; auto: of 64, only where "
         "seams show and it helps (default 0: none)"},
    [OTX_FLAG_EXTRA] =
        {"extra", 0, OTX_FLAG_GROUP_BAKE, "patch,uv,stretch,seam,source,slice",
         "also bake these, as 32-bit NAME_patch.<UDIM>.exr and so on"},
    [OTX_FLAG_PREVIEW_PNG] =
        {"preview-png", 0, OTX_FLAG_GROUP_BAKE, NULL,
         "also write NAME.<UDIM>.png and NAME_preview.mtl for programs that "
         "read no EXR"},
    [OTX_FLAG_UDIM] =
        {"udim", 0, OTX_FLAG_GROUP_BAKE, "N",
         "bake this tile only, 1001 and on, beside those of other runs"},
    [OTX_FLAG_NORMALS] =
        {"normals", 0, OTX_FLAG_GROUP_MAIN, NULL,
         "also write normals (vn): those of the limit surface, one for each "
         "side of an infinitely sharp crease"},
    [OTX_FLAG_PASTES] =
        {"pastes", 0, OTX_FLAG_GROUP_MAIN, NULL,
         "write what --method lapped pastes as layers of faces that lie over "
         "one another, with NAME_pastes.exr and NAME.usda, instead of a bake"},
    [OTX_FLAG_UNITS] =
        {"units", 0, OTX_FLAG_GROUP_BAKE, "m|cm|mm|km|in|ft|METRES",
         "what a scene unit is, for NAME.usda (default: m with --for blender "
         "or houdini, else cm)"},
    [OTX_FLAG_UP] =
        {"up", 0, OTX_FLAG_GROUP_BAKE, "y|z",
         "which axis points up, for NAME.usda and for pictures; nothing is "
         "turned (default y)"},
    [OTX_FLAG_PREVIEW] =
        {"preview", 0, OTX_FLAG_GROUP_MAIN, "FILE",
         "also render the result to a .png or .exr"},
    [OTX_FLAG_JSON_REPORT] =
        {"json-report", 0, OTX_FLAG_GROUP_MAIN, "FILE",
         "also write what was done, decided and measured"},
    [OTX_FLAG_SCHEME] =
        {"scheme", 0, OTX_FLAG_GROUP_CAGE, "catmark|loop|bilinear|none",
         "subdivision scheme; none: a plain mesh, whose own vertices and faces "
         "are textured as they are (default catmark)"},
    [OTX_FLAG_BOUNDARY] =
        {"boundary", 0, OTX_FLAG_GROUP_CAGE, "none|edgeOnly|edgeAndCorner",
         "how the rim is subdivided (default: the file's tag, else "
         "edgeAndCorner)"},
    [OTX_FLAG_FVAR] =
        {"fvar", 0, OTX_FLAG_GROUP_CAGE,
         "none|cornersOnly|cornersPlus1|cornersPlus2|boundaries|all",
         "how the cage's own UVs are smoothed (default: the file's tag, else "
         "cornersPlus1)"},
    [OTX_FLAG_WELD] =
        {"weld", 0, OTX_FLAG_GROUP_CAGE, "[DIST]",
         "let vertices that lie within this distance of each other, in scene "
         "units, be one (without a number: a millionth of the bounding box's "
         "diagonal)"},
    [OTX_FLAG_LAYER] =
        {"layer", 0, OTX_FLAG_GROUP_COLOUR, "NAME",
         "layer or part of an EXR that is the picture (default: plain R, G, B "
         "of any part, else what is called beauty, rgba, combined or the "
         "like)"},
    [OTX_FLAG_SAVE] =
        {"save", 0, OTX_FLAG_GROUP_MAIN, "NAME.osdtex",
         "also save the mapping: --from NAME.osdtex makes from it, without "
         "mapping anew, other bakes, tiles, sizes and pictures"},
    [OTX_FLAG_FROM] =
        {"from", 0, OTX_FLAG_GROUP_COLOUR, "SPACE|NAME.osdtex",
         "colour space of the exemplar (default: what the file says, else "
         "sRGB for integers and scene_linear for floats); or a saved mapping "
         "to start from, with the cage and the picture that it names, or with "
         "CAGE (the same faces in another pose) and EXEMPLAR (another picture "
         "of the same size) in their places"},
    [OTX_FLAG_TO] =
        {"to", 0, OTX_FLAG_GROUP_COLOUR, "SPACE",
         "colour space of the textures that are written (default: role "
         "scene_linear, which is linear Rec.709 without a configuration)"},
    [OTX_FLAG_RECEIVER] =
        {"for", 0, OTX_FLAG_GROUP_COLOUR, "blender|maya|houdini|usd|web",
         "the program that will read the textures: sets their colour space, "
         "where --to does not, to what it takes a texture to be in by default, "
         "and their type, which is 8-bit sRGB PNG for the web"},
    [OTX_FLAG_MATCH_SPACE] =
        {"match-space", 0, OTX_FLAG_GROUP_COLOUR, "SPACE",
         "display-like space in which colours are compared (default: role "
         "color_picking, else sRGB)"},
    [OTX_FLAG_MATCH_IN] =
        {"match-in", 0, OTX_FLAG_GROUP_COLOUR, "hsv|hsv-cylinder|lab|rgb",
         "coordinates in which distances are taken (default hsv: the cone; "
         "osdtex tiles: lab)"},
    [OTX_FLAG_WRAP] =
        {"wrap", 0, OTX_FLAG_GROUP_COLOUR, "auto|no|yes",
         "whether the exemplar tiles (default auto: tested, for each axis)"},
    [OTX_FLAG_TILEABLE] =
        {"tileable", 0, OTX_FLAG_GROUP_COLOUR, "auto|keep|make",
         "what to do with an exemplar that does not tile: keep it, and stay "
         "inside it; make it tile by cuts, which gives patches more places to "
         "come from, and another texture than the file's; auto: make it, where "
         "that is judged good (default keep: UVs fit the file, and maps that "
         "belong to it)"},
    [OTX_FLAG_COLORCONFIG] =
        {"colorconfig", 0, OTX_FLAG_GROUP_COLOUR, "FILE",
         "OpenColorIO configuration (default: $OCIO, else a built-in one)"},
    [OTX_FLAG_CAMERA] =
        {"camera", 0, OTX_FLAG_GROUP_PICTURE, "NAME|X,Y,Z,TX,TY,TZ,FOV",
         "three_quarter, front, back, left, right or top; seam1, seam2 ...: "
         "close to where seams show, the worst first; or eye, target and the "
         "picture's height in degrees (default three_quarter)"},
    [OTX_FLAG_TURN] =
        {"turn", 0, OTX_FLAG_GROUP_PICTURE, "DEGREES",
         "turn the named camera about the vertical"},
    [OTX_FLAG_SIZE] =
        {"size", 0, OTX_FLAG_GROUP_PICTURE, "WxH", "pixels (default 1280x720)"},
    [OTX_FLAG_SAMPLES] =
        {"samples", 0, OTX_FLAG_GROUP_PICTURE, "N",
         "N x N rays a pixel, 1 to 16 (default 4)"},
    [OTX_FLAG_SHOW] =
        {"show", 0, OTX_FLAG_GROUP_PICTURE, "WHAT",
         "of the picture or preview: texture, patches, stretch, seams, uv, "
         "normals, flat, field, "
         "singularities, cells or, of a mapping that is saved, windows: how "
         "far "
         "what is seen is from the exemplar; clay: grey with a highlight; "
         "sheet: a contact sheet with the three worst seams (default texture)"},
    [OTX_FLAG_DRAW] =
        {"draw", 0, OTX_FLAG_GROUP_PICTURE, "wire|uv|wire,uv",
         "over the picture: wire, the edges of the cage, or of the faces of a "
         "MODEL.obj; uv, lines of equal u (red) and v (green), eight to the "
         "texture"},
    [OTX_FLAG_FRAMES] =
        {"frames", 0, OTX_FLAG_GROUP_PICTURE, "N",
         "of a turntable, once round the named camera's vertical, into "
         "-o NAME.%04d.png or .exr, numbered from 1 (default 48)"},
    [OTX_FLAG_UNLIT] =
        {"unlit", 0, OTX_FLAG_GROUP_PICTURE, NULL,
         "the colours as they are, without light"},
    [OTX_FLAG_PLAIN] =
        {"plain", 0, OTX_FLAG_GROUP_PICTURE, NULL,
         "of a material the colour alone, lit as if it were matte"},
    [OTX_FLAG_DISPLACE] =
        {"displace", 0, OTX_FLAG_GROUP_PICTURE, NULL,
         "of the picture or preview: move the mesh by the map of heights"},
    [OTX_FLAG_NO_SHADOWS] =
        {"no-shadows", 0, OTX_FLAG_GROUP_PICTURE, NULL,
         "light that the model does not keep off itself"},
    [OTX_FLAG_NO_BROWSER] =
        {"no-browser", 0, OTX_FLAG_GROUP_MAIN, NULL,
         "only print the page's address, and open no browser"},
    [OTX_FLAG_THREADS] =
        {"threads", 0, OTX_FLAG_GROUP_COMMON, "N",
         "threads, 0 for all cores; the result does not depend on it (default: "
         "$OSDTEX_THREADS, $CUE_THREADS, $SLURM_CPUS_PER_TASK, else 0)"},
    [OTX_FLAG_MEMORY_LIMIT] =
        {"memory-limit", 0, OTX_FLAG_GROUP_COMMON, "SIZE",
         "stop rather than use more: bytes, or 500M, 8G; 0 for none (default: "
         "three quarters of the machine's)"},
    [OTX_FLAG_DRY_RUN] =
        {"dry-run", 'n', OTX_FLAG_GROUP_COMMON, NULL,
         "read and check the inputs, say what would be done, write nothing"},
    [OTX_FLAG_UPDATE] =
        {"update", 'u', OTX_FLAG_GROUP_COMMON, NULL,
         "do nothing when the outputs were made by this build from the same "
         "inputs and options, and are whole"},
    [OTX_FLAG_REPLACE] =
        {"replace", 0, OTX_FLAG_GROUP_COMMON, NULL,
         "also replace files of another job, or of another program"},
    [OTX_FLAG_UPDATE_CASE] =
        {"update", 0, OTX_FLAG_GROUP_MAIN, "CASE|all",
         "run this case, or all, and make what comes out the reference"},
    [OTX_FLAG_PROGRAM] =
        {"program", 0, OTX_FLAG_GROUP_MAIN, "COMMAND",
         "what runs the cases or tasks: another build of osdtex, for regress "
         "perhaps behind other words (default: this program)"},
    [OTX_FLAG_HISTORY] =
        {"history", 0, OTX_FLAG_GROUP_MAIN, "FILE",
         "JSON lines to which the figures of this run are added, and from "
         "which trends are drawn (default: history.jsonl beside the report)"},
    [OTX_FLAG_ENGINE] =
        {"engine", 0, OTX_FLAG_GROUP_MAIN, "make|slurm|opencue|deadline",
         "for whom the job is written (default make)"},
    [OTX_FLAG_TASK] =
        {"task", 0, OTX_FLAG_GROUP_MAIN, "K", "which task of the job, from 0"},
    [OTX_FLAG_MAN] =
        {"man", 0, OTX_FLAG_GROUP_HIDDEN, NULL,
         "print the man page, or that of a command"},
    [OTX_FLAG_COMPLETION] =
        {"completion", 0, OTX_FLAG_GROUP_HIDDEN, NULL,
         "print a completion script, for bash, zsh or fish"},
    [OTX_FLAG_VERBOSE] =
        {"verbose", 'v', OTX_FLAG_GROUP_COMMON, NULL,
         "also say how long each stage took"},
    [OTX_FLAG_QUIET] =
        {"quiet", 'q', OTX_FLAG_GROUP_COMMON, NULL, "only say what is wrong"},
    [OTX_FLAG_HELP] =
        {"help", 'h', OTX_FLAG_GROUP_COMMON, NULL, "print this and exit"},
    [OTX_FLAG_VERSION] =
        {"version", 0, OTX_FLAG_GROUP_COMMON, NULL,
         "print the version and exit"},
};

const otx_flag *
otx_flag_at(otx_flag_id id)
{
    return &flags[id];
}

const char *
otx_flag_group_title(otx_flag_group group)
{
    static const char *const titles[] = {
        "Options",     "The bake",
        "The cage",    "The exemplar and its colours",
        "The picture", "Common options",
        NULL};

    return titles[group];
}

/* Flags as getopt_long wants them; `val` is id + 256 so that letters and ids
 * never meet. */
typedef struct getopt_table
{
    struct option longs[OTX_FLAG_COUNT + 1];
    char shorts[2 * OTX_FLAG_COUNT + 2];
} getopt_table;

enum
{
    ID_BASE = 256
};

/* Arguments in brackets may be left out. */
static bool
is_optional(const otx_flag *f)
{
    return f->argument && f->argument[0] == '[' &&
           f->argument[strlen(f->argument) - 1] == ']';
}

static getopt_table
make_table(const otx_flag_id *ids)
{
    getopt_table table = {0};
    int count = 0;
    char *s = table.shorts;

    *s++ = ':'; /* a missing argument is told from an unknown flag */
    for (; *ids != OTX_FLAG_COUNT; ++ids)
    {
        const otx_flag *f = &flags[*ids];

        table.longs[count++] = (struct option){
            f->name,
            is_optional(f) ? optional_argument
            : f->argument  ? required_argument
                           : no_argument,
            NULL, ID_BASE + (int)*ids};
        if (f->letter)
            *s++ = f->letter;
        if (f->letter && f->argument)
            *s++ = ':';
    }
    return table;
}

static const char *
name_of(const void *ids, int index)
{
    const otx_flag_id id = ((const otx_flag_id *)ids)[index];

    return id == OTX_FLAG_COUNT ? NULL : flags[id].name;
}

static bool
is_flag(const char *name)
{
    for (int i = 0; i < OTX_FLAG_COUNT; ++i)
        if (strcmp(flags[i].name, name) == 0)
            return true;
    return false;
}

static bool
complain(const char *word, const otx_flag_id *ids)
{
    char name[64];
    const char *near_name;

    if (strncmp(word, "--", 2) != 0)
    {
        fprintf(
            stderr, "osdtex: error: there is no option '%s'; see --help\n",
            word);
        return false;
    }
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    near_name = otx_near_best(name, name_of, ids);
    if (near_name && strcmp(near_name, name) == 0)
        fprintf(stderr, "osdtex: error: '--%s' takes no value\n", name);
    else if (is_flag(name))
        fprintf(
            stderr,
            "osdtex: error: '--%s' cannot stand here: it is for other "
            "commands; see --help\n",
            name);
    else if (near_name)
        fprintf(
            stderr,
            "osdtex: error: there is no option '--%s'; did you mean '--%s'?\n",
            name, near_name);
    else
        fprintf(
            stderr, "osdtex: error: there is no option '--%s'; see --help\n",
            name);
    return false;
}

static bool
take_edge(const char *text, otx_flag_values *out)
{
    if (out->edge_count == OTX_FLAG_EDGES_MAX)
    {
        fprintf(stderr, "osdtex: error: --edge-template is given too often\n");
        return false;
    }
    out->edges[out->edge_count++] = text;
    return true;
}

static bool
take_also(const char *text, otx_flag_values *out)
{
    if (out->also_count == OTX_FLAG_ALSO_MAX)
    {
        fprintf(stderr, "osdtex: error: --also is given too often\n");
        return false;
    }
    out->also[out->also_count++] = text;
    return true;
}

/* KEY=VALUE into the list; argv is ours to cut. */
static bool
take_setting(char *text, otx_flag_values *out)
{
    char *equals = strchr(text, '=');

    if (!equals || equals == text)
    {
        fprintf(
            stderr, "osdtex: error: --set takes KEY=VALUE, not '%s'\n", text);
        return false;
    }
    if (out->setting_count == OTX_FLAG_SETTINGS_MAX)
    {
        fprintf(stderr, "osdtex: error: --set is given too often\n");
        return false;
    }
    *equals = '\0';
    out->settings[out->setting_count++] = (osdtex_setting){text, equals + 1};
    return true;
}

static bool
take_operands(int argc, char **argv, otx_flag_values *out)
{
    for (int i = optind; i < argc; ++i)
    {
        if (out->operand_count == OTX_FLAG_OPERANDS_MAX)
        {
            fprintf(
                stderr, "osdtex: error: '%s' is one file too many\n", argv[i]);
            return false;
        }
        out->operands[out->operand_count++] = argv[i];
    }
    return true;
}

/* getopt takes an argument that may be left out behind a = only; a number that
 * stands by itself is one, too. */
static bool
is_number(const char *word)
{
    double value;

    return word && otx_value_real(word, &value);
}

static int
id_of_letter(int letter)
{
    for (int i = 0; i < OTX_FLAG_COUNT; ++i)
        if (flags[i].letter == letter)
            return i;
    return OTX_FLAG_COUNT;
}

bool
otx_flag_is_taken(const otx_flag_values *values, otx_flag_id id)
{
    const otx_flag_id *ids = values->ids;

    while (*ids != OTX_FLAG_COUNT && *ids != id)
        ++ids;
    return *ids == id;
}

bool
otx_flag_parse(
    int argc, char **argv, const otx_flag_id *ids, otx_flag_values *out)
{
    const getopt_table table = make_table(ids);

    *out = (otx_flag_values){.ids = ids};
    /* getopt puts the operands last. */
    for (; out->word_count < argc && out->word_count < OTX_FLAG_WORDS_MAX;
         ++out->word_count)
        out->words[out->word_count] = argv[out->word_count];
    optind = 0; /* glibc: start afresh */
    opterr = 0;
    for (;;)
    {
        const int at = optind > 0 ? optind : 1;
        const int c = getopt_long(argc, argv, table.shorts, table.longs, NULL);
        int id;

        if (c == -1)
            return take_operands(argc, argv, out);
        if (c == '?' && optopt > 0 && optopt < ID_BASE)
            return complain((const char[]){'-', (char)optopt, '\0'}, ids);
        if (c == '?')
            return complain(argv[optind > 1 ? optind - 1 : at], ids);
        if (c == ':')
        {
            fprintf(
                stderr, "osdtex: error: '%s' needs a value\n",
                argv[optind - 1]);
            return false;
        }
        id = c >= ID_BASE ? c - ID_BASE : id_of_letter(c);
        if (id == OTX_FLAG_FROM && otx_value_has_extension(optarg, ".osdtex"))
        {
            out->inputs.saved.path = optarg;
            continue;
        }
        out->text[id] = optarg ? optarg : "";
        if (!optarg && is_optional(&flags[id]) && is_number(argv[optind]))
            out->text[id] = argv[optind++];
        if (id == OTX_FLAG_SET && !take_setting(optarg, out))
            return false;
        if (id == OTX_FLAG_EDGE_TEMPLATE && !take_edge(optarg, out))
            return false;
        if (id == OTX_FLAG_ALSO && !take_also(optarg, out))
            return false;
    }
}

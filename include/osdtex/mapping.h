/* mapping.h -- UVs into the exemplar for every leaf face.
 *
 *     osdtex_map_options options = osdtex_map_options_default();
 *     const osdtex_mapping_info *info;
 *     osdtex_mapping *mapping;
 *
 *     options.scale = 2.5;          // the picture is 2.5 scene units wide
 *     osdtex_map(context, cage, exemplar, &options, &mapping);
 *     info = osdtex_mapping_describe(mapping);
 *     for (osdtex_index c = 0; c < info->corner_count; ++c)
 *         use_uv(c, info->uvs[2 * c], info->uvs[2 * c + 1]);
 *
 * Corners are those of
 * osdtex_surface_describe(osdtex_mapping_surface(mapping)), whose face_first
 * and face_verts say of which face and vertex they are. From here a mapping is
 * written as OBJ (below), baked (bake.h, textures.h), measured (report.h),
 * rendered (render.h), or saved and read again.
 *
 * A mapping keeps its surface and its exemplars. It is immutable; contexts may
 * share it. */
#ifndef OSDTEX_MAPPING_H
#define OSDTEX_MAPPING_H

#include <osdtex/exemplar.h>
#include <osdtex/field.h>
#include <osdtex/method.h>
#include <osdtex/surface.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_mapping osdtex_mapping;

enum
{
    OSDTEX_EXEMPLARS_MAX = 4,       /* of a mapping */
    OSDTEX_PLACE_PICTURES_MAX = 256 /* that lie over it; each may many times */
};

/* One more exemplar of a mapping. */
typedef struct osdtex_also
{
    const osdtex_exemplar *exemplar; /* kept as the first is */
    const char *material; /* of the cage: its faces show it; NULL none */
    double scale; /* width in scene units; 0: as many texels to a unit as
                   * the first has */
} osdtex_also;

/* For osdtex_map_options.heal. */
#define OSDTEX_HEAL_AUTO (-1.0)

typedef struct osdtex_map_options
{
    size_t size;
    const char *method; /* NULL: the first of the table; "auto": by the
                         * exemplar */
    const osdtex_setting *settings; /* [setting_count], later ones win */
    int32_t setting_count;
    osdtex_index first_face; /* of the cage: where to begin; -1 free */
    double first_u;          /* UV that the middle of that face gets */
    double first_v;
    double first_angle; /* radians, counter-clockwise in the picture */
    double scale;       /* width of the exemplar in scene units; 0:
                         * osdtex_cage_info.default_scale */
    uint64_t seed;
    /* A file of constraints on direction, scale and exemplars, JSON or CSV;
     * NULL none. */
    const char *constraints;
    /* "isotropic", "directional", "weak-lattice" or "lattice"; NULL: the
     * exemplar is analysed. */
    const char *exemplar_class;
    /* Two vectors, in texels, by which the exemplar repeats; all 0: analysed.
     */
    double generators[4];
    /* What the field follows, as for osdtex_field_options; NULL: what the file
     * of constraints says, else nothing. */
    const char *follow;
    /* Up to three exemplars more, for methods that mix them. Which a face shows
     * is said by its material, by a mask, by a table or by the constraints
     * (docs/notes/mask.md); the first exemplar goes wherever nothing is said.
     */
    const osdtex_also *also; /* [also_count] */
    int32_t also_count;
    int32_t reserved;
    /* A picture on the cage's UVs: black asks for the first exemplar, red,
     * green and blue for the second to fourth. It fills the unit square; UVs
     * beyond it need a picture for each UDIM tile that a face lies in, and a
     * name that holds <UDIM> for 1001 and on, or <UVTILE> for u1_v1:
     * "mask.<UDIM>.exr". They are read one after the other. NULL none. */
    const char *mask;
    /* [face_count of the cage] 0 the first exemplar, 1 the second, and so on;
     * NULL none. */
    const uint8_t *face_exemplars;
    /* The same as `mask`, from memory: RGB or RGBA on the unit square of the
     * cage's UVs. Copied from while the call lasts. NULL none. */
    const osdtex_image *mask_image;
    /* More constraints, after those of the file. */
    const osdtex_constraint *constraint_items; /* [constraint_count] */
    int32_t constraint_count;
    /* Refinement of the cage, 0 .. OSDTEX_LEVEL_MAX, or OSDTEX_LEVEL_AUTO: as
     * the exemplar's texels ask for. */
    int32_t level;
    /* The cage as it was refined before, for hosts that look at the surface or
     * map it several times; `level` then says nothing. NULL: it is refined by
     * the call. */
    const osdtex_surface *surface;
    /* A field to follow, in the place of `constraints` and `follow`: directions
     * and sizes are those of the field, also where it was edited. Its surface
     * is the one that is mapped. Methods follow it where they follow
     * constraints, which is where the exemplar has a direction. NULL none. */
    const osdtex_field *field;
    /* Width in texels of a band across seams that is made anew from the
     * exemplar, texel by texel, so that structure goes on through it; 0: seams
     * stay as they were cut; OSDTEX_HEAL_AUTO: 64, only of seams that show, and
     * where it helps. Bakes and pictures show it, UVs cannot. */
    double heal;
    /* Where the slices of a stack go (stack.h), unless constraints say it by
     * their material. 0 is its first slice and 1 its last:
     *
     *   "x" "y" "z"  from the lowest point of the surface to the highest
     *   "curvature"  from the deepest hollow to the sharpest ridge
     *   "ridges"     0 but on ridges; "hollows": 0 but in hollows
     *   "occlusion"  from where the sky is seen to where it is not
     *   "boundary"   from boundaries and holes to what is farthest from them;
     *                "boundary:L": to L scene units along the surface
     *   "creases"    likewise from the creases of the cage
     *   "red" "green" "blue"  what the colours of the cage's vertices say
     *   "scatter"    a slice by chance, another one every half width of the
     *                exemplar; "scatter:L": every L scene units
     *   "map:FILE"   a picture from black to white on the cage's UVs; with
     *                <UDIM> or <UVTILE> in its name one for each tile
     *
     * and with a minus before it the other way round. NULL: "y". Of other
     * exemplars it says nothing. */
    const char *along;
    /* A mapping that is to be kept on a cage that has changed: leaves whose
     * shape has hardly changed show what they did, others are relaxed between
     * them, or covered anew where they are stretched too far. Where the cage
     * has the same faces that is told by their numbers and to the bit, else by
     * where leaves lie. It decides method, settings, scale and, unless `level`
     * does, the level. One that was read for the changed cage
     * (osdtex_mapping_read_options.cage) knows the shape that it was saved
     * with. What was asked of it by constraints is not asked again. NULL none.
     */
    const struct osdtex_mapping *keep;
    /* A file of pictures that are placed over what the method makes, JSON or
     * CSV: docs/formats-place.md. Bakes and pictures show them, UVs cannot.
     * NULL none. */
    const char *place;
} osdtex_map_options;

static inline osdtex_map_options
osdtex_map_options_default(void)
{
    osdtex_map_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.first_face = -1;
    options.first_u = 0.5;
    options.first_v = 0.5;
    options.seed = 1;
    options.level = OSDTEX_LEVEL_AUTO;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void osdtex_map_options_init(osdtex_map_options *out, size_t bytes);

typedef struct osdtex_mapping_info
{
    const char *method;
    double scale;                   /* as resolved */
    osdtex_index face_count;        /* of the surface */
    osdtex_index corner_count;      /* of the surface */
    const float *uvs;               /* [corner_count * 2] */
    const osdtex_index *face_patch; /* [face_count], -1 on holes */
    osdtex_index patch_count;
    int32_t exemplar_count;        /* 1 unless there are more */
    const uint8_t *patch_exemplar; /* [patch_count] which one each patch is
                                    * from, 0 the first; NULL: all are */
} osdtex_mapping_info;

/* Covers a cage with an exemplar: the whole of osdtex in one call.
 *
 *     osdtex_map(context, cage, exemplar, NULL, &mapping);
 *
 *   cage      to be covered; NULL only where options->surface is given
 *   exemplar  what covers it
 *   options   NULL: the defaults, which show the picture five times across the
 *             cage and refine until leaf edges are about 14 texels long
 *
 * Takes seconds for tens of thousands of leaf faces, on all threads of the
 * context; the same inputs give the same mapping whatever their number. Calls
 * the context's progress about once in a hundredth of the way.
 *
 * ARGUMENT (with near names), LIMIT, NUMERIC, MEMORY, CANCELLED; of several
 * exemplars also FORMAT and IO (of a mask) and SUPPORT (a method that takes
 * one). INTERNAL when what the method returned is no mapping: there is none
 * then, and the fault is the library's. */
OSDTEX_API osdtex_status osdtex_map(
    osdtex_context *context, const osdtex_cage *cage,
    const osdtex_exemplar *exemplar, const osdtex_map_options *options,
    osdtex_mapping **out);
OSDTEX_API const osdtex_mapping_info *
osdtex_mapping_describe(const osdtex_mapping *mapping);
/* The surface whose faces the mapping is of, lent. NULL for NULL. */
OSDTEX_API const osdtex_surface *
osdtex_mapping_surface(const osdtex_mapping *mapping);
/* How much larger each face of the surface shows the texture than the scale
 * asks for: the L2 stretch [Sander01], RMS over directions and the face. 1 is
 * as asked, above it is larger, INFINITY where the UVs are turned over or have
 * no area, NAN on holes.
 *
 *   out  [face_count], filled
 *
 * ARGUMENT, MEMORY. */
OSDTEX_API osdtex_status osdtex_mapping_stretch(
    osdtex_context *context, const osdtex_mapping *mapping, float *out);

typedef struct osdtex_edit_options
{
    size_t size;
    const char *constraints; /* a file, JSON or CSV, as for osdtex_map; NULL
                              * none */
    /* More of them, after those of the file. */
    const osdtex_constraint *constraint_items; /* [constraint_count] */
    int32_t constraint_count;
    int32_t reserved;
    double reach; /* of constraints that name none, scene units along the
                   * surface; 0: half a picture's width */
} osdtex_edit_options;

static inline osdtex_edit_options
osdtex_edit_options_default(void)
{
    osdtex_edit_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_edit_options_init(osdtex_edit_options *out, size_t bytes);

/* A mapping with something asked of it afterwards, in a part of the surface:
 *
 *     osdtex_edit_options options = osdtex_edit_options_default();
 *     osdtex_constraint comb = osdtex_constraint_none();
 *
 *     comb.point[0] = 0.3;          // around here
 *     comb.radius = 0.1;
 *     comb.direction[1] = 1.0;      // the texture is to run upwards
 *     comb.reach = 0.4;             // and nothing changes farther than this
 *     options.constraint_items = &comb;
 *     options.constraint_count = 1;
 *     osdtex_mapping_edit(context, mapping, &options, &edited);
 *
 * Directions, sizes, places along a stack and exemplars may be asked for, or
 * another texture (`redo`). What they hold and what lies within their reach
 * along the surface is solved and covered again, continuing what is around it;
 * everywhere else UVs and patches are the same to the bit. All constraints of
 * one call make one edit, unless their `edit` says otherwise.
 *
 * The old mapping stays as it is and may be destroyed first: a host that keeps
 * it has undo. What was asked for is saved with the mapping, and osdtex_map()
 * with the same constraints, their numbers in `edit`, makes the same mapping.
 *
 * ARGUMENT (a constraint that cannot be held, with its number), SUPPORT (a
 * mapping whose method lays no plain patches, saying so), FORMAT, IO, LIMIT,
 * NUMERIC, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_mapping_edit(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_edit_options *options, osdtex_mapping **out);

/* The mapping on its cage in another pose: a mapping made at rest goes with an
 * animated mesh, its UVs the same to the bit on every frame. What is measured,
 * drawn and baked is the surface of the pose; a USD file of a bake has the rest
 * positions as primvar Pref, and a saved mapping has them as its own.
 *
 *   cage  of the same faces in the same order
 *
 * The mapping that is given stays and may be destroyed first. ARGUMENT (other
 * faces), and as osdtex_surface_refine. */
OSDTEX_API osdtex_status osdtex_mapping_pose(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_cage *cage, osdtex_mapping **out);

typedef struct osdtex_write_options
{
    size_t size;
    const char *const *comments; /* [comment_count] lines for OBJ, MTL */
    int32_t comment_count;
    int32_t without_image; /* 1: neither write nor replace the EXR */
    int32_t normals;       /* 1: `vn` too, of the limit surface, one for each
                            * side of an infinitely sharp crease */
    int32_t resolution;    /* texels of a side of the texture that pastes are
                            * baked into; 0: 512 to 8192, as the exemplar's
                            * own density asks for. Others have no such
                            * texture */
    int32_t pastes;        /* 1: pastes as layers of faces and the pictures
                            * that these look up, instead of a texture that
                            * they are baked into */
    int32_t reserved;
} osdtex_write_options;

static inline osdtex_write_options
osdtex_write_options_default(void)
{
    osdtex_write_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_write_options_init(osdtex_write_options *out, size_t bytes);

/* Writes NAME.obj (`path`), NAME.mtl and NAME.exr, all or none of them. Of
 * several exemplars NAME_1.exr, NAME_2.exr and so on, each with materials of
 * its own. Of a mapping of pastes over one another (method lapped) the UVs are
 * those of an atlas, and NAME.exr is what was baked onto it; or as a run-time
 * list (`pastes`) NAME.obj, NAME.mtl, NAME.exr, NAME_pastes.exr and NAME.usda,
 * which docs/formats-pastes.md describes. ARGUMENT, SUPPORT (a list of what are
 * no pastes), IO, LIMIT, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_mapping_write(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path,
    const osdtex_write_options *options);

/* Saves a mapping, from which osdtex_mapping_read() makes it again without
 * mapping anew: to bake another layout, size or tile of it, or another picture
 * in the place of its own. docs/formats-mapping.md says what is in the file,
 * which is the same bytes for the same mapping. ARGUMENT (the cage or an
 * exemplar is from no file), IO, MEMORY. */
OSDTEX_API osdtex_status osdtex_mapping_save(
    osdtex_context *context, const osdtex_mapping *mapping, const char *path);

typedef struct osdtex_mapping_read_options
{
    size_t size;
    const char *cage; /* another file of the same faces, such as another pose;
                       * NULL: the one that the mapping names */
    /* Pictures of the same size in the place of the mapping's own; NULL: its
     * own. */
    const char *exemplars[OSDTEX_EXEMPLARS_MAX];
    const char *from; /* colour space of those; NULL: by the stated rules */
    /* Of what is written; NULL and ANY: as of the mapping. */
    const char *to;
    osdtex_receiver receiver;
    int32_t without_figures; /* 1: to be baked, written and drawn, not to be
                              * measured by osdtex_report_write() or edited: of
                              * large exemplars that is read much sooner */
    /* The other maps of the first exemplar's material: exemplar.h. */
    const osdtex_companion *maps; /* [map_count] */
    int32_t map_count;
    int32_t normals_y_down;
    double height_range, height_middle;
    /* As osdtex_map_options.heal: seams are mended once the mapping is read. 0:
     * as they were saved. */
    double heal;
    const char *place; /* as osdtex_map_options.place, instead of what was
                        * saved; NULL: that */
    osdtex_texture_type texture_type; /* of what is written; ANY: what the
                                       * receiver takes */
    /* 1: where `cage` has other faces it is left aside, and the mapping read on
     * its own one: to be kept on the other (osdtex_map_options.keep). */
    int32_t other_faces;
} osdtex_mapping_read_options;

static inline osdtex_mapping_read_options
osdtex_mapping_read_options_default(void)
{
    osdtex_mapping_read_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.height_middle = 0.5;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void osdtex_mapping_read_options_init(
    osdtex_mapping_read_options *out, size_t bytes);

/* Reads a saved mapping, and the cage and the exemplars that it names: where it
 * says, or else beside the file itself. The handle holds all of them. ARGUMENT
 * (other faces, a picture of another size), FORMAT, SUPPORT, and as
 * osdtex_cage_read, osdtex_surface_refine and osdtex_exemplar_read. */
OSDTEX_API osdtex_status osdtex_mapping_read(
    osdtex_context *context, const char *path,
    const osdtex_mapping_read_options *options, osdtex_mapping **out);

/* Calls `visit` once, with what a saved mapping says of itself as JSON text
 * that is gone afterwards: docs/formats-mapping.md names the keys. What it
 * names need not be there. FORMAT, SUPPORT, IO, MEMORY. */
OSDTEX_API osdtex_status osdtex_mapping_inspect(
    osdtex_context *context, const char *path,
    void (*visit)(void *user, const char *about), void *user);
/* What a file that a saved mapping names is. */
typedef int32_t osdtex_saved_file;
enum
{
    OSDTEX_SAVED_CAGE = 0,
    OSDTEX_SAVED_EXEMPLAR = 1,
    OSDTEX_SAVED_MAP = 2,    /* another map of an exemplar's material */
    OSDTEX_SAVED_PICTURE = 3 /* placed over the mapping */
};

/* Calls `visit` with the files that osdtex_mapping_read() would read for this
 * saved mapping, by the paths where they are found: the cage, then the
 * exemplars in their order, then pictures that are placed, then the exemplars'
 * maps. FORMAT, SUPPORT, IO, MEMORY. */
OSDTEX_API osdtex_status osdtex_mapping_files(
    osdtex_context *context, const char *path,
    void (*visit)(void *user, osdtex_saved_file file, const char *path),
    void *user);
OSDTEX_API void osdtex_mapping_destroy(osdtex_mapping *mapping);

OSDTEX_END_DECLS

#endif

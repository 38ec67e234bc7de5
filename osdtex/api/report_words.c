/* report_words.c -- the unit of each figure of a report, and what it says.
 *
 * docs/report.md has the same in groups, docs/notes/measure.md what each is
 * blind to. A test finds figures that have no words. */
#include "api/report_words.h"

#include <stddef.h>
#include <string.h>

static const otx_report_words MAPPING[] = {
    {"mapping.leaf_faces", "faces", "Faces of the level that is textured."},
    {"mapping.leaf_vertices", "vertices", "Vertices of that level."},
    {"mapping.area", "square scene units", "Area of the surface, less holes."},
    {"mapping.mean_edge_length", "scene units",
     "Mean length of the edges of the level that is textured."},
    {"mapping.patches", "patches", "Patches that show."},
    {"mapping.clusters.face_level", "",
     "Level of the hierarchy of clusters at which single faces begin; before "
     "are the whole surface and its regions."},
    {"mapping.clusters.subdivision_level", "",
     "Level of the surface that those faces are of; 0: of the cage."},
    {"mapping.patches_by_level", "patches",
     "Patches made of clusters of level 0, 1 and so on of the hierarchy, of "
     "method tile of the surface."},
    {"mapping.fits", "searches", "Searches for a place in the exemplar."},
    {"mapping.splits", "clusters",
     "Clusters that found no good place and were split."},
    {"mapping.threshold", "random pairs",
     "Mean distance to its neighbours above which a patch is split, over that "
     "of a random pair of texels."},
    {"mapping.fit_error_mean", "random pairs",
     "Mean distance of the accepted patches to their neighbours, likewise."},
    {"mapping.cut_before", "seam energy",
     "Energy of the seams before the cut."},
    {"mapping.cut_after", "seam energy", "The same after the cut."},
    {"mapping.relax_before", "seam energy",
     "Energy of the seams before texture coordinates were relaxed."},
    {"mapping.relax_after", "seam energy", "The same after that."},
    {"mapping.kept.held", "faces",
     "Leaf faces that show what they did in the mapping that was kept."},
    {"mapping.kept.moved", "faces", "Those that were relaxed between them."},
    {"mapping.kept.covered", "faces",
     "Those that were covered anew, or lie within 24 texels of such."},
    {"mapping.kept.texels", "of the area",
     "Share of the surface that shows what it did, within a texel."},
    {"mapping.placed.decals", "decals",
     "Pictures that were placed over the texture."},
    {"mapping.placed.faces", "faces",
     "Leaf faces under them, each counted for each."},
    {"mapping.placed.stretch_mean", "",
     "Mean stretch of their pictures; 1: none."},
    {"mapping.placed.stretch_p95", "",
     "The 95th percentile of the one that is stretched most."},
    {"mapping.placed.offset", "texels",
     "Furthest distance of a picture's anchor from its place."},
    {"mapping.healed.band", "texels",
     "Width of the band across seams that was made anew."},
    {"mapping.healed.charts", "charts", "Charts that it was made in."},
    {"mapping.healed.texels", "texels", "Texels that were made."},
    {"mapping.healed.area_share", "", "Their share of the surface."},
    {"mapping.healed.sections", "sections",
     "Pieces that seams were parted into, to be mended or left."},
    {"mapping.healed.mended", "sections", "Pieces that were mended."},
    {"mapping.healed.mended_length_share", "",
     "Their share of the length of the seams."},
    {"mapping.healed.windows.exemplar", "sigma",
     "Mean distance of the exemplar's windows of 56 texels, at an eighth of "
     "the "
     "resolution, from the rest of it."},
    {"mapping.healed.windows.interior_p90", "sigma",
     "Nine of ten such windows of the surface without a seam are nearer to the "
     "exemplar."},
    {"mapping.healed.windows.seams_before", "sigma",
     "Mean distance of windows at seams that were mended, before."},
    {"mapping.healed.windows.seams", "sigma", "The same after."},
    {"mapping.healed.windows.around_before", "sigma",
     "Mean distance of all windows within 48 texels of them, before."},
    {"mapping.healed.windows.around", "sigma", "The same after."},
    {"mapping.healed.windows.all_before", "sigma",
     "Mean distance of windows anywhere on the surface, before."},
    {"mapping.healed.windows.all", "sigma", "The same after."},
    {"mapping.lattice.faces", "faces",
     "Faces for which periodic coordinates were solved."},
    {"mapping.lattice.singular_faces", "faces",
     "Faces among them where the lattice has a dislocation."},
    {"mapping.lattice.singular_rings", "rings",
     "Rings of faces about a vertex where the lattice does not close."},
    {"mapping.lattice.cancelled", "dislocations",
     "Dislocations that were made to vanish."},
    {"mapping.lattice.clean_area_share", "",
     "Share of the area that is more than a cell from a defect."},
    {"mapping.lattice.filled_area_share", "",
     "Share of the area that patches cover."},
    {"mapping.lattice.blended_area_share", "",
     "Share of the area that a bake mixes."},
    {"mapping.lattice.blended_faces", "faces", "Faces that a bake mixes."},
    {"mapping.lattice.gradient_error", "",
     "RMS departure of the steps of the coordinates from the field's."},
    {"mapping.lapped.pastes", "pastes", "Pieces that were laid down."},
    {"mapping.lapped.touched", "layers",
     "Pieces that lie on a face, mean by area, before hidden ones are left "
     "out."},
    {"mapping.lapped.visible", "layers",
     "Pieces that are seen on a face, mean by area."},
    {"mapping.lapped.misfit_right", "",
     "RMS distance of the picture's u axis from where the field has it; 1 is "
     "the axis' length."},
    {"mapping.lapped.misfit_up", "", "The same of the v axis."},
    {"mapping.made.charts", "charts", "Charts that the surface was made in."},
    {"mapping.made.texels", "texels", "Texels that were made."},
    {"mapping.made.coherence", "",
     "Share of texels that go on from their neighbour."},
    {"mapping.made.departure", "degrees",
     "Mean angle between the exemplar's direction and the field."},
    {"mapping.made.used", "",
     "Share of the exemplar that is used: e to the entropy of 256 cells."},
    {"mapping.made.contrast", "",
     "Spread of lightness over that of the exemplar."},
    {"mapping.made.histogram", "",
     "Mean distance of lightness of equal rank, over the exemplar's spread."},
};

static const otx_report_words SEAMS[] = {
    {"seams.energy", "Delta E per texel",
     "Length of seams times Delta E across them, summed, over the area."},
    {"seams.delta_e_rms", "Delta E", "CIELAB difference across seams, RMS."},
    {"seams.delta_e_p50", "Delta E", "The same, median."},
    {"seams.delta_e_p95", "Delta E", "The same, 95th percentile."},
    {"seams.rms_per_sigma", "",
     "RMS across seams over that of random texels of the exemplar."},
    {"seams.rms_per_step", "",
     "RMS across seams over that of adjacent texels of the exemplar."},
    {"seams.p95_per_sigma", "",
     "95th percentile across seams over the RMS of random texels."},
    {"seams.visible_share", "",
     "Share of the length of seams that differ more than adjacent texels do."},
    {"seams.length_texels", "texels", "Length of all seams."},
    {"seams.share_of_edges", "",
     "Share of the length of inner leaf edges that is seam."},
    {"seams.per_100_texels", "seams",
     "Seams that a straight walk of 100 texels meets."},
    {"seams.windows.count", "windows",
     "Windows at seams that were looked up in the exemplar."},
    {"seams.windows.seam_p50", "sigma",
     "Distance of what is seen at seams from the nearest piece of the "
     "exemplar, median."},
    {"seams.windows.seam_p90", "sigma", "The same, 90th percentile."},
    {"seams.windows.interior_p50", "sigma",
     "The same inside patches, which is what distortion costs, median."},
    {"seams.windows.interior_p90", "sigma",
     "The same inside patches, 90th percentile."},
    {"transitions.length_texels", "texels",
     "Length of what lies between two exemplars."},
    {"transitions.delta_e_rms", "Delta E", "CIELAB difference across it, RMS."},
};

static const otx_report_words DISTORTION[] = {
    {"distortion.flips", "faces",
     "Faces with area that are reversed or empty in UV."},
    {"distortion.folds", "faces", "Other faces with a reversed corner."},
    {"distortion.uncovered", "faces", "Faces without a patch or with bad UVs."},
    {"distortion.outside", "faces",
     "Faces that leave a picture which does not tile."},
    {"distortion.outside_max_texels", "texels",
     "How far the farthest of them leaves it."},
    {"distortion.log_area_mean", "",
     "Mean of |ln(area in UV over area on the surface)|; 0 is none."},
    {"distortion.stretch_l2_mean", "",
     "L2 stretch, mean by area; 1 is isometric."},
    {"distortion.stretch_l2_p95", "", "L2 stretch, 95th percentile by area."},
    {"distortion.stretch_ratio_mean", "",
     "Ratio of the axes of stretch, mean by area; 1 is conformal."},
    {"distortion.stretch_ratio_p95", "",
     "Ratio of the axes of stretch, 95th percentile by area."},
    {"exemplar.coverage", "",
     "How evenly the exemplar is used; 1 where all of it shows alike."},
    {"exemplar.lab_sigma", "Delta E",
     "Contrast of the exemplar: RMS of random texels."},
    {"exemplar.lab_step", "Delta E",
     "Fineness of the exemplar: RMS of adjacent texels."},
    {"exemplar.texels_per_unit", "texels per scene unit",
     "How many texels of the exemplar a scene unit shows."},
    {"exemplar.area_texels", "square texels", "Covered area."},
    {"exemplars.width", "texels", "Width of the exemplar."},
    {"exemplars.height", "texels", "Height of the exemplar."},
    {"exemplars.channels", "channels", "Channels of the exemplar."},
    {"exemplars.scale", "scene units", "Width that it has on the surface."},
    {"exemplars.faces", "faces", "Leaf faces that show it."},
    {"exemplars.area_share", "", "Share of the area that shows it."},
    {"exemplars.coverage", "", "How evenly it is used."},
};

static const otx_report_words TILES[] = {
    {"tiles.boundaries", "boundaries", "Kinds of boundaries of the tiles."},
    {"tiles.corners", "corners", "Kinds of vertices of the tiles."},
    {"tiles.tile_size", "texels", "Side of a tile."},
    {"tiles.gutter", "texels", "Gutter of a tile on each side."},
    {"tiles.exact_levels", "levels", "Mip levels that keep tiles apart."},
    {"tiles.inner_cut", "random pairs",
     "CIELAB distance along the cuts inside tiles, mean."},
    {"tiles.vertex_window", "random pairs",
     "Distance of what is seen around vertices from the nearest piece of the "
     "exemplar, median."},
    {"tiles.inner_window", "random pairs", "The same inside tiles."},
    {"tiles.count", "tiles", "Tiles of the texture."},
    {"tiles.used", "tiles", "Tiles that the mapping uses."},
    {"tiles.faces_least", "faces", "Faces that the rarest tile in use has."},
    {"tiles.faces_mean", "faces", "Faces that a tile in use has, mean."},
    {"tiles.faces_most", "faces", "Faces that the commonest tile has."},
    {"tiles.edges", "edges", "Edges between two tiles."},
    {"tiles.edges_between_equals", "edges",
     "Edges on both sides of which the same tile is seen."},
    {"tiles.vertices", "vertices", "Vertices at which tiles meet."},
    {"tiles.vertices_with_equals", "vertices",
     "Vertices at which the same tile is seen twice."},
    {"tiles.mismatch_by_mip_level.edge_max", "",
     "Largest difference of a channel across edges between tiles, for each mip "
     "level."},
    {"tiles.mismatch_by_mip_level.corner_max", "",
     "The same at vertices of tiles."},
};

static const otx_report_words OTHERS[] = {
    {"field.symmetry", "", "1 arrows, 2 lines, 4 crosses."},
    {"field.singularities.vertex", "",
     "Vertex of the surface, for each singularity of the field."},
    {"field.singularities.index", "",
     "Turns of the field about it, a multiple of 1 / symmetry."},
    {"field.singularities.place", "scene units",
     "Its place, three numbers for each."},
    {"field.angle.", "degrees",
     "Angle between the field and the exemplar's direction on the surface, by "
     "area."},
    {"field.scale.", "",
     "Size of the texture over what was asked for, percentiles by area."},
    {"seconds.map_stages.", "seconds", "Wall time of a stage of the mapping."},
    {"seconds.", "seconds",
     "Wall time of the calls of this name since the context was made."},
    {"memory.peak_bytes", "bytes", "Peak of the library's heap."},
    {"memory.peak_resident_bytes", "bytes", "Peak of the process."},
};

typedef struct table
{
    const otx_report_words *rows;
    size_t count;
} table;

#define TABLE(rows)                                                            \
    {                                                                          \
        rows, sizeof rows / sizeof *rows                                       \
    }

static const table TABLES[] = {
    TABLE(MAPPING), TABLE(SEAMS), TABLE(DISTORTION), TABLE(TILES),
    TABLE(OTHERS)};

static int
speaks_of(const otx_report_words *row, const char *key)
{
    const size_t length = strlen(row->key);

    return row->key[length - 1] == '.' ? strncmp(row->key, key, length) == 0
                                       : strcmp(row->key, key) == 0;
}

const otx_report_words *
otx_report_words_of(const char *key)
{
    for (size_t t = 0; t < sizeof TABLES / sizeof *TABLES; ++t)
        for (size_t i = 0; i < TABLES[t].count; ++i)
            if (speaks_of(&TABLES[t].rows[i], key))
                return &TABLES[t].rows[i];
    return NULL;
}

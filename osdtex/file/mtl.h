/* mtl.h -- material libraries: as much of them as a picture needs.
 *
 * The writer is as plain as can be. Options of `map_Kd` break half of the
 * readers (they take them for a part of the file name), so it writes none, and
 * colour spaces are told elsewhere. */
#ifndef OTX_FILE_MTL_H
#define OTX_FILE_MTL_H

#include "file/data_maps.h"

#include "base/run.h"

typedef struct otx_mtl_material
{
    const char *name;   /* verbatim: the rest of the line */
    float diffuse[3];   /* `Kd`, 1 1 1 when absent */
    bool has_diffuse;   /* it is there; the writer always writes it */
    const char *map_kd; /* file name as written, options skipped; NULL none */
    const char *map_d;  /* what cuts it out, likewise */
    otx_data_maps maps; /* likewise; `map_Bump` is not read, of which nobody can
                         * tell what it is, nor is there occlusion */
    int64_t line;       /* of `newmtl`; the writer does not look */
} otx_mtl_material;

typedef struct otx_mtl
{
    const char *path;
    int32_t count;
    const otx_mtl_material *materials; /* [count], in the file's order */
} otx_mtl;

/* Reads `path` into run->arena. FORMAT with file and line, IO, MEMORY. */
otx_status otx_mtl_read(otx_run *run, const char *path, otx_mtl *out);
otx_status otx_mtl_parse(
    otx_run *run, const char *name, const char *bytes, size_t size,
    otx_mtl *out);

/* Index of the material called `name`, or written as `name` by our writers
 * (blanks become `_`); -1 none. Of several, the last, as readers do. */
int32_t otx_mtl_find(const otx_mtl *mtl, const char *name);

/* Writes `newmtl`, `Kd`, `illum`, `map_Kd` and `map_d` for each material to
 * `path`; with other maps also `map_Pr`, `map_Pm`, `norm` and `disp`, and
 * `map_Bump`: the normals, which Blender takes for it, or where there are none
 * the height. `title` is for messages (NULL: the path). */
otx_status otx_mtl_write(
    otx_run *run, const otx_mtl *mtl, const char *path, const char *title);

#endif

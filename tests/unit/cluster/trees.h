/* trees.h -- hierarchies of clusters to test with. */
#ifndef OTX_TESTS_TREES_H
#define OTX_TESTS_TREES_H

#include "unit/cluster/sheets.h"

#include "cluster/tree.h"
#include "cluster/tree_check.h"

typedef struct tree_bench
{
    otx_run *run;
    otx_surface surface;
    otx_dual dual;
    otx_cluster_tree tree;
} tree_bench;

static inline void
tree_assert_sound(const tree_bench *b)
{
    const char *wrong = otx_cluster_tree_check(&b->tree, b->run->scratch);

    if (wrong)
        fail_msg("%s", wrong);
}

/*   count  regions that are asked for; 0: each face by itself */
static inline tree_bench *
tree_plant(otx_surface surface, otx_run *run, int32_t level, double count)
{
    tree_bench *b = OTX_ZNEW(run->arena, tree_bench, 1);
    otx_cluster_part part = {
        sheet_all(run, &surface, level),
        count > 0.0 ? surface.area / count : 0};

    b->run = run;
    b->surface = surface;
    b->dual = sheet_dual(run, &b->surface, level);
    assert_int_equal(
        otx_cluster_tree_create(
            run, &b->surface, &b->dual, 1.0, &part, 1, &b->tree),
        OSDTEX_OK);
    tree_assert_sound(b);
    return b;
}

static inline tree_bench *
tree_plant_cage(otx_run *run, const char *name, int32_t level, double count)
{
    char path[128];

    snprintf(path, sizeof path, "models/cages/%s.obj", name);
    return tree_plant(sheet_from_file(run, path, 2), run, level, count);
}

#endif

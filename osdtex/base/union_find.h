/* union_find.h -- sets of elements that are merged and never parted.
 *
 * A set is known by its smallest element, so that numbers given to sets in the
 * order of elements do not depend on the order of the merges.
 *
 *     for (int32_t i = 0; i < count; ++i)
 *         parent[i] = i;
 *     otx_union_find_join(parent, a, b);
 */
#ifndef OTX_BASE_UNION_FIND_H
#define OTX_BASE_UNION_FIND_H

#include <stdint.h>

/* The smallest element of the set that `i` is in. Shortens paths. */
static inline int32_t
otx_union_find_root(int32_t *parent, int32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static inline void
otx_union_find_join(int32_t *parent, int32_t a, int32_t b)
{
    a = otx_union_find_root(parent, a);
    b = otx_union_find_root(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

#endif

/* uv_pool.c -- open addressing over (vertex, u, v). */
#include "export/uv_pool.h"

#include "base/hash.h"
#include "base/random.h"

#include <string.h>

static const char STAGE[] = "export";

/* -0 and 0 are one number. */
static uint64_t
uv_bits(const float uv[2])
{
    const float clean[2] = {uv[0] + 0.0f, uv[1] + 0.0f};
    uint64_t bits;

    memcpy(&bits, clean, sizeof bits);
    return bits;
}

static bool
is_same(const int32_t *verts, const float *uvs, int32_t a, int32_t b)
{
    return verts[a] == verts[b] &&
           uv_bits(uvs + 2 * (size_t)a) == uv_bits(uvs + 2 * (size_t)b);
}

otx_status
otx_uv_pool_build(
    otx_run *run, otx_arena *arena, int32_t corner_count, const int32_t *verts,
    const float *uvs, otx_uv_pool *out)
{
    const size_t corners = (size_t)corner_count;
    const size_t size = otx_hash_table_size((size_t)corner_count);
    float *pool = OTX_NEW(arena, float, corners * 2);
    int32_t *indices = OTX_NEW(arena, int32_t, corners);
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    int32_t *table = OTX_NEW(run->scratch, int32_t, size); /* first corners */
    int32_t count = 0;

    if (!pool || !indices || !table)
        return otx_fail_memory(run, STAGE);
    memset(table, -1, size * sizeof *table);
    for (int32_t c = 0; c < corner_count; ++c)
    {
        const float *uv = uvs + 2 * (size_t)c;
        size_t slot =
            otx_random_bits((uint64_t)verts[c], 0, uv_bits(uv)) & (size - 1);

        while (table[slot] >= 0 && !is_same(verts, uvs, table[slot], c))
            slot = (slot + 1) & (size - 1);
        if (table[slot] >= 0)
        {
            indices[c] = indices[table[slot]];
            continue;
        }
        table[slot] = c;
        indices[c] = count;
        memcpy(pool + 2 * (size_t)count, uv, 2 * sizeof *uv);
        ++count;
    }
    otx_arena_release(run->scratch, mark);
    *out = (otx_uv_pool){count, pool, indices};
    return OSDTEX_OK;
}

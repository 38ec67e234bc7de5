/* obj_names.c -- open addressing, at most half full. */
#include "file/obj_names.h"

#include <string.h>

otx_status
otx_obj_names_create(otx_run *run, int32_t capacity, otx_obj_names_table *out)
{
    size_t slots = 2;

    while (slots < 2 * (size_t)capacity)
        slots *= 2;
    *out = (otx_obj_names_table){
        .text = OTX_NEW(run->arena, const char *, capacity),
        .slots = OTX_NEW(run->scratch, int32_t, slots),
        .slot_mask = (uint32_t)(slots - 1)};
    OTX_TRY(otx_run_ok(run));
    memset(out->slots, 0xFF, slots * sizeof *out->slots);
    return OSDTEX_OK;
}

otx_status
otx_obj_names_add(
    otx_run *run, otx_obj_names_table *table, otx_token name, int32_t *index)
{
    uint32_t slot = otx_token_hash(name) & table->slot_mask;
    const char *copy;

    *index = -1;
    if (name.begin == name.end)
        return OSDTEX_OK;
    for (; table->slots[slot] >= 0; slot = (slot + 1) & table->slot_mask)
    {
        if (otx_token_is(name, table->text[table->slots[slot]]))
        {
            *index = table->slots[slot];
            return OSDTEX_OK;
        }
    }
    copy = otx_token_copy(run->arena, name);
    OTX_TRY(otx_run_ok(run));
    *index = table->slots[slot] = table->count;
    table->text[table->count++] = copy;
    return OSDTEX_OK;
}

otx_obj_names
otx_obj_names_view(const otx_obj_names_table *table)
{
    return (otx_obj_names){table->count, table->text};
}

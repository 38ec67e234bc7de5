/* obj_index.c -- OBJ's way to number elements. */
#include "file/obj_index.h"

#include <inttypes.h>

static otx_where
where_of(const otx_obj_index_context *context, int64_t line)
{
    otx_where where = otx_text_where(context->text);

    where.line = line;
    where.face = context->face;
    return where;
}

otx_status
otx_obj_index_resolve(
    const otx_obj_index_context *context, int64_t number, int32_t so_far,
    int32_t *index)
{
    const otx_text *text = context->text;
    const otx_where where = where_of(context, text->line);

    if (number == 0)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, where,
            "%s 0 does not exist; OBJ counts from 1", context->what);
    if (number > INT32_MAX)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, where,
            "%s %" PRId64 " does not exist; numbers end at %" PRId32,
            context->what, number, INT32_MAX);
    if (number < -(int64_t)so_far)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, where,
            "%s %" PRId64 " does not exist; up to this line there are %" PRId32,
            context->what, number, so_far);
    *index = (int32_t)(number > 0 ? number - 1 : so_far + number);
    return OSDTEX_OK;
}

otx_status
otx_obj_index_check(
    const otx_obj_index_context *context, int64_t line, int32_t index,
    int32_t count)
{
    const otx_text *text = context->text;

    if (index < count)
        return OSDTEX_OK;
    return otx_fail(
        text->run, OSDTEX_ERROR_FORMAT, text->stage, where_of(context, line),
        "%s %" PRId64 " does not exist; the file has %" PRId32, context->what,
        (int64_t)index + 1, count);
}

/* obj_support.h -- OBJ texts that are in order. */
#ifndef OTX_TESTS_OBJ_SUPPORT_H
#define OTX_TESTS_OBJ_SUPPORT_H

#include "support.h"

#include "file/obj.h"

static inline otx_obj
test_obj_parse(otx_run *run, const char *text)
{
    otx_obj obj;

    assert_int_equal(
        otx_obj_parse(run, "t.obj", text, strlen(text), &obj), OSDTEX_OK);
    return obj;
}

#endif

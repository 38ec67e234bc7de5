/* edit_flags.c -- what flags say of spots that are to be textured again. */
#include "cli/edit_flags.h"

#include "cli/inputs.h"
#include "cli/session.h"
#include "cli/value.h"

bool
otx_edit_flags_redo(const otx_flag_values *values, osdtex_constraint *out)
{
    const char *text = values->text[OTX_FLAG_REDO];
    int64_t face, take = 1;
    double v[4];

    *out = osdtex_constraint_none();
    if (!otx_inputs_number(values, OTX_FLAG_SEED, 1, INT32_MAX, &take))
        return false;
    out->redo = (int32_t)take;
    if (otx_value_int(text, 0, INT32_MAX, &face))
    {
        out->face = (osdtex_index)face;
        return true;
    }
    if (otx_value_reals(text, 4, v) && v[3] > 0.0)
    {
        for (int k = 0; k < 3; ++k)
            out->point[k] = v[k];
        out->radius = v[3];
        return true;
    }
    otx_session_refuse(
        "--redo takes a face of the cage, from 0, or X,Y,Z,RADIUS, not '%s'",
        text);
    return false;
}

/* field_flags.c -- what the flags say about a field. */
#include "cli/field_flags.h"

#include "cli/session.h"
#include "cli/value.h"

bool
otx_field_flags_parse(const otx_flag_values *values, osdtex_field_options *out)
{
    const char *symmetry = values->text[OTX_FLAG_SYMMETRY];
    const char *octaves = values->text[OTX_FLAG_OCTAVES];
    int64_t number;

    *out = osdtex_field_options_default();
    out->constraints = values->text[OTX_FLAG_CONSTRAINTS];
    out->follow = values->text[OTX_FLAG_FOLLOW];
    if (symmetry)
    {
        if (!otx_value_int(symmetry, 1, 4, &number) || number == 3)
        {
            otx_session_refuse(
                "--symmetry takes 1, 2 or 4, not '%s'", symmetry);
            return false;
        }
        out->symmetry = (int32_t)number;
    }
    if (octaves &&
        (!otx_value_real(octaves, &out->octaves) || out->octaves < 0.0))
    {
        otx_session_refuse(
            "--octaves takes a number of at least 0, not '%s'", octaves);
        return false;
    }
    return true;
}

/* height_gaps.c -- what is said where displaced surfaces may open. */
#include "export/companion_files.h"

static const char STAGE[] = "export";

/* Faces that are neither quads nor triangles. */
static int32_t
count_others(const otx_level *cage)
{
    int32_t count = 0;

    for (int32_t f = 0; f < cage->face_count; ++f)
        count += otx_level_face_size(cage, f) > 4;
    return count;
}

void
otx_companion_files_say_gaps(
    otx_run *run, bool in_blocks, const otx_level *cage, const char *height)
{
    const int32_t others = height && in_blocks ? count_others(cage) : 0;

    if (!height)
        return;
    if (!in_blocks)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
            "on the cage's own UVs and on charts heights cannot be the same "
            "from both sides of a cut everywhere, so what they displace may "
            "open there; an atlas of quads and triangles has no such gaps");
    else if (others > 0)
        otx_note(
            run, OSDTEX_SEVERITY_INFO, STAGE, OTX_NOWHERE,
            "%d of %d faces have more than four corners: at their edges in the "
            "atlas heights cannot be the same from both sides everywhere, so "
            "what they displace may open there; quads and triangles have no "
            "such gaps",
            (int)others, (int)cage->face_count);
}

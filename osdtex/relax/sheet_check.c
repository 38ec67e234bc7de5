/* sheet_check.c -- what holds of every elastic sheet. */
#include "relax/sheet_check.h"

#include <math.h>

static const char *
check_face(const otx_sheet *s, const otx_level *leaf, int32_t face)
{
    const int32_t first = s->first[face];

    for (int32_t c = first; c < s->first[face + 1]; ++c)
    {
        const int32_t variable = s->corners[c];

        if (variable < 0 || variable >= s->count)
            return "a corner has no variable";
        if (s->verts[variable] != leaf->face_verts[s->corner_leaf[c]])
            return "a variable is not of its corner's vertex";
        if (s->patches[variable] != s->patches[s->corners[first]])
            return "a face is of two patches";
    }
    return NULL;
}

static const char *
check_seam(const otx_sheet *s, const otx_sheet_seam *seam)
{
    for (int k = 0; k < 2; ++k)
        if (s->verts[seam->a[k]] != s->verts[seam->b[k]])
            return "the sides of a seam are not the same edge";
    if (s->patches[seam->a[0]] == s->patches[seam->b[0]])
        return "a seam lies within a patch";
    return seam->length >= 0.0 ? NULL : "a seam has no length";
}

const char *
otx_sheet_check(const otx_sheet *sheet, const otx_surface *surface)
{
    const otx_level *leaf = otx_surface_leaf(surface);
    const char *wrong = NULL;

    for (int32_t f = 0; f < sheet->face_count && !wrong; ++f)
        wrong = check_face(sheet, leaf, f);
    for (int32_t i = 0; i < sheet->seam_count && !wrong; ++i)
        wrong = check_seam(sheet, &sheet->seams[i]);
    for (int32_t v = 0; v < sheet->count && !wrong; ++v)
        if (!isfinite(sheet->at[v].x) || !isfinite(sheet->at[v].y))
            wrong = "a variable is not finite";
    return wrong;
}

/* sheet_check.h -- what holds of every elastic sheet.
 *
 * Builds with assertions check each sheet that is made. */
#ifndef OTX_RELAX_SHEET_CHECK_H
#define OTX_RELAX_SHEET_CHECK_H

#include "relax/sheet.h"

/* NULL when the sheet is sound, else what is not, for assert():
 *
 * - corners name variables, and variables vertices;
 * - all corners of a face are of one patch;
 * - the two sides of a seam are the same two vertices, of two patches. */
const char *otx_sheet_check(const otx_sheet *sheet, const otx_surface *surface);

#endif

/* shelf.h -- mappings that were made a while ago, by their recipes.
 *
 * Undo finds its mapping here, and a gesture that is an edit the one that it
 * changes, so that neither maps anew. */
#ifndef OTX_STUDIO_SHELF_H
#define OTX_STUDIO_SHELF_H

#include "studio/snapshot.h"

enum
{
    OTX_SHELF_MOST = 24,
    OTX_SHELF_FACES_MOST = 4000000 /* of all together, but for the newest */
};

typedef struct otx_shelf_row
{
    json_t *recipe;
    otx_outcome *outcome;
} otx_shelf_row;

/* The newest first. Begins as {0}. */
typedef struct otx_shelf
{
    otx_shelf_row rows[OTX_SHELF_MOST];
    int count;
} otx_shelf;

/* Holds the outcome and a copy of the recipe; the oldest make room. */
void
otx_shelf_put(otx_shelf *shelf, const json_t *recipe, otx_outcome *outcome);

/* What that very recipe made, lent; NULL none. */
otx_outcome *otx_shelf_find(const otx_shelf *shelf, const json_t *recipe);

/* What a recipe is one edit away from, lent; NULL none.
 *
 *   rest  the edit: its constraints, as a new array */
otx_outcome *
otx_shelf_base(const otx_shelf *shelf, const json_t *recipe, json_t **rest);

void otx_shelf_free(otx_shelf *shelf);

#endif

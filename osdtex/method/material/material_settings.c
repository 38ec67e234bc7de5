/* material_settings.c -- what can be set in material space texturing. */
#include "method/material/material.h"

#define FIELD(member) offsetof(otx_material_settings, member)

static const char *const COURSES[] = {"auto", "on", "off", NULL};
static const char *const FILL[] = {"off", "on", "blend", NULL};
static const char *const SYMMETRY[] = {"auto", "one", "two", NULL};

const otx_option otx_material_options[] = {
    {"symmetry", OTX_OPTION_CHOICE, FIELD(symmetry), 0, 0, 0, SYMMETRY,
     "Whether the texture may be laid upside down: one direction, or two; auto "
     "asks the exemplar"},
    {"courses", OTX_OPTION_CHOICE, FIELD(courses), 0, 0, 0, COURSES,
     "Whether courses of the exemplar may slide along each other, as in "
     "masonry, so that curvature changes no sizes; auto asks the exemplar"},
    {"octaves", OTX_OPTION_REAL, FIELD(octaves), 0, 3, 0.5, NULL,
     "How far the texture's size may follow the curvature, in octaves; more "
     "gives fewer dislocations, less an even size"},
    {"cancel", OTX_OPTION_REAL, FIELD(cancel), 0, 8, 1.5, NULL,
     "Distance within which a dislocation is made to meet its opposite, a "
     "singularity or a border, and vanish, in cells"},
    {"clear", OTX_OPTION_REAL, FIELD(clear), 0, 8, 0.6, NULL,
     "Distance from a dislocation within which patches replace the periodic "
     "texture, in cells"},
    {"fill", OTX_OPTION_CHOICE, FIELD(fill), 0, 0, OTX_FILL_ON, FILL,
     "What replaces the texture around dislocations: on, patches that continue "
     "it; blend, the texture as each corner of a face would continue it, "
     "mixed, "
     "which bakes and pictures show but no OBJ can say, and which needs an "
     "exemplar that tiles; off, nothing"},
    {"stretch", OTX_OPTION_REAL, FIELD(stretch), 1, 16, 2.5, NULL,
     "Factor by which the periodic texture may be squeezed or stretched before "
     "patches replace it"},
    {"turn", OTX_OPTION_REAL, FIELD(turn), -360, 360, 0, NULL,
     "Angle from the field's direction to the texture's, in degrees"},
};

_Static_assert(
    sizeof otx_material_options / sizeof otx_material_options[0] ==
        OTX_MATERIAL_OPTION_COUNT,
    "the header says how long the table is");

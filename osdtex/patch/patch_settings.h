/* patch_settings.h -- how patches are made, fitted and joined. */
#ifndef OTX_PATCH_PATCH_SETTINGS_H
#define OTX_PATCH_PATCH_SETTINGS_H

#include "exemplar/exemplar.h"
#include "surface/cage.h"

typedef enum otx_patch_mode
{
    OTX_PATCH_BEST,
    OTX_PATCH_PAPER
} otx_patch_mode;

enum
{
    OTX_PATCH_AUTO = 0, /* of every CHOICE that has it */
    OTX_PATCH_GROWN = 1,
    OTX_PATCH_SUBDIVISION = 2,
    OTX_PATCH_OFF = 1,
    OTX_PATCH_ON = 2,
    OTX_PATCH_JOINT = 1,
    OTX_PATCH_RECURSIVE = 2,
    OTX_PATCH_RELAX_OFF = 1,
    OTX_PATCH_RELAX_LOOP = 2,
    OTX_PATCH_RELAX_GLOBAL = 3
};

/* Meaning, range and default of each: the table of
 * method/hierarchical/settings.c. */
typedef struct otx_patch_settings
{
    int32_t mode;
    int32_t clusters;
    double patch;
    int32_t flatten;
    double flatness;
    int32_t angles;
    double drift;         /* degrees */
    int32_t continuation; /* 0 avoid, 1 allow */
    int32_t coarse;       /* -1 auto */
    int32_t keep;
    int32_t candidates;
    double band;
    double collar;
    double edges; /* -1 auto */
    double tau;   /* 0 auto */
    double usage;
    int32_t cut;
    int32_t sweeps;
    int32_t relax;
    int32_t relax_rounds;
    double stiffness;
    int32_t guide;
    double transition; /* texels, -1 auto */
} otx_patch_settings;

/* Replaces every "auto" by what it means for this mode, exemplar
 * and cage. */
void otx_patch_resolve(
    otx_patch_settings *settings, const otx_exemplar *exemplar,
    const otx_cage *cage);

/* Makes settings that were resolved for `first` those of another exemplar: what
 * is as it comes out for the first by itself becomes so for this one. */
void otx_patch_adapt(
    otx_patch_settings *settings, const otx_exemplar *first,
    const otx_exemplar *exemplar);

#endif

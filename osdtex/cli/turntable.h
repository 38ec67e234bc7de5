/* turntable.h -- the frames of a model that turns: their names and turns. */
#ifndef OTX_CLI_TURNTABLE_H
#define OTX_CLI_TURNTABLE_H

#include "cli/flag.h"
#include "cli/path_list.h"

enum
{
    OTX_TURNTABLE_PATH_BYTES = 4096
};

typedef struct otx_turntable
{
    const char *pattern; /* of the output */
    int frames;          /* 0: a single picture */
} otx_turntable;

/* By -o and --frames. False after saying what is wrong. */
bool otx_turntable_parse(const otx_flag_values *values, otx_turntable *out);

/* The file of frame `i`, from 0, which is numbered 1; of a single picture its
 * own. Names fit: parsing sees to it. */
void otx_turntable_name(
    const otx_turntable *turntable, int i, char out[OTX_TURNTABLE_PATH_BYTES]);

/* All files. */
void otx_turntable_outputs(const otx_turntable *turntable, otx_path_list *out);

/* Radians by which frame `i` is turned beyond the first. */
double otx_turntable_turn(const otx_turntable *turntable, int i);

#endif

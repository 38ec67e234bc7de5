/* desk.h -- what the threads of the studio share, behind one lock.
 *
 * Requests lay recipes on the desk, the worker takes the newest and lays what
 * came of it beside it. `serial` grows with whatever a page may want to know;
 * pages wait for that. */
#ifndef OTX_STUDIO_DESK_H
#define OTX_STUDIO_DESK_H

#include "studio/past.h"
#include "studio/snapshot.h"
#include "studio/studio.h"

#include <pthread.h>

/* What the worker is at. */
typedef struct otx_desk_work
{
    bool is_busy, is_cancelled;
    bool wants_export;
    int64_t tried; /* revision of the recipe that was taken last */
    char stage[32];
    double fraction;
    char error[OTX_STUDIO_ERROR_BYTES]; /* of the last try; "" none */
    char told[OTX_STUDIO_ERROR_BYTES];  /* what was exported; "" nothing */
    json_t *figures; /* of the snapshot `figures_of`; NULL none */
    int64_t figures_of;
} otx_desk_work;

typedef struct otx_desk
{
    const otx_studio_options *options;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int64_t serial;
    bool is_closing;
    otx_past past;
    otx_snapshot *snapshot; /* NULL before the first */
    otx_desk_work work;
    /* For looking at constraints before they are taken; under the lock. */
    osdtex_context *checker;
    osdtex_surface *cage; /* at level 0 */
} otx_desk;

/* Begins with the recipe of the state file, else with that of the options.
 * False after saying in `error` what is wrong. */
osdtex_status otx_desk_open(
    const otx_studio_options *options, otx_desk *desk,
    char error[OTX_STUDIO_ERROR_BYTES]);
void otx_desk_close(otx_desk *desk);

/* Takes a recipe as text, saves it, and has it mapped.
 *
 *   revision  of the recipe that the sender saw; another one is refused, so
 *             that two pages do not undo each other's work unseen
 *
 * False after saying in `error` what is wrong; then all stays as it was. */
bool otx_desk_put(
    otx_desk *desk, const char *text, size_t bytes, int64_t revision,
    char error[OTX_STUDIO_ERROR_BYTES]);
/* Undo by -1, redo by 1. As otx_desk_put. */
bool otx_desk_step(otx_desk *desk, int by, char error[OTX_STUDIO_ERROR_BYTES]);

/* Stops what the worker is at; the last picture stays. */
void otx_desk_cancel(otx_desk *desk);
void otx_desk_export(otx_desk *desk);

/* Waits, up to some seconds, until there is more than `serial`. All that a page
 * is told, as text to be freed; NULL when memory is out. */
char *otx_desk_tell(otx_desk *desk, int64_t serial);

/* What is shown now, held for the caller; NULL nothing yet. */
otx_snapshot *otx_desk_snapshot(otx_desk *desk);

/* Wakes all who wait, and ends the worker's work. */
void otx_desk_end(otx_desk *desk);

/* Something changed; under the lock. */
void otx_desk_touch(otx_desk *desk);

#endif

/* worker.h -- the thread that maps whatever recipe is newest.
 *
 * A newer recipe cancels the one that is at work. One that was mapped lately is
 * taken from the shelf, and of one that is an edit of such a one only the edit
 * is made: osdtex_map() with all of it makes the same bytes. Figures come
 * behind the picture, so that nobody waits for them. */
#ifndef OTX_STUDIO_WORKER_H
#define OTX_STUDIO_WORKER_H

#include "studio/desk.h"
#include "studio/shelf.h"

typedef struct otx_studio_worker
{
    otx_desk *desk;
    osdtex_context *context;
    osdtex_surface *surface;
    int64_t surface_serial;
    int surface_exemplar; /* what it was refined for */
    double surface_scale;
    double scale;  /* as resolved */
    int64_t taken; /* revision at work */
    pthread_t thread;
    bool is_started;
    otx_shelf shelf;
    osdtex_exemplar *exemplars[OTX_STUDIO_EXEMPLARS_MAX]; /* as read; NULL */
} otx_studio_worker;

/* Starts it. False when there is no memory or no thread. */
bool otx_worker_start(otx_desk *desk, otx_studio_worker *worker);
/* Waits for its end, after otx_desk_end; also of one that was not started. */
void otx_worker_join(otx_studio_worker *worker);

#endif

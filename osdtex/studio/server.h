/* server.h -- HTTP on the loopback address, a thread for each connection.
 *
 * GET  /TOKEN/               the page; /TOKEN/main.js and so on, its files
 *      /TOKEN/state?after=N  all that a page is told, once its serial exceeds N
 *      /TOKEN/surface, mapping, seams, texture?index=K   blocks of wire.h
 * POST /TOKEN/recipe?revision=N   a recipe; undo, redo, cancel, export
 *
 * What is not ours (door.h) is answered 403 and a sentence, what cannot be
 * mapped 400 and a sentence. */
#ifndef OTX_STUDIO_SERVER_H
#define OTX_STUDIO_SERVER_H

#include "studio/desk.h"
#include "studio/door.h"

struct MHD_Daemon;

typedef struct otx_server
{
    otx_desk *desk;
    otx_door door;
    struct MHD_Daemon *daemon;
} otx_server;

/* Listens on a port that is free. False after saying in `error` why not. The
 * server must not move. */
bool otx_server_start(
    otx_desk *desk, otx_server *server, char error[OTX_STUDIO_ERROR_BYTES]);
/* Ends all answers; after otx_desk_end. Nothing of one that was not started. */
void otx_server_stop(otx_server *server);

#endif

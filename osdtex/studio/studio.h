/* studio.h -- a page on which a person directs a texture.
 *
 * The program serves the page itself, on the loopback address alone, under a
 * random token: server.h. What a person does there is a recipe (recipe.h),
 * whose constraints are the file that `osdtex map --constraints` reads; a
 * thread maps it anew whenever it changes (worker.h). All goes through the
 * public header: a host may do the same. */
#ifndef OTX_STUDIO_STUDIO_H
#define OTX_STUDIO_STUDIO_H

#include <osdtex/osdtex.h>

enum
{
    OTX_STUDIO_EXEMPLARS_MAX = 7, /* to choose among */
    OTX_STUDIO_PATH_BYTES = 4096,
    OTX_STUDIO_ERROR_BYTES = 8192
};

/* Where the files go: NAME.json, the constraints, NAME_studio.json, all else
 * that the page knows, and NAME.obj and so on where it exports. */
typedef struct otx_studio_files
{
    char constraints[OTX_STUDIO_PATH_BYTES];
    char state[OTX_STUDIO_PATH_BYTES];
    char model[OTX_STUDIO_PATH_BYTES];
    char saved[OTX_STUDIO_PATH_BYTES];
} otx_studio_files;

/* What it is all about; borrowed while it runs. */
typedef struct otx_studio_options
{
    osdtex_context_options context; /* progress and log are the studio's own */
    const osdtex_cage *cage;
    const char *exemplars[OTX_STUDIO_EXEMPLARS_MAX];
    int exemplar_count;
    osdtex_exemplar_options exemplar;
    osdtex_surface_options surface;
    osdtex_map_options map; /* constraints: to begin with */
    const otx_studio_files *files;
    const char *const *words; /* [word_count] flags of `osdtex map` that stay */
    int word_count;
    bool (*is_stopped)(void);
    void (*say)(void *user, const char *sentence); /* to the person */
    void *say_user;
    bool opens_browser;
} otx_studio_options;

/* Whether this build has it: it needs libmicrohttpd. */
bool otx_studio_is_built(void);

/* Serves until is_stopped() says so. In `error`, one sentence when it fails:
 * SUPPORT (not built), IO (no port, a file that is not the studio's), FORMAT
 * and ARGUMENT (of constraints to begin with), MEMORY. */
osdtex_status otx_studio_run(
    const otx_studio_options *options, char error[OTX_STUDIO_ERROR_BYTES]);

#endif

/* door.h -- who is let in.
 *
 * The page is on the loopback address, which every program of the machine and
 * every page in its browser can reach. So addresses begin with a token that
 * only the person is shown; and since a page elsewhere may have itself called
 * by any name, or send requests from where it is, the names that a request
 * gives (Host, Origin, Sec-Fetch-Site) must be ours, too. */
#ifndef OTX_STUDIO_DOOR_H
#define OTX_STUDIO_DOOR_H

#include <stdbool.h>
#include <stdint.h>

enum
{
    OTX_DOOR_TOKEN_BYTES = 33 /* 128 bits in hexadecimal, and the NUL */
};

typedef struct otx_door
{
    char token[OTX_DOOR_TOKEN_BYTES];
    uint16_t port;
} otx_door;

/* What a request says of itself; NULL: it does not. */
typedef struct otx_door_names
{
    const char *host;
    const char *origin;
    const char *site; /* Sec-Fetch-Site */
} otx_door_names;

/* Makes the token; false when the system has no random numbers. */
bool otx_door_make(otx_door *door);

/* What of "/TOKEN/rest" is behind the token: "rest". NULL for others. Takes as
 * long for any wrong token. */
const char *otx_door_path(const otx_door *door, const char *url);

/* Whether a request that names itself so comes from our page, or from an
 * address that somebody typed. */
bool otx_door_is_ours(const otx_door *door, const otx_door_names *names);

#endif
